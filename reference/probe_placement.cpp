// SPDX-License-Identifier: MIT
// Triangles are halved along their longest edge until they are as small as cells; their bounds then tell which cells
// they lie in, with a little more.
#include "reference/probe_placement.h"

#include <algorithm>
#include <array>

namespace conelight::reference {
namespace {

class Cells {
  public:
    explicit Cells(const ProbeGrid& grid) : grid_(grid), met_(grid.size(), false) {}

    // In cells from the grid's corner.
    glm::vec3 inCells(const glm::vec3& point) const { return (point - grid_.origin) / grid_.spacing + 0.5f; }
    void add(std::array<glm::vec3, 3> p) {
        std::vector<std::array<glm::vec3, 3>> left = {p};
        while (!left.empty()) {
            p = left.back();
            left.pop_back();
            std::size_t longest = 0;
            const auto length = [&](std::size_t i) { return glm::distance(p[i], p[(i + 1) % 3]); };
            for (std::size_t i = 1; i < 3; ++i)
                if (length(i) > length(longest)) longest = i;
            if (!(length(longest) > 1)) {
                mark(p);
                continue;
            }
            const std::size_t a = longest, b = (longest + 1) % 3;
            const glm::vec3 middle = 0.5f * (p[a] + p[b]);
            left.push_back(p);
            left.back()[a] = middle;
            left.push_back(p);
            left.back()[b] = middle;
        }
    }
    std::vector<bool> nearMet() const {
        std::vector<bool> near(met_.size(), false);
        forCells(glm::ivec3(0), grid_.counts - 1, [&](const glm::ivec3& at) {
            forCells(at - 1, at + 1, [&](const glm::ivec3& beside) {
                if (met_[grid_.index(beside)]) near[grid_.index(at)] = true;
            });
        });
        return near;
    }

  private:
    // Cells from one to the other, as far as the grid has them.
    template <class Visit>
    void forCells(const glm::ivec3& first, const glm::ivec3& last, Visit visit) const {
        const glm::ivec3 low = glm::max(first, glm::ivec3(0)), high = glm::min(last, grid_.counts - 1);
        for (int z = low.z; z <= high.z; ++z)
            for (int y = low.y; y <= high.y; ++y)
                for (int x = low.x; x <= high.x; ++x) visit(glm::ivec3(x, y, z));
    }
    void mark(const std::array<glm::vec3, 3>& p) {
        constexpr float kRounding = 1e-3f;
        const glm::vec3 low = glm::min(glm::min(p[0], p[1]), p[2]) - kRounding;
        const glm::vec3 high = glm::max(glm::max(p[0], p[1]), p[2]) + kRounding;
        const glm::ivec3 first(glm::clamp(glm::floor(low), glm::vec3(0), glm::vec3(grid_.counts - 1)));
        const glm::ivec3 last(glm::clamp(glm::floor(high), glm::vec3(0), glm::vec3(grid_.counts - 1)));
        forCells(first, last, [&](const glm::ivec3& at) { met_[grid_.index(at)] = true; });
    }

    const ProbeGrid& grid_;
    std::vector<bool> met_;
};

}  // namespace

std::vector<bool> probesNearSurfaces(const Scene& scene, const ProbeGrid& grid) {
    Cells cells(grid);
    for (const Instance& instance : scene.instances) {
        if (!instance.visible || instance.mesh < 0) continue;
        const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            std::array<glm::vec3, 3> p;
            for (std::size_t k = 0; k < 3; ++k)
                p[k] = cells.inCells(
                    glm::vec3(instance.worldFromObject * glm::vec4(mesh.positions[mesh.indices[i + k]], 1)));
            cells.add(p);
        }
    }
    return cells.nearMet();
}

}  // namespace conelight::reference
