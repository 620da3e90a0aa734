// SPDX-License-Identifier: MIT
// The compute voxelizer against the CPU reference (tests/support/reference_voxelizer.h): which voxels, how
// much area, planes through edges, odd triangles.
#include "support/voxelize_rig.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>
#include <unordered_set>

#include "io/scene_file.h"
#include "math/octahedral.h"

namespace conelight::test {
namespace {

using voxels::VoxelGrid;

// --- Which voxels, how much area

class VoxelizeSizes : public VoxelizeTest, public ::testing::WithParamInterface<int> {};

TEST_P(VoxelizeSizes, RotatedBoxOfHugeTriangles) {
    const Scene scene = rotatedBox();
    expectSameVoxels(scene, voxelize(scene, GetParam()));
}

TEST_P(VoxelizeSizes, Torus) {
    const Scene scene = torus();
    expectSameVoxels(scene, voxelize(scene, GetParam()));
}

TEST_P(VoxelizeSizes, BuiltinSpheres) {
    const Scene scene = io::loadScene("builtin:spheres");
    expectSameVoxels(scene, voxelize(scene, GetParam()));
}

TEST_P(VoxelizeSizes, ThesisSceneWithLucy) {
    const std::optional<std::string> file = testData("vxct/scenes/scene.txt");
    if (!file) GTEST_SKIP() << "no test data";
    const Scene scene = io::loadScene(*file);
    expectSameVoxels(scene, voxelize(scene, GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Grid, VoxelizeSizes, ::testing::Values(64, 128, 256));

TEST_F(VoxelizeTest, TrianglesLargerThanTheGridAreClippedToIt) {
    const Scene scene = rotatedBox();
    // A window into the middle of one side and one edge, a tenth of the box; not cubic.
    VoxelGrid window;
    window.voxelSize = 0.004f;
    window.size = {64, 40, 52};
    const glm::vec3 corner(glm::vec3(scene.instances[0].worldFromObject * glm::vec4(0.9f, 1, 0.1f, 1)));
    window.origin = corner - 0.5f * window.voxelSize * glm::vec3(window.size);
    const VoxelizeResult result = voxelize(scene, window);
    std::size_t missed = 0, extra = 0, met = 0;
    std::unordered_set<std::uint32_t> nearly;
    double area = 0;
    for (const ReferenceTriangle& t : referenceTriangles(scene, window))
        forEachVoxel(t, window, 3e-4, [&](const glm::ivec3& voxel) {  // coordinates reach 500: a wider slack
            nearly.insert(voxels::packVoxel(voxel));
            if (!touches(t, glm::dvec3(voxel) + 0.5, 0.5)) return;
            ++met;
            missed += result.has(voxel) ? 0 : 1;
            area += polygonArea(clippedPolygon(t, voxel));
        });
    for (const glm::ivec3& voxel : result.occupied)
        extra += nearly.count(voxels::packVoxel(voxel)) != 0 ? 0 : 1;
    EXPECT_GT(met, 2000u);
    EXPECT_EQ(missed, 0u);
    EXPECT_EQ(extra, 0u);
    EXPECT_NEAR(result.area / area, 1.0, 1e-3);
}

TEST_F(VoxelizeTest, SceneOutsideTheGridGivesNothing) {
    VoxelGrid away;
    away.origin = glm::vec3(100);
    away.size = glm::ivec3(16);
    const VoxelizeResult result = voxelize(rotatedBox(), away);
    EXPECT_TRUE(result.occupied.empty());
    EXPECT_TRUE(result.faces.empty());
    EXPECT_TRUE(voxelize(Scene{}, 32).faces.empty());
}

TEST_F(VoxelizeTest, TheDiagonalSectionOfAVoxelHasItsFullArea) {
    // A plane at 45 degrees through the edges of voxels: area sqrt 2, the most a voxel can hold of a plane,
    // half of it each of its two faces'.
    Scene scene;
    addInstance(scene, squareMesh(), addDiffuseMaterial(scene, glm::vec3(1)),
                glm::rotate(glm::mat4(1), glm::quarter_pi<float>(), {1, 0, 0}));
    VoxelGrid grid;
    grid.origin = {-2, -2, -2 + 0.001f};
    grid.voxelSize = 0.25f;
    grid.size = glm::ivec3(16);
    const VoxelizeResult r = voxelize(scene, grid);
    EXPECT_NEAR(r.area, 64.0, 0.01);
    float largest = 0;
    for (const gpu::FaceMaterial& material : r.materials)
        largest = std::max(largest, voxels::unpackArea(material));
    EXPECT_NEAR(2 * largest, glm::root_two<float>(), 0.01f);
}

// Planes that hold edges of voxels, or their corners: every voxel must decide alike on which side an edge is.
TEST_F(VoxelizeTest, PlanesThroughEdgesKeepTheirArea) {
    const glm::vec3 normals[] = {{0, 1, 1}, {0, 1, -1}, {1, 0, 1}, {-1, 0, 1},
                                 {1, 1, 0}, {1, -1, 0}, {1, 1, 1}};
    for (const glm::vec3& normal : normals)
        for (const float voxel : {0.25f, 0.3f, 2.0f / 7})
            for (const float side : {-1.0f, 1.0f}) {
                const glm::vec3 n = side * glm::normalize(normal);
                // An edge that lies in the plane, exactly; the other is not along the grid.
                const glm::vec3 u = normal.x == 0   ? glm::vec3(2, 0, 0)
                                    : normal.y == 0 ? glm::vec3(0, 2, 0)
                                                    : glm::vec3(normal.y, -normal.x, 0);
                const glm::vec3 v = glm::cross(n, u) + 0.3f * u;
                Scene scene;
                Mesh mesh;
                mesh.positions = {-0.5f * (u + v), 0.5f * (u - v), 0.5f * (u + v), 0.5f * (v - u)};
                mesh.indices = {0, 1, 2, 0, 2, 3};
                addInstance(scene, std::move(mesh), addDiffuseMaterial(scene, glm::vec3(1)));
                const VoxelGrid grid{glm::vec3(-12 * voxel), voxel, glm::ivec3(24)};
                const double area = meshArea(referenceTriangles(scene, grid));
                EXPECT_NEAR(voxelize(scene, grid).area / area, 1.0, 2e-3)
                    << side * normal.x << ' ' << side * normal.y << ' ' << side * normal.z << ' ' << voxel;
            }
}

TEST_F(VoxelizeTest, ASurfaceExactlyOnABorderBelongsToTheUpperVoxelWhicheverWayItFaces) {
    for (const bool turned : {false, true}) {
        Scene scene;
        addInstance(scene, squareMesh(), addDiffuseMaterial(scene, glm::vec3(1)),
                    turned ? glm::rotate(glm::mat4(1), glm::pi<float>(), {1, 0, 0}) : glm::mat4(1));
        for (glm::vec3& p : scene.meshes[0].positions) p.z = 0;
        if (turned) {  // an exact half turn: the rotation above leaves 1e-7 behind
            scene.instances[0].worldFromObject = glm::scale(glm::mat4(1), {1, -1, -1});
        }
        VoxelGrid grid;
        grid.origin = {-2, -2, -1};
        grid.voxelSize = 0.25f;
        grid.size = {16, 16, 8};
        const VoxelizeResult r = voxelize(scene, grid);
        ASSERT_EQ(r.faces.size(), 64u);
        for (const gpu::FaceRecord& face : r.faces) {
            EXPECT_EQ(voxels::unpackVoxel(face.voxel).z, 4);
            EXPECT_NEAR(voxels::unpackWeight(face.offsetWeight), 1.0f, 1e-4f);
        }
        EXPECT_NEAR(r.area, 64.0, 1e-3);
    }
}

// --- Odd input

TEST_F(VoxelizeTest, DegenerateTrianglesAddNothingAndNothingIsNan) {
    Scene plain = torus();
    Scene scene = plain;
    Mesh odd;
    odd.positions = {{0, 0, 0},    {0, 0, 0},    {0, 0, 0},          {-0.5f, 0, 0},
                     {0.5f, 0, 0}, {0.1f, 0, 0}, {0.3f, 0.3f, 0.3f}, {0.3f, 0.3f, 0.30000001f}};
    odd.indices = {0, 1, 2, 3, 4, 5, 3, 3, 4, 6, 7, 6, 6, 7, 0, 4, 3, 3};
    addInstance(scene, odd, 0);
    // Scaled flat: every triangle of a box collapses or keeps an area in one plane only.
    addInstance(scene, boxMesh(), 0, glm::scale(glm::mat4(1), {0, 0, 0}));
    const VoxelGrid grid = voxels::fitGrid(plain.bounds(), 64, 0.03f);
    const VoxelizeResult with = voxelize(scene, grid);
    const VoxelizeResult without = voxelize(plain, grid);
    EXPECT_EQ(with.faces.size(), without.faces.size());
    EXPECT_EQ(with.hash(), without.hash());
    for (const gpu::FaceRecord& face : with.faces) {
        const glm::vec3 n = math::octDecode(math::unpackSnorm2x16(face.normal));
        EXPECT_NEAR(glm::length(n), 1.0f, 1e-5f);
    }
    for (const gpu::FaceMaterial& material : with.materials)
        EXPECT_TRUE(std::isfinite(voxels::unpackEmission(material).x));
}

TEST_F(VoxelizeTest, InvisibleAndUnvoxelizedInstancesAreLeftOutUnlitOnesAreBlack) {
    Scene scene = rotatedBox();
    scene.materials[0].unlit = true;
    scene.materials[0].emission = glm::vec3(5);
    scene.instances.push_back(scene.instances[0]);
    scene.instances[1].worldFromObject = glm::scale(glm::mat4(1), glm::vec3(0.2f));
    scene.instances[1].voxelized = false;
    scene.instances.push_back(scene.instances[1]);
    scene.instances[2].visible = false;
    const VoxelizeResult r = voxelize(scene, 64);
    expectSameVoxels(scene, r);
    for (const gpu::FaceMaterial& material : r.materials) {
        EXPECT_EQ(material.albedo, 0u);
        EXPECT_EQ(voxels::unpackEmission(material), glm::vec3(0));
    }
}

}  // namespace
}  // namespace conelight::test
