// SPDX-License-Identifier: MIT
// The radiance volume of real voxels against what must be in it: a wall's area and colour in every level, the
// eight children of every texel, nothing in blocks no face looks towards.
#include "gather/radiance_volume.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cmath>

#include "light/inject_light.h"
#include "support/gl_fixture.h"
#include "support/view_rig.h"

namespace conelight::test {
namespace {

using gather::RadianceLayout;
using gather::RadianceVolume;

// Rounding of a half: 2^-11 relative, and a half's smallest step for tiny values.
constexpr float kHalf = 1.0f / 2048;

struct Level {
    glm::ivec3 size;  // texels of the whole texture
    int blockWidth;
    std::vector<glm::vec4> texels;
    const glm::vec4& at(int block, const glm::ivec3& p) const {
        return texels[static_cast<std::size_t>(block * blockWidth + p.x) +
                      static_cast<std::size_t>(size.x) *
                          (static_cast<std::size_t>(p.y) +
                           static_cast<std::size_t>(size.y) * static_cast<std::size_t>(p.z))];
    }
};

Level readLevel(const RadianceVolume& volume, int level) {
    const gl::Texture& texture = volume.texture();
    Level result{{texture.width(level), texture.height(level), texture.depth(level)}, 0, {}};
    result.blockWidth = result.size.x / volume.layout().blocks;
    result.texels.resize(static_cast<std::size_t>(result.size.x) * static_cast<std::size_t>(result.size.y) *
                         static_cast<std::size_t>(result.size.z));
    texture.read(level, GL_RGBA, GL_FLOAT, result.texels.data(), result.texels.size() * sizeof(glm::vec4));
    return result;
}

// What a texel of the next level must be; the formulas of radiance_level.comp.glsl, written per block anew.
glm::vec4 parentOf(const Level& fine, int block, int blocks, OpacityModel opacity, const glm::ivec3& p) {
    glm::vec4 sum(0);
    if (blocks == 1) {
        for (int i = 0; i < 8; ++i) sum += fine.at(0, 2 * p + glm::ivec3(i & 1, (i >> 1) & 1, i >> 2));
        if (opacity == OpacityModel::Fog) return sum / 8.0f;
        sum /= 4.0f;
        return sum / std::max(sum.a, 1.0f);
    }
    const int axis = block / 2;
    for (int i = 0; i < 4; ++i) {
        glm::ivec3 near = 2 * p;
        near[(axis + 1) % 3] += i & 1;
        near[(axis + 2) % 3] += i >> 1;
        glm::ivec3 far = near;
        (block % 2 == 0 ? near : far)[axis] += 1;
        const glm::vec4 front = fine.at(block, near);
        const glm::vec4 back = fine.at(block, far);
        const float share = opacity == OpacityModel::Fog
                                ? 1 - front.a
                                : std::min(back.a, 1 - front.a) / std::max(back.a, 1e-6f);
        sum += 0.25f * (front + back * share);
    }
    return sum;
}

Material glowing(const glm::vec3& emission) {
    Material material;
    material.baseColor = {0, 0, 0, 1};
    material.emission = emission;
    return material;
}

// Emissive quad of edge 1 that faces +x, in a unit cube of bounds (two far corners hold tiny triangles).
Scene wallScene(const glm::vec3& emission) {
    Scene scene;
    addInstance(scene, quadMesh({0.4f, 0, 0}, {0, 1, 0}, {0, 0, 1}), glowing(emission));
    addInstance(scene, quadMesh({-0.1f, 0.5f, 0.5f}, {1e-3f, 0, 0}, {0, 1e-3f, 0}), glowing({0, 0, 0}));
    addInstance(scene, quadMesh({0.9f, 0.5f, 0.5f}, {1e-3f, 0, 0}, {0, 1e-3f, 0}), glowing({0, 0, 0}));
    return scene;
}

// Something with all directions and partial coverage: a tilted box, open at one side, with a slanted sheet.
Scene tiltedScene() {
    Scene scene;
    const glm::vec3 u = glm::normalize(glm::vec3(1, 0.3f, 0.2f));
    const glm::vec3 v = glm::normalize(glm::cross(glm::vec3(0.1f, 0.2f, 1), u));
    const glm::vec3 w = glm::cross(u, v);
    addInstance(scene, quadMesh(glm::vec3(0), u, v), glowing({1, 2, 3}));
    addInstance(scene, quadMesh(glm::vec3(0), v, w), glowing({3, 1, 0.5f}));
    addInstance(scene, quadMesh(glm::vec3(0), w, u), glowing({0.2f, 0.1f, 4}));
    addInstance(scene, quadMesh(w, v, u), glowing({10, 10, 10}));
    addInstance(scene, quadMesh(0.2f * u, v, w + 0.5f * u), glowing({0.1f, 0.2f, 0.3f}));
    return scene;
}

class RadianceVolumeTest : public GlTest {
  protected:
    // Volume of a scene, without any light but emission.
    void build(const Scene& scene, int size, VolumeDirections directional, OpacityModel opacity,
               float maxFootprint = 0.25f) {
        gpuScene_.emplace(scene);
        surface_.emplace();
        VoxelSettings settings;
        settings.size = size;
        surface_->build(device(), *gpuScene_, settings);
        volume_ = RadianceVolume(gather::radianceLayout(surface_->grid(), directional, maxFootprint));
        light::Lights lights;
        lights.update(device(), *gpuScene_, {.emissiveQuads = false});
        light::LitFaces faces;
        light::injectLight(device(), {*gpuScene_, lights, *surface_}, faces);
        volume_.build(device(), *surface_, faces, opacity);
    }
    void TearDown() override {
        volume_ = {};
        surface_.reset();
        gpuScene_.reset();
        GlTest::TearDown();
    }

    std::optional<scene::GpuScene> gpuScene_;
    std::optional<voxels::SurfaceVoxels> surface_;
    RadianceVolume volume_;
};

TEST_F(RadianceVolumeTest, LayoutKeepsLevelsWhole) {
    for (const int size : {8, 36, 64, 100, 128}) {
        for (const float footprint : {0.01f, 0.125f, 0.5f, 1.0f}) {
            voxels::VoxelGrid grid;
            grid.size = {size, std::max(4, size / 8 * 4), 4};
            for (const VolumeDirections directional : {VolumeDirections::Isotropic, VolumeDirections::Six}) {
                const RadianceLayout layout = gather::radianceLayout(grid, directional, footprint);
                const int texel = 1 << layout.maxLevel;
                // Nearest power of two, and never finer than a voxel.
                const float ratio =
                    static_cast<float>(texel) / std::max(footprint * static_cast<float>(size), 1.0f);
                EXPECT_LE(ratio, std::sqrt(2.0f) * 1.001f);
                EXPECT_GE(ratio, std::sqrt(0.5f) * 0.999f);
                EXPECT_EQ(layout.blocks, directional == VolumeDirections::Six ? 6 : 1);
                for (int axis = 0; axis < 3; ++axis) {
                    EXPECT_EQ(layout.size[axis] % texel, 0);
                    EXPECT_GE(layout.size[axis], grid.size[axis]);
                    EXPECT_LT(layout.size[axis], grid.size[axis] + texel);
                }
            }
        }
    }
}

// In block +x every level holds the wall's whole area and its colour; the other five blocks hold nothing of
// it.
TEST_F(RadianceVolumeTest, WallKeepsAreaAndColourInEveryLevel) {
    const glm::vec3 emission(2, 0.5f, 8);
    build(wallScene(emission), 32, VolumeDirections::Six, OpacityModel::Area);
    const float h = surface_->grid().voxelSize;
    ASSERT_GE(volume_.layout().maxLevel, 3);
    for (int l = 0; l <= volume_.layout().maxLevel; ++l) {
        const Level level = readLevel(volume_, l);
        const float texelArea = h * h * std::exp2(2.0f * static_cast<float>(l));
        glm::vec4 sums[6] = {};
        for (int block = 0; block < 6; ++block)
            for (int z = 0; z < level.size.z; ++z)
                for (int y = 0; y < level.size.y; ++y)
                    for (int x = 0; x < level.blockWidth; ++x) {
                        const glm::vec4& t = level.at(block, {x, y, z});
                        EXPECT_LE(t.a, 1.0f);
                        sums[block] += t * texelArea;
                    }
        // Coverage is stored in 16 bits of [0,4], then as a half.
        EXPECT_NEAR(sums[0].a, 1.0f, 2 * kHalf) << "level " << l;
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(sums[0][c] / emission[c], 1.0f, 1.0f / 256) << "level " << l;  // RGB9E5
        for (int block = 1; block < 4; ++block) EXPECT_EQ(sums[block].a, 0.0f) << block;
        // The two tiny quads that hold the bounds open.
        EXPECT_LT(sums[4].a + sums[5].a, 1e-4f);
    }
}

TEST_F(RadianceVolumeTest, EveryTexelComesFromItsEightChildren) {
    for (const VolumeDirections directional : {VolumeDirections::Isotropic, VolumeDirections::Six}) {
        for (const OpacityModel opacity : {OpacityModel::Fog, OpacityModel::Area}) {
            build(tiltedScene(), 36, directional, opacity, 0.4f);
            const int blocks = volume_.layout().blocks;
            ASSERT_EQ(volume_.layout().maxLevel, 4);
            Level fine = readLevel(volume_, 0);
            for (int l = 1; l <= volume_.layout().maxLevel; ++l) {
                const Level coarse = readLevel(volume_, l);
                float worst = 0;
                float most = 0;
                for (int block = 0; block < blocks; ++block)
                    for (int z = 0; z < coarse.size.z; ++z)
                        for (int y = 0; y < coarse.size.y; ++y)
                            for (int x = 0; x < coarse.blockWidth; ++x) {
                                const glm::ivec3 p(x, y, z);
                                const glm::vec4 expected = parentOf(fine, block, blocks, opacity, p);
                                const glm::vec4 difference = glm::abs(coarse.at(block, p) - expected);
                                for (int c = 0; c < 4; ++c)
                                    worst = std::max(worst, difference[c] / (expected[c] + 0.01f));
                                most = std::max(most, expected.a);
                            }
                EXPECT_LE(worst, 2 * kHalf) << "level " << l << ", " << blocks << " blocks";
                EXPECT_GT(most, 0.01f);  // there was something to compare
                fine = coarse;
            }
        }
    }
}

// Isotropic: a wall stays a wall in coarse levels when area adds up, and thins to mist when it is fog.
TEST_F(RadianceVolumeTest, AreaKeepsWallsOpaqueAndFogThinsThem) {
    build(wallScene({1, 1, 1}), 32, VolumeDirections::Isotropic, OpacityModel::Area);
    const auto opacityAtWall = [&](int l) {
        const Level level = readLevel(volume_, l);
        const glm::vec3 middle = surface_->grid().gridFromWorld({0.4f, 0.5f, 0.5f});
        return level.at(0, glm::ivec3(middle) >> l).a;
    };
    EXPECT_NEAR(opacityAtWall(0), 1.0f, 2 * kHalf);
    EXPECT_NEAR(opacityAtWall(3), 1.0f, 4 * kHalf);
    build(wallScene({1, 1, 1}), 32, VolumeDirections::Isotropic, OpacityModel::Fog);
    EXPECT_NEAR(opacityAtWall(3), 0.125f, 2 * kHalf);
}

TEST_F(RadianceVolumeTest, SameBitsEveryTime) {
    build(tiltedScene(), 36, VolumeDirections::Six, OpacityModel::Area);
    const Level first = readLevel(volume_, 2);
    build(tiltedScene(), 36, VolumeDirections::Six, OpacityModel::Area);
    const Level second = readLevel(volume_, 2);
    EXPECT_EQ(first.texels, second.texels);
}

}  // namespace
}  // namespace conelight::test
