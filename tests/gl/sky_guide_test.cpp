// SPDX-License-Identifier: MIT
// Rays that are guided to the sky (shaders/lib/sky_guide.glsl): cells learn where their window is, and only there.
#include <gtest/gtest.h>

#include <bit>
#include <vector>

#include "math/octahedral.h"
#include "shared/irradiance.h"
#include "shared/sky_guide.h"
#include "support/cache_rig.h"
#include "support/gl_fixture.h"
#include "support/scenes.h"

namespace conelight::test {
namespace {

// A grey room of [-1,1]^3 whose wall at x = 1 has a window of 0.5 x 0.5 in its middle.
Scene roomWithWindow() {
    Scene scene;
    scene.sky = glm::vec3(2);
    const Material grey = diffuseMaterial(glm::vec3(0.6f));
    const auto wall = [&](const glm::vec3& at, const glm::vec3& u, const glm::vec3& v) {
        addInstance(scene, quadMesh(at, u, v), grey);
    };
    wall({-1, -1, -1}, {0, 0, 2}, {2, 0, 0});  // floor
    wall({-1, 1, -1}, {2, 0, 0}, {0, 0, 2});   // ceiling
    wall({-1, -1, -1}, {0, 2, 0}, {0, 0, 2});
    wall({-1, -1, -1}, {2, 0, 0}, {0, 2, 0});
    wall({-1, -1, 1}, {0, 2, 0}, {2, 0, 0});
    wall({1, -1, -1}, {0, 0, 2}, {0, 0.75f, 0});  // about the window
    wall({1, 0.25f, -1}, {0, 0, 2}, {0, 0.75f, 0});
    wall({1, -0.25f, -1}, {0, 0, 0.75f}, {0, 0.5f, 0});
    wall({1, -0.25f, 0.25f}, {0, 0, 0.75f}, {0, 0.5f, 0});
    for (Material& material : scene.materials) material.doubleSided = true;
    return scene;
}

struct GuideRow {
    float share;
    std::vector<int> slots;   // their bins
    std::vector<int> counts;  // of bins
};

std::vector<GuideRow> guideOf(const CacheRig& rig) {
    const auto words =
        rig.cache.guide().buffer().read<std::uint32_t>(std::size_t{SKY_GUIDE_WORDS} * LIGHT_CLUSTERS);
    std::vector<GuideRow> rows;
    for (std::size_t row = 0; row < LIGHT_CLUSTERS; ++row) {
        const std::uint32_t* begin = &words[row * SKY_GUIDE_WORDS];
        const auto byte = [&](std::size_t at, std::size_t i) {
            return static_cast<int>(begin[at + i / 4] >> (8 * (i % 4)) & 255u);
        };
        GuideRow one{std::bit_cast<float>(begin[0]), {}, {}};
        for (std::size_t i = 0; i < SKY_SLOTS; ++i) one.slots.push_back(byte(SKY_SLOTS_AT, i));
        for (std::size_t i = 0; i < SKY_BINS; ++i) one.counts.push_back(byte(SKY_COUNTS_AT, i));
        rows.push_back(one);
    }
    return rows;
}

glm::vec3 middleOfBin(int bin) {
    const glm::vec2 at(bin % SKY_BINS_ACROSS, bin / SKY_BINS_ACROSS);
    return math::octDecode((at + 0.5f) * (2.0f / SKY_BINS_ACROSS) - 1.0f);
}

class SkyGuideTest : public GlTest {};

TEST_F(SkyGuideTest, RowsKnowHowOftenTheirSlotsNameABin) {
    CacheRig rig(programs(), roomWithWindow(), 64);
    rig.update(8);
    int guiding = 0;
    for (const GuideRow& row : guideOf(rig)) {
        if (row.share == 0.0f) continue;
        ++guiding;
        EXPECT_GT(row.share, 0.0f);
        EXPECT_LE(row.share, 1.0f);
        std::vector<int> counted(SKY_BINS, 0);
        for (const int bin : row.slots) ++counted[static_cast<std::size_t>(bin)];
        EXPECT_EQ(counted, row.counts);
    }
    EXPECT_GT(guiding, 20);
}

// The wall opposite of the window looks along +x, the window's directions lie within 20 degrees or so of it.
TEST_F(SkyGuideTest, WallsAimAtTheirWindow) {
    CacheRig rig(programs(), roomWithWindow(), 64);
    rig.update(16);
    const std::vector<GuideRow> rows = guideOf(rig);
    // The cells of the inner wall at x = -1, half way up.
    const int middle = LIGHT_BLOCKS_OF_GRID / 2 - 1;
    const int row = 6 * LIGHT_BLOCKS_OF_GRID * (middle + LIGHT_BLOCKS_OF_GRID * middle);
    const GuideRow& wall = rows[static_cast<std::size_t>(row)];
    ASSERT_GT(wall.share, 0.3f);
    int along = 0;
    for (const int bin : wall.slots) along += middleOfBin(bin).x > 0.85f ? 1 : 0;
    EXPECT_GT(along, SKY_SLOTS * 9 / 10);
}

TEST_F(SkyGuideTest, ClosedRoomsAimAtNoSky) {
    Scene scene = closedBox(diffuseMaterial(glm::vec3(0.6f)));
    scene.sky = glm::vec3(2);
    CacheRig rig(programs(), scene, 64);
    rig.update(SKY_ROW_PARTS);
    const std::vector<GuideRow> rows = guideOf(rig);
    const int middle = LIGHT_BLOCKS_OF_GRID / 2 - 1;
    const int floor = 6 * (middle + LIGHT_BLOCKS_OF_GRID * LIGHT_BLOCKS_OF_GRID * middle) + 2;  // looks up
    const auto learned =
        rig.cache.guide().learned().read<std::uint32_t>(std::size_t{SKY_LEARNED_WORDS} * LIGHT_CLUSTERS);
    ASSERT_GT(learned[static_cast<std::size_t>(SKY_LEARNED_WORDS * floor + SKY_RAYS_AT)], 0u);
    EXPECT_EQ(rows[static_cast<std::size_t>(floor)].share, 0.0f);
}

TEST_F(SkyGuideTest, SameCallsSameGuide) {
    const auto made = [&] {
        CacheRig rig(programs(), roomWithWindow(), 48);
        rig.update(5);
        return rig.cache.guide().buffer().read<std::uint32_t>(std::size_t{SKY_GUIDE_WORDS} * LIGHT_CLUSTERS);
    };
    EXPECT_EQ(made(), made());
}

}  // namespace
}  // namespace conelight::test
