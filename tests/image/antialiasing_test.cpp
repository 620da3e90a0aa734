// SPDX-License-Identifier: MIT
// Stills as the mean of views at offsets within a pixel: edges against a path tracer that averages over the
// pixel's area, and what must not change.
#include <algorithm>
#include <cmath>
#include <set>

#include "io/generated.h"
#include "support/soft_shadow_rig.h"
#include "support/traced_rig.h"
#include "view/camera.h"

namespace conelight::test {
namespace {

using AntialiasingTest = TracedModeTest;

reference::PathTracedPicture boxFilteredTruth(const Scene& scene, int samples) {
    reference::PathTracerSettings settings;
    settings.samplesPerPixel = samples;
    settings.filter = reference::PixelFilter::Box;
    return reference::PathTracer(scene).render(scene.cameras.at(0), kTracedPixels, kTracedPixels, settings);
}

// Pixels beside which another surface is seen, or the background.
std::vector<bool> edgesOf(Renderer& renderer, const Scene& scene, Settings settings) {
    settings.component = Component::Normal;
    renderer.render(scene.cameras.at(0), kTracedPixels, kTracedPixels, settings);
    const Image normals = renderer.readImage();
    settings.component = Component::Depth;
    renderer.render(scene.cameras.at(0), kTracedPixels, kTracedPixels, settings);
    const Image depths = renderer.readImage();
    std::vector<bool> edges(normals.pixels.size());
    for (int y = 1; y + 1 < kTracedPixels; ++y)
        for (int x = 1; x + 1 < kTracedPixels; ++x) {
            const auto at = static_cast<std::size_t>(y * kTracedPixels + x);
            for (const int step : {-1, 1, -kTracedPixels, kTracedPixels}) {
                const std::size_t other = at + static_cast<std::size_t>(static_cast<std::ptrdiff_t>(step));
                const float depth = depths.pixels[at].x, there = depths.pixels[other].x;
                edges[at] = edges[at] || std::abs(depth - there) > 0.1f * std::max(depth, there) ||
                            glm::distance(normals.pixels[at], normals.pixels[other]) > 0.3f;
            }
        }
    return edges;
}

double errorAt(const std::vector<bool>& where, const Image& image, const Image& truth) {
    double squares = 0, sum = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        if (!where[i]) continue;
        const glm::dvec3 difference(image.pixels[i] - truth.pixels[i]);
        squares += glm::dot(difference, difference) / 3;
        const glm::dvec3 mean(truth.pixels[i]);
        sum += (mean.r + mean.g + mean.b) / 3;
    }
    const auto count = static_cast<double>(std::count(where.begin(), where.end(), true));
    return std::sqrt(squares / count) / (sum / count);
}

TEST_F(AntialiasingTest, EdgesAreThoseOfTheWholePixel) {
    const Scene scene = io::generateScene("cornell-point");
    const reference::PathTracedPicture truth = boxFilteredTruth(scene, 1024);
    Settings settings = tracedSettings(Quality::Interactive);
    settings.voxels.size = 64;
    settings.light.shadowSize = 1024;
    Renderer renderer;
    renderer.setScene(scene);
    const std::vector<bool> edges = edgesOf(renderer, scene, settings);
    ASSERT_GT(std::count(edges.begin(), edges.end(), true), 100);
    const double stairs = errorAt(edges, draw(renderer, scene, settings), truth.full);
    settings.image.antialiasing = 16;
    const double smooth = errorAt(edges, draw(renderer, scene, settings), truth.full);
    EXPECT_LT(smooth, 0.5 * stairs) << "with " << smooth << ", without " << stairs;
}

// Every mode of direct light: the same views, whatever is gathered.
TEST_F(AntialiasingTest, DirectLightAndTheBackgroundAreAveragedInEveryMode) {
    Scene scene = io::generateScene("cornell-point");
    scene.sky = glm::vec3(0.5f);
    const reference::PathTracedPicture truth = boxFilteredTruth(scene, 128);
    for (const Mode mode : {Mode::Traced, Mode::Cones}) {
        Settings settings = tracedSettings(Quality::Draft, Component::Direct);
        settings.mode = mode;
        settings.light.shadowSize = 1024;
        Renderer renderer;
        renderer.setScene(scene);
        const std::vector<bool> edges = edgesOf(renderer, scene, settings);
        const double stairs = errorAt(edges, draw(renderer, scene, settings), truth.direct);
        settings.image.antialiasing = 16;
        const double smooth = errorAt(edges, draw(renderer, scene, settings), truth.direct);
        EXPECT_LT(smooth, 0.4 * stairs) << mode.name() << ": with " << smooth << ", without " << stairs;
    }
}

// A slat across a panel lamp: its half shadow is as smooth as that of four times the sample points, since views turn the
// lamp. So it is in a window at rest.
TEST_F(AntialiasingTest, HalfShadowsHaveTheSamplePointsOfAllViews) {
    Scene scene = plateScene(false);
    addInstance(scene, quadMesh({0.3f, 0.75f, 0.9f}, {0.4f, 0, -1.8f}, {0.1f, 0, 0.02f}),
                diffuseMaterial(glm::vec3(0.5f)));
    scene.lights = {lampOf(0.6f)};
    const Image truth = boxFilteredTruth(scene, 1024).direct;
    Settings settings = tracedSettings(Quality::Draft, Component::Direct);
    Renderer renderer;
    renderer.setScene(scene);
    const double ofCenters = relRmse(draw(renderer, scene, settings), truth);
    settings.image.antialiasing = 16;
    const double ofStill = relRmse(draw(renderer, scene, settings), truth);
    EXPECT_LT(ofStill, 0.6 * ofCenters) << "one view " << ofCenters;
    settings.traced.budgeted = true;
    settings.image.temporal = Toggle::On;
    for (int frame = 0; frame < 48; ++frame) {
        renderer.setLightHeld(frame >= 16);
        draw(renderer, scene, settings);
    }
    EXPECT_LT(relRmse(renderer.readImage(), truth), 0.7 * ofCenters) << "one view " << ofCenters;
}

TEST_F(AntialiasingTest, TheSameCallGivesTheSameBits) {
    for (const char* const name : {"cornell-point", "cornell"}) {
        const Scene scene = io::generateScene(name);
        Settings settings = tracedSettings(Quality::Interactive);
        settings.image.antialiasing = 5;
        Renderer renderer;
        renderer.setScene(scene);
        const Image first = draw(renderer, scene, settings);
        EXPECT_EQ(first.pixels, draw(renderer, scene, settings).pixels) << name;
        EXPECT_EQ(first.pixels, draw(scene, settings).pixels) << name;
    }
}

TEST_F(AntialiasingTest, PicturesOfSurfacesStayAtPixelCenters) {
    const Scene scene = io::generateScene("cornell-point");
    Renderer renderer;
    renderer.setScene(scene);
    for (const Component component : {Component::Normal, Component::Depth, Component::Albedo}) {
        Settings settings = tracedSettings(Quality::Draft, component);
        const Image centers = draw(renderer, scene, settings);
        settings.image.antialiasing = 16;
        EXPECT_EQ(centers.pixels, draw(renderer, scene, settings).pixels);
    }
}

TEST_F(AntialiasingTest, PartsAddUp) {
    const Scene scene = io::generateScene("glossy");
    Settings settings = tracedSettings(Quality::Interactive);
    settings.image.antialiasing = 4;
    Renderer renderer;
    renderer.setScene(scene);
    const Image full = draw(renderer, scene, settings);
    Image sum = full;
    for (glm::vec4& pixel : sum.pixels) pixel = glm::vec4(0);
    for (const Component part : {Component::Direct, Component::Diffuse, Component::Specular}) {
        settings.component = part;
        const Image image = draw(renderer, scene, settings);
        for (std::size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += image.pixels[i];
    }
    EXPECT_LT(relRmse(sum, full), 1e-4);
}

// Neither the pixel's left nor its upper part counts more; no two views share a row or a column.
TEST(AntialiasingViewsTest, ViewsSpreadOverThePixel) {
    for (int count = 2; count <= 64; ++count) {
        glm::dvec2 sum(0);
        std::set<int> columns, rows;
        for (int i = 0; i < count; ++i) {
            const glm::dvec2 offset = view::pixelPart(i, count).offset;
            EXPECT_LT(std::max(std::abs(offset.x), std::abs(offset.y)), 0.5);
            sum += offset;
            columns.insert(static_cast<int>(std::floor((offset.x + 0.5) * count)));
            rows.insert(static_cast<int>(std::floor((offset.y + 0.5) * count)));
        }
        EXPECT_LT(glm::length(sum), 1e-9) << count;
        EXPECT_EQ(columns.size(), static_cast<std::size_t>(count));
        EXPECT_EQ(rows.size(), static_cast<std::size_t>(count)) << count;
    }
}

}  // namespace
}  // namespace conelight::test
