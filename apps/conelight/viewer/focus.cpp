// SPDX-License-Identifier: MIT
#include "viewer/focus.h"

#include "viewer/camera_control.h"

namespace conelight::program {

Aabb selectedBounds(const Session& session) {
    const Scene& scene = session.scene();
    Aabb all;
    for (const Selection& what : session.selected()) {
        if (what.kind == SelectionKind::Instance) {
            const Instance& instance = scene.instances[what.index];
            all.grow(scene.meshes[static_cast<std::size_t>(instance.mesh)].bounds().transformed(
                instance.worldFromObject));
        } else if (what.kind == SelectionKind::Light &&
                   scene.lights[what.index].type != LightType::Directional) {
            // A lamp is a point: what is around it is seen.
            const Light& light = scene.lights[what.index];
            const glm::vec3 around(0.05f * glm::length(scene.bounds().extent()));
            all.grow(light.position - around);
            all.grow(light.position + around);
        }
    }
    return all.empty() ? scene.bounds() : all;
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
