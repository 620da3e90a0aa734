// SPDX-License-Identifier: MIT
// Pictures of mode hybrid: what does not move shows its bake; what moves colours and shades it, and leaves no trace
// behind it; nothing is baked or gathered twice.
#include <algorithm>
#include <cmath>
#include <memory>

#include "conelight/renderer.h"
#include "io/generated.h"
#include "reference/path_tracer.h"
#include "reference/radiosity.h"
#include "support/gl_fixture.h"
#include "support/traced_rig.h"
#include "support/truth_rig.h"

namespace conelight::test {
namespace {

constexpr int kPixels = kTracedPixels;

Settings smallSettings(Mode mode, Component component) {
    Settings settings;
    settings.mode = mode;
    settings.component = component;
    settings.voxels.size = 32;
    settings.light.shadowSize = 256;
    settings.light.areaSamples = 4;
    return settings;
}

reference::RadiositySettings quickBake() {
    reference::RadiositySettings settings;
    settings.patchRays = 128;
    settings.gatherRays = 128;
    settings.maxSubdivision = 1;
    return settings;
}

Scene withBake(Scene scene) {
    scene.baked = std::make_shared<const BakedLight>(reference::bakeIndirect(scene, quickBake()));
    return scene;
}

bool samePixels(const Image& a, const Image& b) { return a.pixels == b.pixels; }

class HybridModeTest : public GlTest {
  protected:
    static Image draw(Renderer& renderer, const Settings& settings) {
        renderer.render(renderer.scene().cameras.at(0), kPixels, kPixels, settings);
        return renderer.readImage();
    }
    static Image draw(const Scene& scene, const Settings& settings) {
        Renderer renderer;
        renderer.setScene(scene);
        return draw(renderer, settings);
    }
    // Whether the last picture had this pass.
    static bool hadPass(const Renderer& renderer, const std::string& name) {
        const std::vector<PassStats>& passes = renderer.stats().passes;
        return std::any_of(passes.begin(), passes.end(),
                           [&](const PassStats& pass) { return pass.name.find(name) != std::string::npos; });
    }
    static std::size_t indexOf(const Scene& scene, const std::string& name) {
        std::size_t i = 0;
        while (scene.instances.at(i).name != name) ++i;
        return i;
    }
};

// Walls are flat emitters: of e / (1 - a), which arrives, e comes straight from them. Half of the rest is reflected. Patches and halves err by less than 1 %.
TEST_F(HybridModeTest, FurnaceShowsTheGeometricSum) {
    const Scene scene = withBake(closedBox(diffuseMaterial(glm::vec3(0.5f), glm::vec3(1))));
    for (const glm::vec4& pixel : draw(scene, smallSettings(Mode::Hybrid, Component::Diffuse)).pixels)
        EXPECT_NEAR(pixel.g, 0.5, 0.005);
}

// The truth's noise is left out.
TEST_F(HybridModeTest, WhatDoesNotMoveIsAsTrueAsItsBake) {
    const Scene scene = withBake(io::generateScene("cornell"));
    reference::PathTracerSettings settings;
    settings.samplesPerPixel = 256;
    const reference::PathTracedPicture truth =
        reference::PathTracer(scene).render(scene.cameras.at(0), kPixels, kPixels, settings);
    const double hybrid = indirectError(draw(scene, smallSettings(Mode::Hybrid, Component::Indirect)), truth);
    const double cones = indirectError(draw(scene, smallSettings(Mode::Cones, Component::Indirect)), truth);
    EXPECT_LT(hybrid, 0.07);
    EXPECT_GT(cones, 5 * hybrid);
}

// The wall turns redder and darker; without the block it is as if that had never been there.
TEST_F(HybridModeTest, ABlockColoursAndShadesTheWallAndLeavesNoTrace) {
    const Settings settings = smallSettings(Mode::Hybrid, Component::Diffuse);
    const Scene scene = withBake(io::generateScene("cornell?block=1"));
    const std::size_t block = indexOf(scene, "moving block");
    Renderer renderer;
    renderer.setScene(scene);
    const Image with = draw(renderer, settings);
    Instance hidden = scene.instances[block];
    hidden.visible = false;
    renderer.setInstance(block, hidden);
    const Image without = draw(renderer, settings);
    EXPECT_TRUE(samePixels(without, draw(withBake(io::generateScene("cornell")), settings)));

    // Just left of the block (x 0.205 m) on the back wall, 0.45 m above the floor.
    const std::size_t beside = 25 * kPixels + 29;
    const glm::vec4 a = with.pixels[beside], b = without.pixels[beside];
    EXPECT_GT(a.r / a.g, 1.03f * b.r / b.g);
    EXPECT_LT(a.g, 0.97f * b.g);
    // Far from it, on the left wall, hardly anything changes.
    const std::size_t far = 24 * kPixels + 4;
    EXPECT_NEAR(with.pixels[far].r, without.pixels[far].r, 0.03f * without.pixels[far].r);
}

TEST_F(HybridModeTest, MovementTouchesNothingThatDoesNotMove) {
    const Settings settings = smallSettings(Mode::Hybrid, Component::Full);
    const Scene scene = withBake(io::generateScene("cornell?block=1&block_x=0.2"));
    const std::size_t block = indexOf(scene, "moving block");
    Renderer renderer;
    renderer.setProfiling(true, false);
    renderer.setScene(scene);
    draw(renderer, settings);
    EXPECT_TRUE(hadPass(renderer, "baked corrections"));
    Instance moved = scene.instances[block];
    moved.worldFromObject[3].x += 0.1f;
    renderer.setInstance(block, moved);
    const Image after = draw(renderer, settings);
    EXPECT_FALSE(hadPass(renderer, "baked corrections"));
    EXPECT_TRUE(hadPass(renderer, "bounce cones"));
    // The same bits as a renderer that has never seen it elsewhere.
    Scene there = scene;
    there.instances[block] = moved;
    EXPECT_TRUE(samePixels(after, draw(there, settings)));
}

// What was baked elsewhere gathers its light anew; the rest keeps its bake.
TEST_F(HybridModeTest, WhatIsMovedAllTheSameLosesItsBake) {
    const Settings settings = smallSettings(Mode::Hybrid, Component::Diffuse);
    const Scene scene = withBake(io::generateScene("cornell"));
    const std::size_t block = indexOf(scene, "short block");
    Renderer renderer;
    renderer.setProfiling(true, false);
    renderer.setScene(scene);
    draw(renderer, settings);
    EXPECT_FALSE(hadPass(renderer, "diffuse cones"));  // nothing moves
    Instance moved = scene.instances[block];
    moved.worldFromObject[3].x += 0.05f;
    renderer.setInstance(block, moved);
    for (const glm::vec4& pixel : draw(renderer, settings).pixels) EXPECT_TRUE(std::isfinite(pixel.r));
    EXPECT_TRUE(hadPass(renderer, "diffuse cones"));
    EXPECT_TRUE(hadPass(renderer, "baked light"));
}

TEST_F(HybridModeTest, WithoutBakedLightItIsModeCones) {
    const Scene scene = io::generateScene("cornell?block=1");
    EXPECT_TRUE(samePixels(draw(scene, smallSettings(Mode::Hybrid, Component::Full)),
                           draw(scene, smallSettings(Mode::Cones, Component::Full))));
}

// As a renderer that was given it with the scene.
TEST_F(HybridModeTest, BakedLightMayComeLater) {
    const Settings settings = smallSettings(Mode::Hybrid, Component::Full);
    const Scene scene = withBake(io::generateScene("cornell?block=1"));
    Scene bare = scene;
    bare.baked = nullptr;
    Renderer renderer;
    renderer.setScene(bare);
    draw(renderer, settings);
    renderer.setBakedLight(scene.baked);
    EXPECT_TRUE(samePixels(draw(renderer, settings), draw(scene, settings)));
}

}  // namespace
}  // namespace conelight::test
