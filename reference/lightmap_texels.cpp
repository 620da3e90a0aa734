// SPDX-License-Identifier: MIT
#include "reference/lightmap_texels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace conelight::reference {
namespace {

std::array<glm::vec2, 3> cornersIn(const ChartedMesh& mesh, std::uint32_t triangle) {
    const std::size_t i = 3 * static_cast<std::size_t>(triangle);
    return {mesh.uvs[mesh.mesh.indices[i]], mesh.uvs[mesh.mesh.indices[i + 1]],
            mesh.uvs[mesh.mesh.indices[i + 2]]};
}

float cross(const glm::vec2& a, const glm::vec2& b) { return a.x * b.y - a.y * b.x; }

// Whether a triangle touches the square from `low` to `low` + 1 (separating axes).
bool touches(const std::array<glm::vec2, 3>& p, const glm::vec2& low) {
    const float area = cross(p[1] - p[0], p[2] - p[0]);
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::vec2 a = p[i], along = p[(i + 1) % 3] - a;
        // The corner of the square that lies deepest within the edge.
        glm::vec2 normal(-along.y, along.x);
        if (area < 0) normal = -normal;
        const glm::vec2 deepest(normal.x > 0 ? low.x + 1 : low.x, normal.y > 0 ? low.y + 1 : low.y);
        if (glm::dot(normal, deepest - a) < 0) return false;
    }
    return true;  // the caller looks at the triangle's bounds alone
}

// Nearest point of a segment, as a share of it.
float nearestAlong(const glm::vec2& a, const glm::vec2& b, const glm::vec2& p) {
    const float square = glm::dot(b - a, b - a);
    return square > 0 ? std::clamp(glm::dot(p - a, b - a) / square, 0.0f, 1.0f) : 0.0f;
}

// Weights of vertices 1 and 2 of the triangle's point nearest to `at`; its squared distance.
float nearest(const std::array<glm::vec2, 3>& p, const glm::vec2& at, glm::vec2& barycentric) {
    const float area = cross(p[1] - p[0], p[2] - p[0]);
    if (std::abs(area) > 1e-12f) {
        const glm::vec2 b(cross(at - p[0], p[2] - p[0]) / area, cross(p[1] - p[0], at - p[0]) / area);
        if (b.x >= 0 && b.y >= 0 && b.x + b.y <= 1) {
            barycentric = b;
            return 0;
        }
    }
    float least = INFINITY;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t k = (i + 1) % 3;
        const float t = nearestAlong(p[i], p[k], at);
        const glm::vec2 way = glm::mix(p[i], p[k], t) - at;
        if (!(glm::dot(way, way) < least)) continue;
        least = glm::dot(way, way);
        std::array<float, 3> weight{};
        weight[i] = 1 - t;
        weight[k] = t;
        barycentric = {weight[1], weight[2]};
    }
    return least;
}

}  // namespace

TexelCover::TexelCover(const ChartedMesh& mesh) : mesh_(mesh) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;  // texel, triangle
    const auto count = static_cast<std::uint32_t>(mesh.mesh.triangleCount());
    for (std::uint32_t t = 0; t < count; ++t) {
        const std::array<glm::vec2, 3> p = cornersIn(mesh, t);
        const glm::ivec2 low(glm::floor(glm::min(glm::min(p[0], p[1]), p[2])));
        const glm::ivec2 high(glm::floor(glm::max(glm::max(p[0], p[1]), p[2])));
        for (int y = std::max(low.y, 0); y <= std::min(high.y, mesh.size.y - 1); ++y)
            for (int x = std::max(low.x, 0); x <= std::min(high.x, mesh.size.x - 1); ++x)
                if (touches(p, glm::vec2(x, y)))
                    pairs.emplace_back(static_cast<std::uint32_t>(x + mesh.size.x * y), t);
    }
    std::sort(pairs.begin(), pairs.end());
    first_.assign(static_cast<std::size_t>(mesh.size.x) * static_cast<std::size_t>(mesh.size.y) + 1, 0);
    for (const auto& [texel, triangle] : pairs) {
        if (texels_.empty() || texels_.back() != texel) texels_.push_back(texel);
        triangles_.push_back(triangle);
        ++first_[static_cast<std::size_t>(texel) + 1];
    }
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
}

void TexelCover::pointOf(std::size_t texel, const glm::vec2& u, std::uint32_t& triangle,
                         glm::vec2& barycentric) const {
    const auto width = static_cast<std::size_t>(mesh_.size.x);
    const glm::vec2 at = glm::vec2(static_cast<float>(texel % width), static_cast<float>(texel / width)) + u;
    float least = INFINITY;
    for (std::uint32_t i = first_[texel]; i < first_[texel + 1] && least > 0; ++i) {
        glm::vec2 b(0);
        const float distance = nearest(cornersIn(mesh_, triangles_[i]), at, b);
        if (!(distance < least)) continue;
        least = distance;
        triangle = triangles_[i];
        barycentric = b;
    }
}

}  // namespace conelight::reference
