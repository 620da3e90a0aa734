// SPDX-License-Identifier: MIT
#include "scene/emissive_boxes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "scene/emissive_quads.h"

namespace conelight::scene {
namespace {

constexpr std::size_t kSides = 6, kTriangles = 12, kCorners = 8;
// What counts as one place, in parts of the box's diagonal.
constexpr float kSame = 1e-4f;

using Sides = std::array<Light, kSides>;

std::array<glm::vec3, 6> twoTriangles(const Mesh& mesh, std::size_t first, std::size_t second) {
    std::array<glm::vec3, 6> corners;
    for (std::size_t i = 0; i < 3; ++i) {
        corners[i] = mesh.positions[mesh.indices[3 * first + i]];
        corners[3 + i] = mesh.positions[mesh.indices[3 * second + i]];
    }
    return corners;
}

// Six parallelograms of two triangles each, in the order of the first of these.
std::optional<Sides> sidesOf(const Mesh& mesh, const Instance& instance, const Material& material) {
    const float size = glm::length(mesh.bounds().extent());
    Sides sides;
    std::size_t count = 0;
    std::array<bool, kTriangles> taken{};
    for (std::size_t i = 0; i < kTriangles; ++i)
        for (std::size_t j = i + 1; j < kTriangles && !taken[i]; ++j) {
            if (taken[j]) continue;
            const std::optional<Light> side = quadLight(twoTriangles(mesh, i, j), size, instance, material);
            if (!side) continue;
            taken[i] = taken[j] = true;
            sides[count++] = *side;
        }
    return count == kSides ? std::optional(sides) : std::nullopt;
}

glm::vec3 middleOf(const Sides& sides) {
    glm::vec3 sum(0);
    for (const Light& side : sides) sum += side.position;
    return sum / static_cast<float>(kSides);
}

// Places that differ, of all corners of all sides: those of a box are eight.
std::size_t countCorners(const Sides& sides, float near) {
    std::vector<glm::vec3> places;
    for (const Light& side : sides)
        for (const glm::vec2 at : {glm::vec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
            const glm::vec3 corner = side.position + at.x * side.halfU + at.y * side.halfV;
            const bool known = std::any_of(places.begin(), places.end(), [&](const glm::vec3& place) {
                return glm::length(place - corner) <= near;
            });
            if (!known) places.push_back(corner);
        }
    return places.size();
}

// Half the least distance of opposite sides; none unless the sides are those of a box, which all look outwards.
std::optional<float> halfThickness(const Sides& sides) {
    const glm::vec3 middle = middleOf(sides);
    float thinnest = INFINITY, farthest = 0;
    for (const Light& side : sides) {
        thinnest = std::min(thinnest, glm::dot(side.position - middle, side.direction));
        farthest = std::max(farthest, glm::length(side.position - middle) + glm::length(side.halfU) +
                                          glm::length(side.halfV));
    }
    const float near = kSame * farthest;
    if (!(thinnest > near) || countCorners(sides, near) != kCorners) return std::nullopt;
    for (const Light& side : sides) {
        const glm::vec3 across = 2.0f * middle - side.position;
        const bool opposite = std::any_of(sides.begin(), sides.end(), [&](const Light& other) {
            return glm::length(other.position - across) <= near;
        });
        if (!opposite) return std::nullopt;
    }
    return thinnest;
}

}  // namespace

void addEmissiveBoxes(const Scene& scene, float largest, std::vector<SmallLamp>& lamps) {
    std::vector<SmallLamp> found;
    for (const std::size_t i : possibleLamps(scene, kTriangles, kTriangles)) {
        const Instance& instance = scene.instances[i];
        const std::optional<Sides> sides =
            sidesOf(scene.meshes[static_cast<std::size_t>(instance.mesh)], instance,
                    scene.materials[static_cast<std::size_t>(instance.material)]);
        const std::optional<float> half = sides ? halfThickness(*sides) : std::nullopt;
        if (!half || *half >= largest) continue;
        for (const Light& side : *sides) found.push_back({i, side});
    }
    if (found.size() <= kMostEmissiveBoxes * kSides) lamps.insert(lamps.end(), found.begin(), found.end());
}

}  // namespace conelight::scene
