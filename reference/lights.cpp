// SPDX-License-Identifier: MIT
#include "reference/lights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "reference/surface.h"
#include "scene/emissive_quads.h"

namespace conelight::reference {
namespace {

constexpr double kPi = 3.14159265358979;

double luminance(const glm::vec3& c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; }

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

LightTable::LightTable(const Scene& scene, bool quads, bool extended)
    : scene_(scene), ofInstance_(scene.instances.size()) {
    sceneRadius_ = std::max(0.5f * glm::length(scene.bounds().extent()), 1e-6f);
    for (const Instance& instance : scene.instances)
        if (instance.visible && instance.mesh >= 0 && instance.voxelized != instance.castsShadow)
            sameBlockers_ = false;
    for (const Light& light : scene.lights)
        if (light.enabled) addLight(light);
    if (quads)
        for (const scene::EmissiveQuad& quad : scene::emissiveQuads(scene)) {
            OfInstance& of = ofInstance_[quad.instance];
            of.twoSided = of.first != kNone;
            if (!of.twoSided) of.first = static_cast<std::uint32_t>(emitters_.size());
            of.quad = true;
            addRect(quad.light, static_cast<std::uint32_t>(quad.instance), true);
        }
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
        if (!ofInstance_[i].quad) addTriangles(scene, i);
    setChoices(extended);
}

void LightTable::addLight(const Light& light) {
    if (light.type == LightType::Rect) {
        addRect(light, kNone, false);
        return;
    }
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

void LightTable::addRect(const Light& light, std::uint32_t instance, bool isQuad) {
    const glm::vec3 cross = glm::cross(light.halfU, light.halfV);
    const float area = 4 * glm::length(cross);
    if (!(area > 0)) return;
    Emitter e;
    e.kind = Kind::Rect;
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
    hasQuadsOrRects_ = true;
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
    const bool mirrored = glm::determinant(glm::mat3(instance.worldFromObject)) < 0;
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
        std::array<glm::vec3, 3> p;
        for (std::size_t k = 0; k < 3; ++k)
            p[k] = glm::vec3(instance.worldFromObject *
                             glm::vec4(mesh.positions[mesh.indices[3 * std::size_t{t} + k]], 1));
        Emitter e;
        e.kind = Kind::Triangle;
        e.direct = false;
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
            return 2 * kPi * (1 - std::min(cosine, 0.999)) * luminance(e.radiance) * falloff;
        }
        case Kind::Directional:
            return kPi * radius * radius * luminance(e.radiance);
        case Kind::Rect:
            return kPi * static_cast<double>(e.area) * luminance(e.radiance);
        case Kind::Triangle: {
            double emission = luminance(e.radiance);
            if (!e.constant)
                emission = std::max(luminance(meanEmission(scene_, e.instance, e.triangle)),
                                    kLeastEmission * emission);
            return kPi * static_cast<double>(e.area) * emission * (e.twoSided ? 2 : 1);
        }
    }
    return 0;
}

void LightTable::setChoices(bool extended) {
    std::vector<double> sums;
    double sum = 0;
    for (const Emitter& e : emitters_) {
        const bool chosen = extended || e.kind == Kind::Point || e.kind == Kind::Directional;
        const double power = chosen ? powerOf(e) : 0.0;
        sum += std::isfinite(power) ? std::max(power, 0.0) : 0.0;
        sums.push_back(sum);
    }
    if (!(sum > 0)) return;
    float before = 0;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        cumulative_.push_back(static_cast<float>(sums[i] / sum));
        // As the search sees it.
        emitters_[i].choice = cumulative_[i] - before;
        before = cumulative_[i];
    }
}

bool LightTable::sample(const glm::vec3& from, float choice, const glm::vec2& u, LightSample& result) const {
    const auto place = std::upper_bound(cumulative_.begin(), cumulative_.end(), choice) - cumulative_.begin();
    const Emitter& e = emitters_[std::min(static_cast<std::size_t>(place), emitters_.size() - 1)];
    result = LightSample{};
    result.direct = e.direct;
    result.castsShadow = e.castsShadow;
    if (!(e.choice > 0)) return false;
    switch (e.kind) {
        case Kind::Point:
            return samplePoint(e, from, result);
        case Kind::Directional:
            result.toLight = -e.normal;
            result.distance = std::numeric_limits<float>::infinity();
            result.radiance = e.radiance;
            result.density = e.choice;
            return true;
        case Kind::Rect:
        case Kind::Triangle:
            return sampleArea(e, from, u, result);
    }
    return false;
}

bool LightTable::samplePoint(const Emitter& e, const glm::vec3& from, LightSample& result) const {
    const glm::vec3 l = e.position - from;
    const float d2 = glm::dot(l, l);
    if (!(d2 > 1e-20f)) return false;
    result.distance = std::sqrt(d2);
    result.toLight = l / result.distance;
    result.target = e.position;
    result.radiance = e.radiance * (distanceFalloff(*e.light, d2) *
                                    spotFalloff(-glm::dot(result.toLight, e.normal), e.cosInner, e.cosOuter));
    result.density = e.choice;
    return result.radiance.r + result.radiance.g + result.radiance.b > 0;
}

bool LightTable::sampleArea(const Emitter& e, const glm::vec3& from, const glm::vec2& u,
                            LightSample& result) const {
    glm::vec2 b = u;
    if (e.kind == Kind::Triangle) {
        // Uniform over the triangle with the square root's map, which keeps strata compact.
        const float root = std::sqrt(u.x);
        b = {root * (1 - u.y), root * u.y};
    }
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
    result.density = e.choice * d2 / (cosine * e.area);
    result.radiance = e.constant ? e.radiance : emissionAt(scene_, e.instance, e.triangle, b);
    const bool front = glm::dot(result.toLight, e.normal) < 0;
    result.target = RayScene::offsetOrigin(point, front ? e.normal : -e.normal);
    result.distance = distance;
    return result.radiance.r + result.radiance.g + result.radiance.b > 0;
}

LightTable::Found LightTable::found(const RayHit& hit, const glm::vec3& direction) const {
    Found result;
    const OfInstance& of = ofInstance_[hit.instance];
    if (of.first == kNone) return result;
    result.emitter = true;
    result.quad = of.quad;
    result.elsewhere = of.quad && !sameBlockers_;
    const Emitter* e = &emitters_[of.first + (of.quad ? 0 : hit.triangle)];
    float cosine = -glm::dot(direction, e->normal);
    if (of.quad && of.twoSided && cosine < 0) {
        ++e;
        cosine = -glm::dot(direction, e->normal);
    }
    if (e->twoSided) cosine = std::fabs(cosine);
    if (cosine > 1e-7f) result.density = e->choice * hit.t * hit.t / (cosine * e->area);
    return result;
}

bool LightTable::rectAlong(const Emitter& e, const glm::vec3& from, const glm::vec3& direction,
                           LightSample& hit) const {
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
    hit.toLight = direction;
    hit.distance = distance;
    hit.target = RayScene::offsetOrigin(e.position + p, e.normal);
    hit.radiance = e.radiance;
    hit.density = e.choice * distance * distance / (cosine * e.area);
    hit.extended = hit.direct = true;
    hit.castsShadow = e.castsShadow;
    return true;
}

}  // namespace conelight::reference
