// SPDX-License-Identifier: MIT
// Second texture coordinates for light maps: a mesh -> charts, connected pieces of it that lie on a plane without
// covering each other, side by side in one rectangle of texels.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "conelight/scene.h"

namespace conelight::reference {

// Triangles whose normals differ by more than this from the middle of their chart begin another: a texel then
// covers at most 1.7 times the surface that it would cover straight on.
constexpr float kLeastChartCosine = 0.6f;

// An edge that two charts share and that is no crease, from end to end: its texels in one and in the other.
struct Seam {
    std::array<glm::vec2, 2> one, other;
};

struct ChartedMesh {
    // The triangles of the mesh in their order. Vertices on borders of charts are there once per chart.
    Mesh mesh;
    std::vector<glm::vec2> uvs;          // by vertex: texels from the corner of the rectangle
    std::vector<std::uint32_t> chartOf;  // by triangle
    std::uint32_t charts = 0;
    std::vector<Seam> seams;
    glm::ivec2 size{0};  // of the rectangle, texels
};

// A texel is `texel` m wide on the mesh placed by `worldFromObject`. Borders of charts run through middles of
// texels; two texels between charts belong to none. Throws Error(Usage) when the rectangle would be wider or
// higher than `side`; `what` starts the line. Throws Error(Runtime) when memory runs out.
ChartedMesh chartMesh(const Mesh& mesh, const glm::mat4& worldFromObject, float texel, int side,
                      const std::string& what);

// Rectangles side by side in a square of `side` or less: where each is, or false when they do not fit.
bool packRectangles(const std::vector<glm::ivec2>& sizes, const glm::ivec2& within,
                    std::vector<glm::ivec2>& places);

}  // namespace conelight::reference
