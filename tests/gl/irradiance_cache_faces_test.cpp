// SPDX-License-Identifier: MIT
// Which faces of the irradiance cache gather light, in what order, and which share it with another face of
// their voxel; slices of an update.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <glm/gtc/matrix_transform.hpp>

#include "io/scene_file.h"
#include "math/octahedral.h"
#include "shared/irradiance.h"
#include "support/cache_rig.h"
#include "support/gl_fixture.h"
#include "support/scenes.h"
#include "voxels/voxel_record.h"

namespace conelight::test {
namespace {

using IrradianceCacheFacesTest = GlTest;

// interleavedPlace of shaders/lib/interleave.glsl, as the bit of a voxel.
std::uint32_t placeOf(const glm::ivec3& voxel, int axis) {
    const glm::uvec3 brick = glm::uvec3(voxel) / 4u;
    const std::uint32_t state = (brick.x | brick.y << 10 | brick.z << 20) * 747796405u + 2891336453u;
    const std::uint32_t word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    const std::uint32_t hash = (word >> 22u) ^ word;
    glm::uvec3 turn(hash, hash >> 2, hash >> 4);
    turn[axis] = 0;
    return voxels::bitOfVoxel(glm::ivec3((glm::uvec3(voxel) ^ turn) & 3u));
}

// Updates visit every face once, those of a block of 16^3 voxels together, by direction and place in the brick.
void expectLikeFacesTogether(const CacheRig& rig) {
    const std::uint32_t count = rig.surface.faceCount();
    const auto order = rig.cache.order().read<std::uint32_t>(count);
    const auto records = rig.surface.faces().read<gpu::FaceRecord>(count);
    const auto states = rig.cache.state().read<gpu::FaceCache>(count);
    const auto gathering =
        static_cast<std::uint32_t>(std::count_if(states.begin(), states.end(), [](const gpu::FaceCache& s) {
            return (s.counts & CACHE_SHARES) == 0;
        }));
    const glm::ivec3 blocks = (rig.surface.grid().bricks() + 3) / 4;
    std::vector<int> visits(count);
    std::array<int, 4> last{};
    for (std::uint32_t i = 0; i < gathering; ++i) {
        ASSERT_LT(order[i], count);
        ++visits[order[i]];
        const gpu::FaceRecord& r = records[order[i]];
        const glm::ivec3 voxel = voxels::unpackVoxel(r.voxel & 0x3fffffffu);
        const auto axis = static_cast<int>(r.voxel >> 30);
        const bool down = math::octDecode(math::unpackSnorm2x16(r.normal))[axis] < 0;
        const glm::ivec3 block = voxel / 16, brick = voxel / 4 % 4;
        const std::array<int, 4> key{block.x + blocks.x * (block.y + blocks.y * block.z),
                                     2 * axis + (down ? 1 : 0), static_cast<int>(placeOf(voxel, axis)),
                                     brick.x + 4 * brick.y + 16 * brick.z};
        if (i > 0) {
            ASSERT_LT(last, key) << i;
        }
        last = key;
    }
    for (std::uint32_t i = 0; i < count; ++i)
        ASSERT_EQ(visits[i], (states[i].counts & CACHE_SHARES) == 0 ? 1 : 0) << i;
}

TEST_F(IrradianceCacheFacesTest, OrderPutsLikeFacesTogether) {
    expectLikeFacesTogether(CacheRig(programs(), io::loadScene("builtin:spheres"), 48));
}

// A grid of more blocks than are sorted at once: balls at its corners and in its middle.
TEST_F(IrradianceCacheFacesTest, OrderOfManyBlocksPutsLikeFacesTogether) {
    Scene scene;
    for (int i = 0; i < 9; ++i) {
        const glm::vec3 corner(i % 2, i / 2 % 2, i / 4 % 2);
        const glm::vec3 middle = i < 8 ? 30.0f * corner : glm::vec3(15);
        addInstance(scene, sphereMesh(12, 8), {}, glm::translate(glm::mat4(1), middle));
    }
    const CacheRig rig(programs(), scene, 512);
    const glm::ivec3 blocks = (rig.surface.grid().bricks() + 3) / 4;
    ASSERT_GT(blocks.x * blocks.y * blocks.z, 8192);
    expectLikeFacesTogether(rig);
}

// Faces that do not gather name one of their own voxel that does, and hold its surface or next to nothing of
// it. On curved surfaces that is many of them, on walls along the axes none.
TEST_F(IrradianceCacheFacesTest, FacesOfOneSurfaceShareOneMean) {
    const auto sharing = [&](const char* name) {
        CacheRig rig(programs(), io::loadScene(name), 48);
        rig.update(2);
        const std::uint32_t count = rig.surface.faceCount();
        const auto records = rig.surface.faces().read<gpu::FaceRecord>(count);
        const auto light = rig.lit.buffer().read<gpu::LitFace>(count);
        const auto states = rig.cache.state().read<gpu::FaceCache>(count);
        std::uint32_t share = 0;
        for (std::uint32_t i = 0; i < count; ++i) {
            if ((states[i].counts & CACHE_SHARES) == 0) continue;
            ++share;
            const auto other = std::bit_cast<std::uint32_t>(states[i].irradiance.x);
            EXPECT_LT(other, count);
            if (other >= count) return -1.0;
            EXPECT_EQ(states[other].counts & CACHE_SHARES, 0u) << i;
            EXPECT_EQ((records[i].voxel ^ records[other].voxel) & 0x3fffffffu, 0u) << i;
            EXPECT_EQ(light[i].irradiance0, light[other].irradiance0) << i;
            const auto normal = [](const gpu::FaceRecord& r) {
                return math::octDecode(math::unpackSnorm2x16(r.normal));
            };
            const bool sliver = records[i].offsetWeight >> 16 < (records[other].offsetWeight >> 16) / 9;
            EXPECT_GT(glm::dot(normal(records[i]), normal(records[other])), sliver ? 0.49f : 0.919f) << i;
        }
        return static_cast<double>(share) / count;
    };
    EXPECT_GT(sharing("builtin:vases"), 0.1);
    EXPECT_EQ(sharing("builtin:furnace"), 0.0);
}

// Slices of the faces add up to whole rounds.
TEST_F(IrradianceCacheFacesTest, BudgetVisitsEveryFace) {
    CacheRig rig(programs(), io::loadScene("builtin:cornell"), 32);
    rig.settings.facesPerUpdate = rig.surface.faceCount() / 7;
    EXPECT_FALSE(rig.cache.settled());
    rig.update(8);
    EXPECT_EQ(rig.cache.updates(), 1);
    const auto states = rig.cache.state().read<gpu::FaceCache>(rig.surface.faceCount());
    for (const gpu::FaceCache& state : states)
        ASSERT_GE(state.counts & CACHE_UPDATES_MASK, (state.counts & CACHE_SHARES) == 0 ? 1u : 0u);
    rig.update(8 * 14);
    EXPECT_TRUE(rig.cache.settled());
}

}  // namespace
}  // namespace conelight::test
