// SPDX-License-Identifier: MIT
#include "reference/arriving_light.h"

#include <cmath>

#include "scene/emissive_quads.h"

namespace conelight::reference {
namespace {

PathTracerSettings tracerSettings(const ArrivingLight::Settings& settings) {
    PathTracerSettings result;
    result.samplesPerPixel = settings.samples;
    result.bounces = settings.bounces < 0 ? -1 : settings.bounces - 1;
    result.seed = settings.seed;
    result.smallLamps = false;  // hosts know of none
    return result;
}

}  // namespace

ArrivingLight::ArrivingLight(const Scene& scene, const Settings& settings)
    : scene_(scene),
      rays_(scene),
      settings_(tracerSettings(settings)),
      integrator_(scene, rays_, settings_),
      surroundings_(scene),
      isQuad_(scene.instances.size(), false) {
    for (const scene::EmissiveQuad& quad : scene::emissiveQuads(scene)) isQuad_[quad.instance] = true;
}

Arriving ArrivingLight::meet(const glm::vec3& origin, const glm::vec3& direction, RayHit& hit) const {
    Arriving result;
    const Ray ray{.origin = origin, .direction = direction};
    result.distance = INFINITY;
    if (!rays_.intersect(RayKind::Bounce, ray, hit)) return result;
    result.distance = hit.t;
    const Surface surface = surfaceAt(scene_, ray, hit);
    result.back = !surface.frontFace && surface.material != nullptr && !surface.material->doubleSided;
    return result;
}

Arriving ArrivingLight::arriving(const glm::vec3& origin, const glm::vec3& direction, Sampler& sampler,
                                 PathSample& path) const {
    RayHit hit;
    Arriving result = meet(origin, direction, hit);
    if (!std::isfinite(result.distance)) {
        result.radiance = surroundings_.radiance(direction);
        return result;
    }
    if (result.back) return result;
    Ray ray{.origin = origin, .direction = direction};
    ray.tMin = hit.t * (1 - 1e-4f);
    path.clear();
    integrator_.trace(ray, nullptr, sampler, path);
    if (!path.finite()) return result;
    result.radiance = path.direct + path.diffuse + path.specular;
    if (isQuad_[hit.instance])
        result.radiance = glm::max(result.radiance - surfaceAt(scene_, ray, hit).emission, glm::vec3(0));
    return result;
}

}  // namespace conelight::reference
