// SPDX-License-Identifier: MIT
// How many updates the faces of the irradiance cache get.
#include <gtest/gtest.h>

#include "light/lit_voxels.h"

namespace conelight::test {
namespace {

constexpr std::uint32_t kFaces = 1u << 18;

TEST(RelightUpdates, FewFacesHaveAll) {
    EXPECT_EQ(light::updatesOfFaces(32, 0), 32);
    EXPECT_EQ(light::updatesOfFaces(32, kFaces), 32);
}

// 24 of the 32 updates are averages. All faces together cast as many rays for them as 2^18 do.
TEST(RelightUpdates, AveragesOfManyFacesCastAsManyRaysInAll) {
    EXPECT_EQ(light::updatesOfFaces(32, 2 * kFaces), 8 + 12);
    EXPECT_EQ(light::updatesOfFaces(56, 6 * kFaces), 8 + 8);
}

TEST(RelightUpdates, BouncesSettleWhateverTheNumber) {
    EXPECT_EQ(light::updatesOfFaces(32, 100 * kFaces), 14);
    EXPECT_EQ(light::updatesOfFaces(4096, 4'000'000'000u), 14);
    EXPECT_EQ(light::updatesOfFaces(10, 100 * kFaces), 10);
}

}  // namespace
}  // namespace conelight::test
