// SPDX-License-Identifier: MIT
#include "scene/framing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scene/triangles.h"

namespace conelight {
using scene::forTriangles;
namespace {

// From where a framed scene is seen: from the front, a little from the right and above.
const glm::vec3 kFrontSide = glm::normalize(glm::vec3(0.35f, 0.25f, 1.0f));

// Reaches of points beyond the four sides of a square picture whose eye is at the origin: by them the nearest eye that
// sees all points is found at once.
class Fit {
  public:
    Fit(const glm::vec3& up, const glm::vec3& side, float slope)
        : side_(side),
          right_(glm::normalize(glm::cross(up, side))),
          up_(glm::cross(side, right_)),
          slope_(slope) {}

    void add(const glm::vec3& p) {
        const float x = glm::dot(p, right_), y = glm::dot(p, up_), z = slope_ * glm::dot(p, side_);
        const std::array<float, 4> reach = {x + z, z - x, y + z, z - y};
        for (std::size_t i = 0; i < 4; ++i) reach_[i] = std::max(reach_[i], reach[i]);
        nearest_ = std::max(nearest_, z / slope_);
    }
    bool empty() const { return !std::isfinite(nearest_); }

    glm::vec3 eye() const {
        const float away = std::max(reach_[0] + reach_[1], reach_[2] + reach_[3]) / (2 * slope_);
        return right_ * (0.5f * (reach_[0] - reach_[1])) + up_ * (0.5f * (reach_[2] - reach_[3])) +
               side_ * std::max(away, nearest_);
    }

  private:
    static constexpr float kNone = -std::numeric_limits<float>::infinity();
    glm::vec3 side_, right_, up_;
    float slope_;
    std::array<float, 4> reach_{kNone, kNone, kNone, kNone};
    float nearest_ = kNone;
};

void takeUp(Camera& camera, const glm::vec3& side) {
    if (std::abs(glm::dot(side, camera.up)) > 0.99f) camera.up = {0, 0, -1};
}

// A scene that is one sheet, or nearly, is seen from the side that its triangles face: from behind,
// single-sided ones are not there.
glm::vec3 sideToSee(const Scene& scene) {
    glm::vec3 facing(0);
    float area = 0;
    forTriangles(scene, [&](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
        const glm::vec3 twice = glm::cross(b - a, c - a);
        facing += twice;
        area += glm::length(twice);
    });
    const float alike = area > 0 ? glm::length(facing) / area : 0;
    if (!(alike > 0.6f)) return kFrontSide;  // closed things have 0, a half of a sphere 0.5
    const glm::vec3 front = facing / glm::length(facing);
    const float cosine = glm::dot(front, kFrontSide);
    const glm::vec3 side = cosine < 0 ? kFrontSide - 2.0f * cosine * front : kFrontSide;
    return glm::normalize(side + 0.4f * front);
}

void setPlanes(Camera& camera, float radius) {
    camera.zNear = radius * 0.01f;
    camera.zFar = radius * 20.0f;
}

}  // namespace

// All corners of the bounds in a square picture, with a margin.
Camera frameCamera(const Aabb& bounds) {
    constexpr float kMargin = 1.05f;
    Camera camera;
    camera.name = "framed";
    if (bounds.empty()) return camera;
    const float radius = std::max(0.5f * glm::length(bounds.extent()), 1e-4f);
    const glm::vec3& side = kFrontSide;
    const glm::vec3 right = glm::normalize(glm::cross(camera.up, side)), up = glm::cross(side, right);
    float distance = 0;
    for (const glm::vec3& corner : bounds.corners()) {
        const glm::vec3 from = corner - bounds.center();
        const float beside = std::max(std::abs(glm::dot(from, right)), std::abs(glm::dot(from, up)));
        distance = std::max(distance, beside * kMargin / std::tan(0.5f * camera.fovY) + glm::dot(from, side));
    }
    camera.target = bounds.center();
    camera.eye = camera.target + side * std::max(distance, 0.5f * radius);
    setPlanes(camera, radius);
    return camera;
}

namespace scene {

Floor floorOf(const Scene& scene, const Aabb& bounds) {
    constexpr std::size_t kSlices = 64;
    constexpr float kLowest = 0.1f;  // of the height, from below
    const glm::vec3 size = bounds.extent();
    // What is as flat as a sheet is a floor as a whole.
    const float slice = std::max(kLowest * size.y, 1e-3f * std::max(size.x, size.z)) / float(kSlices);
    std::array<double, kSlices> areas{};
    if (slice > 0)
        forTriangles(scene, [&](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
            const glm::vec3 twice = glm::cross(b - a, c - a);
            const float height = (std::max({a.y, b.y, c.y}) - bounds.min.y) / slice;
            if (height < float(kSlices) && twice.y > 0.99f * glm::length(twice))
                areas[static_cast<std::size_t>(height)] += 0.5 * static_cast<double>(twice.y);
        });
    const auto largest = std::max_element(areas.begin(), areas.end());
    Floor floor;
    floor.height = bounds.min.y + slice * float(largest - areas.begin() + 1);
    floor.carries = *largest > 0.5 * static_cast<double>(size.x) * static_cast<double>(size.z);
    return floor;
}

Camera frameShape(const Scene& scene, const Aabb& bounds, const Floor& floor) {
    return frameShape(scene, bounds, floor, sideToSee(scene));
}

Camera frameShape(const Scene& scene, const Aabb& bounds, const Floor& floor, const glm::vec3& side) {
    constexpr float kMargin = 1.12f;
    Camera camera;
    camera.name = "framed";
    if (bounds.empty()) return camera;
    takeUp(camera, side);
    const float slope = std::tan(0.5f * camera.fovY) / kMargin;
    // Numbers are of the bounds' size: those of models far from the origin would lose their digits.
    const glm::vec3 middle = bounds.center();
    Fit all(camera.up, side, slope), above = all;
    Aabb shape;
    forTriangles(scene, [&](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
        const bool rises = !floor.carries || std::max({a.y, b.y, c.y}) > floor.height;
        for (const glm::vec3& p : {a, b, c}) {
            all.add(p - middle);
            if (!rises) continue;
            above.add(p - middle);
            shape.grow(p);
        }
    });
    if (all.empty()) return frameCamera(bounds);
    if (above.empty()) shape = bounds;
    const float radius = std::max(0.5f * glm::length(shape.extent()), 1e-4f);
    camera.eye = middle + (above.empty() ? all : above).eye();
    camera.eye += side * std::max(0.5f * radius - glm::dot(camera.eye - shape.center(), side), 0.0f);
    camera.target = camera.eye - side * glm::dot(camera.eye - shape.center(), side);
    setPlanes(camera, std::max(radius, 0.1f * glm::length(bounds.extent())));
    return camera;
}

}  // namespace scene
}  // namespace conelight
