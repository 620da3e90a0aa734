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

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace conelight::reference {
namespace {

// Paths live on with at least this probability, so that no survivor weighs more than twenty.
constexpr float kLeastSurvival = 0.05f;
// And end with at least one in fifty, or a closed white room would keep them for ever.
constexpr float kMostSurvival = 0.98f;
// Rays towards a point end by this share of their length before it.
// Rays through panes and blended surfaces go on this far behind them, m and share of the way.
constexpr float kPaneStep = 1e-5f;
constexpr int kMostPanes = 64;  // on one ray; then it is dark

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
    albedo = gloss = emission = normal = glm::vec3(0);
    distance = 0;
}

bool PathSample::finite() const { return allFinite(direct) && allFinite(diffuse) && allFinite(specular); }

PathIntegrator::PathIntegrator(const Scene& scene, const RayScene& rays, const PathTracerSettings& settings)
    : scene_(scene),
      rays_(rays),
      settings_(settings),
      lights_(scene, {settings.emissiveQuads, settings.smallLamps},
              settings.estimator != Estimator::MaterialsOnly),
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

// What is left of a light's radiance on its way to a surface. `through`: the surface has a use for light from
// behind it. Light of extended sources that solids and rough panes bend is found by paths alone; light without
// extent, which no path would meet, goes straight through them.
glm::vec3 PathIntegrator::arriving(const Vertex& vertex, const LightSample& light, bool through,
                                   PathSample& result) const {
    const glm::vec3 all(1), none(0);
    if (light.direct && !light.castsShadow && !light.extended) return all;
    const Surface& s = vertex.surface;
    const bool above = glm::dot(s.geometricNormal, light.toLight) > 0;
    // A surface is in its own way, unless it casts no shadow.
    if (!above && !through && (light.extended || scene_.instances[vertex.instance].castsShadow)) return none;
    if (light.direct && !light.castsShadow) return all;
    Ray ray;
    ray.origin = RayScene::offsetOrigin(s.position, above ? s.geometricNormal : -s.geometricNormal);
    ray.direction = light.toLight;
    if (std::isfinite(light.distance)) {
        const glm::vec3 way = light.target - ray.origin;
        const float distance = glm::length(way);
        if (!(distance > 0)) return all;
        ray.direction = way / distance;
        ray.tMax = distance * kRayEnd;
    }
    ++result.rays;
    return rays_.transmittance(light.direct ? RayKind::Shadow : RayKind::Bounce, ray, !light.extended);
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
    if (!wanted(vertex, bounce)) return;
    const Reflection::Value value = reflection.evaluate(light.toLight);
    if (!(largest(value.sum()) > 0)) return;
    float weight = 1;
    if (light.extended && settings_.estimator == Estimator::Mis)
        weight = misWeight(light.density, value.density);
    const glm::vec3 left = arriving(vertex, light, reflection.scattersThrough(), result);
    if (left != glm::vec3(0))
        add(result, vertex, bounce, left * light.radiance * value.sum() * (weight / light.density), value);
}

// Light of the surroundings from a direction drawn for it: of a picture by its light, else of the hemisphere.
void PathIntegrator::gatherSky(const Vertex& vertex, const Reflection& reflection, const glm::vec2& u,
                               PathSample& result) const {
    if (!wanted(vertex, vertex.depth + 1) || surroundings_.isBlack()) return;
    LightSample sky;
    sky.distance = std::numeric_limits<float>::infinity();
    sky.extended = true;
    sky.density = 1 / (2 * glm::pi<float>());
    if (surroundings_.hasPicture()) {
        const scene::Surroundings::Draw drawn = surroundings_.draw(u);
        sky.toLight = drawn.direction;
        sky.density = drawn.density;
    } else {
        sky.toLight = uniformHemisphere(vertex.surface.shadingNormal, u);
    }
    const Reflection::Value value = reflection.evaluate(sky.toLight);
    if (!(sky.density > 0) || !(largest(value.sum()) > 0)) return;
    const glm::vec3 left = arriving(vertex, sky, reflection.scattersThrough(), result);
    if (left == glm::vec3(0)) return;
    const float weight = settings_.estimator == Estimator::Mis ? misWeight(sky.density, value.density) : 1.0f;
    add(result, vertex, vertex.depth + 1,
        left * surroundings_.radiance(sky.toLight) * value.sum() * (weight / sky.density), value);
}

// Of a direction that the surface's reflection has drawn, when the surroundings are drawn as well.
float PathIntegrator::skyWeight(const Vertex& vertex, const glm::vec3& direction,
                                const Reflection::Value& value) const {
    if (settings_.estimator != Estimator::Mis || !surroundings_.hasPicture() || vertex.alone) return 1.0f;
    return misWeight(value.density, surroundings_.density(direction));
}

// Features of the first surface that is more than a mirror.
void PathIntegrator::mark(Vertex& vertex, const Reflection& reflection, PathSample& result) {
    const Surface& s = vertex.surface;
    const glm::vec3 albedo = s.baseColor * ((1 - s.metallic) * (1 - s.transmission));
    const bool mirror = reflection.mirrorShare() != glm::vec3(0) && !s.layered();
    if (mirror && !(largest(albedo) > 0)) return;
    vertex.unmarked = false;
    const glm::vec3 seen = vertex.throughput;
    const glm::vec3 gloss =
        seen * (glm::mix(s.dielectricF0, s.baseColor, s.metallic) + s.coat * math::kCoatF0 + s.sheenColor);
    const bool first = vertex.depth == 0;
    result.albedo = first ? seen * albedo : glm::vec3(0);
    result.gloss = first ? gloss : seen * albedo + gloss;
    result.normal = s.shadingNormal;
    result.distance = vertex.distance;
}

// The first surface along a ray. At blended surfaces and smooth panes a number decides whether it goes on.
bool PathIntegrator::find(RayKind kind, Ray ray, const PixelTurns* pixel, Sampler& sampler,
                          Arrival& arrival) const {
    for (int panes = 0; panes < kMostPanes; ++panes) {
        if (!rays_.intersect(kind, ray, arrival.hit, Blended::Met)) return false;
        // Untextured surfaces take no number: their samples stay what they are.
        glm::vec3 turn(0);
        if (pixel != nullptr && isTextured(scene_, arrival.hit)) {
            const glm::vec2 inPixel = sampler.next2() - 0.5f;
            turn = inPixel.x * pixel->steps[0] + inPixel.y * pixel->steps[1];
            if (pixel->parallel) turn /= arrival.hit.t;
        }
        arrival.surface = surfaceAt(scene_, ray, arrival.hit, turn);
        const Surface& met = arrival.surface;
        ray.tMin = arrival.hit.t + std::max(kPaneStep, kPaneStep * arrival.hit.t);
        if (met.opacity < 1 && !(sampler.next2().x < met.opacity)) continue;
        if (!passesStraight(met)) return true;
        const StraightPass pass = straightPass(met, -ray.direction);
        if (!(sampler.next2().x < pass.share)) {
            arrival.passed /= 1 - pass.share;
            return true;
        }
        arrival.passed *= pass.transmittance / pass.share;
    }
    arrival.passed = glm::vec3(0);
    return true;
}

bool PathIntegrator::arriveAt(Vertex& vertex, const Ray& ray, const Reflection::Value& value,
                              Sampler& sampler, PathSample& result) const {
    const bool lightsOnly = settings_.estimator == Estimator::LightsOnly && !vertex.alone;
    const bool mis = settings_.estimator == Estimator::Mis && !vertex.alone;
    glm::vec3 reflected = value.sum() / value.density;

    // Rectangles that are no triangles, or block other light than they are blocked by.
    if (!lightsOnly && lights_.hasRectsToTest())
        lights_.forRectsAlong(
            vertex.lights, vertex.surface.position, ray.direction, [&](const LightSample& rect) {
                const float weight = mis ? misWeight(value.density, rect.density) : 1.0f;
                const glm::vec3 left = arriving(vertex, rect, true, result);
                if (left != glm::vec3(0))
                    add(result, vertex, vertex.depth, left * rect.radiance * reflected * weight, value);
            });

    ++result.rays;
    Arrival arrival;
    if (!find(RayKind::Bounce, ray, nullptr, sampler, arrival)) {
        if (!lightsOnly && wanted(vertex, vertex.depth + 1))
            add(result, vertex, vertex.depth + 1,
                arrival.passed * surroundings_.radiance(ray.direction) * reflected *
                    skyWeight(vertex, ray.direction, value),
                value);
        return false;
    }
    const Surface& next = arrival.surface;
    if (next.unlit) return false;  // is seen, and lights nothing
    reflected *= arrival.passed;
    if (vertex.medium != nullptr) reflected *= glm::exp(-absorption(*vertex.medium) * arrival.hit.t);
    const LightTable::Found found = lights_.found(vertex.lights, arrival.hit, ray.direction);
    const int bounce = vertex.depth + (found.direct ? 0 : 1);
    if (!lightsOnly && !found.elsewhere && wanted(vertex, bounce) && largest(next.emission) > 0)
        add(result, vertex, bounce,
            next.emission * reflected *
                (mis && found.density > 0 ? misWeight(value.density, found.density) : 1),
            value);

    // The back of a single-sided surface absorbs, unless light goes through it.
    const bool absorbs = !next.frontFace && !next.material->doubleSided && !(next.transmission > 0);
    if (!wanted(vertex, vertex.depth + 1) || absorbs) return false;
    if (vertex.depth == 0) vertex.diffuseShare = shareOf(value.diffuse, value.sum());
    vertex.throughput *= reflected;
    vertex.surface = next;
    vertex.distance += arrival.hit.t;
    vertex.toEye = -ray.direction;
    vertex.instance = arrival.hit.instance;
    vertex.mirrored = false;
    ++vertex.depth;
    return true;
}

// `numbers`: the lobe and the path's end, the direction.
bool PathIntegrator::advance(Vertex& vertex, const Reflection& reflection,
                             const std::array<glm::vec2, 2>& numbers, Sampler& sampler,
                             PathSample& result) const {
    const bool last = !wanted(vertex.depth + 1);
    // The last direction only looks for direct light, which mirrors alone find in every way of finding it.
    const bool looks =
        settings_.estimator != Estimator::LightsOnly || reflection.mirrorShare() != glm::vec3(0);
    if (last && !(looks && lights_.hasExtendedLamps())) return false;
    const Reflection::Draw drawn = reflection.draw(numbers[0].x, numbers[1]);
    Ray ray;
    ray.direction = drawn.direction;
    const float above = glm::dot(ray.direction, vertex.surface.geometricNormal);
    if (!(drawn.below ? above < 0 : above > 0)) return false;
    const Reflection::Value value = drawn.alone ? drawn.value : reflection.evaluate(ray.direction);
    if (!(value.density > 0) || !(largest(value.sum()) > 0)) return false;

    // Russian roulette, not on the first surface, where it would only add noise.
    if (vertex.depth > 0) {
        const float survival = std::clamp(largest(vertex.throughput * value.sum() / value.density),
                                          kLeastSurvival, kMostSurvival);
        if (!(numbers[0].y < survival)) return false;
        vertex.throughput /= survival;
    }
    vertex.alone = drawn.alone || reflection.inside();
    vertex.mirrored = drawn.mirrored;
    if (drawn.below && vertex.surface.solid)
        vertex.medium = vertex.surface.frontFace ? vertex.surface.material : nullptr;
    const glm::vec3& normal = vertex.surface.geometricNormal;
    ray.origin = RayScene::offsetOrigin(vertex.surface.position, drawn.below ? -normal : normal);
    return arriveAt(vertex, ray, value, sampler, result);
}

// Light that is looked for. Within a solid there is none.
void PathIntegrator::gather(Vertex& vertex, const Reflection& reflection, Sampler& sampler,
                            PathSample& result) const {
    lights_.choose(vertex.surface.position, vertex.surface.shadingNormal, vertex.depth == 0, vertex.lights);
    if (reflection.inside()) return;
    if (reflection.scattersThrough())
        lights_.chooseBothSides(vertex.surface.position, vertex.surface.shadingNormal, vertex.lights);
    gatherLights(vertex, reflection, sampler, result);
    const bool drawsSky = surroundings_.hasPicture() ? settings_.estimator != Estimator::MaterialsOnly
                                                     : settings_.estimator == Estimator::LightsOnly;
    if (drawsSky) gatherSky(vertex, reflection, sampler.next2(), result);
}

void PathIntegrator::trace(const Ray& cameraRay, const PixelTurns* pixel, Sampler& sampler,
                           PathSample& result) const {
    ++result.rays;
    Arrival arrival;
    if (!find(RayKind::Camera, cameraRay, pixel, sampler, arrival)) {
        result.direct = arrival.passed * surroundings_.radiance(glm::normalize(cameraRay.direction));
        result.emission = result.direct;
        return;
    }
    result.seen = true;
    Vertex vertex;
    vertex.surface = arrival.surface;
    vertex.instance = arrival.hit.instance;
    vertex.throughput = arrival.passed;
    vertex.distance = result.distance = arrival.hit.t;
    result.normal = vertex.surface.shadingNormal;
    vertex.toEye = -cameraRay.direction;
    const float seen = shareBelowLayers(vertex.surface, vertex.toEye);
    result.direct = result.emission = arrival.passed * vertex.surface.emission * seen;
    if (!vertex.surface.unlit) follow(vertex, sampler, result);
}

void PathIntegrator::reflectedAt(const Surface& surface, std::uint32_t instance, Sampler& sampler,
                                 PathSample& result) const {
    Vertex vertex;
    vertex.surface = surface;
    vertex.instance = instance;
    vertex.toEye = surface.shadingNormal;
    follow(vertex, sampler, result);
}

void PathIntegrator::follow(Vertex& vertex, Sampler& sampler, PathSample& result) const {
    for (bool goesOn = true; goesOn;) {
        const Reflection reflection(vertex.surface, vertex.toEye);
        if (reflection.black()) return;
        if (vertex.unmarked) mark(vertex, reflection, result);
        const glm::vec2 choices = sampler.next2(), direction = sampler.next2();
        gather(vertex, reflection, sampler, result);
        goesOn = advance(vertex, reflection, {choices, direction}, sampler, result);
    }
}

}  // namespace conelight::reference
