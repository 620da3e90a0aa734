// SPDX-License-Identifier: MIT
#include "scene/mesh_order.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "conelight/scene.h"

namespace conelight::scene {
namespace {

constexpr std::uint32_t kUnnamed = std::numeric_limits<std::uint32_t>::max();
constexpr float kMortonSteps = 1023;  // 10 bits per axis

struct Place {
    std::uint32_t code, triangle;
};

// Bits of a point's three coordinates in the box, in turn. One scale for all axes.
std::uint32_t mortonCode(const glm::vec3& point, const Aabb& box) {
    const glm::vec3 size = box.extent();
    const float extent = std::max({size.x, size.y, size.z, 1e-30f});
    std::uint32_t code = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const float along = (point[axis] - box.min[axis]) / extent * kMortonSteps;
        const auto cell = static_cast<std::uint32_t>(std::clamp(along, 0.0f, kMortonSteps));
        for (int bit = 0; bit < 10; ++bit) code |= (cell >> bit & 1u) << (3 * bit + axis);
    }
    return code;
}

}  // namespace

std::vector<std::uint32_t> orderForReuse(std::vector<gpu::Vertex>& vertices, std::size_t firstVertex,
                                         std::vector<std::uint32_t>& indices, std::size_t firstIndex) {
    const std::size_t triangles = (indices.size() - firstIndex) / 3;
    std::vector<std::uint32_t> order(vertices.size() - firstVertex);
    std::iota(order.begin(), order.end(), 0u);
    if (triangles == 0) return order;
    Aabb box;
    for (std::size_t i = firstVertex; i < vertices.size(); ++i) box.grow(vertices[i].position);
    const std::vector<std::uint32_t> before(indices.begin() + static_cast<std::ptrdiff_t>(firstIndex),
                                            indices.end());
    std::vector<Place> places(triangles);
    for (std::size_t t = 0; t < triangles; ++t) {
        const gpu::Vertex* mesh = &vertices[firstVertex];
        const glm::vec3 centre = (mesh[before[3 * t]].position + mesh[before[3 * t + 1]].position +
                                  mesh[before[3 * t + 2]].position) /
                                 3.0f;
        places[t] = {mortonCode(centre, box), static_cast<std::uint32_t>(t)};
    }
    std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
        return a.code != b.code ? a.code < b.code : a.triangle < b.triangle;
    });

    const std::vector<gpu::Vertex> old(vertices.begin() + static_cast<std::ptrdiff_t>(firstVertex),
                                       vertices.end());
    std::vector<std::uint32_t> number(old.size(), kUnnamed);
    std::uint32_t named = 0;
    for (std::size_t t = 0; t < triangles; ++t)
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t vertex = before[3 * places[t].triangle + corner];
            if (number[vertex] == kUnnamed) {
                vertices[firstVertex + named] = old[vertex];
                order[named] = vertex;
                number[vertex] = named++;
            }
            indices[firstIndex + 3 * t + corner] = number[vertex];
        }
    for (std::uint32_t vertex = 0; vertex < old.size(); ++vertex) {
        if (number[vertex] != kUnnamed) continue;
        order[named] = vertex;
        vertices[firstVertex + named++] = old[vertex];
    }
    return order;
}

}  // namespace conelight::scene
