// SPDX-License-Identifier: MIT
#include "reference/radiosity_gather.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "math/disc.h"
#include "reference/materials.h"
#include "reference/radiosity_form_factor.h"
#include "reference/sampler.h"
#include "reference/surface.h"
#include "scene/emissive_quads.h"

namespace conelight::reference {
namespace {

// Emissive meshes of more triangles are found by rays: by their form factors they would cost more.
constexpr std::size_t kMostTriangles = 64;
constexpr std::size_t kRoundCorners = kMostCorners;  // of the polygon that stands for a disk
constexpr int kProbeEdge = 4;                        // points a side that tell penumbra from light and umbra

bool shines(const glm::vec3& c) { return c.r > 0 || c.g > 0 || c.b > 0; }

}  // namespace

RadiosityLights::RadiosityLights(const Scene& scene, bool emissiveQuads)
    : areaLight_(scene.instances.size(), false) {
    for (const Light& light : scene.lights) {
        if (!light.enabled || !shines(light.intensity)) continue;
        if (hasArea(light.type)) {
            addRect(light);
            continue;
        }
        auto single = std::make_unique<Single>();
        single->scene.lights = {light};
        single->table = std::make_unique<LightTable>(single->scene, DirectEmitters{false, false}, false);
        singles_.push_back(std::move(single));
    }
    for (const scene::EmissiveQuad& quad : scene::emissiveQuads(scene)) {
        const std::size_t before = areas_.size();
        addRect(quad.light);
        if (areas_.size() > before) areas_.back().direct = emissiveQuads;
        areaLight_[quad.instance] = true;
    }
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
        if (!areaLight_[i]) addTriangles(scene, i);
}

void RadiosityLights::addRect(const Light& light) {
    AreaLight a;
    a.castsShadow = light.castsShadow;
    a.radiance = light.intensity;
    if (light.type == LightType::Sphere) {
        a.corner = glm::dvec3(light.position);
        a.sphere = glm::length(glm::dvec3(light.halfU));
        if (a.sphere > 0) areas_.push_back(a);
        return;
    }
    a.round = light.type == LightType::Disk;
    a.corner = glm::dvec3(light.position) - glm::dvec3(light.halfU) - glm::dvec3(light.halfV);
    a.edgeU = 2.0 * glm::dvec3(light.halfU);
    a.edgeV = 2.0 * glm::dvec3(light.halfV);
    a.normal = glm::cross(a.edgeU, a.edgeV);
    if (!(glm::length(a.normal) > 0)) return;
    a.normal = glm::normalize(a.normal);
    if (glm::dot(a.normal, glm::dvec3(light.direction)) < 0) a.normal = -a.normal;
    areas_.push_back(a);
}

void RadiosityLights::addTriangles(const Scene& scene, std::uint32_t index) {
    const Instance& instance = scene.instances[index];
    if (!instance.visible || !instance.voxelized || instance.mesh < 0 || instance.material < 0) return;
    const Material& material = scene.materials[static_cast<std::size_t>(instance.material)];
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
    if (material.unlit || !shines(material.emission) || material.emissiveTexture.used() ||
        material.alphaMode != AlphaMode::Opaque || mesh.triangleCount() > kMostTriangles)
        return;
    areaLight_[index] = true;
    const double side = glm::determinant(glm::mat3(instance.worldFromObject)) < 0 ? -1 : 1;
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
        std::array<glm::dvec3, 3> p;
        for (std::size_t k = 0; k < 3; ++k)
            p[k] = glm::dvec3(glm::dmat4(instance.worldFromObject) *
                              glm::dvec4(glm::dvec3(mesh.positions[mesh.indices[3 * t + k]]), 1));
        AreaLight a;
        a.triangle = true;
        a.direct = false;
        a.twoSided = material.doubleSided;
        a.corner = p[0];
        a.edgeU = p[1] - p[0];
        a.edgeV = p[2] - p[0];
        const glm::dvec3 cross = glm::cross(a.edgeU, a.edgeV);
        if (!(glm::length(cross) > 0)) continue;
        a.normal = glm::normalize(cross) * side;
        a.radiance = material.emission;
        areas_.push_back(a);
    }
}

// The disc where lines from a place touch a sphere; without an area from within.
RadiosityLights::AreaLight RadiosityLights::discOf(const AreaLight& sphere, const glm::dvec3& seenFrom) {
    AreaLight disc = sphere;
    const glm::dvec3 way = sphere.corner - seenFrom;
    const double d2 = std::max(glm::dot(way, way), 1e-30), r2 = sphere.sphere * sphere.sphere;
    const double part = std::max(1 - r2 / d2, 0.0), radius = std::sqrt(r2 * part);
    disc.round = true;
    disc.normal = -way / std::sqrt(d2);
    const Frame frame{glm::vec3(disc.normal)};
    disc.edgeU = 2 * radius * glm::dvec3(frame.toWorld({1, 0, 0}));
    disc.edgeV = 2 * radius * glm::dvec3(frame.toWorld({0, 1, 0}));
    disc.corner = seenFrom + part * way - 0.5 * (disc.edgeU + disc.edgeV);
    return disc;
}

struct RadiosityLights::Outline {
    std::array<glm::dvec3, kRoundCorners> corners;
    std::size_t count = 0;
};

// Round lights as a polygon of their area.
RadiosityLights::Outline RadiosityLights::outlineOf(const AreaLight& light) {
    Outline outline;
    const glm::dvec3 &u = light.edgeU, &v = light.edgeV;
    if (!light.round) {
        outline.count = light.triangle ? 3 : 4;
        outline.corners[0] = light.corner;
        outline.corners[1] = light.corner + u;
        outline.corners[2] = light.corner + (light.triangle ? v : u + v);
        outline.corners[3] = light.corner + v;
        return outline;
    }
    outline.count = kRoundCorners;
    const double each = 2 * std::numbers::pi / kRoundCorners;
    const double radius = 0.5 * std::sqrt(each / std::sin(each));
    for (std::size_t i = 0; i < outline.count; ++i) {
        const double angle = each * static_cast<double>(i);
        outline.corners[i] =
            light.corner + (0.5 + radius * std::cos(angle)) * u + (0.5 + radius * std::sin(angle)) * v;
    }
    return outline;
}

// Weighted by what each point of the light would give if it were seen.
double RadiosityLights::visiblePart(const RayScene& rays, const Receiver& at, const AreaLight& light,
                                    int edge, std::uint64_t& count, bool& mixed) const {
    double seen = 0, all = 0;
    const glm::vec3 origin = RayScene::offsetOrigin(at.position, at.geometricNormal);
    for (int y = 0; y < edge; ++y)
        for (int x = 0; x < edge; ++x) {
            double u = (x + 0.5) / edge, v = (y + 0.5) / edge;
            if (light.triangle) {  // the square's map that keeps areas
                const double root = std::sqrt(u);
                u = root * (1 - v);
                v *= root;
            }
            if (light.round) {
                const glm::dvec2 disc = math::discFromSquare({u, v});
                u = 0.5 + 0.5 * disc.x;
                v = 0.5 + 0.5 * disc.y;
            }
            const glm::dvec3 point = light.corner + u * light.edgeU + v * light.edgeV;
            const glm::dvec3 way = point - glm::dvec3(at.position);
            const double d2 = glm::dot(way, way);
            const double above = glm::dot(way, glm::dvec3(at.shadingNormal));
            const double facing = -glm::dot(way, light.normal);
            if (!(above > 0) || !(d2 > 0) || facing == 0) continue;
            const double weight = above * std::fabs(facing) / (d2 * d2);
            all += weight;
            if (!(glm::dot(way, glm::dvec3(at.geometricNormal)) > 0)) continue;
            bool visible = true;
            if (!light.direct || light.castsShadow) {
                const glm::vec3 side(facing > 0 ? light.normal : -light.normal);
                const glm::vec3 ahead = RayScene::offsetOrigin(glm::vec3(point), side) - origin;
                Ray ray;
                ray.origin = origin;
                const float distance = glm::length(ahead);
                ray.direction = ahead / distance;
                ray.tMax = distance * kRayEnd;
                ++count;
                visible = !rays.occluded(light.direct ? RayKind::Shadow : RayKind::Bounce, ray);
            }
            if (visible) seen += weight;
        }
    mixed = seen > 0 && seen < all;
    return all > 0 ? seen / all : 0;
}

glm::vec3 RadiosityLights::irradiance(const RayScene& rays, const Receiver& at, int lightRays,
                                      const Kinds& kinds, std::uint64_t& count) const {
    glm::vec3 sum(0);
    // The one light of a table is certain.
    LightTable::Choice first{};
    first.probability[0] = 1;
    for (const std::unique_ptr<Single>& single : singles_) {
        if (!kinds.direct) break;
        LightSample light;
        if (single->table->groupCount() == 0 ||
            !single->table->sample(first, 0, at.position, 0.5f, glm::vec2(0.5f), light))
            continue;
        const float cosine = glm::dot(light.toLight, at.shadingNormal);
        if (!(cosine > 0)) continue;
        if (light.castsShadow) {
            const bool above = glm::dot(light.toLight, at.geometricNormal) > 0;
            if (!above && at.castsShadow) continue;
            Ray ray;
            ray.origin =
                RayScene::offsetOrigin(at.position, above ? at.geometricNormal : -at.geometricNormal);
            ray.direction = light.toLight;
            if (std::isfinite(light.distance)) ray.tMax = light.distance * kRayEnd;
            ++count;
            if (rays.occluded(RayKind::Shadow, ray)) continue;
        }
        sum += light.radiance * (cosine / light.density);
    }
    const int edge = std::max(kProbeEdge, static_cast<int>(std::lround(std::sqrt(lightRays))));
    for (const AreaLight& own : areas_) {
        const AreaLight light = own.sphere > 0 ? discOf(own, glm::dvec3(at.position)) : own;
        if (light.direct ? !kinds.direct : !kinds.indirect) continue;
        if (!light.twoSided && !(glm::dot(glm::dvec3(at.position) - light.corner, light.normal) > 0))
            continue;
        const Outline outline = outlineOf(light);
        const double factor = polygonFormFactor(glm::dvec3(at.position), glm::dvec3(at.shadingNormal),
                                                std::span(outline.corners).first(outline.count));
        if (!(factor > 0)) continue;
        bool mixed = false;
        double seen = visiblePart(rays, at, light, kProbeEdge, count, mixed);
        if (mixed && edge > kProbeEdge) seen = visiblePart(rays, at, light, edge, count, mixed);
        sum += light.radiance * static_cast<float>(glm::pi<float>() * factor * seen);
    }
    return sum;
}

glm::vec3 cosineDirection(const glm::vec3& normal, std::uint32_t n, std::uint32_t count,
                          const glm::vec2& shift) {
    std::uint32_t bits = n;
    bits = (bits << 16) | (bits >> 16);
    bits = ((bits & 0x00ff00ffu) << 8) | ((bits & 0xff00ff00u) >> 8);
    bits = ((bits & 0x0f0f0f0fu) << 4) | ((bits & 0xf0f0f0f0u) >> 4);
    bits = ((bits & 0x33333333u) << 2) | ((bits & 0xccccccccu) >> 2);
    bits = ((bits & 0x55555555u) << 1) | ((bits & 0xaaaaaaaau) >> 1);
    const float a = glm::fract((static_cast<float>(n) + 0.5f) / static_cast<float>(count) + shift.x);
    const float b = glm::fract(static_cast<float>(bits >> 8) * 0x1p-24f + shift.y);
    const float radius = std::sqrt(a), phi = 2 * glm::pi<float>() * b;
    return glm::normalize(Frame(normal).toWorld(
        {radius * std::cos(phi), radius * std::sin(phi), std::sqrt(std::max(1 - a, 1e-7f))}));
}

}  // namespace conelight::reference
