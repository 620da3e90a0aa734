// SPDX-License-Identifier: MIT
// Thin closed solids of two sides have no faces inside; thick ones, and what is open, have (docs/theory/2_voxels.md,
// "Insides of solids").
#include <glm/gtc/matrix_transform.hpp>

#include "support/scenes.h"
#include "support/voxelize_rig.h"

namespace conelight::test {
namespace {

// Of a box, in metres: three voxels of the finest of three levels of 64 voxels.
constexpr float kLevelEdge = 1;

class VoxelSolidsTest : public GlTest {
  protected:
    // In a space of 64 voxels of one metre.
    VoxelizeResult voxelized(Scene scene, int levels = 1, const glm::vec3& eye = glm::vec3(0)) {
        for (const float corner : {-31.0f, 31.0f})  // marks that stretch the grid
            addInstance(scene, quadMesh(glm::vec3(corner), {0.01f, 0, 0}, {0, 0, 0.01f}), Material{});
        gl::Device device = this->device();
        device.nestedGrids = levels > 1;
        const scene::GpuScene gpu(scene);
        VoxelSettings settings{64};
        settings.levels = levels;
        voxels::SurfaceVoxels surface;
        if (levels > 1)
            surface.build(device, gpu, voxels::SurfaceVoxels::gridAround(gpu, settings, eye));
        else
            surface.build(device, gpu, settings);
        return download(surface);
    }
    static Scene boxOf(float edge, bool twoSided, const glm::vec3& at = glm::vec3(0.3f, 0.2f, 0.1f)) {
        Scene scene;
        Material material;
        material.doubleSided = twoSided;
        const glm::mat4 turned = glm::rotate(glm::translate(glm::mat4(1), at), 0.4f, {1, 0.5f, 0.2f});
        addInstance(scene, boxMesh(), material, glm::scale(turned, glm::vec3(0.5f * edge)));
        return scene;
    }
};

TEST_F(VoxelSolidsTest, ThinOnesAreAsIfOfOneSide) {
    for (const float edge : {0.4f, 1.0f, 1.4f}) {
        const VoxelizeResult one = voxelized(boxOf(edge, false)), two = voxelized(boxOf(edge, true));
        ASSERT_EQ(one.faces.size(), two.faces.size()) << edge;
        for (std::size_t i = 0; i < one.faces.size(); ++i) {
            EXPECT_EQ(one.faces[i].normal, two.faces[i].normal);
            EXPECT_EQ(one.faces[i].offsetWeight, two.faces[i].offsetWeight);
            EXPECT_EQ(one.faces[i].bounds, two.faces[i].bounds);
        }
    }
}

// A box of 12 voxels may be a room.
TEST_F(VoxelSolidsTest, ThickOnesHaveAnInside) {
    const std::size_t outside = voxelized(boxOf(12, false)).faces.size();
    EXPECT_GT(voxelized(boxOf(12, true)).faces.size(), outside + outside / 2);
}

TEST_F(VoxelSolidsTest, OpenOnesHaveAnInside) {
    Scene scene = boxOf(1, true);
    scene.meshes[0].indices.resize(scene.meshes[0].indices.size() - 6);
    const VoxelizeResult open = voxelized(scene), closed = voxelized(boxOf(1, true));
    EXPECT_GT(open.faces.size(), closed.faces.size());
}

// Through its holes one sees the inside.
TEST_F(VoxelSolidsTest, MaskedOnesHaveAnInside) {
    Scene masked = boxOf(1, true);
    masked.materials[0].alphaMode = AlphaMode::Mask;
    EXPECT_GT(voxelized(masked).faces.size(), voxelized(boxOf(1, true)).faces.size());
}

// An instance that is scaled has another thickness, also where it is scaled along one axis.
TEST_F(VoxelSolidsTest, ScalesCount) {
    const auto faces = [&](bool twoSided, const glm::vec3& scale) {
        Scene scene = boxOf(1, twoSided);
        scene.instances[0].worldFromObject =
            glm::scale(glm::translate(glm::mat4(1), {0.1f, 0.3f, 0.2f}), scale);
        return voxelized(scene).faces.size();
    };
    const glm::vec3 board(6, 0.2f, 6), wall(6, 3, 6);  // 0.4 and 6 voxels thick
    EXPECT_EQ(faces(true, board), faces(false, board));
    EXPECT_GT(faces(true, wall), faces(false, wall) + 100);
}

// A box of 3 voxels of the finest level is thin for a level whose voxels are four times as large.
TEST_F(VoxelSolidsTest, LevelsDecideByTheirOwnVoxels) {
    const glm::vec3 near(-14.9f, -15.1f, -15.2f), far(14.8f, 15.1f, 15.2f);
    const auto facesAt = [&](bool twoSided, const glm::vec3& middle, int level) {
        const VoxelizeResult result = voxelized(boxOf(kLevelEdge, twoSided, middle), 3, near);
        EXPECT_EQ(result.grid.levels, 3);
        std::size_t count = 0;
        for (const gpu::FaceRecord& face : result.faces) {
            const glm::ivec3 stored = voxels::unpackVoxel(face.voxel);
            if (stored.z / result.grid.size.z != level) continue;
            const glm::ivec3 voxel(stored.x, stored.y, stored.z % result.grid.size.z);
            const glm::vec3 at = result.grid.level(level).worldFromGrid(glm::vec3(voxel) + 0.5f);
            count += glm::distance(at, middle) < 6 ? 1 : 0;
        }
        return count;
    };
    EXPECT_GT(facesAt(false, near, 0), 0u);
    EXPECT_GT(facesAt(true, near, 0), facesAt(false, near, 0));
    EXPECT_GT(facesAt(false, far, 2), 0u);
    EXPECT_EQ(facesAt(true, far, 2), facesAt(false, far, 2));
}

}  // namespace
}  // namespace conelight::test
