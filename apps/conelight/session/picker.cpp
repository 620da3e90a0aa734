// SPDX-License-Identifier: MIT
#include "session/picker.h"

#include <cmath>

#include "reference/surface.h"

namespace conelight::program {

struct Picker::Impl {
    std::optional<reference::RayScene> rays;
    const Session* session = nullptr;
    std::uint64_t revision = 0;

    const reference::RayScene& raysOf(const Session& wanted) {
        const std::uint64_t now = wanted.revisions().rayTables();
        if (!rays || session != &wanted || revision != now) {
            rays.reset();
            rays.emplace(wanted.scene());
            session = &wanted;
            revision = now;
        }
        return *rays;
    }
};

Picker::Picker() : impl_(std::make_unique<Impl>()) {}
Picker::~Picker() = default;

std::optional<Pick> Picker::along(const Session& session, const glm::vec3& origin, const glm::vec3& direction,
                                  float tMin) {
    const reference::Ray ray{origin, glm::normalize(direction), tMin};
    reference::RayHit hit;
    if (!impl_->raysOf(session).intersect(reference::RayKind::Camera, ray, hit)) return std::nullopt;
    const reference::Surface surface = reference::surfaceAt(session.scene(), ray, hit);
    const Instance& instance = session.scene().instances[hit.instance];
    Pick pick;
    // Not the surface's own point, which path tracing keeps away from edges.
    pick.position = origin + hit.t * ray.direction;
    pick.normal = surface.geometricNormal;
    pick.shadingNormal = surface.shadingNormal;
    pick.distance = hit.t;
    pick.instance = hit.instance;
    pick.material = instance.material;
    pick.triangle = hit.triangle;
    pick.barycentric = hit.barycentric;
    pick.object = instance.name;
    return pick;
}

std::optional<Pick> Picker::atPixel(const Session& session, int width, int height, int x, int y) {
    const glm::vec2 ndc(2 * (static_cast<float>(x) + 0.5f) / static_cast<float>(width) - 1,
                        1 - 2 * (static_cast<float>(y) + 0.5f) / static_cast<float>(height));
    const float aspect = static_cast<float>(width) / static_cast<float>(height);
    const Camera& camera = session.camera();
    const glm::vec3 direction = rayDirection(camera, aspect, ndc);
    const float along = glm::dot(direction, rayDirection(camera, aspect, glm::vec2(0)));
    return this->along(session, camera.eye, direction, camera.zNear / along);
}

glm::vec3 rayDirection(const Camera& camera, float aspect, const glm::vec2& ndc) {
    // The same axes as the renderer's (src/view/camera.cpp), also where view and up are parallel.
    const glm::dvec3 view = glm::dvec3(camera.target) - glm::dvec3(camera.eye);
    const glm::dvec3 forward = glm::length(view) > 0 ? glm::normalize(view) : glm::dvec3(0, 0, -1);
    glm::dvec3 side = glm::cross(forward, glm::dvec3(camera.up));
    if (!(glm::length(side) > 1e-6 * glm::length(glm::dvec3(camera.up)))) {
        const glm::dvec3 away = glm::abs(forward);
        const glm::dvec3 up = away.y <= away.x && away.y <= away.z ? glm::dvec3(0, 1, 0)
                              : away.z <= away.x                   ? glm::dvec3(0, 0, -1)
                                                                   : glm::dvec3(1, 0, 0);
        side = glm::cross(forward, up);
    }
    side = glm::normalize(side);
    const glm::dvec3 up = glm::cross(side, forward);
    const double half = std::tan(0.5 * static_cast<double>(camera.fovY));
    return glm::vec3(glm::normalize(forward + half * (static_cast<double>(ndc.x) * double(aspect) * side +
                                                      static_cast<double>(ndc.y) * up)));
}

}  // namespace conelight::program
