// SPDX-License-Identifier: MIT
// Path tracing (Kajiya 1986, "The Rendering Equation") from the eye: at every surface one light of the table
// is sampled and one direction of the BRDF, joined by multiple importance sampling with the power heuristic
// (Veach and Guibas 1995, "Optimally Combining Sampling Techniques for Monte Carlo Rendering"). Paths end by
// Russian roulette with their throughput as the probability (Arvo and Kirk 1990, "Particle Transport and
// Image Synthesis"), which keeps the mean. Nothing is clamped.
//
// What is direct light is the question of two visibilities: direct light (lights of the scene, flat emissive
// quads) is blocked by instances with castsShadow, all other light by voxelized ones. Where the two sets
// differ, flat quads are met analytically instead of as triangles.
//
// Surfaces reflect nothing to or from below their geometric horizon, whatever the shading normal says; light
// below the shading normal's is zero by the BRDF. Interpolated normals so lose a little energy near
// silhouettes of coarse meshes; the shadow maps of the GL modes lose the same of direct light.
#include "reference/path_integrator.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace conelight::reference {
namespace {

constexpr float kPi = 3.14159265358979f;
// Paths live on with at least this probability, so that no survivor weighs more than twenty.
constexpr float kLeastSurvival = 0.05f;
// And end with at least one in fifty, or a closed white room would keep them for ever.
constexpr float kMostSurvival = 0.98f;
// Rays towards a point end by this share of their length before it.
constexpr float kRayEnd = 1 - 1e-5f;

float largest(const glm::vec3& v) { return std::max({v.r, v.g, v.b}); }

// Power heuristic, exponent 2. An infinite own density is certain.
float misWeight(float own, float other) {
    const float ratio = other / own;
    return 1.0f / (1.0f + ratio * ratio);
}

glm::vec3 shareOf(const glm::vec3& part, const glm::vec3& whole) {
    return {whole.r > 0 ? part.r / whole.r : 0, whole.g > 0 ? part.g / whole.g : 0,
            whole.b > 0 ? part.b / whole.b : 0};
}

bool allFinite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace

void PathSample::clear() {
    direct = diffuse = specular = glm::vec3(0);
    std::fill(bounces.begin(), bounces.end(), glm::vec3(0));
    seen = false;
}

bool PathSample::finite() const { return allFinite(direct) && allFinite(diffuse) && allFinite(specular); }

PathIntegrator::PathIntegrator(const Scene& scene, const RayScene& rays, const PathTracerSettings& settings)
    : scene_(scene),
      rays_(rays),
      settings_(settings),
      lights_(scene, settings.emissiveQuads, settings.estimator != Estimator::MaterialsOnly),
      surroundings_(scene) {}

void PathIntegrator::add(PathSample& result, const Vertex& vertex, int bounce, const glm::vec3& light,
                         const Reflection::Value& value) {
    const glm::vec3 radiance = vertex.throughput * light;
    if (bounce == 0) {
        result.direct += radiance;
        return;
    }
    const glm::vec3 share = vertex.depth == 0 ? shareOf(value.diffuse, value.sum()) : vertex.diffuseShare;
    result.diffuse += radiance * share;
    result.specular += radiance * (1.0f - share);
    if (static_cast<std::size_t>(bounce) <= result.bounces.size())
        result.bounces[static_cast<std::size_t>(bounce) - 1] += radiance;
}

bool PathIntegrator::arrives(const Vertex& vertex, const LightSample& light, PathSample& result) const {
    if (light.direct && !light.castsShadow && !light.extended) return true;
    const Surface& s = vertex.surface;
    const bool above = glm::dot(s.geometricNormal, light.toLight) > 0;
    // A surface is in its own way, unless it casts no shadow.
    if (!above && (light.extended || scene_.instances[vertex.instance].castsShadow)) return false;
    if (light.direct && !light.castsShadow) return true;
    Ray ray;
    ray.origin = RayScene::offsetOrigin(s.position, above ? s.geometricNormal : -s.geometricNormal);
    ray.direction = light.toLight;
    if (std::isfinite(light.distance)) {
        const glm::vec3 way = light.target - ray.origin;
        const float distance = glm::length(way);
        if (!(distance > 0)) return true;
        ray.direction = way / distance;
        ray.tMax = distance * kRayEnd;
    }
    ++result.rays;
    return !rays_.occluded(light.direct ? RayKind::Shadow : RayKind::Bounce, ray);
}

void PathIntegrator::gatherLights(const Vertex& vertex, const Reflection& reflection, Sampler& sampler,
                                  PathSample& result) const {
    if (vertex.lights.each) {
        for (std::size_t group = 0; group < lights_.groupCount(); ++group) {
            const float within = sampler.next2().x;
            gatherGroup(vertex, reflection, group, within, sampler.next2(), result);
        }
        return;
    }
    float number = sampler.next2().x;
    const std::size_t group = lights_.groupOf(vertex.lights, number);
    const glm::vec2 u = sampler.next2();
    if (group < lights_.groupCount()) gatherGroup(vertex, reflection, group, number, u, result);
}

void PathIntegrator::gatherGroup(const Vertex& vertex, const Reflection& reflection, std::size_t group,
                                 float within, const glm::vec2& u, PathSample& result) const {
    LightSample light;
    if (!lights_.sample(vertex.lights, group, vertex.surface.position, within, u, light)) return;
    const int bounce = vertex.depth + (light.direct ? 0 : 1);
    if (!wanted(bounce)) return;
    const Reflection::Value value = reflection.evaluate(light.toLight);
    if (!(largest(value.sum()) > 0)) return;
    float weight = 1;
    if (light.extended && settings_.estimator == Estimator::Mis)
        weight = misWeight(light.density, value.density);
    if (arrives(vertex, light, result))
        add(result, vertex, bounce, light.radiance * value.sum() * (weight / light.density), value);
}

// Light of the surroundings from a direction drawn for it: of a picture by its light, else of the hemisphere.
void PathIntegrator::gatherSky(const Vertex& vertex, const Reflection& reflection, const glm::vec2& u,
                               PathSample& result) const {
    if (!wanted(vertex.depth + 1) || surroundings_.isBlack()) return;
    LightSample sky;
    sky.distance = std::numeric_limits<float>::infinity();
    sky.extended = true;
    sky.density = 1 / (2 * kPi);
    if (surroundings_.hasPicture()) {
        const scene::Surroundings::Draw drawn = surroundings_.draw(u);
        sky.toLight = drawn.direction;
        sky.density = drawn.density;
    } else {
        sky.toLight = uniformHemisphere(vertex.surface.shadingNormal, u);
    }
    const Reflection::Value value = reflection.evaluate(sky.toLight);
    if (!(sky.density > 0) || !(largest(value.sum()) > 0) || !arrives(vertex, sky, result)) return;
    const float weight = settings_.estimator == Estimator::Mis ? misWeight(sky.density, value.density) : 1.0f;
    add(result, vertex, vertex.depth + 1,
        surroundings_.radiance(sky.toLight) * value.sum() * (weight / sky.density), value);
}

// Of a direction that the surface's reflection has drawn, when the surroundings are drawn as well.
float PathIntegrator::skyWeight(const glm::vec3& direction, const Reflection::Value& value) const {
    if (settings_.estimator != Estimator::Mis || !surroundings_.hasPicture()) return 1.0f;
    return misWeight(value.density, surroundings_.density(direction));
}

bool PathIntegrator::arriveAt(Vertex& vertex, const Ray& ray, const Reflection::Value& value,
                              PathSample& result) const {
    const bool lightsOnly = settings_.estimator == Estimator::LightsOnly;
    const bool mis = settings_.estimator == Estimator::Mis;
    const glm::vec3 reflected = value.sum() / value.density;

    // Rectangles that are no triangles, or block other light than they are blocked by.
    if (!lightsOnly && lights_.hasRectsToTest())
        lights_.forRectsAlong(
            vertex.lights, vertex.surface.position, ray.direction, [&](const LightSample& rect) {
                const float weight = mis ? misWeight(value.density, rect.density) : 1.0f;
                if (arrives(vertex, rect, result))
                    add(result, vertex, vertex.depth, rect.radiance * reflected * weight, value);
            });

    ++result.rays;
    RayHit hit;
    if (!rays_.intersect(RayKind::Bounce, ray, hit)) {
        if (!lightsOnly && wanted(vertex.depth + 1))
            add(result, vertex, vertex.depth + 1,
                surroundings_.radiance(ray.direction) * reflected * skyWeight(ray.direction, value), value);
        return false;
    }
    const Surface next = surfaceAt(scene_, ray, hit);
    if (next.unlit) return false;  // is seen, and lights nothing
    const LightTable::Found found = lights_.found(vertex.lights, hit, ray.direction);
    const int bounce = vertex.depth + (found.quad ? 0 : 1);
    if (!lightsOnly && !(found.quad && found.elsewhere) && wanted(bounce) && largest(next.emission) > 0)
        add(result, vertex, bounce,
            next.emission * reflected *
                (mis && found.density > 0 ? misWeight(value.density, found.density) : 1),
            value);

    // The back of a single-sided surface absorbs.
    if (!wanted(vertex.depth + 1) || (!next.frontFace && !next.material->doubleSided)) return false;
    if (vertex.depth == 0) vertex.diffuseShare = shareOf(value.diffuse, value.sum());
    vertex.throughput *= reflected;
    vertex.surface = next;
    vertex.toEye = -ray.direction;
    vertex.instance = hit.instance;
    ++vertex.depth;
    return true;
}

bool PathIntegrator::advance(Vertex& vertex, const Reflection& reflection, const glm::vec2& choices,
                             const glm::vec2& u, PathSample& result) const {
    const bool last = !wanted(vertex.depth + 1);
    // The last direction only looks for direct light.
    if (last && (settings_.estimator == Estimator::LightsOnly || !lights_.hasQuadsOrRects())) return false;
    Ray ray;
    ray.direction = glm::normalize(reflection.sample(choices.x, u));
    if (!(glm::dot(ray.direction, vertex.surface.geometricNormal) > 0)) return false;
    const Reflection::Value value = reflection.evaluate(ray.direction);
    if (!(value.density > 0) || !(largest(value.sum()) > 0)) return false;

    // Russian roulette, not on the first surface, where it would only add noise.
    if (vertex.depth > 0) {
        const float survival = std::clamp(largest(vertex.throughput * value.sum() / value.density),
                                          kLeastSurvival, kMostSurvival);
        if (!(choices.y < survival)) return false;
        vertex.throughput /= survival;
    }
    ray.origin = RayScene::offsetOrigin(vertex.surface.position, vertex.surface.geometricNormal);
    return arriveAt(vertex, ray, value, result);
}

void PathIntegrator::trace(const Ray& cameraRay, const PixelTurns* pixel, Sampler& sampler,
                           PathSample& result) const {
    ++result.rays;
    RayHit hit;
    if (!rays_.intersect(RayKind::Camera, cameraRay, hit)) {
        result.direct = surroundings_.radiance(glm::normalize(cameraRay.direction));
        return;
    }
    result.seen = true;
    Vertex vertex;
    // Untextured surfaces take no number: their samples stay what they are.
    glm::vec3 turn(0);
    if (pixel != nullptr && isTextured(scene_, hit)) {
        const glm::vec2 inPixel = sampler.next2() - 0.5f;
        turn = inPixel.x * (*pixel)[0] + inPixel.y * (*pixel)[1];
    }
    vertex.surface = surfaceAt(scene_, cameraRay, hit, turn);
    vertex.instance = hit.instance;
    result.direct = vertex.surface.emission;
    vertex.toEye = -cameraRay.direction;
    for (bool goesOn = !vertex.surface.unlit; goesOn;) {
        const Reflection reflection(vertex.surface, vertex.toEye);
        if (reflection.black()) return;
        const glm::vec2 choices = sampler.next2(), direction = sampler.next2();
        lights_.choose(vertex.surface.position, vertex.surface.shadingNormal, vertex.depth == 0,
                       vertex.lights);
        gatherLights(vertex, reflection, sampler, result);
        const bool drawsSky = surroundings_.hasPicture() ? settings_.estimator != Estimator::MaterialsOnly
                                                         : settings_.estimator == Estimator::LightsOnly;
        if (drawsSky) gatherSky(vertex, reflection, sampler.next2(), result);
        goesOn = advance(vertex, reflection, choices, direction, result);
    }
}

}  // namespace conelight::reference
