// SPDX-License-Identifier: MIT
#include "light/baked_lookup.h"

#include <algorithm>

namespace conelight::light {
namespace {

// Voxels. Centres of faces are means of what a voxel holds, and lie beside its surfaces by less than its diagonal.
constexpr float kReach = 1.5f;
constexpr float kLeastCosine = 0.34f;  // of 70 degrees: faces show the mean of what looks their way

// Weights of a triangle's second and third corner at its point that is nearest to `p`, which counts from the first.
glm::vec2 nearestPlace(const glm::vec3& edge1, const glm::vec3& edge2, const glm::vec3& p) {
    const float a = glm::dot(edge1, edge1), b = glm::dot(edge1, edge2), c = glm::dot(edge2, edge2);
    const float d = glm::dot(edge1, p), e = glm::dot(edge2, p);
    const float determinant = a * c - b * b;
    if (determinant > 0) {
        const glm::vec2 inside((c * d - b * e) / determinant, (a * e - b * d) / determinant);
        if (inside.x >= 0 && inside.y >= 0 && inside.x + inside.y <= 1) return inside;
    }
    // Else on an edge.
    const auto part = [](float along, float length2) {
        return length2 > 0 ? std::clamp(along / length2, 0.0f, 1.0f) : 0.0f;
    };
    const float t = part(glm::dot(edge2 - edge1, p - edge1), glm::dot(edge2 - edge1, edge2 - edge1));
    const glm::vec2 places[] = {{part(d, a), 0}, {0, part(e, c)}, {1 - t, t}};
    const auto distance2 = [&](const glm::vec2& place) {
        const glm::vec3 way = p - place.x * edge1 - place.y * edge2;
        return glm::dot(way, way);
    };
    return *std::min_element(std::begin(places), std::end(places), [&](const auto& one, const auto& other) {
        return distance2(one) < distance2(other);
    });
}

}  // namespace

BakedLookup::BakedLookup(const BakedLight& baked, const voxels::VoxelGrid& grid)
    : baked_(baked), grid_(grid) {
    triangles_.reserve(baked.indices.size() / 3);
    for (std::size_t i = 0; i + 2 < baked.indices.size(); i += 3) {
        const glm::vec3 corner = grid.gridFromWorld(baked.positions[baked.indices[i]]);
        const glm::vec3 edge1 = grid.gridFromWorld(baked.positions[baked.indices[i + 1]]) - corner;
        const glm::vec3 edge2 = grid.gridFromWorld(baked.positions[baked.indices[i + 2]]) - corner;
        const glm::vec3 cross = glm::cross(edge1, edge2);
        const float length = glm::length(cross);
        triangles_.push_back({corner, edge1, edge2, length > 0 ? cross / length : glm::vec3(0)});
    }
    sortIntoBricks();
}

// Calls visit(brick) for those that a triangle's box, grown by the reach, meets.
template <class Visit>
void BakedLookup::visitBricks(const Triangle& t, const Visit& visit) const {
    const glm::vec3 b = t.corner + t.edge1, c = t.corner + t.edge2;
    const glm::vec3 bricks(grid_.bricks());
    const glm::ivec3 low(
        glm::clamp(glm::floor((glm::min(t.corner, glm::min(b, c)) - kReach) / 4.0f), glm::vec3(0), bricks));
    const glm::ivec3 high(glm::clamp(glm::floor((glm::max(t.corner, glm::max(b, c)) + kReach) / 4.0f),
                                     glm::vec3(-1), bricks - 1.0f));
    for (int z = low.z; z <= high.z; ++z)
        for (int y = low.y; y <= high.y; ++y)
            for (int x = low.x; x <= high.x; ++x) visit(voxels::brickIndex({x, y, z}, grid_.bricks()));
}

void BakedLookup::sortIntoBricks() {
    firstOf_.assign(grid_.brickCount() + 1, 0);
    for (const Triangle& triangle : triangles_)
        visitBricks(triangle, [&](std::uint32_t brick) { ++firstOf_[brick + 1]; });
    for (std::size_t i = 1; i < firstOf_.size(); ++i) firstOf_[i] += firstOf_[i - 1];
    listed_.resize(firstOf_.back());
    std::vector<std::uint32_t> next(firstOf_.begin(), firstOf_.end() - 1);
    for (std::uint32_t i = 0; i < triangles_.size(); ++i)
        visitBricks(triangles_[i], [&](std::uint32_t brick) { listed_[next[brick]++] = i; });
}

std::optional<glm::vec3> BakedLookup::irradiance(const glm::vec3& point, const glm::vec3& normal) const {
    const glm::ivec3 voxel = voxels::VoxelGrid::voxelOf(point);
    if (!grid_.contains(voxel)) return std::nullopt;
    const std::uint32_t brick = voxels::brickIndex(voxel / 4, grid_.bricks());
    // Surfaces as near as each other in a corner are told by their normals: a voxel away counts as a right angle.
    float least = kReach * kReach;
    std::optional<glm::vec3> found;
    for (std::uint32_t i = firstOf_[brick]; i < firstOf_[brick + 1]; ++i) {
        const Triangle& t = triangles_[listed_[i]];
        const float cosine = glm::dot(t.normal, normal);
        if (cosine < kLeastCosine) continue;
        const glm::vec3 p = point - t.corner;
        const glm::vec2 place = nearestPlace(t.edge1, t.edge2, p);
        const glm::vec3 way = p - place.x * t.edge1 - place.y * t.edge2;
        const float score = glm::dot(way, way) + (1 - cosine);
        if (!(score < least)) continue;
        least = score;
        const std::uint32_t* corners = &baked_.indices[3 * std::size_t{listed_[i]}];
        found = (1 - place.x - place.y) * baked_.irradiance[corners[0]] +
                place.x * baked_.irradiance[corners[1]] + place.y * baked_.irradiance[corners[2]];
    }
    return found ? std::optional(glm::max(*found, glm::vec3(0))) : std::nullopt;
}

}  // namespace conelight::light
