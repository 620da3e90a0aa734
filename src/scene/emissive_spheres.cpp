// SPDX-License-Identifier: MIT
#include "scene/emissive_spheres.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace conelight::scene {
namespace {

// An icosahedron is the coarsest ball. More triangles than these are no small bulb, and take time at each change.
constexpr std::size_t kFewestTriangles = 20, kMostTriangles = 8192;
// How much nearer to the middle than the farthest corner the nearest may be.
constexpr double kRound = 0.99;
// Of an icosahedron, the mean height of faces over the radius is 0.79.
constexpr double kLeastHeight = 0.75;
// A polyhedron of corners on a sphere has nearly this part of the sphere's area, times that height, unless faces are
// missing; and never more than the sphere.
constexpr double kWholeArea = 0.95, kMostArea = 1.001;

// Bounds of a ball over the radius of the sphere of its area: an icosahedron has 2.3 at most.
constexpr float kWidest = 2.4f;

struct Ball {
    glm::vec3 center;
    float radius;  // of the sphere with the mesh's area
};

// Corners from the middle of their bounds, of a mesh whose bounds are those of a ball of less than this radius; else none.
std::vector<glm::dvec3> cornersOf(const Mesh& mesh, const glm::mat4& worldFromObject, float largest,
                                  glm::dvec3& center) {
    std::vector<glm::dvec3> corners;
    const auto inWorld = [&](std::uint32_t i) {
        return glm::vec3(worldFromObject * glm::vec4(mesh.positions[i], 1));
    };
    Aabb box;
    for (const std::uint32_t i : mesh.indices) {
        box.grow(inWorld(i));
        const glm::vec3 extent = box.extent();
        if (std::max({extent.x, extent.y, extent.z}) > kWidest * largest) return corners;
    }
    center = glm::dvec3(box.center());
    corners.reserve(mesh.indices.size());
    for (const std::uint32_t i : mesh.indices) corners.emplace_back(glm::dvec3(inWorld(i)) - center);
    return corners;
}

// The ball that a closed mesh is in the world, or nothing.
std::optional<Ball> ballOf(const Mesh& mesh, const glm::mat4& worldFromObject, float largest) {
    glm::dvec3 center;
    const std::vector<glm::dvec3> corners = cornersOf(mesh, worldFromObject, largest, center);
    double nearest = INFINITY, farthest = 0, area = 0, volume = 0;
    for (const glm::dvec3& corner : corners) {
        const double radius = glm::length(corner);
        nearest = std::min(nearest, radius);
        farthest = std::max(farthest, radius);
    }
    if (!(farthest > 0 && nearest > kRound * farthest)) return std::nullopt;
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
        const glm::dvec3 &a = corners[i], &b = corners[i + 1], &c = corners[i + 2];
        area += 0.5 * glm::length(glm::cross(b - a, c - a));
        volume += glm::dot(a, glm::cross(b, c)) / 6;
    }
    // Below 0 where it shines inwards.
    if (glm::determinant(glm::mat3(worldFromObject)) < 0) volume = -volume;
    const double sphereArea = 4 * std::numbers::pi * farthest * farthest;
    const double height = 3 * volume / (farthest * area);
    const bool whole = height > kLeastHeight && area > kWholeArea * height * sphereArea;
    if (!whole || area > kMostArea * sphereArea) return std::nullopt;
    return Ball{glm::vec3(center), static_cast<float>(std::sqrt(area / (4 * std::numbers::pi)))};
}

Light sphereLight(const Ball& ball, const Scene& scene, const Instance& instance) {
    Light light;
    light.name = instance.name;
    light.type = LightType::Sphere;
    light.intensity = scene.materials[static_cast<std::size_t>(instance.material)].emission;
    light.position = ball.center;
    light.halfU = {ball.radius, 0, 0};
    return light;
}

}  // namespace

void addEmissiveSpheres(const Scene& scene, float largest, std::vector<SmallLamp>& lamps) {
    std::vector<SmallLamp> found;
    for (const std::size_t i : possibleLamps(scene, kFewestTriangles, kMostTriangles)) {
        const Instance& instance = scene.instances[i];
        const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
        const std::optional<Ball> ball = ballOf(mesh, instance.worldFromObject, largest);
        if (ball && ball->radius < largest) found.push_back({i, sphereLight(*ball, scene, instance)});
    }
    if (found.size() <= kMostEmissiveSpheres) lamps.insert(lamps.end(), found.begin(), found.end());
}

}  // namespace conelight::scene
