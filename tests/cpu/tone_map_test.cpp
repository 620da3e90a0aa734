// SPDX-License-Identifier: MIT
// From linear radiance to 8 bits: known values of each curve, order of bytes, and inputs that are no colours.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "conelight/renderer.h"

namespace conelight::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

ImageSettings settings(ToneMap curve, bool srgb = false, float exposure = 0) {
    ImageSettings result;
    result.toneMap = curve;
    result.srgb = srgb;
    result.exposure = exposure;
    return result;
}

std::vector<std::uint8_t> mapped(const std::vector<glm::vec3>& colors, const ImageSettings& how) {
    Image image{static_cast<int>(colors.size()), 1, {}};
    for (const glm::vec3& color : colors) image.pixels.emplace_back(color, 1.0f);
    return toneMapped(image, how);
}

int grey(float value, const ImageSettings& how) { return mapped({glm::vec3(value)}, how).at(0); }

}  // namespace

TEST(ToneMapTest, BytesAreRgbInTheOrderOfPixels) {
    EXPECT_EQ(mapped({{1, 0, 0.2f}, {0, 0.4f, 1}}, settings(ToneMap::None)),
              (std::vector<std::uint8_t>{255, 0, 51, 0, 102, 255}));
}

TEST(ToneMapTest, SrgbIsTheStandardsCurve) {
    const ImageSettings srgb = settings(ToneMap::None, true);
    // 12.92 c below 0.0031308; 0.5 -> 187.5; 0.18 -> 117.6; 0.21586 is 128/255.
    EXPECT_EQ(grey(0.001f, srgb), 3);
    EXPECT_EQ(grey(0.5f, srgb), 188);
    EXPECT_EQ(grey(0.18f, srgb), 118);
    EXPECT_EQ(grey(0.21586f, srgb), 128);
    EXPECT_EQ(grey(1.0f, srgb), 255);
}

TEST(ToneMapTest, ExposureCountsInStops) {
    EXPECT_EQ(grey(0.2f, settings(ToneMap::None, false, 1)), 102);
    EXPECT_EQ(grey(0.4f, settings(ToneMap::None, false, -1)), 51);
}

TEST(ToneMapTest, ReinhardHalvesOneAndKeepsRatios) {
    EXPECT_EQ(grey(1.0f, settings(ToneMap::Reinhard)), 128);
    EXPECT_EQ(grey(3.0f, settings(ToneMap::Reinhard)), 191);
    const std::vector<std::uint8_t> color = mapped({{0.8f, 0.4f, 0.2f}}, settings(ToneMap::Reinhard));
    EXPECT_NEAR(color[0], 2 * color[1], 1.5);
    EXPECT_NEAR(color[1], 2 * color[2], 1.5);
}

TEST(ToneMapTest, AcesHasItsPublishedValues) {
    // (2.51 c^2 + 0.03 c) / (2.43 c^2 + 0.59 c + 0.14) at 0, 0.18, 1 and far above.
    EXPECT_EQ(grey(0.0f, settings(ToneMap::Aces)), 0);
    EXPECT_EQ(grey(0.18f, settings(ToneMap::Aces)), 68);
    EXPECT_EQ(grey(1.0f, settings(ToneMap::Aces)), 205);
    EXPECT_EQ(grey(100.0f, settings(ToneMap::Aces)), 255);
}

TEST(ToneMapTest, BrighterIsNeverDarker) {
    for (const ToneMap curve : {ToneMap::None, ToneMap::Reinhard, ToneMap::Aces})
        for (const bool srgb : {false, true}) {
            int last = 0;
            for (float value = 1e-6f; value < 1e38f; value *= 1.1f) {
                const int byte = grey(value, settings(curve, srgb));
                ASSERT_GE(byte, last) << value;
                last = byte;
            }
            EXPECT_EQ(last, 255);
            EXPECT_EQ(grey(kInfinity, settings(curve, srgb)), 255) << "infinitely bright is white";
        }
}

TEST(ToneMapTest, WhatIsNoColourIsBlack) {
    for (const ToneMap curve : {ToneMap::None, ToneMap::Reinhard, ToneMap::Aces}) {
        EXPECT_EQ(grey(-1.0f, settings(curve, true)), 0);
        EXPECT_EQ(grey(-kInfinity, settings(curve, true)), 0);
        EXPECT_EQ(grey(std::numeric_limits<float>::quiet_NaN(), settings(curve, true)), 0);
    }
    EXPECT_TRUE(toneMapped(Image{}, ImageSettings{}).empty());
}

}  // namespace conelight::test
