// SPDX-License-Identifier: MIT
// BakedLight at any point near its surfaces: the nearest triangle that looks the same way, interpolated. On the
// CPU, asked once for each face of the voxels of what does not move.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "conelight/scene.h"
#include "voxels/voxel_grid.h"

namespace conelight::light {

class BakedLookup {
  public:
    // Sorts the triangles into the bricks of `grid`; both are kept by reference.
    BakedLookup(const BakedLight& baked, const voxels::VoxelGrid& grid);

    // Irradiance, W/m^2, at a point in grid coordinates on a surface with this normal. Nothing where no surface is
    // within 1.5 voxels that looks within 70 degrees of it. Of equally good triangles the first.
    std::optional<glm::vec3> irradiance(const glm::vec3& point, const glm::vec3& normal) const;

  private:
    struct Triangle {
        glm::vec3 corner, edge1, edge2;  // grid coordinates
        glm::vec3 normal;                // unit
    };
    void sortIntoBricks();
    template <class Visit>
    void visitBricks(const Triangle& triangle, const Visit& visit) const;

    const BakedLight& baked_;
    const voxels::VoxelGrid& grid_;
    std::vector<Triangle> triangles_;
    std::vector<std::uint32_t> firstOf_, listed_;  // triangles by brick
};

}  // namespace conelight::light
