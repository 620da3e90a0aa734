// SPDX-License-Identifier: MIT
// Light samples (shaders/lib/light_cells.glsl): pools hold faces of their cluster by flux, rows hold clusters by what they
// bring to a cell, and a room draws few of what shines outside.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <vector>

#include "math/octahedral.h"
#include "shared/irradiance.h"
#include "support/cache_rig.h"
#include "support/gl_fixture.h"
#include "support/scenes.h"
#include "voxels/voxel_record.h"

namespace conelight::test {
namespace {

// A closed room of [-1,1]^3 with a lamp below its ceiling, in a house whose outside shines.
Scene roomInHouse() {
    Scene scene = closedBox(diffuseMaterial(glm::vec3(0.6f)));
    addInstance(scene, quadMesh({-0.3f, 0.93f, -0.3f}, {0.6f, 0, 0}, {0, 0, 0.6f}),
                diffuseMaterial(glm::vec3(0), glm::vec3(3)));
    addInstance(scene, boxMesh(), diffuseMaterial(glm::vec3(0.5f), glm::vec3(5)),
                glm::scale(glm::mat4(1), glm::vec3(1.2f)));
    return scene;
}

// All that shines is found by rays.
void shine(CacheRig& rig) {
    rig.light.emissiveQuads = false;
    rig.relight();
    rig.update(3);
}

struct Drawn {
    explicit Drawn(const CacheRig& rig)
        : words(rig.cache.samples().buffer().read<std::uint32_t>(LIGHT_SAMPLE_WORDS)),
          records(rig.surface.faces().read<gpu::FaceRecord>(rig.surface.faceCount())),
          fluxes(rig.cache.samples().fluxes().read<float>(rig.surface.faceCount())) {
        // The last bits tell where a face looks to.
        for (float& flux : fluxes) flux = std::bit_cast<float>(std::bit_cast<std::uint32_t>(flux) & ~7u);
        const glm::ivec3 bricks = rig.surface.grid().bricks();
        const auto most = static_cast<std::uint32_t>(std::max({bricks.x, bricks.y, bricks.z}));
        const int shift = 2 + std::bit_width((most - 1) / LIGHT_BLOCKS_OF_GRID);
        for (std::size_t i = 0; i < records.size(); ++i) {
            const glm::vec3 n = math::octDecode(math::unpackSnorm2x16(records[i].normal));
            const int axis = static_cast<int>(records[i].voxel >> 30);
            const glm::ivec3 at = voxels::unpackVoxel(records[i].voxel & 0x3fffffffu) >> shift;
            const int cube = at.x + LIGHT_BLOCKS_OF_GRID * (at.y + LIGHT_BLOCKS_OF_GRID * at.z);
            clusters.push_back(6 * cube + 2 * axis + (n[axis] < 0 ? 1 : 0));
            fluxOfCluster[clusters.back()] += static_cast<double>(fluxes[i]);
            total += static_cast<double>(fluxes[i]);
        }
    }
    // The cluster of a place in the list: places go up as clusters with flux do.
    int clusterAt(std::size_t place) const {
        for (const auto& [cluster, flux] : fluxOfCluster)
            if (flux > 1e-30 && place-- == 0) return cluster;
        return -1;
    }
    std::size_t slotCount() const { return words[LIGHT_SLOT_COUNT_AT]; }
    std::map<int, int> slotsOf(std::size_t row) const {
        std::map<int, int> slots;
        for (std::size_t slot = 0; slot < slotCount(); ++slot) {
            const std::uint32_t word =
                words[LIGHT_SLOTS_AT + (words[LIGHT_PLACES_AT + row] * slotCount() + slot) / 2];
            ++slots[clusterAt(slot % 2 == 1 ? word >> 16 : word & 0xffffu)];
        }
        return slots;
    }
    // Of the slots of a row, those of clusters with a face for which `counts` holds, as a part.
    template <typename Counts>
    double partOf(std::size_t row, const Counts& counts) const {
        const std::map<int, int> slots = slotsOf(row);
        std::map<int, bool> counted;
        for (std::size_t i = 0; i < records.size(); ++i)
            if (fluxes[i] > 1e-20f && counts(i)) counted[clusters[i]] = true;
        int found = 0;
        for (const auto& [cluster, count] : slots) found += counted.contains(cluster) ? count : 0;
        return static_cast<double>(found) / static_cast<double>(slotCount());
    }

    std::vector<std::uint32_t> words;
    std::vector<gpu::FaceRecord> records;
    std::vector<float> fluxes;
    std::vector<int> clusters;  // of faces
    std::map<int, double> fluxOfCluster;
    double total = 0;
};

class LightSamplesTest : public GlTest {};

TEST_F(LightSamplesTest, PoolsAndTheRowOfAllAreDrawnByFlux) {
    for (const int voxels : {48, 64, 96}) {
        CacheRig rig(programs(), roomInHouse(), voxels);
        shine(rig);
        const Drawn drawn(rig);
        ASSERT_GT(drawn.total, 0);
        EXPECT_NEAR(std::bit_cast<float>(drawn.words[LIGHT_INVERSE_FLUX_AT]) * drawn.total, 1.0, 1e-3);
        for (const auto& [cluster, count] : drawn.slotsOf(LIGHT_ROW_OF_ALL))
            EXPECT_NEAR(
                count, static_cast<double>(drawn.slotCount()) * drawn.fluxOfCluster.at(cluster) / drawn.total,
                1.01)
                << cluster;
        int looked = 0;
        for (std::size_t place = 0; drawn.clusterAt(place) >= 0; ++place) {
            const int cluster = drawn.clusterAt(place);
            const double flux = drawn.fluxOfCluster.at(cluster);
            if (flux < 1e-6 * drawn.total) continue;
            ++looked;
            const std::uint32_t pool = drawn.words[LIGHT_CLUSTER_POOLS_AT + place];
            const std::size_t faces = std::size_t{1} << (pool & 15u);
            ASSERT_LE((pool >> 4) + faces, LIGHT_POOL_ENTRIES);
            std::map<std::size_t, int> entries;
            for (std::size_t i = 0; i < faces; ++i)
                ++entries[drawn.words[LIGHT_POOLS_AT + (pool >> 4) + i] & ~LIGHT_MOVED];
            for (const auto& [face, count] : entries) {
                ASSERT_LT(face, drawn.records.size());
                ASSERT_EQ(drawn.clusters[face], cluster);
                EXPECT_NEAR(
                    count, static_cast<double>(faces) * static_cast<double>(drawn.fluxes[face]) / flux, 2.01);
            }
        }
        EXPECT_GT(looked, 50);
    }
}

// Stills keep the pools of the last update: those that many slots name have many faces, and all have room.
TEST_F(LightSamplesTest, PoolsAreAsLargeAsTheirPartOfAllSlots) {
    CacheRig rig(programs(), roomInHouse(), 96);
    shine(rig);
    const Drawn drawn(rig);
    std::map<int, int> slotsOfCluster;
    int slots = 0;
    for (std::size_t row = 0; row < LIGHT_ROWS; ++row) {
        const bool listed = drawn.words[LIGHT_SCALES_AT + row] != 0 || row == LIGHT_ROW_OF_ALL;
        if (!listed) continue;
        for (const auto& [cluster, count] : drawn.slotsOf(row)) slotsOfCluster[cluster] += count;
        slots += static_cast<int>(drawn.slotCount());
    }
    std::uint32_t end = 0;
    int large = 0;
    for (std::size_t place = 0; drawn.clusterAt(place) >= 0; ++place) {
        const std::uint32_t pool = drawn.words[LIGHT_CLUSTER_POOLS_AT + place];
        const std::uint32_t faces = 1u << (pool & 15u);
        EXPECT_EQ(pool >> 4, end) << place;
        end += faces;
        if (faces <= 1u << LIGHT_LEAST_POOL_SHIFT || faces >= 1u << LIGHT_MOST_POOL_SHIFT) continue;
        const double part =
            LIGHT_POOL_ENTRIES * static_cast<double>(slotsOfCluster[drawn.clusterAt(place)]) / slots;
        EXPECT_LE(faces, part) << place;
        EXPECT_GT(4 * faces, part) << place;
        large += faces >= 64 ? 1 : 0;
    }
    EXPECT_LE(end, LIGHT_POOL_ENTRIES);
    EXPECT_GT(end, LIGHT_POOL_ENTRIES / 3);
    EXPECT_GT(large, 50);
}

// Of all light nine tenths is that of the outside, which the room does not see: its walls draw a quarter of it or less.
TEST_F(LightSamplesTest, RoomsDrawLittleOfWhatShinesOutside) {
    CacheRig rig(programs(), roomInHouse(), 96);
    shine(rig);
    const Drawn drawn(rig);
    const voxels::VoxelGrid& grid = rig.surface.grid();
    const auto isOutside = [&](std::size_t face) {
        const glm::vec3 at = glm::abs(grid.worldFromGrid(
            glm::vec3(voxels::unpackVoxel(drawn.records[face].voxel & 0x3fffffffu)) + 0.5f));
        return std::max({at.x, at.y, at.z}) > 1.1f;
    };
    EXPECT_GT(drawn.partOf(LIGHT_ROW_OF_ALL, isOutside), 0.85);
    const std::uint32_t bits = drawn.words[LIGHT_SHIFT_AT];
    const glm::vec3 shift = glm::vec3(glm::uvec3(bits, bits >> 10, bits >> 20) & 1023u) / 1024.0f;
    const float edge = static_cast<float>(std::max({grid.size.x, grid.size.y, grid.size.z})) / 7.0f;
    int walls = 0;
    for (std::size_t row = 0; row < LIGHT_CLUSTERS; ++row) {
        const auto cube = static_cast<int>(row / 6);
        const glm::vec3 at(cube % 8, cube / 8 % 8, cube / 64);
        const glm::vec3 middle = grid.worldFromGrid((at + 0.5f - shift) * edge);
        const int axis = static_cast<int>(row % 6) / 2;
        const float along = row % 2 == 0 ? middle[axis] : -middle[axis];
        // Those that look inwards.
        if (along > -0.5f || std::bit_cast<float>(drawn.words[LIGHT_SCALES_AT + row]) == 0) continue;
        ++walls;
        EXPECT_LT(drawn.partOf(row, isOutside), 0.25) << row;
    }
    EXPECT_GT(walls, 50);
}

TEST_F(LightSamplesTest, SameCallsSameSamples) {
    std::vector<std::uint32_t> first;
    for (int run = 0; run < 2; ++run) {
        CacheRig rig(programs(), roomInHouse(), 48);
        rig.update(4);
        const auto words = rig.cache.samples().buffer().read<std::uint32_t>(LIGHT_SAMPLE_WORDS);
        if (run == 0) first = words;
        EXPECT_EQ(words, first);
    }
}

}  // namespace
}  // namespace conelight::test
