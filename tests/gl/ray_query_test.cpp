// SPDX-License-Identifier: MIT
// Rays through voxels: lib/ray_query.glsl against its twin in double precision (voxels/ray_query.h), which
// knows neither bricks nor octants; octant words against what they are said to mean.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "gl/pass.h"
#include "io/scene_file.h"
#include "math/octahedral.h"
#include "scene/gpu_scene.h"
#include "shared/bindings.h"
#include "support/gl_fixture.h"
#include "support/view_rig.h"
#include "voxels/octant_words.h"
#include "voxels/ray_query.h"
#include "voxels/surface_voxels.h"
#include "voxels/voxel_record.h"

namespace conelight::test {
namespace {

struct TestRay {
    glm::vec4 origin;     // w: tMax
    glm::vec4 direction;  // w: 0
    glm::vec4 leaves;     // normal of the surface where it starts, or 0
};

Scene thinWalls(float turn) {
    Scene scene = io::loadScene("builtin:leak");
    const glm::mat4 turned = glm::rotate(glm::mat4(1), turn, glm::vec3(0.1f, 1, 0.05f));
    for (Instance& instance : scene.instances) instance.worldFromObject = turned * instance.worldFromObject;
    return scene;
}

class RayQueryTest : public GlTest {
  protected:
    void TearDown() override {
        surface_ = {};
        octants_ = {};
        GlTest::TearDown();
    }
    void voxelize(const Scene& scene, int size) {
        const scene::GpuScene gpuScene(scene);
        surface_.build(programs(), profiler_, gpuScene, VoxelSettings{size});
        octants_.build(programs(), profiler_, surface_);
        tables_ = voxels::downloadVoxels(surface_);
    }

    std::vector<glm::vec4> traced(const std::vector<TestRay>& rays) {
        addShader("test/rays.comp.glsl", R"(#version 450 core
layout(local_size_x = 64) in;
#include "lib/linear_index.glsl"
#include "lib/ray_query.glsl"
layout(std430, binding = BINDING_STORAGE_PASS) buffer Data { vec4 data[]; };
void main() {
    uint i = 3u * linearIndex();
    if (i >= uint(data.length())) return;
    VoxelHit hit = traceVoxels(data[i].xyz, data[i + 1u].xyz, data[i].w, data[i + 2u].xyz);
    data[i] = vec4(intBitsToFloat(hit.face), hit.t, 0.0, 0.0);
}
)");
        gl::Buffer buffer(rays, "rays");
        surface_.bind();
        octants_.bind();
        buffer.bindStorage(BINDING_STORAGE_PASS);
        programs().compute("test/rays.comp.glsl").dispatchLinear(rays.size());
        gl::barrier(gl::Access::ShaderStorage);
        return buffer.read<glm::vec4>(3 * rays.size());
    }

    // Cosine rays from random faces, grazing rays along them, rays from and to anywhere, axis-parallel ones.
    std::vector<TestRay> mixedRays(std::size_t count) {
        std::mt19937 random(7);
        const auto uniform = [&](float low, float high) {
            return low + (high - low) * static_cast<float>(random()) * 0x1p-32f;
        };
        const auto anywhere = [&] {
            while (true) {
                const glm::vec3 v(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
                const float length = glm::length(v);
                if (length < 1 && length > 0.05f) return v / length;
            }
        };
        const glm::vec3 size(tables_.grid.size);
        std::vector<TestRay> rays;
        for (std::size_t i = 0; i < count; ++i) {
            const gpu::FaceRecord& face = tables_.faces[random() % tables_.faces.size()];
            const glm::vec3 n = faceNormal(face);
            const glm::vec3 on =
                glm::vec3(voxels::unpackVoxel(face.voxel)) + 0.5f + n * unpackedOffset(face) + 0.05f * n;
            TestRay ray{{on, 1e9f}, {glm::normalize(n + 0.999f * anywhere()), 0}, {n, 0}};
            const glm::vec3 side = glm::normalize(glm::cross(n, anywhere()));
            switch (i % 6) {
                case 1:  // grazing
                    ray.direction = glm::vec4(glm::normalize(side + uniform(0, 0.02f) * n), 0);
                    break;
                case 2:  // from outside, also past the grid
                    ray.leaves = glm::vec4(0);
                    ray.origin = glm::vec4(size * (0.5f + 1.2f * anywhere()), 1e9f);
                    ray.direction =
                        glm::vec4(glm::normalize(size * glm::vec3(uniform(-0.1f, 1.1f), uniform(-0.1f, 1.1f),
                                                                  uniform(-0.1f, 1.1f)) -
                                                 glm::vec3(ray.origin)),
                                  0);
                    break;
                case 3: {  // along an axis, with true zeros
                    glm::vec3 d(0);
                    d[static_cast<int>(random() % 3)] = random() % 2 == 0 ? 1.0f : -1.0f;
                    ray.direction = glm::vec4(d, 0);
                    break;
                }
                case 4: {  // across one axis
                    glm::vec3 d = anywhere();
                    d[static_cast<int>(random() % 3)] = random() % 2 == 0 ? 0.0f : -0.0f;
                    ray.direction = glm::vec4(glm::normalize(d), 0);
                    break;
                }
                case 5:  // short
                    ray.origin.w = uniform(0, 30);
                    break;
                default:
                    break;
            }
            rays.push_back(ray);
        }
        return rays;
    }

    static glm::vec3 faceNormal(const gpu::FaceRecord& face);
    static float unpackedOffset(const gpu::FaceRecord& face);

    void expectEqualHits(const Scene& scene, int size) {
        voxelize(scene, size);
        const std::vector<TestRay> rays = mixedRays(60000);
        const std::vector<glm::vec4> found = traced(rays);
        std::size_t differ = 0, hits = 0;
        double furthest = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const voxels::VoxelHit hit =
                voxels::traceVoxels(tables_, glm::dvec3(rays[i].origin), glm::dvec3(rays[i].direction),
                                    static_cast<double>(rays[i].origin.w), glm::dvec3(rays[i].leaves));
            const int face = std::bit_cast<int>(found[3 * i].x);
            hits += hit.face >= 0 ? 1 : 0;
            const bool same = face == hit.face;
            differ += same ? 0 : 1;
            if (same && face >= 0)
                furthest =
                    std::max(furthest, std::abs(static_cast<double>(found[3 * i].y) - hit.t) / (1 + hit.t));
        }
        EXPECT_GT(hits, rays.size() / 10);
        // A crossing within rounding of a face's bounds goes either way: 1 in 10,000 of these rays.
        EXPECT_LE(differ, rays.size() / 10000) << "of " << rays.size();
        // Grazing: t = height / sine, the sine as small as 1e-3.
        EXPECT_LT(furthest, 2e-3);
    }

    gl::Profiler profiler_;
    voxels::SurfaceVoxels surface_;
    voxels::OctantWords octants_;
    voxels::VoxelTables tables_;
};

glm::vec3 RayQueryTest::faceNormal(const gpu::FaceRecord& face) {
    return math::octDecode(math::unpackSnorm2x16(face.normal));
}
float RayQueryTest::unpackedOffset(const gpu::FaceRecord& face) {
    return voxels::unpackOffset(face.offsetWeight);
}

TEST_F(RayQueryTest, SameFacesAsTwinCornell) { expectEqualHits(io::loadScene("builtin:cornell"), 64); }
TEST_F(RayQueryTest, SameFacesAsTwinCurved) { expectEqualHits(io::loadScene("builtin:spheres"), 128); }
TEST_F(RayQueryTest, SameFacesAsTwinTextured) { expectEqualHits(io::loadScene("builtin:atrium"), 96); }
TEST_F(RayQueryTest, SameFacesAsTwinThinWalls) { expectEqualHits(thinWalls(0), 64); }
TEST_F(RayQueryTest, SameFacesAsTwinThinWallsTurned) { expectEqualHits(thinWalls(0.35f), 128); }

// A floor in a grid of 512 voxels, almost all of it empty: steps are long and many.
TEST_F(RayQueryTest, SameFacesAsTwinInALargeEmptySpace) {
    Scene scene;
    Material white;
    addInstance(scene, quadMesh({-100, 0, 100}, {200, 0, 0}, {0, 0, -200}), white);
    for (float z = -90; z < 100; z += 20)
        addInstance(scene, quadMesh({-100, 1, z}, {200, 0, 0}, {0, 5, 0}), white);
    addInstance(scene, quadMesh({-1, 90, 1}, {2, 0, 0}, {0, 0.5f, -2}), white);
    expectEqualHits(scene, 256);
}

// Every voxel that looks against an octant is in its mask, no other; the reach ends before all of them, and
// is as long as it may be.
TEST_F(RayQueryTest, OctantWordsSayWhatIsThere) {
    voxelize(io::loadScene("builtin:spheres"), 64);
    const glm::ivec3 bricks = tables_.grid.bricks();
    std::vector<glm::uvec2> words(8 * tables_.grid.brickCount());
    octants_.texture().read(0, GL_RG_INTEGER, GL_UNSIGNED_INT, words.data(), 8 * words.size());
    // Words count bricks and voxels from the other end along axes that the octant's rays go down.
    const auto mirrored = [](int octant, glm::ivec3 at, const glm::ivec3& size) {
        for (int axis = 0; axis < 3; ++axis)
            if ((octant >> axis & 1) != 0) at[axis] = size[axis] - 1 - at[axis];
        return at;
    };
    // Mask and, in z, reach.
    const auto word = [&](int octant, const glm::ivec3& brick) {
        const glm::ivec3 b = mirrored(octant, brick, bricks);
        const glm::uvec2 w =
            words[static_cast<std::size_t>(b.x + octant * bricks.x + 8 * bricks.x * (b.y + bricks.y * b.z))];
        return w.y == OCTANT_EMPTY ? glm::uvec3(0, 0, w.x) : glm::uvec3(w, 0);
    };
    std::size_t wrongMasks = 0, wrongReach = 0;
    for (int octant = 0; octant < 8; ++octant) {
        const glm::ivec3 ahead = 1 - 2 * (glm::ivec3(octant, octant >> 1, octant >> 2) & 1);
        const auto isEmpty = [&](const glm::ivec3& from, int edge) {
            for (int z = 0; z < edge; ++z)
                for (int y = 0; y < edge; ++y)
                    for (int x = 0; x < edge; ++x) {
                        const glm::ivec3 b = from + ahead * glm::ivec3(x, y, z);
                        const bool inside = glm::all(glm::greaterThanEqual(b, glm::ivec3(0))) &&
                                            glm::all(glm::lessThan(b, bricks));
                        if (inside && word(octant, b).z == 0) return false;
                    }
            return true;
        };
        for (int z = 0; z < bricks.z; ++z)
            for (int y = 0; y < bricks.y; ++y)
                for (int x = 0; x < bricks.x; ++x) {
                    const glm::uvec3 w = word(octant, {x, y, z});
                    for (std::uint32_t bit = 0; bit < 64; ++bit) {
                        const glm::ivec3 voxel = voxels::voxelOfBit({x, y, z}, bit);
                        std::uint32_t facing = 0;
                        if (tables_.has(voxel)) {
                            const std::uint32_t directions = tables_.record(voxel) >> 26;
                            for (int axis = 0; axis < 3; ++axis)
                                facing |= directions >> (2 * axis + (ahead[axis] > 0 ? 1 : 0)) & 1u;
                        }
                        const std::uint32_t at =
                            voxels::bitOfVoxel(mirrored(octant, voxel % 4, glm::ivec3(4)));
                        wrongMasks += ((at < 32 ? w.x : w.y) >> (at % 32) & 1u) != facing ? 1 : 0;
                    }
                    int reach = (w.x | w.y) == 0 ? 1 : 0;
                    while (reach != 0 && reach < OCTANT_REACH && isEmpty({x, y, z}, 2 * reach)) reach *= 2;
                    wrongReach += static_cast<int>(w.z) != reach ? 1 : 0;
                }
    }
    EXPECT_EQ(wrongMasks, 0u);
    EXPECT_EQ(wrongReach, 0u);
}

}  // namespace
}  // namespace conelight::test
