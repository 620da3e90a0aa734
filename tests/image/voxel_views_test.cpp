// SPDX-License-Identifier: MIT
// Views of voxels, by pixels of scenes whose answer is known: every level, shape and kind of data, alone and
// among the objects, and what is kept of them from frame to frame.
#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "conelight/thesis/settings.h"
#include "support/views_rig.h"

namespace conelight::test {
namespace {

constexpr int kPixels = kViewPixels;

using VoxelViewsTest = ViewsTest;

// The cube is as large in voxels as it is, to about a voxel, at every level; and has its colour and normals.
TEST_F(VoxelViewsTest, VoxelsShowTheCubeAtEveryLevel) {
    const Scene scene = redCube();
    const double truth = covered(draw(scene, viewSettings(Mode::Phong, Component::Albedo)));
    for (const Mode mode : {Mode::Traced, Mode::Cones}) {
        Settings settings = viewSettings(mode, Component::Voxels);
        settings.view.voxelShape = VoxelShape::Cubes;
        settings.view.voxelData = VoxelData::Albedo;
        for (int level = 0; level <= 3; ++level) {
            settings.view.voxelLevel = {false, static_cast<float>(level)};
            const Image image = draw(scene, settings);
            // 32 voxels are 1.06 m: cubes of 2^level stick out by less than one on each side.
            const double edge = 1 + 2 * 0.033 * (1 << level);
            EXPECT_GE(covered(image), 0.97 * truth) << level;
            EXPECT_LE(covered(image), 1.05 * truth * edge * edge) << level;
            EXPECT_NEAR(colorAt(image, 32, 32).x, 0.8f, 0.01f) << level;
            EXPECT_NEAR(colorAt(image, 32, 32).y, 0.1f, 0.01f) << level;
        }
        settings.view.voxelLevel = {};
        settings.view.voxelData = VoxelData::Normal;
        EXPECT_NEAR(colorAt(draw(scene, settings), 32, 32).z, 1.0f, 0.02f);  // +z
        settings.view.voxelData = VoxelData::Coverage;
        EXPECT_NEAR(colorAt(draw(scene, settings), 32, 32).x, 1.0f, 0.05f);
        settings.view.voxelData = VoxelData::Level;
        EXPECT_EQ(colorAt(draw(scene, settings), 32, 32), glm::vec3(0, 0, 1));  // level 0 is blue
    }
}

TEST_F(VoxelViewsTest, EveryShapeAndKindOfDataDraws) {
    const Scene scene = redCube();
    const double truth = covered(draw(scene, viewSettings(Mode::Phong, Component::Albedo)));
    for (const Mode mode : {Mode::Traced, Mode::Cones, thesis::kMode}) {
        Settings settings = viewSettings(mode, Component::Voxels);
        draw(scene, settings);
        for (const VoxelShape shape : {VoxelShape::Auto, VoxelShape::Cubes, VoxelShape::Edges,
                                       VoxelShape::Faces, VoxelShape::Volume, VoxelShape::Surfaces})
            for (int data = 0; data <= static_cast<int>(VoxelData::Level); ++data) {
                settings.view.voxelShape = shape;
                settings.view.voxelData = static_cast<VoxelData>(data);
                const Image image = again(scene, settings);
                SCOPED_TRACE(testing::Message() << "mode " << mode.name() << " shape "
                                                << static_cast<int>(shape) << " data " << data);
                const double part = covered(image);
                EXPECT_GT(part, shape == VoxelShape::Edges ? 0.02 : 0.15);
                EXPECT_LT(part, 1.3 * truth);  // bricks stick out by up to four voxels
                for (const glm::vec4& p : image.pixels)
                    for (int c = 0; c < 4; ++c) ASSERT_TRUE(std::isfinite(p[c]));
            }
    }
}

// A lamp that is a light itself: rays count it as that, and its voxels were black once.
TEST_F(VoxelViewsTest, LampsGlow) {
    const glm::vec3 emission(3, 2, 1);
    Scene scene = redCube();
    for (Material& material : scene.materials) material.emission = emission;
    for (const int level : {0, 2}) {
        Settings settings = viewSettings(Mode::Traced, Component::Voxels);
        settings.traced.bounces = 0;
        settings.view.voxelLevel.value = static_cast<float>(level);
        const Image image = draw(scene, settings);
        const glm::vec3 shown = colorAt(image, kPixels / 2, kPixels / 2);
        // On top of its own light what it reflects of the lamp of the scene: at most 0.8 * 10 / 2.5^2 / pi.
        for (int c = 0; c < 3; ++c) {
            EXPECT_GT(shown[c], 0.95f * emission[c]) << "level " << level;
            EXPECT_LT(shown[c], 1.05f * emission[c] + 0.45f) << "level " << level;
        }
    }
}

// Age is the number of updates; the cache's irradiance alone is dark where there is nothing to reflect.
TEST_F(VoxelViewsTest, AgeCountsUpdates) {
    const Scene scene = closedBox(diffuseMaterial(glm::vec3(0.5f), glm::vec3(1)));
    Settings settings = viewSettings(Mode::Traced, Component::Voxels);
    settings.view.voxelData = VoxelData::Age;
    settings.traced.cacheUpdates = 1;
    const glm::vec3 young = colorAt(draw(scene, settings), 32, 32);  // log2(2) / 8: much blue
    settings.traced.cacheUpdates = 255;
    settings.traced.cacheRays = 1;
    settings.voxels.size = 16;
    const glm::vec3 old = colorAt(draw(scene, settings), 32, 32);  // log2(256) / 8: red
    EXPECT_GT(young.z, 0.9f);
    EXPECT_LT(young.x, 0.1f);
    EXPECT_NEAR(old.x, 1.0f, 0.05f);
    EXPECT_NEAR(old.z, 0.0f, 0.05f);
    settings.view.voxelData = VoxelData::Irradiance;  // e / (1 - rho) arrives from everywhere
    settings.light.emissiveQuads = false;
    EXPECT_NEAR(colorAt(draw(scene, settings), 32, 32).x, 2.0f, 0.1f);
}

// A cone of the aperture has the diameter of a voxel at one distance, and of two at twice that.
TEST_F(VoxelViewsTest, TheLevelGrowsWithTheDistance) {
    Scene scene;
    addInstance(scene, quadMesh({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}), diffuseMaterial(glm::vec3(0.5f)));
    Camera camera;
    camera.eye = {0, 0.8f, 3.9f};
    camera.target = {0, 0.3f, 0};
    camera.fovY = 1.2f;
    scene.cameras.push_back(camera);
    for (const Mode mode : {Mode::Traced, Mode::Cones, thesis::kMode})
        for (const VoxelShape shape : {VoxelShape::Cubes, VoxelShape::Surfaces}) {
            Settings settings = viewSettings(mode, Component::Voxels);
            settings.view.voxelShape = shape;
            settings.view.voxelData = VoxelData::Level;
            settings.view.voxelAperture = 0.4f;
            const Image image = draw(scene, settings);
            // From blue (low) below to redder or greener ones above: green never falls on the way up.
            float last = -1;
            int levels = 0;
            for (int y = kPixels - 1; y > 0 && image.pixels[static_cast<std::size_t>(y * kPixels + 32)].a > 0;
                 --y) {
                const glm::vec3 color = colorAt(image, 32, y);
                const float order = color.y - color.z + 2 * color.x;
                EXPECT_GE(order, last - 1e-4f) << y;
                levels += order > last + 1e-4f ? 1 : 0;
                last = std::max(last, order);
            }
            EXPECT_GE(levels, 3) << mode.name() << " " << static_cast<int>(shape);
        }
}

// Cubes stick out of the surface by up to a voxel: among the objects some are in front and some are not; what
// is nearer than both stays.
TEST_F(VoxelViewsTest, VoxelsStandAmongTheObjects) {
    Scene scene = redCube();
    // A plate in front of the cube's left half that is not voxelized.
    const std::size_t plate =
        addInstance(scene, quadMesh({-1, -1, 1}, {1, 0, 0}, {0, 2, 0}), diffuseMaterial({0, 0, 1}));
    scene.instances[plate].voxelized = false;
    for (const Mode mode : {Mode::Traced, Mode::Cones, thesis::kMode}) {
        Settings settings = viewSettings(mode, Component::Albedo);
        const Image picture = draw(scene, settings);
        settings.view.voxels = true;
        settings.view.voxelShape = VoxelShape::Cubes;
        settings.view.voxelData = VoxelData::Level;
        const Image among = draw(scene, settings);
        EXPECT_EQ(colorAt(among, 16, 32), colorAt(picture, 16, 32)) << mode.name();  // the plate is in front
        EXPECT_EQ(colorAt(picture, 16, 32), glm::vec3(0, 0, 1));
        EXPECT_GT(differing(among, picture), 0.05) << mode.name();
    }
}

// From outside a closed room shows its front wall, or what is behind that wall.
TEST_F(VoxelViewsTest, AnEyeOutsideLooksIntoAClosedRoom) {
    Scene room = closedBox(diffuseMaterial({0.8f, 0.1f, 0.05f}));
    const int back = room.instances[4].material;  // z = -1
    room.materials[static_cast<std::size_t>(back)].baseColor = {0.05f, 0.1f, 0.8f, 1};
    room.cameras.front() = redCube().cameras.front();
    room.cameras.front().eye.z = 6;
    room.lights = redCube().lights;
    room.lights[0].position = {0.1f, 0.1f, 0};
    for (const Mode mode : {Mode::Traced, Mode::Cones, thesis::kMode}) {
        Settings settings = viewSettings(mode, Component::Voxels);
        settings.view.voxelShape = VoxelShape::Cubes;
        for (const int level : {0, 1}) {
            settings.view.voxelLevel = {false, static_cast<float>(level)};
            settings.view.voxelsInside = false;
            const glm::vec3 front = colorAt(draw(room, settings), 32, 32);
            settings.view.voxelsInside = true;
            const glm::vec3 inside = colorAt(again(room, settings), 32, 32);
            EXPECT_LE(front.b, front.r) << mode.name() << " level " << level;
            EXPECT_GT(inside.b, 2 * inside.r) << mode.name() << " level " << level;
        }
    }
}

// The coarser levels and what is empty are kept from frame to frame: not when the scene or its light changes.
TEST_F(VoxelViewsTest, WhatIsKeptForVoxelsFollowsTheScene) {
    for (const Mode mode : {Mode::Traced, Mode::Cones, thesis::kMode})
        for (const int level : {0, 2}) {
            SCOPED_TRACE(testing::Message() << "mode " << mode.name() << " level " << level);
            Scene scene = redCube();
            Settings settings = viewSettings(mode, Component::Voxels);
            settings.traced.bounces = 0;
            settings.view.voxelShape = VoxelShape::Cubes;
            settings.view.voxelLevel = {false, static_cast<float>(level)};
            Renderer kept;
            kept.setScene(scene);
            const auto drawWith = [&](Renderer& renderer) {
                renderer.render(scene.cameras[0], kPixels, kPixels, settings);
                return renderer.readImage();
            };
            const auto drawAnew = [&] {
                Renderer fresh;
                fresh.setScene(scene);
                return drawWith(fresh);
            };
            const Image before = drawWith(kept);
            // The side towards the camera goes in, within the bounds: the grid stays.
            scene.instances.back().worldFromObject = glm::translate(glm::mat4(1), glm::vec3(0, 0, -0.4f));
            kept.setInstance(scene.instances.size() - 1, scene.instances.back());
            const Image moved = drawWith(kept);
            EXPECT_GT(differing(before, moved), 0.01);
            EXPECT_LT(differing(moved, drawAnew()), 0.005);
            scene.lights[0].intensity *= 3.0f;
            kept.setLight(0, scene.lights[0]);
            const Image lit = drawWith(kept);
            EXPECT_GT(differing(moved, lit), 0.01);
            EXPECT_LT(differing(lit, drawAnew()), 0.005);
        }
}

// Edges leave the cubes open, and the ray meets the same cubes as a volume does.
TEST_F(VoxelViewsTest, EdgesAreOpenAndVolumesThin) {
    Scene scene = redCube();
    scene.cameras[0].fovY = 0.25f;  // cubes of 11 pixels: their edges are 1.5 wide
    Settings settings = viewSettings(Mode::Traced, Component::Voxels);
    settings.voxels.size = 8;
    settings.view.voxelShape = VoxelShape::Cubes;
    const double cubes = covered(draw(scene, settings));
    settings.view.voxelShape = VoxelShape::Edges;
    EXPECT_LT(covered(draw(scene, settings)), 0.7 * cubes);
    settings.view.voxelShape = VoxelShape::Volume;
    settings.view.voxelDensity = 1;
    const double dense = covered(draw(scene, settings));
    settings.view.voxelDensity = 0.02f;
    const double thin = covered(draw(scene, settings));
    EXPECT_GT(dense, 0.8 * cubes);
    EXPECT_LT(thin, 0.5 * dense);
    EXPECT_GT(thin, 0.01);
}

}  // namespace
}  // namespace conelight::test
