// SPDX-License-Identifier: MIT
// The voxelizer's reference: Scene and VoxelGrid -> occupied voxels and their faces, on the CPU, in double
// precision, by other means than the shaders: separating axes for touching (Akenine-Moeller, "Fast 3D
// Triangle-Box Overlap Testing", 2001), Sutherland-Hodgman for clipping. Slow, plain, without textures.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <unordered_map>
#include <vector>

#include "conelight/scene.h"
#include "voxels/voxel_grid.h"

namespace conelight::test {

// In grid coordinates, counter-clockwise seen from the front.
struct ReferenceTriangle {
    std::array<glm::dvec3, 3> p;
    int material;
    bool twoSided;
    double area() const;
    glm::dvec3 normal() const;
};
std::vector<ReferenceTriangle> referenceTriangles(const Scene& scene, const voxels::VoxelGrid& grid);

// Does the triangle touch the cube of half edge `half` (borders included)?
bool touches(const ReferenceTriangle& t, const glm::dvec3& center, double half);

// What of the triangle lies in the voxel.
std::vector<glm::dvec3> clippedPolygon(const ReferenceTriangle& t, const glm::ivec3& voxel);
double polygonArea(const std::vector<glm::dvec3>& polygon);

// Calls `visit` for every voxel of the grid that the triangle touches when voxels are grown by `slack`.
void forEachVoxel(const ReferenceTriangle& t, const voxels::VoxelGrid& grid, double slack,
                  const std::function<void(const glm::ivec3&)>& visit);

// Sums of eq. 2.2 for one voxel and direction, of what is not hidden. Key: packVoxel(voxel) * 8 + direction.
struct ReferenceFace {
    double weight = 0;
    double area = 0;
    glm::dvec3 normal{0};
    glm::dvec3 center{0};  // times weight, relative to the voxel's centre
    glm::dvec3 albedo{0};
    glm::dvec3 lower{1}, upper{0};
    double offset = 0;     // of the plane, from the voxel's centre
    bool layered = false;  // something covers something else
};
// Bounds that a face record may have: those of what the face holds, rounded outwards; or smaller ones of
// which a plane piece fills as much as the face holds, where the surface ends askew within the voxel. Returns
// what is wrong, or nothing.
std::string wrongBounds(const ReferenceFace& face, int direction, const glm::dvec3& lower,
                        const glm::dvec3& upper);
using ReferenceFaces = std::unordered_map<std::uint64_t, ReferenceFace>;
// `hides`: what lies in front hides what it covers; false: all counts.
ReferenceFaces referenceFaces(const Scene& scene, const std::vector<ReferenceTriangle>& triangles,
                              const voxels::VoxelGrid& grid, bool hides = true);

}  // namespace conelight::test
