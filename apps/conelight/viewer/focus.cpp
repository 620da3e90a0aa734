// SPDX-License-Identifier: MIT
#include "viewer/focus.h"

#include "viewer/camera_control.h"

namespace conelight::program {

Aabb selectedBounds(const Session& session) {
    const Scene& scene = session.scene();
    if (session.selection().kind != SelectionKind::Instance) return scene.bounds();
    const Instance& instance = scene.instances[session.selection().index];
    return scene.meshes[static_cast<std::size_t>(instance.mesh)].bounds().transformed(
        instance.worldFromObject);
}

float aspectOf(const glm::ivec2& pictureSize) {
    const glm::vec2 size = glm::max(pictureSize, glm::ivec2(1));
    return size.x / size.y;
}

void focusOnSelection(Session& session, const glm::ivec2& pictureSize) {
    Camera camera = session.camera();
    focusOn(camera, selectedBounds(session), aspectOf(pictureSize));
    session.jumpCamera(camera, "focus");
}

}  // namespace conelight::program
