// SPDX-License-Identifier: MIT
// Voxels in nested grids: each level holds what a grid of its own would, but for what the next finer one holds; rays
// cross the levels, and find triangles where they are.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <random>
#include <set>

#include "scene/gpu_scene.h"
#include "support/voxelize_rig.h"
#include "voxels/nested_grid.h"
#include "voxels/octant_words.h"
#include "voxels/ray_query.h"

namespace conelight::test {
namespace {

using voxels::VoxelGrid;

constexpr float kEdge = 40;  // m, of the room that all stands in

void addScaled(Scene& scene, Mesh mesh, const glm::vec3& at, float scale, float turn) {
    const glm::mat4 turned = glm::rotate(glm::translate(glm::mat4(1), at), turn, {0.3f, 1, 0.2f});
    addInstance(scene, std::move(mesh), 0, glm::scale(turned, glm::vec3(scale)));
}

// A closed room, turned, seen from inside; boxes near its middle and far from it.
Scene roomWithBoxes() {
    Scene scene;
    addDiffuseMaterial(scene, {0.5f, 0.5f, 0.5f});
    Mesh inwards = boxMesh();
    for (std::size_t i = 0; i < inwards.indices.size(); i += 3)
        std::swap(inwards.indices[i + 1], inwards.indices[i + 2]);
    addScaled(scene, inwards, {0, 0, 0}, kEdge / 2, 0.3f);
    addScaled(scene, boxMesh(), {1, 0.5f, 0.3f}, 0.7f, 0.5f);
    addScaled(scene, boxMesh(), {-0.8f, -0.4f, 0.9f}, 0.35f, 1.1f);
    addScaled(scene, boxMesh(), {4, 1, -3}, 1.5f, 0.9f);
    addScaled(scene, boxMesh(), {-9, -6, 8}, 3, 0.2f);
    return scene;
}

class NestedVoxelsTest : public GlTest {
  protected:
    void TearDown() override {
        surface_ = {};
        octants_ = {};
        GlTest::TearDown();
    }
    gl::Device nested() {
        gl::Device device = this->device();
        device.nestedGrids = true;
        return device;
    }
    void voxelize(const Scene& scene, int size, int levels, const glm::vec3& eye) {
        const scene::GpuScene gpu(scene);
        VoxelSettings settings{size};
        settings.levels = levels;
        grid_ = voxels::SurfaceVoxels::gridAround(gpu, settings, eye);
        surface_.build(nested(), gpu, grid_);
    }
    static VoxelizeResult oneGrid(const gl::Device& device, const Scene& scene, const VoxelGrid& grid) {
        const scene::GpuScene gpu(scene);
        voxels::SurfaceVoxels surface;
        surface.build(device, gpu, grid);
        return download(surface);
    }
    void expectLevel(int level, const VoxelizeResult& all, const VoxelizeResult& alone);
    std::vector<glm::vec4> traced(const std::vector<glm::vec4>& rays);

    VoxelGrid grid_;
    voxels::SurfaceVoxels surface_;
    voxels::OctantWords octants_;
};

std::uint32_t recordOf(const VoxelizeResult& r, const glm::ivec3& voxel) {
    return voxels::VoxelTables{r.grid, r.brickWords, r.records, {}}.record(voxel);
}

// Coordinates are rounded otherwise in the two: touches may differ, and pieces by the rounding of what is stored.
void NestedVoxelsTest::expectLevel(int level, const VoxelizeResult& all, const VoxelizeResult& alone) {
    std::size_t differ = 0, faces = 0, apart = 0, held = 0;
    for (int z = 0; z < grid_.size.z; ++z)
        for (int y = 0; y < grid_.size.y; ++y)
            for (int x = 0; x < grid_.size.x; ++x) {
                const glm::ivec3 voxel(x, y, z), stored = voxels::storedVoxel(grid_, level, voxel);
                if (voxels::isWithinFiner(grid_, level, voxel)) {
                    held += all.has(stored) ? 1 : 0;
                    continue;
                }
                const bool there = alone.has(voxel);
                differ += there != all.has(stored) ? 1 : 0;
                if (!there || !all.has(stored)) continue;
                const std::uint32_t a = recordOf(all, stored), b = recordOf(alone, voxel);
                differ += a >> 26 != b >> 26 ? 1 : 0;
                if (a >> 26 != b >> 26) continue;
                for (int i = 0; i < std::popcount(a >> 26); ++i) {
                    const auto at = static_cast<std::uint32_t>(i);
                    const gpu::FaceRecord& one = all.faces[(a & 0x3ffffffu) + at];
                    const gpu::FaceRecord& other = alone.faces[(b & 0x3ffffffu) + at];
                    EXPECT_EQ(voxels::unpackVoxel(one.voxel), stored);
                    const float offset =
                        voxels::unpackOffset(one.offsetWeight) - voxels::unpackOffset(other.offsetWeight);
                    const float weight =
                        voxels::unpackWeight(one.offsetWeight) - voxels::unpackWeight(other.offsetWeight);
                    ++faces;
                    apart += std::abs(offset) > 1e-3f || std::abs(weight) > 1e-3f ? 1 : 0;
                }
            }
    EXPECT_EQ(held, 0u) << "level " << level;
    EXPECT_GT(faces, 300u) << "level " << level;
    EXPECT_LE(differ, faces / 200) << "level " << level << ", of " << faces;
    EXPECT_LE(apart, faces / 200) << "level " << level << ", of " << faces;
}

// Faces of `a`, and how many of either are not in the other.
std::pair<std::size_t, std::size_t> compared(const VoxelizeResult& a, const VoxelizeResult& b) {
    const auto table = [](const VoxelizeResult& r) {
        std::map<std::pair<std::uint32_t, int>, std::pair<gpu::FaceRecord, gpu::FaceMaterial>> faces;
        for (std::size_t i = 0; i < r.faces.size(); ++i) {
            const gpu::FaceRecord& face = r.faces[i];
            const int turn = static_cast<int>(faces.count({face.voxel, 0}));  // two look along one axis
            faces[{face.voxel, turn}] = {face, r.materials[i]};
        }
        return faces;
    };
    const auto left = table(a), right = table(b);
    std::size_t differ = 0;
    for (const auto& [key, face] : left) {
        const auto other = right.find(key);
        const bool found = other != right.end();
        const auto close = [&](auto unpack) {
            return std::abs(unpack(face.first.offsetWeight) - unpack(other->second.first.offsetWeight)) <
                   1e-3f;
        };
        const bool same = found && close(voxels::unpackOffset) && close(voxels::unpackWeight) &&
                          face.second.emission == other->second.second.emission;
        differ += same ? 0 : 1;
    }
    for (const auto& entry : right) differ += left.count(entry.first) == 0 ? 1 : 0;
    return {left.size(), differ};
}

// xyz, xyz -> face, t
std::vector<glm::vec4> NestedVoxelsTest::traced(const std::vector<glm::vec4>& rays) {
    addShader("test/nested_rays.comp.glsl", R"(#version 450 core
layout(local_size_x = 64) in;
#include "lib/linear_index.glsl"
#include "lib/ray_query.glsl"
layout(std430) buffer Data { vec4 data[]; };
void main() {
    uint i = 2u * linearIndex();
    if (i >= uint(data.length())) return;
    VoxelHit hit = traceVoxels(Ray(data[i].xyz, data[i + 1u].xyz, data[i].w, vec3(0.0)));
    data[i] = vec4(intBitsToFloat(hit.face), hit.t, 0.0, 0.0);
}
)");
    octants_.build(nested(), surface_);
    gl::Buffer buffer(rays, "rays");
    nested()
        .get({{"test/nested_rays.comp.glsl"}, {}})
        .dispatchLinear(gl::Inputs().add(surface_).add(octants_).storage("Data", buffer), rays.size() / 2);
    gl::barrier(gl::Access::ShaderStorage);
    return buffer.read<glm::vec4>(rays.size());
}

// The first front of a triangle on a ray, in grid coordinates; infinity: none.
double firstFront(const std::vector<ReferenceTriangle>& triangles, const glm::dvec3& origin,
                  const glm::dvec3& direction) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const ReferenceTriangle& t : triangles) {
        const glm::dvec3 e1 = t.p[1] - t.p[0], e2 = t.p[2] - t.p[0], p = glm::cross(direction, e2);
        const double determinant = glm::dot(e1, p);
        if (determinant <= 0) continue;
        const glm::dvec3 from = origin - t.p[0], q = glm::cross(from, e1);
        const double u = glm::dot(from, p) / determinant, v = glm::dot(direction, q) / determinant;
        const double along = glm::dot(e2, q) / determinant;
        if (u >= 0 && v >= 0 && u + v <= 1 && along > 0) nearest = std::min(nearest, along);
    }
    return nearest;
}

}  // namespace

TEST_F(NestedVoxelsTest, EachLevelHoldsWhatAGridOfItsOwnWould) {
    const Scene scene = roomWithBoxes();
    voxelize(scene, 48, 4, {0.5f, 0.2f, 0.1f});
    ASSERT_EQ(grid_.levels, 4);
    const VoxelizeResult all = download(surface_);
    for (int level = 0; level < grid_.levels; ++level)
        expectLevel(level, all, oneGrid(device(), scene, grid_.level(level)));
}

// Whatever the eye, levels have the anchor near their middle: those that need not be moved inwards at the scene's border.
TEST_F(NestedVoxelsTest, LevelsLieRoundTheAnchor) {
    const scene::GpuScene gpu(roomWithBoxes());
    VoxelSettings settings{64};
    settings.levels = 4;
    const glm::vec3 anchor(5, -3, 2), eye(-11, 4, 6);
    const VoxelGrid byEye = voxels::SurfaceVoxels::gridAround(gpu, settings, eye);
    settings.anchor = VoxelAnchor::at(anchor);
    const VoxelGrid grid = voxels::SurfaceVoxels::gridAround(gpu, settings, eye);
    EXPECT_FALSE(grid == byEye);
    EXPECT_EQ(grid, voxels::SurfaceVoxels::gridAround(gpu, settings, anchor));
    ASSERT_EQ(grid.levels, 4);
    for (int level = 0; level < 2; ++level) {
        const VoxelGrid one = grid.level(level);
        const glm::vec3 apart =
            glm::abs(one.worldFromGrid(0.5f * glm::vec3(one.size)) - anchor) / one.voxelSize;
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_LE(apart[axis], static_cast<float>(one.size[axis]) / 7.9f) << level;
    }
    settings.anchor = {{}, {false, anchor.y}, {}};
    EXPECT_EQ(voxels::SurfaceVoxels::gridAround(gpu, settings, {5, 17, 2}), grid);
}

TEST_F(NestedVoxelsTest, UpdatesGiveTheBitsOfABuild) {
    Scene scene = roomWithBoxes();
    voxelize(scene, 32, 3, {0.5f, 0.2f, 0.1f});
    scene::GpuScene gpu(scene);
    voxels::SurfaceVoxels surface;
    surface.updateInSteps(nested(), gpu, grid_).finish();
    for (const std::size_t moved : {1u, 3u, 4u}) {
        Instance instance = scene.instances[moved];
        instance.worldFromObject[3] += glm::vec4(1.3f, 0.4f, -2.1f, 0);
        gpu.setInstance(moved, instance);
        surface.updateInSteps(nested(), gpu, grid_).finish();
        EXPECT_FALSE(surface.lastUpdate().whole);
        voxels::SurfaceVoxels whole;
        whole.build(nested(), gpu, grid_);
        const VoxelizeResult a = download(surface), b = download(whole);
        EXPECT_EQ(a.brickWords, b.brickWords) << moved;
        EXPECT_EQ(a.records, b.records) << moved;
        EXPECT_EQ(a.hash(), b.hash()) << moved;
    }
}

// Levels that move keep what stays in them, and are what a build there makes, but for rounding; also while something moves.
TEST_F(NestedVoxelsTest, LevelsThatMoveKeepTheirVoxels) {
    for (const bool emits : {false, true}) {
        Scene scene = roomWithBoxes();
        if (emits) scene.materials[0].emission = glm::vec3(0.5f);
        scene::GpuScene gpu(scene);
        VoxelSettings settings{48};
        settings.levels = 3;
        glm::vec3 eye(0.5f, 0.2f, 0.1f);
        voxels::SurfaceVoxels surface;
        surface.build(nested(), gpu, voxels::SurfaceVoxels::gridAround(gpu, settings, eye));
        const std::vector<glm::vec3> steps = {
            {2, 0, 0}, {-1.5f, 1.6f, 0}, {0.1f, 0, -4}, {-6, 2, 9}, {5, -3, -5}};
        for (std::size_t i = 0; i < steps.size(); ++i) {
            eye += steps[i];
            if (i == 2) {
                scene.instances[1].worldFromObject[3] += glm::vec4(0.4f, 0.4f, -0.9f, 0);
                gpu.setInstance(1, scene.instances[1]);
            }
            const VoxelGrid grid = voxels::SurfaceVoxels::gridAround(gpu, settings, eye);
            ASSERT_FALSE(grid == surface.grid());
            surface.updateInSteps(nested(), gpu, grid).finish();
            ASSERT_TRUE(surface.lastUpdate().scrolled && surface.hasScrolled()) << i;
            const std::uint32_t most = i < 3 ? surface.faceCount() / 3 : surface.faceCount();
            EXPECT_LT(surface.lastUpdate().faces, most) << i;
            voxels::SurfaceVoxels whole;
            whole.build(nested(), gpu, grid);
            const auto [faces, differ] = compared(download(surface), download(whole));
            EXPECT_GT(faces, 3000u);
            EXPECT_LE(differ, faces / 200) << i << ", of " << faces;
            EXPECT_NEAR(surface.fragmentCount(), whole.fragmentCount(), 20) << i;
        }
    }
}

// From anywhere in the room to anywhere: rays do not leave it, and hits are where triangles are, within the voxels of the
// level they are in.
TEST_F(NestedVoxelsTest, RaysFindTrianglesThroughAllLevels) {
    const Scene scene = roomWithBoxes();
    voxelize(scene, 48, 4, {0.5f, 0.2f, 0.1f});
    const std::vector<ReferenceTriangle> triangles = referenceTriangles(scene, grid_);
    std::mt19937 random(5);
    const auto uniform = [&] { return 2 * static_cast<float>(random()) * 0x1p-32f - 1; };
    const auto anywhere = [&] { return glm::vec3(uniform(), uniform(), uniform()); };
    std::vector<glm::vec4> rays;
    const glm::mat4& room = scene.instances[0].worldFromObject;
    for (int i = 0; i < 20000; ++i) {
        const float reach = std::exp2(uniform() * 3 - 3);
        const glm::vec3 from(room * glm::vec4(0.98f * anywhere() * reach, 1));
        const glm::vec3 origin = grid_.gridFromWorld(from);
        const glm::vec3 towards = i % 3 == 0 ? grid_.gridFromWorld(2.0f * anywhere()) - origin : anywhere();
        rays.emplace_back(origin, 1e9f);
        rays.emplace_back(glm::normalize(towards), 0);
    }
    const std::vector<glm::vec4> found = traced(rays);
    std::size_t escaped = 0, inside = 0, wrong = 0, tested = 0;
    std::set<int> levels;
    for (std::size_t i = 0; i < rays.size(); i += 2) {
        const glm::dvec3 origin(rays[i]), direction(rays[i + 1]);
        const double truth = firstFront(triangles, origin, direction);
        // From within a box rays see nothing but the room.
        const bool startsInside = !std::isfinite(truth);
        inside += startsInside ? 1 : 0;
        if (startsInside) continue;
        ++tested;
        const int face = std::bit_cast<int>(found[i].x);
        escaped += face < 0 ? 1 : 0;
        if (face < 0) continue;
        const double t = static_cast<double>(found[i].y);
        const int level = voxels::levelAt(grid_, glm::vec3(origin + truth * direction));
        levels.insert(level);
        wrong += std::abs(t - truth) > std::ldexp(1.0, level) ? 1 : 0;
    }
    EXPECT_EQ(inside, 0u);
    // As rays in one grid, which one in ten thousand passes an edge between two pieces.
    EXPECT_LE(escaped, tested / 10000) << "of " << tested;
    EXPECT_LE(wrong, tested / 100) << "of " << tested;
    EXPECT_EQ(levels, (std::set<int>{0, 1, 2, 3}));
}

}  // namespace conelight::test
