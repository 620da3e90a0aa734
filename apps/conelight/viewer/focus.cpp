// SPDX-License-Identifier: MIT
#include "viewer/focus.h"

#include "viewer/camera_control.h"

namespace conelight::program {

void focusOnSelection(Session& session, const glm::ivec2& pictureSize) {
    const Scene& scene = session.scene();
    Aabb bounds = scene.bounds();
    if (session.selection().kind == SelectionKind::Instance) {
        const Instance& instance = scene.instances[session.selection().index];
        bounds = scene.meshes[static_cast<std::size_t>(instance.mesh)].bounds().transformed(
            instance.worldFromObject);
    }
    Camera camera = session.camera();
    const glm::ivec2 size = glm::max(pictureSize, glm::ivec2(1));
    focusOn(camera, bounds, static_cast<float>(size.x) / static_cast<float>(size.y));
    session.jumpCamera(camera, "focus");
}

}  // namespace conelight::program
