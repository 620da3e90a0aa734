// SPDX-License-Identifier: MIT
#include "scene/coarse_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scene/triangles.h"

namespace conelight::scene {
namespace {

// Panes of windows, curtains of gauze.
bool isClear(const Scene& scene, const Instance& instance) {
    if (instance.material < 0) return false;
    const Material& material = scene.materials[static_cast<std::size_t>(instance.material)];
    return isTransmissive(material) || material.alphaMode == AlphaMode::Blend;
}

// Downwards; what is no number is `least`.
int wholeWithin(float x, int least, int most) {
    return static_cast<int>(
        std::floor(std::fmin(std::fmax(x, static_cast<float>(least)), static_cast<float>(most))));
}

}  // namespace

CoarseGrid::CoarseGrid(const Scene& scene, const Aabb& bounds, int cells) {
    const glm::vec3 extent = bounds.extent();
    edge_ = std::max({extent.x, extent.y, extent.z, 1e-6f}) / static_cast<float>(cells);
    // Of bounds beyond the range of floats all is in a few cells.
    if (!std::isfinite(edge_)) edge_ = std::numeric_limits<float>::max();
    for (int axis = 0; axis < 3; ++axis)
        size_[axis] = wholeWithin(std::ceil(extent[axis] / edge_), 0, cells) + 1 + 2 * kBorder;
    // Half a cell of room on either side: rounding leaves no surface in the border.
    origin_ = bounds.center() - 0.5f * edge_ * glm::vec3(size_);
    cells_.assign(static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y) *
                      static_cast<std::size_t>(size_.z),
                  kEmpty);
    for (const Instance& instance : scene.instances) {
        if (isClear(scene, instance)) continue;
        forTriangles(scene, instance, [&](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
            touch(a, b, c);
            for (const glm::vec3& p : {a, b, c}) count(p);
        });
    }
}

glm::ivec3 CoarseGrid::cellOf(const glm::vec3& p) const {
    const glm::vec3 at = (p - origin_) / edge_;
    return {wholeWithin(at.x, 0, size_.x - 1), wholeWithin(at.y, 0, size_.y - 1),
            wholeWithin(at.z, 0, size_.z - 1)};
}

void CoarseGrid::count(const glm::vec3& p) {
    std::uint32_t& cell = cells_[at(cellOf(p))];
    if ((cell & ~kTouched) < ~kTouched) ++cell;
    cell |= kTouched;
}

// Cells whose box the triangle's plane cuts, within the triangle's outlines along the axis that it faces most.
void CoarseGrid::touch(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const glm::ivec3 low = cellOf(glm::min(glm::min(a, b), c)), high = cellOf(glm::max(glm::max(a, b), c));
    if (low == high) return;
    const glm::vec3 normal = glm::cross(b - a, c - a), size = glm::abs(normal);
    const int w = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
    const int u = (w + 1) % 3, v = (w + 2) % 3;
    if (!(size[w] > 0)) return;  // its corners count
    const float turn = normal[w] > 0 ? 1.0f : -1.0f;
    const std::array<glm::vec3, 3> corners = {a, b, c};
    // How far a square's middle may lie outside an edge while the square still meets the inside.
    const auto meets = [&](const glm::vec2& middle) {
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::vec3 &p = corners[i], &q = corners[(i + 1) % 3];
            const glm::vec2 along(q[u] - p[u], q[v] - p[v]);
            const glm::vec2 inwards = turn * glm::vec2(-along.y, along.x);
            const float inside = inwards.x * (middle.x - p[u]) + inwards.y * (middle.y - p[v]);
            if (inside < -0.5f * edge_ * (std::abs(inwards.x) + std::abs(inwards.y))) return false;
        }
        return true;
    };
    const float slopeU = -normal[u] / normal[w], slopeV = -normal[v] / normal[w];
    const float half = 0.5f * edge_ * (std::abs(slopeU) + std::abs(slopeV));
    glm::ivec3 cell;
    for (cell[u] = low[u]; cell[u] <= high[u]; ++cell[u])
        for (cell[v] = low[v]; cell[v] <= high[v]; ++cell[v]) {
            cell[w] = low[w];
            glm::vec3 p = middle(cell);
            if (!meets({p[u], p[v]})) continue;
            const float height = a[w] + slopeU * (p[u] - a[u]) + slopeV * (p[v] - a[v]);
            const auto level = [&](float z) {
                return wholeWithin((z - origin_[w]) / edge_, low[w], high[w]);
            };
            for (cell[w] = level(height - half); cell[w] <= level(height + half); ++cell[w])
                cells_[at(cell)] |= kTouched;
        }
}

CoarseGrid::Hit CoarseGrid::look(const glm::ivec3& from, const glm::vec3& direction) const {
    Hit hit{0, false, from};
    glm::vec3 next, step;  // distances to the next cell along each axis, in edges of cells
    glm::ivec3 ahead;
    for (int k = 0; k < 3; ++k) {
        ahead[k] = direction[k] < 0 ? -1 : 1;
        step[k] = 1 / std::max(std::abs(direction[k]), 1e-9f);
        next[k] = 0.5f * step[k];
    }
    for (;;) {
        const int axis = next.x < next.y ? (next.x < next.z ? 0 : 2) : (next.y < next.z ? 1 : 2);
        hit.distance = next[axis] * edge_;
        hit.cell[axis] += ahead[axis];
        next[axis] += step[axis];
        if (hit.cell[axis] < 0 || hit.cell[axis] >= size_[axis]) {
            hit.leaves = true;
            return hit;
        }
        if (!empty(hit.cell)) return hit;
    }
}

}  // namespace conelight::scene
