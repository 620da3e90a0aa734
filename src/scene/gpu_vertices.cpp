// SPDX-License-Identifier: MIT
#include "scene/gpu_vertices.h"

#include <algorithm>
#include <cmath>

#include "math/octahedral.h"

namespace conelight::scene {
namespace {

std::uint32_t packUnorm8(const glm::vec4& color) {
    std::uint32_t bits = 0;
    for (int i = 0; i < 4; ++i)
        bits |= static_cast<std::uint32_t>(std::lround(glm::clamp(color[i], 0.0f, 1.0f) * 255.0f)) << (8 * i);
    return bits;
}

// RGB9E5 of EXT_texture_shared_exponent, section "Conversion": rounding errs by 1/1022 of the largest
// channel.
std::uint32_t packRgb9e5(const glm::vec4& color) {
    constexpr float kLargest = 65408.0f;
    const glm::vec3 c = glm::clamp(glm::vec3(color), 0.0f, kLargest);
    const float most = std::max({c.r, c.g, c.b});
    int exponent = most > 0 ? std::max(-16, std::ilogb(most)) + 16 : 0;
    if (std::lround(std::ldexp(most, 24 - exponent)) == 512) ++exponent;
    std::uint32_t bits = static_cast<std::uint32_t>(exponent) << 27;
    for (int i = 0; i < 3; ++i)
        bits |= static_cast<std::uint32_t>(std::lround(std::ldexp(c[i], 24 - exponent))) << (9 * i);
    return bits;
}

// Area-weighted smooth normals would hide hard edges: missing normals are flat, which splits vertices.
struct FlatMesh {
    std::vector<glm::vec3> positions, normals;
    std::vector<std::uint32_t> source;  // vertex of the original mesh
};

FlatMesh flattened(const Mesh& mesh) {
    FlatMesh flat;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::vec3 a = mesh.positions[mesh.indices[i]];
        const glm::vec3 b = mesh.positions[mesh.indices[i + 1]];
        const glm::vec3 c = mesh.positions[mesh.indices[i + 2]];
        const glm::vec3 cross = glm::cross(b - a, c - a);
        const float length = glm::length(cross);
        const glm::vec3 normal = length > 0 ? cross / length : glm::vec3(0, 1, 0);
        for (int corner = 0; corner < 3; ++corner) {
            const std::uint32_t source = mesh.indices[i + static_cast<std::size_t>(corner)];
            flat.positions.push_back(mesh.positions[source]);
            flat.normals.push_back(normal);
            flat.source.push_back(source);
        }
    }
    return flat;
}

glm::vec3 unitOr(const glm::vec3& v, const glm::vec3& fallback) {
    const float length = glm::length(v);
    return length > 1e-20f && std::isfinite(length) ? v / length : fallback;
}

}  // namespace

bool hasWideColors(const Mesh& mesh) {
    bool wide = false;
    for (const glm::vec4& color : mesh.colors) {
        if (color.a != 1.0f) return false;
        for (int i = 0; i < 3; ++i) {
            // Values made of 8 bits, as most files have them, are off by rounding only.
            const float steps = color[i] * 255.0f;
            wide = wide || color[i] > 1.0f || std::fabs(steps - std::round(steps)) > 1e-3f;
        }
    }
    return wide;
}
bool appendVertices(const Mesh& mesh, std::vector<gpu::Vertex>& vertices) {
    const bool hasNormals = !mesh.normals.empty();
    FlatMesh flat;
    if (!hasNormals) flat = flattened(mesh);
    const bool wide = hasWideColors(mesh);
    const std::size_t count = hasNormals ? mesh.positions.size() : flat.positions.size();
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t source = hasNormals ? i : flat.source[i];
        gpu::Vertex vertex{};
        vertex.position = hasNormals ? mesh.positions[i] : flat.positions[i];
        const glm::vec3 normal = unitOr(hasNormals ? mesh.normals[i] : flat.normals[i], {0, 1, 0});
        vertex.normalOct = math::packSnorm2x16(math::octEncode(normal));
        const glm::vec2 uv = mesh.uvs.empty() ? glm::vec2(0) : mesh.uvs[source];
        vertex.u = std::isfinite(uv.x) ? uv.x : 0;
        vertex.v = std::isfinite(uv.y) ? uv.y : 0;
        const glm::vec4 tangent = mesh.tangents.empty() ? glm::vec4(1, 0, 0, 1) : mesh.tangents[source];
        const std::uint32_t packed =
            math::packSnorm2x16(math::octEncode(unitOr(glm::vec3(tangent), {1, 0, 0})));
        vertex.tangentOct = (packed & ~(VERTEX_SOLID_BITS | 1u)) | (tangent.w < 0 ? 1u : 0u);
        const glm::vec4 color = mesh.colors.empty() ? glm::vec4(1) : mesh.colors[source];
        vertex.color = wide ? packRgb9e5(color) : packUnorm8(color);
        vertices.push_back(vertex);
    }
    return hasNormals;
}

}  // namespace conelight::scene
