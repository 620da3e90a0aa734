// SPDX-License-Identifier: MIT
// A thin lens: circles of confusion against their formula, what is in focus, and a lens of no width.
#include <algorithm>
#include <cmath>
#include <optional>

#include "conelight/renderer.h"
#include "reference/path_tracer.h"
#include "support/gl_fixture.h"
#include "support/scenes.h"
#include "support/truth_rig.h"

namespace conelight::test {
namespace {

constexpr int kPixels = 64;
using LensTest = GlTest;

// A bright spot, a pixel wide at `distance`, on the axis of a lens.
Scene spotAt(float distance, float lensDiameter, float focusDistance) {
    Scene scene;
    Material bright;
    bright.unlit = true;
    bright.baseColor = glm::vec4(1);
    const float edge = distance / kPixels;
    addInstance(scene, quadMesh({-0.5f * edge, -0.5f * edge, -distance}, {edge, 0, 0}, {0, edge, 0}), bright);
    Camera camera;
    camera.eye = {0, 0, 0};
    camera.target = {0, 0, -1};
    camera.fovY = 2 * std::atan(0.5f);
    camera.lensDiameter = lensDiameter;
    camera.focusDistance = focusDistance;
    scene.cameras = {camera};
    return scene;
}

Image byRenderer(const Scene& scene, Mode mode, int views) {
    Settings settings;
    settings.mode = mode;
    settings.voxels.size = 16;
    settings.image.antialiasing = views;
    Renderer renderer;
    renderer.setScene(scene);
    renderer.render(scene.cameras.front(), kPixels, kPixels, settings);
    return renderer.readImage();
}

Image byPaths(const Scene& scene, int samples) {
    reference::PathTracerSettings settings;
    settings.samplesPerPixel = samples;
    settings.filter = reference::PixelFilter::Box;
    return reference::PathTracer(scene).render(scene.cameras.front(), kPixels, kPixels, settings).full;
}

// Diameter of the disc whose light lies as far from its middle as the picture's, pixels: a disc of diameter c has the
// variance c^2 / 16 along each axis, a pixel 1 / 12.
double diameterOf(const Image& image, double& sum) {
    double x = 0, y = 0, squares = 0;
    sum = 0;
    for (int j = 0; j < kPixels; ++j)
        for (int i = 0; i < kPixels; ++i) {
            const double light =
                static_cast<double>(image.pixels[static_cast<std::size_t>(j * kPixels + i)].g);
            sum += light;
            x += light * i;
            y += light * j;
            squares += light * (i * i + j * j);
        }
    x /= sum;
    y /= sum;
    const double variance = 0.5 * (squares / sum - x * x - y * y);
    // The spot is a pixel wide, and so is the filter.
    return 4 * std::sqrt(std::max(variance - 2.0 / 12, 0.0));
}

TEST_F(LensTest, CirclesOfConfusionAreAsWideAsTheFormulaSays) {
    constexpr float kLens = 0.2f, kFocus = 2;
    for (const float distance : {1.0f, 4.0f}) {
        const Scene scene = spotAt(distance, kLens, kFocus);
        // On the plane in focus, which the picture's height of `kFocus` m covers.
        const double expected =
            static_cast<double>(kLens * std::abs(distance - kFocus) / distance / kFocus) * kPixels;
        const auto check = [&](const char* who, const Image& image) {
            double sum = 0;
            const double diameter = diameterOf(image, sum);
            EXPECT_NEAR(diameter, expected, 0.05 * expected) << who << " at " << distance << " m";
            // A pixel's light, spread. From the rim of the lens the spot is as large as from the middle.
            EXPECT_NEAR(sum, 1, 0.05) << who << " at " << distance << " m";
        };
        check("reference", byPaths(scene, 1024));
        check("phong", byRenderer(scene, Mode::Phong, 64));
        check("traced", byRenderer(scene, Mode::Traced, 64));
    }
}

TEST_F(LensTest, WhatIsInFocusIsAsSharpAsWithoutALens) {
    const Image pinhole = byRenderer(spotAt(2, 0, 0), Mode::Phong, 64);
    EXPECT_LT(relRmse(byRenderer(spotAt(2, 0.2f, 2), Mode::Phong, 64), pinhole), 1e-3);
    EXPECT_GT(relRmse(byRenderer(spotAt(2, 0.2f, 1), Mode::Phong, 64), pinhole), 1);
}

TEST_F(LensTest, WithoutANumberOfViewsAStillHasSixtyFourThroughThePixelsCenters) {
    double sum = 0;
    const double diameter = diameterOf(byRenderer(spotAt(4, 0.2f, 2), Mode::Phong, 0), sum);
    EXPECT_NEAR(diameter, 3.2, 0.4);
}

TEST_F(LensTest, ALensOfNoWidthChangesNoBit) {
    const Scene plain = spotAt(4, 0, 0), focused = spotAt(4, 0, 2);
    for (const int views : {0, 8})
        for (const Mode mode : {Mode::Phong, Mode::Traced})
            EXPECT_EQ(byRenderer(plain, mode, views).pixels, byRenderer(focused, mode, views).pixels);
    EXPECT_EQ(byPaths(plain, 16).pixels, byPaths(focused, 16).pixels);
}

// At rest frames are views through points of the lens; what moves is in focus.
TEST_F(LensTest, FramesOfARestingViewAddUpToTheStill) {
    const Scene scene = spotAt(1, 0.2f, 2);
    Settings settings;
    settings.mode = Mode::Phong;
    settings.image.temporal = Toggle::On;
    Renderer renderer;
    renderer.setScene(scene);
    for (int i = 0; i < 64; ++i) renderer.render(scene.cameras.front(), kPixels, kPixels, settings);
    double sum = 0;
    EXPECT_NEAR(diameterOf(renderer.readImage(), sum), 6.4, 0.4);
    EXPECT_NEAR(sum, 1, 0.1);
}

}  // namespace
}  // namespace conelight::test
