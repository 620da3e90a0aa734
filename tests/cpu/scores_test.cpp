// SPDX-License-Identifier: MIT
// Scores against pictures whose score is known.
#include "reference/scores.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "conelight/error.h"

namespace conelight::reference {
namespace {

constexpr int kWidth = 64, kHeight = 48;

Image filled(float value) {
    return {kWidth, kHeight, std::vector<glm::vec4>(kWidth * kHeight, glm::vec4(value, value, value, 1))};
}

Image noisy(float value, float sigma, std::mt19937& random) {
    std::normal_distribution<float> noise(0, sigma);
    Image image = filled(value);
    for (glm::vec4& p : image.pixels) p += glm::vec4(noise(random), noise(random), noise(random), 0);
    return image;
}

// Frames of a camera that stands still before a wall at depth 2; the test picture is made per frame.
std::vector<FlickerFrame> still(int count, const std::function<Image(int)>& test) {
    std::vector<FlickerFrame> frames;
    for (int t = 0; t < count; ++t) frames.push_back({test(t), filled(1), filled(1), filled(2), Camera{}});
    return frames;
}

TEST(Scores, LeakIsLightWhereTheReferenceIsBlack) {
    Image dark = filled(0.02f), truth = filled(0);
    for (int i = 0; i < kWidth * 10; ++i) {  // a lamp seen in the dark room: not counted
        truth.pixels[static_cast<std::size_t>(i)] = glm::vec4(5, 5, 5, 1);
        dark.pixels[static_cast<std::size_t>(i)] = glm::vec4(7, 7, 7, 1);
    }
    const LeakScore score = leakScore(dark, truth, filled(0.5f), filled(0.4f));
    EXPECT_EQ(score.darkPixels, std::size_t(kWidth * (kHeight - 10)));
    EXPECT_NEAR(score.darkMean, 0.02, 1e-7);
    EXPECT_NEAR(score.litMean, 0.5, 1e-7);
    EXPECT_NEAR(score.ratio, 0.04, 1e-6);
    EXPECT_EQ(leakScore(filled(0), filled(0), filled(1), filled(1)).ratio, 0);
    EXPECT_THROW(leakScore(dark, filled(1), filled(1), filled(1)), Error);
}

TEST(Scores, DifferenceIsRelativeToTheMean) {
    EXPECT_NEAR(relativeDifference(filled(1.1f), filled(1)), 0.1, 1e-6);
    EXPECT_EQ(relativeDifference(filled(3), filled(3)), 0);
    EXPECT_EQ(relativeDifference(filled(0), filled(0)), 0);
    EXPECT_TRUE(std::isinf(relativeDifference(filled(1), filled(0))));
    Image bad = filled(1);
    bad.pixels[0].x = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(relativeDifference(bad, filled(1)), 0);
    EXPECT_NEAR(relativeDifference(filled(0.3f), filled(0), 3), 0.1, 1e-6);
    EXPECT_NEAR(meanRadiance(filled(0.25f)), 0.25, 1e-6);
    EXPECT_EQ(meanRadiance(Image{}), 0);
}

TEST(Scores, SteadyAndEvenlyChangingErrorsDoNotFlicker) {
    std::mt19937 random(1);
    const Image pattern = noisy(1, 0.3f, random);
    EXPECT_EQ(flickerScore(still(5, [&](int) { return pattern; })).flicker, 0);
    // An even change: 1, 1.25, 1.5 ... (exact in binary).
    EXPECT_EQ(flickerScore(still(5, [](int t) { return filled(1 + 0.25f * static_cast<float>(t)); })).flicker,
              0);
}

TEST(Scores, AlternatingErrorOfAKnownSize) {
    // h = +-2a: sqrt(2/3) * 2a.
    const FlickerScore score =
        flickerScore(still(6, [](int t) { return filled(t % 2 == 0 ? 1.125f : 0.875f); }));
    EXPECT_NEAR(score.flicker, std::sqrt(2.0 / 3.0) * 2 * 0.125, 1e-7);
    EXPECT_EQ(score.each.size(), 4u);
    EXPECT_EQ(score.pixelsUsed, 1);
    EXPECT_THROW(flickerScore(still(2, [](int) { return filled(1); })), Error);
}

TEST(Scores, IndependentErrorsGiveTheirRelRmse) {
    std::mt19937 random(2);
    const FlickerScore score = flickerScore(still(6, [&](int) { return noisy(1, 0.1f, random); }));
    // 36864 products; their spread is about 1 % of the mean square.
    EXPECT_NEAR(score.flicker, 0.1, 0.002);
}

TEST(Scores, NoiseOfTheReferenceIsNotCounted) {
    std::mt19937 random(3);
    std::vector<FlickerFrame> frames = still(6, [](int) { return filled(1); });
    for (FlickerFrame& frame : frames) {
        frame.halfA = noisy(1, 0.2f, random);
        frame.halfB = noisy(1, 0.2f, random);
    }
    // The mean product of independent noise is 0 within 0.04 * 1.5 / sqrt(36864) = 0.0003.
    const FlickerScore score = flickerScore(frames);
    EXPECT_LT(score.flicker, 0.03);
    // The same estimate made by the score: sqrt(2/3 * 0.0003) = 0.015.
    EXPECT_NEAR(score.floor, 0.015, 0.003);
    EXPECT_LT(score.flicker, 3 * score.floor);
}

// Only the frames that are named count, and only they and their neighbours need references.
TEST(Scores, NamedFramesAloneCount) {
    std::vector<FlickerFrame> frames = still(9, [](int t) { return filled(t == 2 || t == 7 ? 1.5f : 1.0f); });
    for (const std::size_t t : {0u, 1u, 2u, 3u}) frames[t].halfA = frames[t].halfB = {};
    const std::size_t calm = 5, jump = 7;
    EXPECT_EQ(flickerScore(frames, {&calm, 1}).flicker, 0);
    EXPECT_NEAR(flickerScore(frames, {&jump, 1}).flicker, std::sqrt(2.0 / 3.0) * 0.5, 1e-6);
    EXPECT_EQ(flickerScore(frames, {&jump, 1}).pixelsUsed, 1);
    EXPECT_THROW(flickerScore(frames), Error);  // frame 1 has no reference
}

TEST(Scores, UnsteadinessFindsTheFrameThatJumps) {
    std::vector<FlickerFrame> frames = still(7, [](int t) { return filled(t < 4 ? 1.0f : 1.25f); });
    for (FlickerFrame& frame : frames) frame.halfA = frame.halfB = {};
    const std::vector<double> each = unsteadiness(frames);
    ASSERT_EQ(each.size(), 5u);
    const double mean = (4 + 3 * 1.25) / 7;
    for (std::size_t i = 0; i < each.size(); ++i)  // frames 3 and 4 have the step beside them
        EXPECT_NEAR(each[i], i == 2 || i == 3 ? std::sqrt(2.0 / 3.0) * 0.125 / mean : 0, 1e-7) << i;
    EXPECT_THROW(unsteadiness({frames.data(), 2}), Error);
    EXPECT_EQ(jumpOf(each).frame, 4u);
}

// Against what is about it: a long part that is restless is no jump, nor is one frame alone.
TEST(Scores, AJumpStandsOutInTwoFrames) {
    std::vector<double> each(60, 0.01);
    std::fill(each.begin() + 30, each.end(), 0.1);
    each[10] = 0.5;
    EXPECT_DOUBLE_EQ(jumpOf(std::span(each).first(25)).ratio, 1);
    EXPECT_DOUBLE_EQ(jumpOf(std::span(each).subspan(35)).ratio, 1);
    each[50] = each[51] = 2;
    EXPECT_DOUBLE_EQ(jumpOf(each).ratio, 20);
    EXPECT_EQ(jumpOf(each).frame, 52u);
}

// A wall at z = 0 with a smooth error fixed to it, seen by a camera that slides sideways: nothing flickers on
// the wall, though every pixel changes.
void expectNoFlicker(float orthographicHeight) {
    const auto frameAt = [orthographicHeight](int t) {
        FlickerFrame frame{filled(0), filled(1), filled(1), filled(2), {}};
        const float slide = 0.05f * static_cast<float>(t * t);
        frame.camera.eye = {slide, 0, 2};
        frame.camera.target = {slide, 0, 0};
        frame.camera.orthographicHeight = orthographicHeight;
        const float tanY = 0.25f * frame.camera.heightAt(2);
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                const float u = (2 * (static_cast<float>(x) + 0.5f) / kWidth - 1) * tanY * kWidth / kHeight;
                const float worldX = slide + 2 * u;
                const float value = 1 + 0.3f * std::sin(6 * worldX);
                frame.test.pixels[static_cast<std::size_t>(y * kWidth + x)] =
                    glm::vec4(value, value, value, 1);
            }
        return frame;
    };
    std::vector<FlickerFrame> frames;
    for (int t = 0; t < 5; ++t) frames.push_back(frameAt(t));
    const FlickerScore moved = flickerScore(frames);
    EXPECT_GT(moved.pixelsUsed, 0.7);
    // Bilinear reading of a wave of 25 pixels: at most (2 pi / 25)^2 / 8 of its height.
    EXPECT_LT(moved.flicker, 0.3 * 0.008);
    // The same pictures from a camera that is said to stand still do flicker.
    for (FlickerFrame& frame : frames) frame.camera = Camera{};
    EXPECT_GT(flickerScore(frames).flicker, 0.02);
}

TEST(Scores, ErrorsFixedToSurfacesDoNotFlickerWhenTheCameraMoves) {
    expectNoFlicker(0);
    expectNoFlicker(1.6f);
}

TEST(Scores, WhatAnotherFrameDoesNotSeeIsLeftOut) {
    std::vector<FlickerFrame> frames = still(3, [](int t) { return filled(t == 1 ? 5.0f : 1.0f); });
    frames[0].depth = filled(1);  // something else stood in front
    const FlickerScore score = flickerScore(frames);
    EXPECT_EQ(score.pixelsUsed, 0);
    EXPECT_EQ(score.flicker, 0);
}

TEST(Scores, SettledFromTheFirstFrameThatStaysClose) {
    EXPECT_EQ(settledAt(std::vector<double>{0.5, 0.2, 0.04, 0.06, 0.03, 0.01}, 0.05), 5);
    EXPECT_EQ(settledAt(std::vector<double>{0, 0, 0}, 0.05), 1);
    EXPECT_EQ(settledAt(std::vector<double>{0.5, 0.2}, 0.05), 0);
    EXPECT_EQ(settledAt(std::vector<double>{}, 0.05), 0);
}

}  // namespace
}  // namespace conelight::reference
