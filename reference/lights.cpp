// SPDX-License-Identifier: MIT
#include "reference/lights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "math/disc.h"
#include "reference/sphere_light.h"
#include "reference/surface.h"
#include "scene/emissive_quads.h"
#include "scene/small_lamps.h"

namespace conelight::reference {
namespace {

double preciseLuminance(const glm::vec3& c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; }

// shaders/lib/lights.glsl, distanceFalloff.
float distanceFalloff(const Light& light, float d2) {
    const float d = std::sqrt(d2);
    const float falloff = light.customFalloff
                              ? 1.0f / (light.falloff.x + light.falloff.y * d + light.falloff.z * d2)
                              : 1.0f / std::max(d2, 1e-6f);
    const float ratio = light.range > 0 ? d2 / (light.range * light.range) : 0.0f;
    return falloff * std::clamp(1.0f - ratio * ratio, 0.0f, 1.0f);
}

// shaders/lib/lights.glsl, spotFalloff.
float spotFalloff(float cosine, float cosInner, float cosOuter) {
    const float t = std::clamp((cosine - cosOuter) / std::max(cosInner - cosOuter, 1e-3f), 0.0f, 1.0f);
    return t * t;
}

// Of a spot; of a point light, which shines everywhere, the cosines are below -1.
struct SpotCone {
    glm::vec3 axis{0};
    float cosInner = -2, cosOuter = -3;
};

bool pointLight(const Light& light, const SpotCone& spot, const glm::vec3& from, LightSample& result) {
    const glm::vec3 l = light.position - from;
    const float d2 = glm::dot(l, l);
    if (!(d2 > 1e-20f)) return false;
    result.distance = std::sqrt(d2);
    result.toLight = l / result.distance;
    result.target = light.position;
    result.radiance =
        light.intensity * (distanceFalloff(light, d2) *
                           spotFalloff(-glm::dot(result.toLight, spot.axis), spot.cosInner, spot.cosOuter) *
                           intensityFactor(light, -result.toLight));
    return result.radiance.r + result.radiance.g + result.radiance.b > 0;
}

glm::vec3 unitOrDown(const glm::vec3& v) {
    const float length = glm::length(v);
    return length > 0 ? v / length : glm::vec3(0, -1, 0);
}

// Lattice of barycentric coordinates at which textured emission is averaged: cell centres of 2 x kEdge^2
// triangles would be finer than the choice of a light needs; 8 x 8 points see a texture's large features.
constexpr int kEmissionEdge = 8;
// A textured emitter is chosen at least as often as if this part of it shone: the lattice may have missed it.
constexpr double kLeastEmission = 0.01;

glm::vec3 meanEmission(const Scene& scene, std::uint32_t instance, std::uint32_t triangle) {
    glm::vec3 sum(0);
    for (int y = 0; y < kEmissionEdge; ++y)
        for (int x = 0; x < kEmissionEdge; ++x) {
            // The unit square folded onto the triangle.
            glm::vec2 b((glm::vec2(x, y) + 0.5f) / static_cast<float>(kEmissionEdge));
            if (b.x + b.y > 1) b = 1.0f - b;
            sum += emissionAt(scene, instance, triangle, b);
        }
    return sum / static_cast<float>(kEmissionEdge * kEmissionEdge);
}

}  // namespace

bool sampleLight(const Light& light, const glm::vec3& from, LightSample& result) {
    const glm::vec3 axis = unitOrDown(light.direction);
    if (light.type == LightType::Spot)
        return pointLight(light, {axis, std::cos(light.innerAngle), std::cos(light.outerAngle)}, from,
                          result);
    if (light.type == LightType::Point) return pointLight(light, {axis}, from, result);
    if (hasArea(light.type)) return false;
    result.toLight = -axis;
    result.distance = std::numeric_limits<float>::infinity();
    result.radiance = light.intensity;
    return true;
}

LightTable::LightTable(const Scene& scene, DirectEmitters direct, bool extended)
    : scene_(scene), ofInstance_(scene.instances.size()) {
    sceneRadius_ = std::max(0.5f * glm::length(scene.bounds().extent()), 1e-6f);
    for (const Instance& instance : scene.instances)
        if (instance.visible && instance.mesh >= 0 && instance.voxelized != instance.castsShadow)
            sameBlockers_ = false;
    for (const Light& light : scene.lights)
        if (light.enabled) addLight(light);
    if (direct.quads)
        for (const scene::EmissiveQuad& quad : scene::emissiveQuads(scene)) {
            OfInstance& of = ofInstance_[quad.instance];
            of.direct = true;
            of.twoSided = of.first != kNone;
            if (!of.twoSided) of.first = static_cast<std::uint32_t>(emitters_.size());
            of.quad = true;
            addRect(quad.light, static_cast<std::uint32_t>(quad.instance), true);
        }
    if (direct.smallLamps)
        for (const scene::SmallLamp& lamp : scene::smallLamps(scene))
            ofInstance_[lamp.instance].direct = true;
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
        if (!ofInstance_[i].quad) addTriangles(scene, i);
    setGroups(extended);
}

void LightTable::addLight(const Light& light) {
    if (light.type == LightType::Sphere) return addSphere(light);
    if (hasArea(light.type)) return addRect(light, kNone, false);
    Emitter e;
    e.kind = light.type == LightType::Directional ? Kind::Directional : Kind::Point;
    e.castsShadow = light.castsShadow;
    e.radiance = light.intensity;
    e.position = light.position;
    e.normal = unitOrDown(light.direction);
    e.light = &light;
    if (light.type == LightType::Spot) {
        e.cosInner = std::cos(light.innerAngle);
        e.cosOuter = std::cos(light.outerAngle);
    }
    emitters_.push_back(e);
}

void LightTable::addSphere(const Light& light) {
    Emitter e;
    e.kind = Kind::Sphere;
    e.castsShadow = light.castsShadow;
    e.radiance = light.intensity;
    e.position = light.position;
    e.radius = glm::length(light.halfU);
    e.area = std::numbers::pi_v<float> * e.radius * e.radius;
    if (!(e.area > 0)) return;
    hasExtendedLamps_ = true;
    rectsToTest_.push_back(static_cast<std::uint32_t>(emitters_.size()));
    emitters_.push_back(e);
}

void LightTable::addRect(const Light& light, std::uint32_t instance, bool isQuad) {
    const glm::vec3 cross = glm::cross(light.halfU, light.halfV);
    const bool round = light.type == LightType::Disk;
    const float area = (round ? std::numbers::pi_v<float> : 4.0f) * glm::length(cross);
    if (!(area > 0)) return;
    Emitter e;
    e.kind = Kind::Rect;
    e.round = round;
    e.castsShadow = light.castsShadow;
    e.radiance = light.intensity;
    e.position = light.position - light.halfU - light.halfV;
    e.edgeU = 2.0f * light.halfU;
    e.edgeV = 2.0f * light.halfV;
    // The normal is that of the edges; `direction` only says which side shines (src/scene/gpu_lights.cpp).
    e.normal = glm::normalize(cross);
    if (glm::dot(e.normal, light.direction) < 0) e.normal = -e.normal;
    e.area = area;
    e.instance = instance;
    hasExtendedLamps_ = true;
    if (!isQuad || !sameBlockers_) rectsToTest_.push_back(static_cast<std::uint32_t>(emitters_.size()));
    emitters_.push_back(e);
}

void LightTable::addTriangles(const Scene& scene, std::size_t index) {
    const Instance& instance = scene.instances[index];
    if (!instance.visible || !instance.voxelized || instance.mesh < 0 || instance.material < 0) return;
    const Material& material = scene.materials[static_cast<std::size_t>(instance.material)];
    if (material.unlit || !(material.emission.r + material.emission.g + material.emission.b > 0)) return;
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
    ofInstance_[index].first = static_cast<std::uint32_t>(emitters_.size());
    hasExtendedLamps_ = hasExtendedLamps_ || ofInstance_[index].direct;
    const bool mirrored = glm::determinant(glm::mat3(instance.worldFromObject)) < 0;
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
        std::array<glm::vec3, 3> p;
        for (std::size_t k = 0; k < 3; ++k)
            p[k] = glm::vec3(instance.worldFromObject *
                             glm::vec4(mesh.positions[mesh.indices[3 * std::size_t{t} + k]], 1));
        Emitter e;
        e.kind = Kind::Triangle;
        e.direct = ofInstance_[index].direct;
        e.twoSided = material.doubleSided;
        e.constant = !material.emissiveTexture.used() && material.alphaMode == AlphaMode::Opaque;
        e.radiance = material.emission;
        e.position = p[0];
        e.edgeU = p[1] - p[0];
        e.edgeV = p[2] - p[0];
        const glm::vec3 cross = glm::cross(e.edgeU, e.edgeV);
        const float length = glm::length(cross);
        e.area = 0.5f * length;
        if (length > 0) e.normal = cross / length * (mirrored ? -1.0f : 1.0f);
        e.instance = static_cast<std::uint32_t>(index);
        e.triangle = t;
        emitters_.push_back(e);
    }
}

double LightTable::powerOf(const Emitter& e) const {
    const double radius = static_cast<double>(sceneRadius_);
    switch (e.kind) {
        case Kind::Point: {
            // Twice the mean of 1 and 0 between the angles for spots; other falloffs count by what they give
            // at half the scene's radius.
            const float half = 0.5f * sceneRadius_;
            const double falloff = e.light->customFalloff
                                       ? static_cast<double>(distanceFalloff(*e.light, half * half)) *
                                             static_cast<double>(half) * static_cast<double>(half)
                                       : 1.0;
            const double cosine =
                0.5 * static_cast<double>(std::max(e.cosInner, -1.0f) + std::max(e.cosOuter, -1.0f));
            if (const auto flux = radiantFlux(*e.light); e.light->profile != nullptr && flux)
                return preciseLuminance(*flux);
            return 2 * std::numbers::pi * (1 - std::min(cosine, 0.999)) * preciseLuminance(e.radiance) *
                   falloff;
        }
        case Kind::Directional:
            return std::numbers::pi * radius * radius * preciseLuminance(e.radiance);
        case Kind::Rect:
        case Kind::Sphere:
            return std::numbers::pi * static_cast<double>(e.area) * preciseLuminance(e.radiance);
        case Kind::Triangle: {
            double emission = preciseLuminance(e.radiance);
            if (!e.constant)
                emission = std::max(preciseLuminance(meanEmission(scene_, e.instance, e.triangle)),
                                    kLeastEmission * emission);
            return std::numbers::pi * static_cast<double>(e.area) * emission * (e.twoSided ? 2 : 1);
        }
    }
    return 0;
}

// About the light that a group gives at a surface, without shadows; 0 only where there is none.
float LightTable::weightOf(std::size_t index, const glm::vec3& from, const glm::vec3& normal) const {
    const Group& group = groups_[index];
    if (!(group.power > 0)) return 0;
    const Emitter& e = emitters_[group.first];
    if (group.count == 1 && e.kind == Kind::Directional)
        return static_cast<float>(preciseLuminance(e.radiance)) * std::max(-glm::dot(e.normal, normal), 0.0f);
    if (group.count == 1 && e.kind == Kind::Point) {
        LightSample light;
        if (!samplePoint(e, from, light)) return 0;
        return static_cast<float>(preciseLuminance(light.radiance)) *
               std::max(glm::dot(light.toLight, normal), 0.0f);
    }
    if (group.count == 1 && !e.twoSided && e.kind != Kind::Sphere &&
        !(glm::dot(from - e.position, e.normal) > 0))
        return 0;
    const glm::vec3 way = group.center - from;
    return group.power / (static_cast<float>(std::numbers::pi) * std::max(glm::dot(way, way), group.radius2));
}

bool LightTable::sample(const Choice& choice, std::size_t index, const glm::vec3& from, float within,
                        const glm::vec2& u, LightSample& result) const {
    const Group& group = groups_[index];
    if (!(choice.probability[index] > 0)) return false;
    if (index == 0 && !tree_.empty()) {
        const LightTree::Drawn drawn = tree_.draw(choice.place, within);
        const bool arrives = sampleEmitter(emitters_[drawn.number], from, u, result);
        result.density *= choice.probability[index] * drawn.probability;
        return arrives;
    }
    const auto begin = cumulative_.begin() + static_cast<std::ptrdiff_t>(group.first);
    const auto place = static_cast<std::size_t>(
        std::upper_bound(begin, begin + static_cast<std::ptrdiff_t>(group.count), within) - begin);
    const bool arrives =
        sampleEmitter(emitters_[group.first + std::min(place, group.count - 1)], from, u, result);
    result.density *= choice.probability[index];
    return arrives;
}

bool LightTable::sampleEmitter(const Emitter& e, const glm::vec3& from, const glm::vec2& u,
                               LightSample& result) const {
    result = LightSample{};
    result.direct = e.direct;
    result.castsShadow = e.castsShadow;
    return e.within > 0 && samplePart(e, from, u, result);
}

bool LightTable::samplePart(const Emitter& e, const glm::vec3& from, const glm::vec2& u,
                            LightSample& result) const {
    switch (e.kind) {
        case Kind::Point:
            return samplePoint(e, from, result);
        case Kind::Directional:
            result.toLight = -e.normal;
            result.distance = std::numeric_limits<float>::infinity();
            result.radiance = e.radiance;
            result.density = e.within;
            return true;
        case Kind::Sphere:
            if (!sampleSphere({e.position, e.radius}, from, u, result)) return false;
            result.extended = true;
            result.density *= e.within;
            result.radiance = e.radiance;
            return true;
        case Kind::Rect:
        case Kind::Triangle:
            return sampleArea(e, from, u, result);
    }
    return false;
}

bool LightTable::samplePoint(const Emitter& e, const glm::vec3& from, LightSample& result) const {
    result.density = e.within;
    return pointLight(*e.light, {e.normal, e.cosInner, e.cosOuter}, from, result);
}

bool LightTable::sampleArea(const Emitter& e, const glm::vec3& from, const glm::vec2& u,
                            LightSample& result) const {
    glm::vec2 b = u;
    if (e.kind == Kind::Triangle) {
        // Uniform over the triangle with the square root's map, which keeps strata compact.
        const float root = std::sqrt(u.x);
        b = {root * (1 - u.y), root * u.y};
    }
    if (e.round) b = 0.5f + 0.5f * glm::vec2(math::discFromSquare(glm::dvec2(u)));
    const glm::vec3 point = e.position + b.x * e.edgeU + b.y * e.edgeV;
    const glm::vec3 l = point - from;
    const float d2 = glm::dot(l, l);
    if (!(d2 > 1e-20f)) return false;
    const float distance = std::sqrt(d2);
    result.toLight = l / distance;
    float cosine = -glm::dot(result.toLight, e.normal);
    if (e.twoSided) cosine = std::fabs(cosine);
    if (!(cosine > 1e-7f)) return false;
    result.extended = true;
    result.density = e.within * d2 / (cosine * e.area);
    result.radiance = e.constant ? e.radiance : emissionAt(scene_, e.instance, e.triangle, b);
    const bool front = glm::dot(result.toLight, e.normal) < 0;
    result.target = RayScene::offsetOrigin(point, front ? e.normal : -e.normal);
    result.distance = distance;
    return result.radiance.r + result.radiance.g + result.radiance.b > 0;
}

LightTable::Found LightTable::found(const Choice& choice, const RayHit& hit,
                                    const glm::vec3& direction) const {
    Found result;
    const OfInstance& of = ofInstance_[hit.instance];
    if (of.first == kNone) return result;
    result.emitter = true;
    result.direct = of.direct;
    result.elsewhere = of.quad && !sameBlockers_;
    const Emitter* e = &emitters_[of.first + (of.quad ? 0 : hit.triangle)];
    float cosine = -glm::dot(direction, e->normal);
    if (of.quad && of.twoSided && cosine < 0) {
        ++e;
        cosine = -glm::dot(direction, e->normal);
    }
    if (e->twoSided) cosine = std::fabs(cosine);
    if (cosine > 1e-7f) result.density = chanceOf(choice, *e) * hit.t * hit.t / (cosine * e->area);
    return result;
}

bool LightTable::lampAlong(const Choice& choice, const Emitter& e, const glm::vec3& from,
                           const glm::vec3& direction, LightSample& hit) const {
    if (e.kind != Kind::Sphere) return rectAlong(choice, e, from, direction, hit);
    if (!sphereAlong({e.position, e.radius}, from, direction, hit)) return false;
    hit.radiance = e.radiance;
    hit.density *= chanceOf(choice, e);
    hit.extended = hit.direct = true;
    hit.castsShadow = e.castsShadow;
    return true;
}

bool LightTable::rectAlong(const Choice& choice, const Emitter& e, const glm::vec3& from,
                           const glm::vec3& direction, LightSample& hit) const {
    const float cosine = -glm::dot(direction, e.normal);
    if (!(cosine > 1e-7f)) return false;
    const float distance = glm::dot(from - e.position, e.normal) / cosine;
    if (!(distance > 0)) return false;
    // Coordinates along the edges, which need not be at right angles.
    const glm::vec3 p = from + direction * distance - e.position;
    const glm::vec3 cross = glm::cross(e.edgeU, e.edgeV);
    const float scale = 1.0f / glm::dot(cross, cross);
    const float a = glm::dot(glm::cross(p, e.edgeV), cross) * scale;
    const float b = glm::dot(glm::cross(e.edgeU, p), cross) * scale;
    if (!(a >= 0 && a <= 1 && b >= 0 && b <= 1)) return false;
    if (const glm::vec2 at = 2.0f * glm::vec2(a, b) - 1.0f; e.round && glm::dot(at, at) > 1) return false;
    hit.toLight = direction;
    hit.distance = distance;
    hit.target = RayScene::offsetOrigin(e.position + p, e.normal);
    hit.radiance = e.radiance;
    hit.density = chanceOf(choice, e) * distance * distance / (cosine * e.area);
    hit.extended = hit.direct = true;
    hit.castsShadow = e.castsShadow;
    return true;
}

}  // namespace conelight::reference
