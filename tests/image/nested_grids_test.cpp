// SPDX-License-Identifier: MIT
// Pictures of mode `traced` with nested grids: light is neither lost nor found where rays and surfaces cross from one
// level into the next; a room keeps its light on a plain of any size; the eye may move.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "io/generated.h"
#include "scene/gpu_scene.h"
#include "support/traced_rig.h"
#include "voxels/surface_voxels.h"

namespace conelight::test {
namespace {

using NestedGridsTest = TracedModeTest;

Settings nestedSettings(Quality quality, int levels) {
    Settings settings = tracedSettings(quality, Component::Indirect);
    settings.voxels.levels = levels;
    return settings;
}

// Whether the last picture made voxels.
bool voxelized(const Renderer& renderer) {
    const std::vector<PassStats>& passes = renderer.stats().passes;
    return std::any_of(passes.begin(), passes.end(),
                       [](const PassStats& pass) { return pass.name.find("voxelize") != std::string::npos; });
}

Scene roomOnAPlain(int edge) { return io::generateScene("plain?size=" + std::to_string(edge)); }

}  // namespace

// As TracedModeTest.FurnaceIsEvenAtEveryQuality: every ray ends at a wall, through three levels.
TEST_F(NestedGridsTest, FurnaceIsEvenThroughAllLevels) {
    Scene scene = closedBox(diffuseMaterial(glm::vec3(0.5f), glm::vec3(1)));
    // Off the middle: borders of levels cross all walls, and corners of the box.
    scene.cameras.at(0).eye += glm::vec3(0.31f, -0.2f, 0.13f);
    for (const Quality quality : {Quality::Draft, Quality::Interactive}) {
        Settings settings = tracedSettings(quality);
        settings.voxels.levels = 3;
        settings.light.emissiveQuads = false;
        const Image image = draw(scene, settings);
        EXPECT_NEAR(meanOf(image), 2.0, 0.006) << static_cast<int>(quality);
        double square = 0;
        for (const glm::vec4& p : image.pixels) square += std::pow(static_cast<double>(p.x) / 2 - 1, 2);
        EXPECT_LT(std::sqrt(square / (kTracedPixels * kTracedPixels)), 0.03) << static_cast<int>(quality);
    }
}

TEST_F(NestedGridsTest, ARoomKeepsItsLightOnAPlain) {
    const Image alone = draw(roomOnAPlain(0), nestedSettings(Quality::Interactive, 1));
    const Scene far = roomOnAPlain(600);
    // As many levels as it takes.
    const Image nested = draw(far, nestedSettings(Quality::Interactive, 0));
    EXPECT_NEAR(meanOf(nested) / meanOf(alone), 1.0, 0.04);
    EXPECT_LT(relRmse(nested, alone), 0.12);
    // In one grid its voxels are 20 m.
    EXPECT_LT(meanOf(draw(far, nestedSettings(Quality::Interactive, 1))) / meanOf(alone), 0.5);
}

// Whose voxels are small in one grid.
TEST_F(NestedGridsTest, ASmallSceneChoosesOneGrid) {
    Scene scene = closedBox(diffuseMaterial(glm::vec3(0.5f), glm::vec3(1)));
    EXPECT_EQ(draw(scene, nestedSettings(Quality::Draft, 0)).pixels,
              draw(scene, nestedSettings(Quality::Draft, 1)).pixels);
}

// A finished picture has the same bits wherever the eye was before.
TEST_F(NestedGridsTest, TheEyeMayMove) {
    Scene scene = roomOnAPlain(100);
    const Settings settings = nestedSettings(Quality::Interactive, 4);
    const Image first = draw(scene, settings);
    Renderer renderer;
    renderer.setScene(scene);
    EXPECT_EQ(draw(renderer, scene, settings).pixels, first.pixels);
    Scene elsewhere = scene;
    elsewhere.cameras.at(0).eye = {20, 1.7f, 9};
    EXPECT_GT(meanOf(draw(renderer, elsewhere, settings)), 0);
    EXPECT_EQ(draw(renderer, scene, settings).pixels, first.pixels);
    // One level again.
    Settings one = settings;
    one.voxels.levels = 1;
    EXPECT_EQ(draw(renderer, scene, one).pixels, draw(scene, one).pixels);
}

// Cameras at other places find the voxels of one anchor as they are, and draw what they would have drawn first.
TEST_F(NestedGridsTest, AnAnchorKeepsTheVoxels) {
    const Scene scene = roomOnAPlain(24);
    Scene elsewhere = scene;
    elsewhere.cameras.at(0).eye += glm::vec3(2.5f, 0, -1);
    Settings settings = nestedSettings(Quality::Draft, 3);
    settings.traced.cacheUpdates = 2;
    settings.traced.passes = 1;
    Renderer renderer;
    renderer.setProfiling(true, false);
    renderer.setScene(scene);
    draw(renderer, scene, settings);
    draw(renderer, elsewhere, settings);
    EXPECT_TRUE(voxelized(renderer));
    settings.voxels.anchor = VoxelAnchor::at({0, 1.5f, 0});
    draw(renderer, scene, settings);
    EXPECT_TRUE(voxelized(renderer));
    const Image second = draw(renderer, elsewhere, settings);
    EXPECT_FALSE(voxelized(renderer));
    EXPECT_EQ(second.pixels, draw(elsewhere, settings).pixels);
    // An anchor that stays in its cell changes nothing.
    settings.voxels.anchor = VoxelAnchor::at({0.01f, 1.5f, 0});
    EXPECT_EQ(draw(renderer, elsewhere, settings).pixels, second.pixels);
    EXPECT_FALSE(voxelized(renderer));
}

// An eye far away sees into a room through its door: its light is that of the room alone where the levels lie round it.
TEST_F(NestedGridsTest, LightIsFineAtTheAnchor) {
    const auto seen = [](int edge) {
        Scene scene = roomOnAPlain(edge);
        scene.cameras.at(0) = {.eye = {30, 1.5f, 2.5f}, .target = {4, 1.2f, 2.5f}, .fovY = 0.07f};
        return scene;
    };
    const Image alone = draw(seen(0), nestedSettings(Quality::Interactive, 1));
    Settings settings = nestedSettings(Quality::Interactive, 0);
    const Image byEye = draw(seen(600), settings);
    settings.voxels.anchor = VoxelAnchor::at({0, 1.5f, 0});
    const Image anchored = draw(seen(600), settings);
    RecordProperty("anchored", std::to_string(relRmse(anchored, alone)));
    RecordProperty("by_eye", std::to_string(relRmse(byEye, alone)));
    EXPECT_LT(relRmse(anchored, alone), 0.1);
    EXPECT_GT(relRmse(byEye, alone), 0.4);
}

// While it moves, light goes from the levels before to those after: no picture is dark.
TEST_F(NestedGridsTest, LightIsReprojectedWhileTheEyeMoves) {
    Scene scene = roomOnAPlain(100);
    Settings settings = nestedSettings(Quality::Interactive, 4);
    settings.traced.budgeted = true;
    Renderer renderer;
    renderer.setScene(scene);
    Image before;
    for (int i = 0; i < 12; ++i) before = draw(renderer, scene, settings);
    // Past the middle of a cell of every level but the coarsest.
    scene.cameras.at(0).eye = {1.5f, 1.7f, 3.4f};
    const double moved = meanOf(draw(renderer, scene, settings));
    Renderer fresh;
    fresh.setScene(scene);
    Image settled;
    for (int i = 0; i < 12; ++i) settled = draw(fresh, scene, settings);
    EXPECT_NEAR(moved / meanOf(settled), 1.0, 0.15);
}

// A walk in motion, over several places of the levels: no frame jumps, each is near the settled picture of its place, and
// the same walk gives the same bits.
TEST_F(NestedGridsTest, NothingPopsOnAWalk) {
    const Scene scene = roomOnAPlain(24);
    Settings settings = nestedSettings(Quality::Draft, 3);
    settings.voxels.size = 48;
    settings.traced.budgeted = true;
    constexpr int kStands = 24, kSteps = 24;
    const auto at = [&](int step) {
        Scene here = scene;
        here.cameras.at(0).eye.x += 0.1f * static_cast<float>(step);
        return here;
    };
    const auto walk = [&] {
        std::vector<Image> frames;
        Renderer renderer;
        renderer.setScene(scene);
        for (int i = 0; i < kStands; ++i) frames.push_back(draw(renderer, scene, settings));
        for (int i = 1; i <= kSteps; ++i) frames.push_back(draw(renderer, at(i), settings));
        return frames;
    };
    const std::vector<Image> frames = walk(), again = walk();
    const std::size_t first = kStands;
    for (std::size_t i = first; i < frames.size(); ++i) {
        EXPECT_NEAR(meanOf(frames[i]) / meanOf(frames[i - 1]), 1.0, 0.015) << i;
        EXPECT_LT(relRmse(frames[i], frames[i - 1]), 0.1) << i;
        EXPECT_EQ(frames[i].pixels, again[i].pixels) << i;
    }
    for (const int step : {kSteps / 2, kSteps}) {
        Renderer fresh;
        fresh.setScene(scene);
        Image settled;
        for (int i = 0; i < kStands; ++i) settled = draw(fresh, at(step), settings);
        const Image& walked = frames[static_cast<std::size_t>(kStands + step - 1)];
        EXPECT_NEAR(meanOf(walked) / meanOf(settled), 1.0, 0.03) << step;
        EXPECT_LT(relRmse(walked, settled), 0.06) << step;
    }
    // Levels moved on the way.
    const scene::GpuScene gpu(scene);
    int moves = 0;
    for (int i = 1; i <= kSteps; ++i)
        moves += voxels::SurfaceVoxels::gridAround(gpu, settings.voxels, at(i).cameras.at(0).eye) ==
                         voxels::SurfaceVoxels::gridAround(gpu, settings.voxels, at(i - 1).cameras.at(0).eye)
                     ? 0
                     : 1;
    EXPECT_GE(moves, 2);
}

}  // namespace conelight::test
