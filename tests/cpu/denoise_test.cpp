// SPDX-License-Identifier: MIT
// The filter of path-traced pictures: by how much the error against converged pictures falls, edges of shadows
// and textures that stay, pictures that must not change, numbers that must stay numbers, bits over threads, and
// the noise it says is left.
#include "reference/denoise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "conelight/error.h"
#include "io/scene_file.h"
#include "reference/metrics.h"
#include "support/truth_rig.h"

namespace conelight::test {
namespace {

using namespace reference;

constexpr int kWidth = 96, kHeight = 72;

PathTracedPicture traced(const Scene& scene, int samples, std::uint32_t seed, PixelFilter filter) {
    PathTracerSettings settings;
    settings.samplesPerPixel = samples;
    settings.seed = seed;
    settings.filter = filter;
    settings.features = true;
    return PathTracer(scene).render(scene.cameras.at(0), kWidth, kHeight, settings);
}

Metrics against(const Image& image, const PathTracedPicture& truth) {
    MetricOptions options;
    options.flip = false;
    return compareImages(image, truth.full, options, Halves{&truth.halfA, &truth.halfB});
}

struct Drop {
    double squared, relative;  // of MSE and of relMSE, by which factor each falls
    double noise, left;        // relRMSE before and after
    double said;               // PathTracedPicture::noise of the filtered picture
};

Drop dropOf(const char* name, int samples, int truthSamples, PixelFilter filter) {
    const Scene scene = io::loadScene(name);
    const PathTracedPicture truth = traced(scene, truthSamples, 99, filter);
    const PathTracedPicture noisy = traced(scene, samples, 1, filter);
    const PathTracedPicture clean = denoise(noisy);
    const Metrics before = against(noisy.full, truth), after = against(clean.full, truth);
    EXPECT_LT(std::abs(after.bias), 0.01) << name;
    return {before.mse / after.mse, before.relMse / after.relMse, before.relRmse, after.relRmse, clean.noise};
}

TEST(Denoise, LeavesATenthOfTheErrorInADiffuseRoom) {
    const Drop drop = dropOf("builtin:cornell", 32, 512, PixelFilter::Center);
    EXPECT_GT(drop.squared, 10);
    EXPECT_GT(drop.relative, 10);
    // What it says of itself: within a third, where the halves can tell.
    EXPECT_NEAR(drop.said, drop.left, 0.15 * drop.noise);
}

TEST(Denoise, LeavesAnEighthOfTheErrorAmongTexturesAndEdges) {
    for (const PixelFilter filter : {PixelFilter::Center, PixelFilter::Box}) {
        const Drop drop = dropOf("builtin:study", 32, 256, filter);
        EXPECT_GT(drop.squared, 8);
        EXPECT_GT(drop.relative, 8);
    }
}

// A picture made by hand: a wall of `size`, direct light of `light` with noise of `sigma`, albedo of `albedo`.
struct Wall {
    PathTracedPicture picture;
    Image truth;
};

float noiseAt(std::uint32_t x, std::uint32_t y, std::uint32_t half, std::uint32_t channel) {
    // Twelve hashed numbers make a normal distribution.
    float sum = -6;
    std::uint32_t state =
        x * 73856093u ^ y * 19349663u ^ (half + 1) * 83492791u ^ (channel + 7) * 2654435761u;
    for (int i = 0; i < 12; ++i) {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        sum += static_cast<float>(state >> 8) * 0x1p-24f;
    }
    return sum;
}

template <class Light, class Albedo>
Wall wallOf(int width, int height, float sigma, Light light, Albedo albedo) {
    Wall wall;
    const Image empty{width, height,
                      std::vector<glm::vec4>(std::size_t(width * height), glm::vec4(0, 0, 0, 1))};
    PathTracedPicture& p = wall.picture;
    FeaturePictures& f = p.features;
    for (Image* image : {&p.full, &p.direct, &p.indirect, &p.diffuse, &p.specular, &p.halfA, &p.halfB,
                         &p.indirectA, &p.indirectB, &f.albedoA, &f.albedoB, &f.glossA, &f.glossB,
                         &f.emissionA, &f.emissionB, &f.normal, &f.diffuseA, &f.diffuseB, &wall.truth})
        *image = empty;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const std::size_t i = std::size_t(y * width + x);
            const float a = albedo(x, y), l = light(x, y);
            f.albedoA.pixels[i] = f.albedoB.pixels[i] = glm::vec4(a, a, a, 1);
            f.normal.pixels[i] = glm::vec4(0, 0, 1, 2);
            wall.truth.pixels[i] = glm::vec4(a * l, a * l, a * l, 1);
            for (int half = 0; half < 2; ++half) {
                glm::vec4 value(0, 0, 0, 1);
                for (int c = 0; c < 3; ++c)
                    value[c] = std::max(
                        a * (l + sigma * noiseAt(unsigned(x), unsigned(y), unsigned(half), unsigned(c))),
                        0.0f);
                (half == 0 ? p.halfA : p.halfB).pixels[i] = value;
            }
            p.full.pixels[i] = p.direct.pixels[i] = 0.5f * (p.halfA.pixels[i] + p.halfB.pixels[i]);
        }
    return wall;
}

// The step of a shadow, noise a fifth of it: no column beside it takes more than a tenth of the other side.
TEST(Denoise, KeepsEdgesOfShadows) {
    const auto light = [](int x, int /*y*/) { return x < 24 ? 1.0f : 0.3f; };
    const Wall wall = wallOf(48, 48, 0.14f, light, [](int, int) { return 0.7f; });
    const PathTracedPicture clean = denoise(wall.picture);
    for (const int x : {22, 23, 24, 25}) {
        double sum = 0;
        for (int y = 0; y < 48; ++y)
            sum += static_cast<double>(clean.full.pixels[std::size_t(48 * y + x)].g) / 48;
        EXPECT_NEAR(sum, 0.7 * (x < 24 ? 1.0 : 0.3), 0.049) << "column " << x;
    }
    EXPECT_LT(relRmse(clean.full, wall.truth), 0.4 * relRmse(wall.picture.full, wall.truth));
}

// A checkerboard whose squares are two pixels wide.
TEST(Denoise, KeepsTextures) {
    const auto albedo = [](int x, int y) { return (x / 2 + y / 2) % 2 == 0 ? 0.8f : 0.2f; };
    const Wall wall = wallOf(
        48, 48, 0.2f, [](int, int) { return 1.0f; }, albedo);
    const PathTracedPicture clean = denoise(wall.picture);
    double contrast = 0;
    for (std::size_t i = 0; i < wall.truth.pixels.size(); ++i)
        contrast +=
            (wall.truth.pixels[i].g > 0.5f ? 1.0 : -1.0) * static_cast<double>(clean.full.pixels[i].g);
    EXPECT_NEAR(contrast / (0.5 * 48 * 48 * 0.6), 1, 0.02);
    EXPECT_LT(relRmse(clean.full, wall.truth), 0.25 * relRmse(wall.picture.full, wall.truth));
}

TEST(Denoise, LeavesAPictureWithoutNoiseAsItIs) {
    const auto light = [](int x, int y) { return 1 + 0.5f * std::sin(0.7f * static_cast<float>(x * y)); };
    const Wall wall = wallOf(32, 24, 0, light, [](int x, int) { return x % 3 == 0 ? 0.0f : 0.6f; });
    const PathTracedPicture clean = denoise(wall.picture);
    for (std::size_t i = 0; i < wall.truth.pixels.size(); ++i)
        for (int c = 0; c < 4; ++c) EXPECT_NEAR(clean.full.pixels[i][c], wall.truth.pixels[i][c], 2e-7f) << i;
    EXPECT_EQ(clean.noise, 0);
}

// One pixel that is bright in both halves is no noise.
TEST(Denoise, KeepsAHighlightOfOnePixel) {
    const auto light = [](int x, int y) { return x == 20 && y == 13 ? 30.0f : 1.0f; };
    const Wall wall = wallOf(40, 30, 0.2f, light, [](int, int) { return 0.5f; });
    EXPECT_NEAR(denoise(wall.picture).full.pixels[13 * 40 + 20].g, 15, 0.5);
}

TEST(Denoise, EvenLightStaysEvenAndKeepsItsMean) {
    const Wall wall = wallOf(
        48, 48, 0.3f, [](int, int) { return 1.0f; }, [](int, int) { return 0.5f; });
    const PathTracedPicture clean = denoise(wall.picture);
    EXPECT_NEAR(meanOf(clean.full) / meanOf(wall.picture.full), 1, 0.003);
    EXPECT_LT(relRmse(clean.full, wall.truth), 0.25 * relRmse(wall.picture.full, wall.truth));
}

TEST(Denoise, WhatIsBlackBrightOrNoNumberLeavesNumbers) {
    Wall wall = wallOf(
        40, 40, 0.2f, [](int, int) { return 1.0f; }, [](int x, int) { return x < 12 ? 0.0f : 0.5f; });
    PathTracedPicture& p = wall.picture;
    for (std::size_t i = 0; i < 400; ++i) {  // sky above
        p.features.normal.pixels[i] = p.features.albedoA.pixels[i] = p.features.albedoB.pixels[i] =
            glm::vec4(0);
        p.features.emissionA.pixels[i] = p.features.emissionB.pixels[i] = p.halfA.pixels[i] =
            p.halfB.pixels[i] = glm::vec4(3, 4, 5, 0);
    }
    p.halfA.pixels[900] = glm::vec4(1e30f, 5, 1e4f, 1);
    p.halfB.pixels[950] =
        glm::vec4(std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN(), 1, 1);
    const PathTracedPicture clean = denoise(p);
    for (std::size_t i = 0; i < clean.full.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c) EXPECT_TRUE(std::isfinite(clean.full.pixels[i][c])) << i;
    EXPECT_TRUE(std::isfinite(clean.noise));
    for (std::size_t i = 0; i < 400; ++i) EXPECT_EQ(glm::vec3(clean.full.pixels[i]), glm::vec3(3, 4, 5)) << i;
}

// A firefly in one half, a thousand times the light: it goes, and its neighbours hardly notice.
TEST(Denoise, TakesOutFireflies) {
    Wall wall = wallOf(
        40, 40, 0.1f, [](int, int) { return 1.0f; }, [](int, int) { return 0.5f; });
    const std::size_t at = 20 * 40 + 20;
    wall.picture.halfA.pixels[at] = glm::vec4(500, 500, 500, 1);
    wall.picture.full.pixels[at] = wall.picture.direct.pixels[at] = glm::vec4(250, 250, 250, 1);
    const PathTracedPicture clean = denoise(wall.picture);
    EXPECT_LT(relRmse(clean.full, wall.truth), 0.2 * relRmse(wall.picture.full, wall.truth));
}

TEST(Denoise, PartsAddUpAndThreadsGiveTheSameBits) {
    const PathTracedPicture noisy = traced(io::loadScene("builtin:spheres"), 4, 1, PixelFilter::Box);
    const PathTracedPicture one = denoise(noisy, {Denoiser::Own, 1}),
                            two = denoise(noisy, {Denoiser::Own, 2});
    for (std::size_t i = 0; i < one.full.pixels.size(); ++i) {
        EXPECT_EQ(one.full.pixels[i], two.full.pixels[i]);
        EXPECT_EQ(one.halfA.pixels[i], two.halfA.pixels[i]);
        const glm::vec4 sum = one.direct.pixels[i] + one.diffuse.pixels[i] + one.specular.pixels[i];
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(sum[c], one.full.pixels[i][c], 1e-5f * (1 + sum[c]));
            EXPECT_NEAR(0.5f * (one.halfA.pixels[i][c] + one.halfB.pixels[i][c]), one.full.pixels[i][c],
                        1e-5f * (1 + sum[c]));
        }
    }
    EXPECT_EQ(one.noise, two.noise);
}

TEST(Denoise, FeaturesChangeNoSample) {
    const Scene scene = io::loadScene("builtin:mirror-hall");
    PathTracerSettings settings;
    settings.samplesPerPixel = 4;
    const PathTracedPicture without = PathTracer(scene).render(scene.cameras.at(0), 32, 24, settings);
    settings.features = true;
    const PathTracedPicture with = PathTracer(scene).render(scene.cameras.at(0), 32, 24, settings);
    EXPECT_EQ(without.full.pixels, with.full.pixels);
    EXPECT_TRUE(without.features.normal.pixels.empty());
    ASSERT_EQ(with.features.normal.pixels.size(), 32u * 24u);
}

TEST(Denoise, RefusesAPictureWithoutFeatures) {
    const Scene scene = io::loadScene("builtin:cornell");
    PathTracerSettings settings;
    settings.samplesPerPixel = 2;
    const PathTracedPicture picture = PathTracer(scene).render(scene.cameras.at(0), 8, 8, settings);
    EXPECT_THROW(denoise(picture), Error);
    if (!hasOidn()) {
        settings.features = true;
        const PathTracedPicture with = PathTracer(scene).render(scene.cameras.at(0), 8, 8, settings);
        EXPECT_THROW(denoise(with, {Denoiser::Oidn, 0}), Error);
    }
}

}  // namespace
}  // namespace conelight::test
