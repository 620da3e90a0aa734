// SPDX-License-Identifier: MIT
#include "reference/beam_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/log.h"
#include "math/disc.h"
#include "reference/materials.h"
#include "reference/surface.h"
#include "scene/emissive_quads.h"

namespace conelight::reference {
namespace {

// Of the scene's size: positions are floats, whose digits end there.
constexpr double kSamePlace = 1e-7;
constexpr int kDiskCorners = 64;  // of a disk as mirrors show it
// Cosine between the normals of a mirror that count as one: 0.1 degrees.
constexpr float kFlat = 0.9999985f;

std::array<glm::dvec3, 3> cornersOf(const Scene& scene, const Instance& instance, std::uint32_t triangle) {
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
    std::array<glm::dvec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k)
        corners[k] =
            glm::dvec3(glm::vec3(instance.worldFromObject *
                                 glm::vec4(mesh.positions[mesh.indices[3 * std::size_t{triangle} + k]], 1)));
    return corners;
}

// The quadrangle that two triangles make, if they share an edge, lie in one plane and turn the same way; else nothing.
Corners joined(const std::array<glm::dvec3, 3>& a, const std::array<glm::dvec3, 3>& b, double within) {
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            if (a[i] != b[(k + 1) % 3] || a[(i + 1) % 3] != b[k]) continue;
            const Corners four = {a[i], b[(k + 2) % 3], a[(i + 1) % 3], a[(i + 2) % 3]};
            BeamPlane plane;
            if (!planeOf({a[0], a[1], a[2]}, plane) || std::fabs(plane.at(four[1])) > within) return {};
            for (std::size_t c = 0; c < 4; ++c) {
                const glm::dvec3 before = four[(c + 1) % 4] - four[c];
                const glm::dvec3 after = four[(c + 2) % 4] - four[(c + 1) % 4];
                if (!(glm::dot(glm::cross(before, after), plane.normal) > 0)) return {};
            }
            return four;
        }
    return {};
}

// Of the roughness that a texture may lower: whether some of it is a mirror and some is not.
bool mirrorsInParts(const Scene& scene, const Material& material) {
    if (!material.metallicRoughnessTexture.used() || material.roughness < math::kMinRoughness) return false;
    const Texture& texture =
        scene.textures[static_cast<std::size_t>(material.metallicRoughnessTexture.texture)];
    for (std::size_t i = 1; i < texture.rgba.size(); i += 4)
        if (material.roughness * static_cast<float>(texture.rgba[i]) / 255 < math::kMinRoughness) return true;
    return false;
}

void refuseMaterial(const Scene& scene, const Material& material) {
    const char* name = material.name.c_str();
    if (material.alphaMode != AlphaMode::Opaque)
        base::fail(ErrorKind::BadInput,
                   "mode beams: material '%s' is masked or blended; opaque materials would be right", name);
    if (isTransmissive(material))
        base::fail(ErrorKind::BadInput,
                   "mode beams: material '%s' lets light through; opaque materials would be right", name);
    if (mirrorsInParts(scene, material))
        base::fail(
            ErrorKind::BadInput,
            "mode beams: material '%s' is a mirror in parts, by a texture; one roughness, or none below %g, "
            "would be right",
            name, static_cast<double>(math::kMinRoughness));
}

void refuseMany(const Scene& scene) {
    std::size_t triangles = 0;
    for (const Instance& instance : scene.instances)
        if (instance.visible && instance.mesh >= 0)
            triangles += scene.meshes[static_cast<std::size_t>(instance.mesh)].triangleCount();
    if (triangles > BeamScene::kMostTriangles)
        base::fail(ErrorKind::BadInput,
                   "mode beams: the scene has %zu triangles; at most %zu would be right, or mode reference",
                   triangles, BeamScene::kMostTriangles);
}

}  // namespace

bool BeamLamp::sample(const glm::vec3& from, LightSample& result) const {
    if (!ofRectangle) return sampleLight(light, from, result);
    const glm::vec3 way = light.position - from;
    const float d2 = glm::dot(way, way);
    if (!(d2 > 1e-20f)) return false;
    result.distance = std::sqrt(d2);
    result.toLight = way / result.distance;
    const float cosine = -glm::dot(result.toLight, light.direction);
    result.radiance = light.intensity * (std::max(cosine, 0.0f) / d2);
    return cosine > 0;
}

BeamScene::BeamScene(const Scene& scene, bool quads, int lampPoints) : scene_(scene) {
    scene.validate();
    refuseMany(scene);
    within_ = kSamePlace * std::max(static_cast<double>(glm::length(scene.bounds().extent())), 1e-3);
    for (std::size_t i = 0; i < scene.instances.size(); ++i) addInstance(i);
    addLamps(quads, lampPoints);
    std::vector<OrderedPart> parts;
    for (std::uint32_t p = 0; p < polygons_.size(); ++p) parts.push_back({polygons_[p].corners, p});
    order_ = std::make_unique<BeamOrder>(std::move(parts), within_);
}

void BeamScene::addInstance(std::size_t index) {
    const Instance& instance = scene_.instances[index];
    if (!instance.visible || instance.mesh < 0) return;
    const Material& material = materialOf(scene_, instance);
    refuseMaterial(scene_, material);
    const double turned = glm::determinant(glm::mat3(instance.worldFromObject)) < 0 ? -1 : 1;
    const Mesh& mesh = scene_.meshes[static_cast<std::size_t>(instance.mesh)];
    const auto count = static_cast<std::uint32_t>(mesh.triangleCount());
    for (std::uint32_t t = 0; t < count; ++t) {
        BeamPolygon polygon;
        const std::array<glm::dvec3, 3> own = cornersOf(scene_, instance, t);
        polygon.corners = {own[0], own[1], own[2]};
        polygon.triangles[0] = t;
        polygon.triangleCount = 1;
        if (t + 1 < count) {
            Corners four = joined(own, cornersOf(scene_, instance, t + 1), within_);
            if (!four.empty()) {
                polygon.corners = std::move(four);
                polygon.triangles[1] = ++t;
                polygon.triangleCount = 2;
            }
        }
        if (!planeOf(polygon.corners, polygon.plane)) continue;
        if (turned < 0) polygon.plane = {-polygon.plane.normal, -polygon.plane.offset};
        polygon.instance = static_cast<std::uint32_t>(index);
        polygon.twoSided = material.doubleSided;
        polygon.voxelized = instance.voxelized;
        polygon.castsShadow = instance.castsShadow;
        polygon.unlit = material.unlit;
        polygon.textured = isTextured(scene_, {0, polygon.instance, 0, {}, {}});
        polygon.mirror = isMirrorAt(polygon);
        if (polygon.mirror) refuseCurved(polygon);
        polygons_.push_back(std::move(polygon));
    }
}

// A mirror: opaque, below the least roughness, and reflecting at all. Textures cannot change that (refuseMaterial).
bool BeamScene::isMirrorAt(const BeamPolygon& polygon) const {
    Ray ray;
    ray.direction = -glm::vec3(polygon.plane.normal);
    const Surface surface = surfaceAt(scene_, ray, hitOf(polygon, centroidOf(polygon.corners), 1));
    if (surface.unlit || !isMirror(surface)) return false;
    return Reflection(surface, -ray.direction).mirrorShare() != glm::vec3(0);
}

void BeamScene::refuseCurved(const BeamPolygon& polygon) const {
    Ray ray;
    ray.direction = -glm::vec3(polygon.plane.normal);
    const Instance& instance = scene_.instances[polygon.instance];
    const bool bumpy = materialOf(scene_, instance).normalTexture.used();
    for (const glm::dvec3& corner : polygon.corners) {
        const Surface surface = surfaceAt(scene_, ray, hitOf(polygon, corner, 1));
        if (!bumpy && glm::dot(surface.shadingNormal, surface.geometricNormal) >= kFlat) continue;
        base::fail(ErrorKind::BadInput,
                   "mode beams: instance '%s' is a curved mirror; flat mirrors, or a roughness of %g or "
                   "more, would be "
                   "right",
                   instance.name.c_str(), static_cast<double>(math::kMinRoughness));
    }
}

RayHit BeamScene::hitOf(const BeamPolygon& polygon, const glm::dvec3& position, double t) const {
    RayHit hit;
    hit.t = static_cast<float>(t);
    hit.instance = polygon.instance;
    hit.geometricNormal = glm::vec3(polygon.plane.normal);
    double best = -std::numeric_limits<double>::infinity();
    for (int k = 0; k < polygon.triangleCount; ++k) {
        const std::uint32_t triangle = polygon.triangles[static_cast<std::size_t>(k)];
        const auto c = cornersOf(scene_, scene_.instances[polygon.instance], triangle);
        const glm::dvec3 u = c[1] - c[0], v = c[2] - c[0], p = position - c[0];
        const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v);
        const double pu = glm::dot(p, u), pv = glm::dot(p, v), scale = 1 / (uu * vv - uv * uv);
        const glm::dvec2 b((vv * pu - uv * pv) * scale, (uu * pv - uv * pu) * scale);
        const double least = std::min({b.x, b.y, 1 - b.x - b.y});
        if (k > 0 && !(least > best)) continue;
        best = least;
        hit.triangle = triangle;
        hit.barycentric = glm::vec2(glm::clamp(b, 0.0, 1.0));
    }
    return hit;
}

void BeamScene::addLamps(bool quads, int lampPoints) {
    for (const Light& light : scene_.lights) {
        if (!light.enabled) continue;
        if (light.type == LightType::Sphere)
            base::fail(ErrorKind::BadInput,
                       "mode beams: light '%s' is a sphere; a rect, a disk or a point would be right",
                       light.name.c_str());
        if (hasArea(light.type)) {
            addRectangle(light, lampPoints, true);
            continue;
        }
        BeamLamp lamp{{glm::dvec3(light.position), false}, light.castsShadow, light};
        if (light.type == LightType::Directional) {
            LightSample sample;
            sampleLight(light, glm::vec3(0), sample);
            lamp.apex = {glm::normalize(glm::dvec3(sample.toLight)), true};
        }
        lamps_.push_back(std::move(lamp));
    }
    if (!quads) return;
    for (const scene::EmissiveQuad& quad : scene::emissiveQuads(scene_)) {
        addRectangle(quad.light, lampPoints, false);
        for (BeamPolygon& polygon : polygons_)
            if (polygon.instance == quad.instance) polygon.quadLamp = true;
    }
}

// A rectangle as a lattice of points. Rectangles without triangles are seen in mirrors, as paths see them.
void BeamScene::addRectangle(const Light& light, int lampPoints, bool seenInMirrors) {
    const glm::vec3 cross = glm::cross(light.halfU, light.halfV);
    const float length = glm::length(cross);
    if (!(length > 0)) return;
    const glm::vec3 normal = cross / (glm::dot(cross, light.direction) < 0 ? -length : length);
    const bool round = light.type == LightType::Disk;
    const float area = (round ? std::numbers::pi_v<float> : 4.0f) * length;
    const glm::vec2 points(static_cast<float>(lampPoints));
    for (int y = 0; y < lampPoints; ++y)
        for (int x = 0; x < lampPoints; ++x) {
            Light point = light;
            point.direction = normal;
            const glm::vec2 u = (glm::vec2(x, y) + 0.5f) / points;
            const glm::vec2 at = round ? glm::vec2(math::discFromSquare(glm::dvec2(u))) : 2.0f * u - 1.0f;
            point.position += at.x * light.halfU + at.y * light.halfV;
            point.intensity *= area / static_cast<float>(lampPoints * lampPoints);
            lamps_.push_back({{glm::dvec3(point.position), false}, light.castsShadow, point, true});
        }
    if (!seenInMirrors) return;
    BeamPolygon polygon;
    const glm::dvec3 middle(light.position), u(light.halfU), v(light.halfV);
    polygon.corners = {middle - u - v, middle + u - v, middle + u + v, middle - u + v};
    if (round) {
        polygon.corners.clear();
        for (int i = 0; i < kDiskCorners; ++i) {
            const double angle = 2 * std::numbers::pi * i / kDiskCorners;
            polygon.corners.push_back(middle + std::cos(angle) * u + std::sin(angle) * v);
        }
    }
    if (!planeOf(polygon.corners, polygon.plane)) return;
    if (glm::dot(polygon.plane.normal, glm::dvec3(normal)) < 0)
        polygon.plane = {-polygon.plane.normal, -polygon.plane.offset};
    polygon.quadLamp = true;
    polygon.radiance = light.intensity;
    polygons_.push_back(std::move(polygon));
}

}  // namespace conelight::reference
