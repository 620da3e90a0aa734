// SPDX-License-Identifier: MIT
// Glass in the path tracer: what it lets through, bends and absorbs, against closed forms. The GL modes are
// compared with it in tests/image/glass_test.cpp.
#include <gtest/gtest.h>

#include <cmath>

#include "io/generated_scenes.h"
#include "io/generated_trial_parts.h"
#include "reference/path_tracer.h"

namespace conelight {
namespace {

using io::generated::add;
using io::generated::addPart;
using io::generated::box;
using io::generated::camera;
using io::generated::quad;
using io::generated::translation;

Material clearGlass(float thickness, float roughness = 0) {
    Material m = io::generated::glossy("glass", glm::vec3(1), roughness);
    m.transmission = 1;
    m.thickness = thickness;
    m.doubleSided = thickness == 0;
    return m;
}

Image traced(const Scene& scene, int size, int samples) {
    reference::PathTracerSettings settings;
    settings.samplesPerPixel = samples;
    return reference::PathTracer(scene).render(scene.cameras[0], size, size, settings).full;
}

glm::dvec3 meanOf(const Image& image) {
    glm::dvec3 sum(0);
    for (const glm::vec4& pixel : image.pixels) sum += glm::dvec3(pixel);
    return sum / static_cast<double>(image.pixels.size());
}

// In even light all glass shows the light it stands in: nothing is lost and nothing made.
TEST(Glass, IsInvisibleInEvenLight) {
    for (const float thickness : {0.0f, 1.0f})
        for (const float roughness : {0.0f, 0.3f, 0.7f}) {
            Scene scene;
            scene.sky = glm::vec3(1);
            addPart(scene, io::generated::sphere(0.5f, 64), "ball",
                    add(scene, clearGlass(thickness, roughness)));
            scene.cameras.push_back(camera("front", {0, 0, 3}, {0, 0, 0}, 15));
            const double mean = meanOf(traced(scene, 12, 256)).g;
            EXPECT_LT(mean, 1.02) << thickness << " " << roughness;
            EXPECT_GT(mean, 0.98) << thickness << " " << roughness;
        }
}

// A pane before an even wall: what Schlick's 4 % leave, tinted.
TEST(Glass, PanesTint) {
    Scene scene;
    addPart(scene, quad({-5, -5, -1}, {10, 0, 0}, {0, 10, 0}), "wall",
            add(scene, io::generated::emitter("wall", glm::vec3(2))));
    Material tinted = clearGlass(0);
    tinted.baseColor = {0.9f, 0.5f, 0.1f, 1};
    addPart(scene, quad({-5, -5, 0}, {10, 0, 0}, {0, 10, 0}), "pane", add(scene, tinted));
    scene.cameras.push_back(camera("front", {0, 0, 2}, {0, 0, 0}, 4));
    const glm::dvec3 mean = meanOf(traced(scene, 4, 1024));
    EXPECT_NEAR(mean.r, 2 * 0.96 * 0.9, 0.03);
    EXPECT_NEAR(mean.g, 2 * 0.96 * 0.5, 0.03);
    EXPECT_NEAR(mean.b, 2 * 0.96 * 0.1, 0.03);
}

// Through a block: two sides, and what its depth absorbs.
TEST(Glass, SolidsAbsorb) {
    Scene scene;
    addPart(scene, quad({-5, -5, -2}, {10, 0, 0}, {0, 10, 0}), "wall",
            add(scene, io::generated::emitter("wall", glm::vec3(2))));
    Material green = clearGlass(1);
    green.attenuationColor = {0.25f, 0.8f, 0.5f};
    green.attenuationDistance = 0.5f;
    addPart(scene, box({{-4, -4, -1}, {4, 4, 0}}), "block", add(scene, green));
    scene.cameras.push_back(camera("front", {0, 0, 2}, {0, 0, 0}, 4));
    const glm::dvec3 mean = meanOf(traced(scene, 4, 1024));
    // Light that is reflected within comes out of the front after three ways: a hundredth.
    const double sides = 0.96 * 0.96;
    EXPECT_NEAR(mean.r, 2 * sides * 0.25 * 0.25, 0.01);
    EXPECT_NEAR(mean.g, 2 * sides * 0.8 * 0.8, 0.03);
    EXPECT_NEAR(mean.b, 2 * sides * 0.5 * 0.5, 0.02);
}

// A tilted slab shifts what is behind it by d sin(a) (1 - cos(a) / sqrt(n^2 - sin^2 a)).
TEST(Glass, SlabsShiftWhatIsBehind) {
    const float angle = 0.8f, depth = 1.0f, ior = 1.6f;
    const float sine = std::sin(angle), cosine = std::cos(angle);
    const float shift = depth * sine * (1 - cosine / std::sqrt(ior * ior - sine * sine));
    const auto lightBeyond = [&](float edge) {
        Scene scene;
        // Bright to the left of the edge.
        addPart(scene, quad({edge - 4, -5, -3}, {4, 0, 0}, {0, 10, 0}), "wall",
                add(scene, io::generated::emitter("wall", glm::vec3(1))));
        Material glass = clearGlass(1);
        glass.ior = ior;
        addPart(scene, box({{-6, -6, -0.5f * depth}, {6, 6, 0.5f * depth}}), "slab", add(scene, glass))
            .worldFromObject = io::generated::turnAboutY(angle);
        scene.cameras.push_back(camera("front", {0, 0, 8}, {0, 0, 0}, 0.2f));
        return meanOf(traced(scene, 2, 512)).g;
    };
    // The slab's normal leans to the right (+x): within, light to the eye runs steeper, and comes from the left.
    EXPECT_GT(lightBeyond(-shift + 0.06f), 0.8);
    EXPECT_LT(lightBeyond(-shift - 0.06f), 0.2);
}

// Lamps without extent shine through glass: a tinted pane tints their light, and casts no black shadow.
TEST(Glass, LampsShineThroughPanes) {
    const auto lit = [](bool pane) {
        Scene scene;
        addPart(scene, quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}), "floor",
                add(scene, io::generated::matte("floor", glm::vec3(0.5f))));
        Material tinted = clearGlass(0);
        tinted.baseColor = {0.2f, 0.9f, 0.4f, 1};
        if (pane) addPart(scene, quad({-5, 1, 5}, {10, 0, 0}, {0, 0, -10}), "pane", add(scene, tinted));
        scene.lights.push_back(io::generated::pointLight("lamp", {0, 2, 0}, glm::vec3(5)));
        scene.cameras.push_back(camera("front", {0, 0.5f, 1}, {0, 0, 0}, 4));
        reference::PathTracerSettings settings;
        settings.samplesPerPixel = 256;
        return meanOf(reference::PathTracer(scene).render(scene.cameras[0], 4, 4, settings).direct);
    };
    const glm::dvec3 without = lit(false), with = lit(true);
    EXPECT_NEAR(with.r / without.r, 0.96 * 0.2, 0.01);
    EXPECT_NEAR(with.g / without.g, 0.96 * 0.9, 0.02);
    EXPECT_NEAR(with.b / without.b, 0.96 * 0.4, 0.01);
}

TEST(Glass, IsRefusedOutOfRange) {
    Scene scene;
    addPart(scene, quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), "pane", add(scene, clearGlass(1)));
    scene.validate();
    const auto refused = [&](auto change) {
        Scene changed = scene;
        change(changed.materials[0]);
        EXPECT_THROW(changed.validate(), std::exception);
    };
    refused([](Material& m) { m.transmission = 1.5f; });
    refused([](Material& m) { m.thickness = -1; });
    refused([](Material& m) { m.attenuationColor.g = 0; });
    refused([](Material& m) { m.attenuationDistance = -1; });
}

}  // namespace
}  // namespace conelight
