// SPDX-License-Identifier: MIT
// A scene's surfaces in a coarse grid: how far one sees in it, for choices that need no more.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "conelight/scene.h"

namespace conelight::scene {

class CoarseGrid {
  public:
    static constexpr int kBorder = 1;  // empty cells on each side

    // All visible triangles that nothing is seen through, in `cells` cells along the longest edge of their bounds, and
    // empty ones around them.
    CoarseGrid(const Scene& scene, const Aabb& bounds, int cells);

    glm::ivec3 size() const { return size_; }
    float edge() const { return edge_; }  // of a cell, m
    glm::vec3 middle(const glm::ivec3& cell) const { return origin_ + edge_ * (glm::vec3(cell) + 0.5f); }
    glm::ivec3 cellOf(const glm::vec3& p) const;  // the nearest one, of points outside
    bool empty(const glm::ivec3& cell) const { return cells_[at(cell)] == kEmpty; }
    // Corners of triangles in a cell.
    std::uint32_t corners(const glm::ivec3& cell) const { return cells_[at(cell)] & ~kTouched; }

    struct Hit {
        float distance = 0;   // m
        bool leaves = false;  // the grid, without having met anything
        glm::ivec3 cell{0};
    };
    // From the middle of a cell to the first one behind it that holds a surface.
    Hit look(const glm::ivec3& from, const glm::vec3& direction) const;

  private:
    static constexpr std::uint32_t kEmpty = 0, kTouched = 0x80000000u;
    std::size_t at(const glm::ivec3& cell) const {
        return static_cast<std::size_t>((cell.z * size_.y + cell.y) * size_.x + cell.x);
    }
    void touch(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);
    void count(const glm::vec3& p);

    glm::vec3 origin_{0};
    glm::ivec3 size_{0};
    float edge_ = 1;
    std::vector<std::uint32_t> cells_;  // kTouched by a triangle, and how many corners lie in it
};

}  // namespace conelight::scene
