// SPDX-License-Identifier: MIT
// What tests of the voxelizer share: scenes whose voxels the CPU reference knows, all that a build leaves on
// the GPU as one value, and a fixture that builds and compares. Coordinates of results are voxels.
#pragma once

#include <cstdint>
#include <vector>

#include "gl/pass.h"
#include "support/gl_fixture.h"
#include "support/reference_voxelizer.h"
#include "support/scenes.h"
#include "voxels/surface_voxels.h"
#include "voxels/voxel_record.h"

namespace conelight::test {

// A material without specular lobe; returns its index.
int addDiffuseMaterial(Scene& scene, const glm::vec3& albedo, bool doubleSided = false);
// Adds the mesh with material number `material`.
void addInstance(Scene& scene, Mesh mesh, int material, const glm::mat4& worldFromObject = glm::mat4(1));

// Two triangles over [-1,1]^2 in the plane z = 0, facing +z, uv from (0,0) to (repeats, repeats).
Mesh squareMesh(float repeats = 1);

// 12 triangles, each hundreds of voxels long, none along an axis.
Scene rotatedBox();
// 7,200 triangles.
Scene torus();

// What the voxelizer made.
struct VoxelizeResult {
    voxels::VoxelGrid grid;
    std::vector<std::uint32_t> brickWords;
    std::vector<std::uint32_t> records;
    std::vector<gpu::FaceRecord> faces;
    std::vector<gpu::FaceMaterial> materials;
    std::vector<std::uint32_t> bricks;
    double area = 0;  // in voxel sides
    std::vector<glm::ivec3> occupied;

    bool has(const glm::ivec3& voxel) const;
    // Of every bit above but the area's.
    std::uint64_t hash() const;
};

VoxelizeResult download(const voxels::SurfaceVoxels& surface);

// The area of all triangles.
double meshArea(const std::vector<ReferenceTriangle>& triangles);

class VoxelizeTest : public GlTest {
  protected:
    VoxelizeResult voxelize(const Scene& scene, int size, float padding = 0.03f);
    VoxelizeResult voxelize(const Scene& scene, const voxels::VoxelGrid& grid);
    // No voxel missed; none marked that no triangle comes within 1e-4 voxel of.
    static void expectSameVoxels(const Scene& scene, const VoxelizeResult& result);
};

}  // namespace conelight::test
