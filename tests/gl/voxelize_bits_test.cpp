// SPDX-License-Identifier: MIT
// The voxelizer makes the same bits in every run: with any number of driver threads, whatever was built
// before, however many triangles one voxel sums.
#include "support/voxelize_rig.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>

#include "scene/gpu_scene.h"

namespace conelight::test {
namespace {

using voxels::VoxelGrid;
using VoxelizeBitsTest = VoxelizeTest;

// Prints a hash when asked to; else runs itself with 0, 1 and 2 driver threads and compares.
TEST_F(VoxelizeBitsTest, SameBitsWithAnyNumberOfThreads) {
    Scene scene = torus();
    addInstance(scene, squareMesh(), addDiffuseMaterial(scene, {0.2f, 0.7f, 0.3f}, true),
                glm::rotate(glm::mat4(1), 0.6f, {1, 1, 0.3f}));
    scene.materials[0].emission = {1, 2, 3};
    const std::uint64_t mine = voxelize(scene, 128).hash();
    if (std::getenv("CONELIGHT_PRINT_HASH") != nullptr) {
        std::printf("hash=%016llx\n", static_cast<unsigned long long>(mine));
        return;
    }
    for (const int threads : {0, 1, 2}) {
        const CommandResult child = runCommand(
            "LP_NUM_THREADS=" + std::to_string(threads) + " CONELIGHT_PRINT_HASH=1 /proc/" +
            std::to_string(getpid()) + "/exe --gtest_filter=VoxelizeBitsTest.SameBitsWithAnyNumberOfThreads");
        ASSERT_EQ(child.status, 0) << child.output;
        char expected[32];
        std::snprintf(expected, sizeof expected, "hash=%016llx", static_cast<unsigned long long>(mine));
        EXPECT_NE(child.output.find(expected), std::string::npos) << threads << " threads: " << child.output;
    }
}

TEST_F(VoxelizeBitsTest, RebuildingGivesTheSameBitsWhateverWasBuiltBefore) {
    const Scene small = rotatedBox();
    const Scene large = torus();
    const std::uint64_t fresh = voxelize(large, 128).hash();
    const scene::GpuScene gpuSmall(small);
    const scene::GpuScene gpuLarge(large);
    voxels::SurfaceVoxels surface;
    surface.build(device(), gpuSmall, VoxelSettings{16, 0.03f});
    const std::uint64_t first = download(surface).hash();
    surface.build(device(), gpuLarge, VoxelSettings{128, 0.03f});  // every list grows
    EXPECT_EQ(download(surface).hash(), fresh);
    for (int i = 0; i < 4; ++i) {
        surface.build(device(), gpuLarge, VoxelSettings{128, 0.03f});
        EXPECT_EQ(download(surface).hash(), fresh);
    }
    const std::size_t objects = gl::liveObjectCount();
    surface.build(device(), gpuSmall, VoxelSettings{16, 0.03f});
    EXPECT_EQ(download(surface).hash(), first);
    EXPECT_EQ(gl::liveObjectCount(), objects);
}

TEST_F(VoxelizeBitsTest, ManyTrianglesInOneVoxelAreSummedExactly) {
    // A torus of 7,200 triangles in a grid so coarse that each voxel holds hundreds.
    const Scene scene = torus();
    const VoxelizeResult r = voxelize(scene, 8);
    const ReferenceFaces reference = referenceFaces(scene, referenceTriangles(scene, r.grid), r.grid);
    double weight = 0, expected = 0;
    for (const gpu::FaceRecord& face : r.faces)
        weight += static_cast<double>(voxels::unpackWeight(face.offsetWeight));
    for (const auto& [key, face] : reference) expected += std::min(face.weight, 4.0);
    EXPECT_NEAR(weight / expected, 1.0, 1e-3);
    // 40 sheets in one voxel: more than the first unit of the sums can hold. The frontmost are seen.
    Scene stack;
    const int material = addDiffuseMaterial(stack, {0.2f, 0.4f, 0.8f});
    for (int i = 0; i < 40; ++i)
        addInstance(stack, squareMesh(), material,
                    glm::translate(glm::mat4(1), {0, 0, 0.002f * static_cast<float>(i)}));
    VoxelGrid grid;
    grid.origin = {-2, -2, -0.1f};
    grid.voxelSize = 0.25f;
    grid.size = {16, 16, 4};
    const VoxelizeResult sheets = voxelize(stack, grid);
    ASSERT_EQ(sheets.faces.size(), 64u);
    for (const gpu::FaceMaterial& seen : sheets.materials)
        EXPECT_NEAR(voxels::unpackAlbedo(seen.albedo).b, 0.8f, 1e-3f);
    for (const gpu::FaceRecord& face : sheets.faces) {
        EXPECT_NEAR(voxels::unpackWeight(face.offsetWeight), 1.0f, 1e-3f);
        // A slice of depth holds the last three, 0.074 to 0.078; the plane is the rearmost's of them.
        EXPECT_NEAR(voxels::unpackOffset(face.offsetWeight), (0.1f + 0.074f) / 0.25f - 0.5f, 1e-3f);
    }
}

}  // namespace
}  // namespace conelight::test
