// SPDX-License-Identifier: MIT
// Mip levels: sizes as OpenGL counts them, and the mean light of level 0 in all of them.
#include "scene/mip_levels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "math/srgb.h"

namespace conelight::test {
namespace {

using scene::MipLevel;
using scene::smallerLevels;

std::vector<std::uint8_t> noise(int width, int height) {
    std::vector<std::uint8_t> rgba;
    std::uint32_t state = 7;
    for (int i = 0; i < 4 * width * height; ++i) {
        state = state * 1664525u + 1013904223u;
        rgba.push_back(static_cast<std::uint8_t>(state >> 24));
    }
    return rgba;
}

double meanOf(const std::vector<std::uint8_t>& rgba, std::size_t channel, bool srgb) {
    double sum = 0;
    for (std::size_t i = channel; i < rgba.size(); i += 4) {
        const float value = static_cast<float>(rgba[i]) / 255.0f;
        sum += static_cast<double>(srgb ? math::srgbToLinear(value) : value);
    }
    return 4 * sum / static_cast<double>(rgba.size());
}

TEST(MipLevelsTest, SizesAreThoseOfOpenGl) {
    const std::vector<MipLevel> levels = smallerLevels(noise(13, 3), 13, 3, true);
    ASSERT_EQ(levels.size(), 3u);
    const int widths[3] = {6, 3, 1};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(levels[i].width, widths[i]);
        EXPECT_EQ(levels[i].height, 1);
        EXPECT_EQ(levels[i].rgba.size(), 4u * static_cast<std::size_t>(widths[i]));
    }
    EXPECT_TRUE(smallerLevels(noise(1, 1), 1, 1, false).empty());
}

// No level is darker: what is rounded does not add up. Sizes that are no powers of two lose no row or column.
TEST(MipLevelsTest, EachKeepsTheMean) {
    for (const auto& [width, height] : {std::pair(256, 256), std::pair(255, 100), std::pair(37, 513)})
        for (const bool srgb : {true, false}) {
            const std::vector<std::uint8_t> rgba = noise(width, height);
            for (const MipLevel& level : smallerLevels(rgba, width, height, srgb))
                for (std::size_t c = 0; c < 4; ++c) {
                    const bool encoded = srgb && c < 3;
                    const double texels = static_cast<double>(level.rgba.size()) / 4;
                    EXPECT_NEAR(meanOf(level.rgba, c, encoded) / meanOf(rgba, c, encoded), 1,
                                0.001 + 0.009 / std::sqrt(texels))
                        << width << " x " << height << ", channel " << c << ", level of " << level.width;
                }
        }
}

// Black and white in turns are half of the light, as 188 of 255 is in sRGB; opacity is not encoded.
TEST(MipLevelsTest, ColoursAreAveragedInLinearLight) {
    std::vector<std::uint8_t> rgba;
    for (int i = 0; i < 16; ++i) rgba.insert(rgba.end(), 4, i % 2 ? 255 : 0);
    const std::vector<MipLevel> encoded = smallerLevels(rgba, 4, 4, true);
    const std::vector<MipLevel> linear = smallerLevels(rgba, 4, 4, false);
    ASSERT_EQ(encoded.size(), 2u);
    EXPECT_EQ(encoded[1].rgba, (std::vector<std::uint8_t>{188, 188, 188, 128}));
    EXPECT_EQ(linear[1].rgba, (std::vector<std::uint8_t>{128, 128, 128, 128}));
}

// The middle column of three belongs to one texel in full.
TEST(MipLevelsTest, OddSizesAreSharedByArea) {
    const std::vector<std::uint8_t> rgba = {30, 0, 0, 255, 60, 0, 0, 255, 90, 0, 0, 255};
    const std::vector<MipLevel> levels = smallerLevels(rgba, 3, 1, false);
    ASSERT_EQ(levels.size(), 1u);
    EXPECT_EQ(levels[0].rgba, (std::vector<std::uint8_t>{60, 0, 0, 255}));
    std::vector<std::uint8_t> five;
    for (const int red : {0, 50, 100, 150, 200}) five.insert(five.end(), {std::uint8_t(red), 0, 0, 255});
    // 2.5 texels each: (0 + 50 + 100/2) / 2.5 and (100/2 + 150 + 200) / 2.5.
    EXPECT_EQ(smallerLevels(five, 5, 1, false)[0].rgba,
              (std::vector<std::uint8_t>{40, 0, 0, 255, 160, 0, 0, 255}));
}

}  // namespace
}  // namespace conelight::test
