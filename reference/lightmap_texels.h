// SPDX-License-Identifier: MIT
// Which triangles of a mesh lie in which texel of its second coordinates, and points in them.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "reference/lightmap_charts.h"

namespace conelight::reference {

class TexelCover {
  public:
    // `mesh` must outlive it.
    explicit TexelCover(const ChartedMesh& mesh);

    // Texels that a triangle touches, row by row: x + width * y.
    const std::vector<std::uint32_t>& texels() const { return texels_; }
    // The point at `u` of a texel, in [0,1)^2, or the nearest one that its triangles have.
    void pointOf(std::size_t texel, const glm::vec2& u, std::uint32_t& triangle,
                 glm::vec2& barycentric) const;

  private:
    const ChartedMesh& mesh_;
    std::vector<std::uint32_t> texels_;
    std::vector<std::uint32_t> first_;      // by texel of the rectangle, and one more
    std::vector<std::uint32_t> triangles_;  // by texel, one after the other
};

}  // namespace conelight::reference
