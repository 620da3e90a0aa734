// SPDX-License-Identifier: MIT
#include "session/picker.h"

#include "reference/surface.h"
#include "session/projection.h"

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
    const ViewRay ray = viewRay(camera, aspect, ndc);
    return along(session, ray.origin, ray.direction, camera.zNear * ray.perDepth);
}

}  // namespace conelight::program
