// SPDX-License-Identifier: MIT
#include "reference/surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include "conelight/scene_fields.h"

namespace conelight::reference {
namespace {

bool isTextured(const Material& material) {
    bool textured = false;
    visitFields(
        [&](const char*, const auto& value) {
            if constexpr (std::is_same_v<decltype(value), const TextureRef&>) textured |= value.used();
        },
        material);
    return textured;
}

std::array<std::uint32_t, 3> cornersOf(const Mesh& mesh, std::uint32_t triangle) {
    const std::size_t i = 3 * static_cast<std::size_t>(triangle);
    return {mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
}

template <typename T>
T interpolated(const std::vector<T>& values, const std::array<std::uint32_t, 3>& corners, const glm::vec2& b,
               const T& missing) {
    if (values.empty()) return missing;
    return values[corners[0]] * (1 - b.x - b.y) + values[corners[1]] * b.x + values[corners[2]] * b.y;
}

// Moves a point on an edge of its triangle by a ten-thousandth towards the middle. Where two walls meet, a
// point of one, rounded, lies in or behind the other, and rays from it escape or see nothing but that;
// pictures taken from a room's axis have such points along whole diagonals.
glm::vec2 offEdges(const glm::vec2& b) {
    constexpr float kLeast = 1e-4f;
    const float least = std::min({b.x, b.y, 1 - b.x - b.y});
    return least < kLeast ? glm::mix(b, glm::vec2(1.0f / 3.0f), 3 * kLeast) : b;
}

// How far the point where a ray meets its triangle's plane moves when `turn` is added to its direction, in
// the triangle's barycentric coordinates: Igehy 1999, "Tracing Ray Differentials", equation 10. Beyond the
// triangle its texture coordinates go on evenly, as a rasterizer's derivatives take them to.
glm::vec2 barycentricShift(const Mesh& mesh, const glm::mat4& worldFromObject,
                           const std::array<std::uint32_t, 3>& corners, const Ray& ray, const RayHit& hit,
                           const glm::vec3& turn) {
    const float across = glm::dot(hit.geometricNormal, ray.direction);
    const glm::vec3 way = hit.t * (turn - ray.direction * (glm::dot(hit.geometricNormal, turn) / across));
    const glm::mat3 turned(worldFromObject);
    const glm::vec3 u = turned * (mesh.positions[corners[1]] - mesh.positions[corners[0]]);
    const glm::vec3 v = turned * (mesh.positions[corners[2]] - mesh.positions[corners[0]]);
    const glm::vec3 n = glm::cross(u, v);
    const float area = glm::dot(n, n);
    const glm::vec2 shift(glm::dot(glm::cross(way, v), n) / area, glm::dot(glm::cross(u, way), n) / area);
    // Seen edge-on there is no plane to move on.
    return std::isfinite(shift.x) && std::isfinite(shift.y) ? shift : glm::vec2(0);
}

float linearFromSrgb(float c) { return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f); }

std::array<float, 256> srgbTable() {
    std::array<float, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) table[i] = linearFromSrgb(static_cast<float>(i) / 255.0f);
    return table;
}

int wrapped(int i, int size, TextureWrap wrap) {
    switch (wrap) {
        case TextureWrap::Clamp:
            return std::clamp(i, 0, size - 1);
        case TextureWrap::Mirror: {
            const int period = ((i % (2 * size)) + 2 * size) % (2 * size);
            return period < size ? period : 2 * size - 1 - period;
        }
        case TextureWrap::Repeat:
            break;
    }
    return ((i % size) + size) % size;
}

glm::vec4 texelAt(const Texture& texture, int x, int y) {
    static const std::array<float, 256> kLinear = srgbTable();
    const auto row = static_cast<std::size_t>(wrapped(y, texture.height, texture.wrapV));
    const auto column = static_cast<std::size_t>(wrapped(x, texture.width, texture.wrapU));
    const std::uint8_t* t = &texture.rgba[4 * (row * static_cast<std::size_t>(texture.width) + column)];
    const float a = static_cast<float>(t[3]) / 255.0f;
    if (texture.srgb) return {kLinear[t[0]], kLinear[t[1]], kLinear[t[2]], a};
    return {static_cast<float>(t[0]) / 255.0f, static_cast<float>(t[1]) / 255.0f,
            static_cast<float>(t[2]) / 255.0f, a};
}

glm::vec4 baseColorAt(const Scene& scene, const Mesh& mesh, const Material& material,
                      const std::array<std::uint32_t, 3>& corners, const glm::vec2& b, const glm::vec2& uv) {
    return material.baseColor * interpolated(mesh.colors, corners, b, glm::vec4(1)) *
           sampleTexture(scene, material.baseColorTexture, uv);
}

float opacityOf(const glm::vec4& color) { return std::clamp(color.a, 0.0f, 1.0f); }

// Normal map on an interpolated normal, as in view/gbuffer.frag.glsl.
glm::vec3 mappedNormal(const glm::vec3& n, const glm::vec4& tangent, const glm::vec3& texel, float scale) {
    glm::vec3 t = glm::vec3(tangent) - n * glm::dot(n, glm::vec3(tangent));
    const float length = glm::length(t);
    if (!(length > 1e-6f)) return n;
    t /= length;
    const glm::vec3 b = glm::cross(n, t) * (tangent.w < 0 ? -1.0f : 1.0f);
    return glm::normalize(t * (texel.x * scale) + b * (texel.y * scale) + n * std::max(texel.z, 1e-3f));
}

// What of a surface its material says beside colour and emission.
void readMaterial(const Scene& scene, const glm::vec2& uv, Surface& s) {
    const Material& material = *s.material;
    const glm::vec4 metalRough = sampleTexture(scene, material.metallicRoughnessTexture, uv);
    s.metallic = material.metallic * metalRough.b;
    s.roughness = material.roughness * metalRough.g;
    const float ratio = material.ior > 0 ? (material.ior - 1) / (material.ior + 1) : 1.0f;
    s.dielectricF0 = glm::min(material.specularColor * (ratio * ratio), glm::vec3(1)) * material.specular *
                     sampleTexture(scene, material.specularTexture, uv).a *
                     glm::vec3(sampleTexture(scene, material.specularColorTexture, uv));
    if (isTransmissive(material)) {
        s.transmission = material.transmission * sampleTexture(scene, material.transmissionTexture, uv).r;
        s.solid = s.transmission > 0 && material.thickness > 0;
    }
    if (!hasLayers(material)) return;
    s.coat = material.coat * sampleTexture(scene, material.coatTexture, uv).r;
    s.coatRoughness = material.coatRoughness * sampleTexture(scene, material.coatRoughnessTexture, uv).g;
    s.sheenColor = material.sheenColor * glm::vec3(sampleTexture(scene, material.sheenColorTexture, uv));
    s.sheenRoughness = material.sheenRoughness * sampleTexture(scene, material.sheenRoughnessTexture, uv).a;
}

}  // namespace

const Material& materialOf(const Scene& scene, const Instance& instance) {
    static const Material kDefault;
    return instance.material < 0 ? kDefault : scene.materials[static_cast<std::size_t>(instance.material)];
}

glm::vec4 sampleTexture(const Scene& scene, const TextureRef& reference, const glm::vec2& uv) {
    if (!reference.used()) return glm::vec4(1);
    const Texture& texture = scene.textures[static_cast<std::size_t>(reference.texture)];
    const glm::vec3 at = reference.uvFromUv * glm::vec3(uv, 1);
    if (!std::isfinite(at.x) || !std::isfinite(at.y)) return texelAt(texture, 0, 0);
    // Large coordinates are reduced first, so that int holds the texel.
    const auto reduced = [](float c, TextureWrap wrap) {
        return wrap == TextureWrap::Clamp ? std::clamp(c, -1.0f, 2.0f) : c - 2.0f * std::floor(0.5f * c);
    };
    const float x = reduced(at.x, texture.wrapU) * static_cast<float>(texture.width);
    const float y = reduced(at.y, texture.wrapV) * static_cast<float>(texture.height);
    if (texture.filter == TextureFilter::Nearest)
        return texelAt(texture, static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)));
    const float x0 = std::floor(x - 0.5f), y0 = std::floor(y - 0.5f);
    const float fx = x - 0.5f - x0, fy = y - 0.5f - y0;
    const int ix = static_cast<int>(x0), iy = static_cast<int>(y0);
    return glm::mix(glm::mix(texelAt(texture, ix, iy), texelAt(texture, ix + 1, iy), fx),
                    glm::mix(texelAt(texture, ix, iy + 1), texelAt(texture, ix + 1, iy + 1), fx), fy);
}

bool coversAt(const Scene& scene, std::uint32_t instanceIndex, std::uint32_t triangle, const glm::vec2& b) {
    const Instance& instance = scene.instances[instanceIndex];
    const Material& material = materialOf(scene, instance);
    if (material.alphaMode == AlphaMode::Opaque) return true;
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
    const auto corners = cornersOf(mesh, triangle);
    const glm::vec2 uv = interpolated(mesh.uvs, corners, b, glm::vec2(0));
    const float cutoff = material.alphaMode == AlphaMode::Mask ? material.alphaCutoff : 0.5f;
    return baseColorAt(scene, mesh, material, corners, b, uv).a >= cutoff;
}

glm::vec3 emissionAt(const Scene& scene, std::uint32_t instanceIndex, std::uint32_t triangle,
                     const glm::vec2& b) {
    const Instance& instance = scene.instances[instanceIndex];
    const Material& material = materialOf(scene, instance);
    const bool blended = material.alphaMode == AlphaMode::Blend;
    if (material.unlit || (!blended && !coversAt(scene, instanceIndex, triangle, b))) return glm::vec3(0);
    if (!material.emissiveTexture.used() && !blended) return material.emission;
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
    const auto corners = cornersOf(mesh, triangle);
    const glm::vec2 uv = interpolated(mesh.uvs, corners, b, glm::vec2(0));
    const float opacity = blended ? opacityOf(baseColorAt(scene, mesh, material, corners, b, uv)) : 1.0f;
    return opacity * material.emission * glm::vec3(sampleTexture(scene, material.emissiveTexture, uv));
}

bool isTextured(const Scene& scene, const RayHit& hit) {
    return isTextured(materialOf(scene, scene.instances[hit.instance]));
}

bool isTextured(const Scene& scene) {
    return std::any_of(scene.materials.begin(), scene.materials.end(),
                       [](const Material& material) { return isTextured(material); });
}

namespace {

glm::vec3 positionOf(const Mesh& mesh, const glm::mat4& worldFromObject,
                     const std::array<std::uint32_t, 3>& corners, const glm::vec2& b) {
    return glm::vec3(worldFromObject *
                     glm::vec4(interpolated(mesh.positions, corners, offEdges(b), glm::vec3(0)), 1));
}

// By the inverse transpose; a missing one is flat.
glm::vec3 normalOf(const Mesh& mesh, const glm::mat3& worldFromObject,
                   const std::array<std::uint32_t, 3>& corners, const RayHit& hit) {
    if (mesh.normals.empty()) return hit.geometricNormal;
    const glm::vec3 n =
        normalTransform(worldFromObject) * interpolated(mesh.normals, corners, hit.barycentric, glm::vec3(0));
    return glm::length(n) > 1e-20f ? glm::normalize(n) : hit.geometricNormal;
}

}  // namespace

glm::mat3 normalTransform(const glm::mat3& worldFromObject) {
    const glm::mat3 cofactor(glm::cross(worldFromObject[1], worldFromObject[2]),
                             glm::cross(worldFromObject[2], worldFromObject[0]),
                             glm::cross(worldFromObject[0], worldFromObject[1]));
    return glm::determinant(worldFromObject) < 0 ? -cofactor : cofactor;
}

SurfacePoint pointAt(const Scene& scene, const RayHit& hit) {
    const Instance& instance = scene.instances[hit.instance];
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
    const auto corners = cornersOf(mesh, hit.triangle);
    return {positionOf(mesh, instance.worldFromObject, corners, hit.barycentric),
            normalOf(mesh, glm::mat3(instance.worldFromObject), corners, hit)};
}

Surface surfaceAt(const Scene& scene, const Ray& ray, const RayHit& hit, const glm::vec3& turn) {
    const Instance& instance = scene.instances[hit.instance];
    const Material& material = materialOf(scene, instance);
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
    const auto corners = cornersOf(mesh, hit.triangle);
    const glm::vec2 b = hit.barycentric;
    glm::vec2 read = b;
    if (turn != glm::vec3(0))
        read += barycentricShift(mesh, instance.worldFromObject, corners, ray, hit, turn);
    const glm::vec2 uv = interpolated(mesh.uvs, corners, read, glm::vec2(0));

    Surface s;
    // From the vertices, not along the ray: exact to the last places however far the ray has come.
    s.position = positionOf(mesh, instance.worldFromObject, corners, b);
    s.material = &material;
    s.frontFace = glm::dot(hit.geometricNormal, ray.direction) < 0;
    s.geometricNormal = s.frontFace ? hit.geometricNormal : -hit.geometricNormal;

    const glm::mat3 worldFromObject(instance.worldFromObject);
    const glm::vec3 vertexNormal = normalOf(mesh, worldFromObject, corners, hit);
    const auto mapped = [&](const TextureRef& map, float scale) {
        if (!map.used() || mesh.tangents.empty()) return vertexNormal;
        const glm::vec4 tangent = interpolated(mesh.tangents, corners, b, glm::vec4(0));
        const glm::vec3 texel = glm::vec3(sampleTexture(scene, map, uv)) * 2.0f - 1.0f;
        return mappedNormal(vertexNormal, {worldFromObject * glm::vec3(tangent), tangent.w}, texel, scale);
    };
    const glm::vec3 normal = mapped(material.normalTexture, material.normalScale);
    // The vertex normal decides which side the shading normal is on (view/gbuffer.frag.glsl).
    const bool turned = glm::dot(vertexNormal, s.geometricNormal) < 0;
    s.shadingNormal = turned ? -normal : normal;
    if (hasLayers(material)) {
        const glm::vec3 coatNormal = mapped(material.coatNormalTexture, material.coatNormalScale);
        s.coatNormal = turned ? -coatNormal : coatNormal;
    }

    const glm::vec4 color = baseColorAt(scene, mesh, material, corners, b, uv);
    const glm::vec3 base(color);
    if (material.alphaMode == AlphaMode::Blend) s.opacity = opacityOf(color);
    const bool shines = s.frontFace || material.doubleSided;
    s.unlit = material.unlit;
    if (s.unlit) {
        s.emission = base;
        return s;
    }
    s.baseColor = base;
    readMaterial(scene, uv, s);
    if (shines)
        s.emission = material.emission * glm::vec3(sampleTexture(scene, material.emissiveTexture, uv));
    return s;
}

}  // namespace conelight::reference
