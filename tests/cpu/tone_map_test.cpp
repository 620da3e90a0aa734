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
    result.exposure = {false, exposure};
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

// Middle grey stays in the middle of the screen's range, and strong colours fade to white as they get brighter.
TEST(ToneMapTest, AgxKeepsGreyAndFadesToWhite) {
    EXPECT_NEAR(grey(0.18f, settings(ToneMap::Agx, true)), 118, 12);
    const std::vector<std::uint8_t> grey3 = mapped({{0.4f, 0.4f, 0.4f}}, settings(ToneMap::Agx, true));
    EXPECT_NEAR(grey3[0], grey3[1], 1);
    EXPECT_NEAR(grey3[1], grey3[2], 1);
    const std::vector<std::uint8_t> red = mapped({{1, 0, 0}, {50, 0, 0}}, settings(ToneMap::Agx, true));
    EXPECT_GT(red[0], red[1] + 100);
    EXPECT_GT(red[4], red[1] + 60) << "brighter red is paler";
}

// The Khronos specification: colours without a common part stay as they are up to 0.76; the common part loses the
// 0.04 that a dielectric reflects; highlights end at white.
TEST(ToneMapTest, NeutralKeepsColoursOfTheMaterial) {
    EXPECT_EQ(mapped({{0.5f, 0.2f, 0}}, settings(ToneMap::Neutral)), (std::vector<std::uint8_t>{128, 51, 0}));
    EXPECT_EQ(grey(0.5f, settings(ToneMap::Neutral)), 117);  // 0.46
    EXPECT_EQ(grey(0.04f, settings(ToneMap::Neutral)), 3);   // 6.25 c^2
    EXPECT_EQ(grey(1.0f, settings(ToneMap::Neutral)), 222);  // 1 - 0.24^2 / (0.96 + 0.24 - 0.76)
    EXPECT_EQ(grey(1000.0f, settings(ToneMap::Neutral)), 255);
}

// --- Automatic exposure

Image evenImage(float value) { return {20, 10, std::vector<glm::vec4>(200, glm::vec4(glm::vec3(value), 1))}; }

TEST(AutoExposureTest, MakesTheMeanMiddleGrey) {
    // Bins are up to a third of a stop wide.
    for (const float value : {0.18f, 1.44f, 1e-4f, 3000.0f})
        EXPECT_NEAR(autoExposure(evenImage(value)), std::log2(0.18f / value), 0.2f) << value;
    EXPECT_EQ(autoExposure(evenImage(0)), 0.0f) << "nothing to see";
    EXPECT_EQ(autoExposure(Image{}), 0.0f);
}

TEST(AutoExposureTest, LampsAndTheBlackAroundARoomDoNotCount) {
    Image image = evenImage(0.18f);
    const float plain = autoExposure(image);
    for (std::size_t i = 0; i < 5; ++i) image.pixels[i] = glm::vec4(5000.0f);
    for (std::size_t i = 20; i < 100; ++i) image.pixels[i] = glm::vec4(0);
    image.pixels[100] = glm::vec4(kInfinity);
    image.pixels[101] = glm::vec4(std::numeric_limits<float>::quiet_NaN());
    EXPECT_EQ(autoExposure(image), plain);
}

TEST(AutoExposureTest, IsWhatToneMappingUses) {
    const Image image = evenImage(7.0f);
    ImageSettings automatic = settings(ToneMap::None);
    automatic.exposure = {};
    EXPECT_EQ(toneMapped(image, automatic),
              toneMapped(image, settings(ToneMap::None, false, autoExposure(image))));
    EXPECT_NEAR(toneMapped(image, automatic)[0], 0.18f * 255, 5);
}

TEST(ToneMapTest, BrighterIsNeverDarker) {
    for (const ToneMap curve :
         {ToneMap::None, ToneMap::Reinhard, ToneMap::Aces, ToneMap::Agx, ToneMap::Neutral})
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
    for (const ToneMap curve :
         {ToneMap::None, ToneMap::Reinhard, ToneMap::Aces, ToneMap::Agx, ToneMap::Neutral}) {
        EXPECT_EQ(grey(-1.0f, settings(curve, true)), 0);
        EXPECT_EQ(grey(-kInfinity, settings(curve, true)), 0);
        EXPECT_EQ(grey(std::numeric_limits<float>::quiet_NaN(), settings(curve, true)), 0);
    }
    EXPECT_TRUE(toneMapped(Image{}, ImageSettings{}).empty());
}

// Illuminant A, a lamp of 2856 K, is white where it is asked to be; daylight is as it was.
TEST(ToneMapTest, WhiteBalanceMakesTheLampWhite) {
    ImageSettings how = settings(ToneMap::None);
    const glm::vec3 lamp(1.8454f, 0.8261f, 0.2332f);  // XYZ 1.0985 1 0.3558 in Rec.709, luminance 1
    EXPECT_EQ(mapped({0.4f * lamp, glm::vec3(0.5f)}, how),
              (std::vector<std::uint8_t>{188, 84, 24, 128, 128, 128}));
    how.whiteBalance = 2856;
    const std::vector<std::uint8_t> white = mapped({0.4f * lamp}, how);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(white[i], 102, 2) << i;
    EXPECT_GT(mapped({glm::vec3(0.4f)}, how)[2], 200) << "daylight is blue beside it";
    // Above 0 takes green out, below 0 magenta.
    for (const float tint : {-20.0f, 20.0f}) {
        how = settings(ToneMap::None);
        how.tint = tint;
        const std::vector<std::uint8_t> shown = mapped({glm::vec3(0.4f)}, how);
        const int green = shown[1] - (shown[0] + shown[2]) / 2;
        EXPECT_TRUE(tint > 0 ? green < -10 : green > 10) << tint << ": " << green;
    }
    how.whiteBalance = 4000;
    EXPECT_EQ(mapped({glm::vec3(kInfinity)}, how), (std::vector<std::uint8_t>{255, 255, 255}));
}

TEST(ToneMapTest, FalseColoursHaveOneForEachStop) {
    ImageSettings how = settings(ToneMap::Aces, true, 1);
    how.check = ExposureCheck::FalseColor;
    // After an exposure of one stop.
    const auto shown = [&](float stops) {
        const std::vector<std::uint8_t> b = mapped({glm::vec3(0.09f * std::exp2(stops))}, how);
        return glm::u8vec3(b[0], b[1], b[2]);
    };
    EXPECT_EQ(shown(0), glm::u8vec3(128));
    EXPECT_EQ(shown(-20), glm::u8vec3(0));
    EXPECT_EQ(shown(20), glm::u8vec3(255));
    for (int stop = -7; stop <= 7; ++stop) {
        const float at = static_cast<float>(stop);
        EXPECT_EQ(shown(at), falseColor(at));
        EXPECT_EQ(shown(at - 0.45f), shown(at + 0.45f)) << stop;
        EXPECT_NE(shown(at), shown(at + 1)) << stop;
        if (stop == 6) break;
    }
    EXPECT_EQ(mapped({glm::vec3(std::nanf(""))}, how), (std::vector<std::uint8_t>{0, 0, 0}));
}

TEST(ToneMapTest, ClippingIsStriped) {
    ImageSettings how = settings(ToneMap::None, true);
    how.check = ExposureCheck::Clipping;
    const std::vector<glm::vec3> row(8, glm::vec3(0.2f, 2, 0.2f));
    const std::vector<std::uint8_t> over = mapped(row, how);
    EXPECT_EQ((std::vector<std::uint8_t>{over.begin(), over.begin() + 3}),
              (std::vector<std::uint8_t>{255, 0, 64}));
    how.check = ExposureCheck::Off;
    const std::vector<std::uint8_t> plain = mapped(row, how);
    EXPECT_TRUE(std::equal(over.begin() + 12, over.end(), plain.begin() + 12))
        << "the picture between the stripes";
    how.check = ExposureCheck::Clipping;
    EXPECT_EQ(mapped({glm::vec3(0)}, how), (std::vector<std::uint8_t>{0, 64, 255}));
    EXPECT_EQ(mapped({glm::vec3(0, 0.5f, 0)}, how),
              mapped({glm::vec3(0, 0.5f, 0)}, settings(ToneMap::None, true)));
}

}  // namespace conelight::test
