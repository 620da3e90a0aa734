// SPDX-License-Identifier: MIT
// Shadow maps after a change: only maps that the change can touch are drawn. That the picture is the right
// one is the matter of tests/image/scene_changes_test.cpp.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "light/shadow_maps.h"
#include "scene/gpu_scene.h"
#include "support/gl_fixture.h"
#include "support/view_rig.h"

namespace conelight::test {
namespace {

struct ShadowUpdates : public GlTest {
    gl::Profiler profiler;
    LightSettings settings{.shadowSize = 128};

    int redrawn(light::ShadowMaps& maps, scene::GpuScene& scene) {
        scene.bind();
        maps.update(programs(), profiler, scene, settings);
        return maps.redrawn();
    }
};

TEST_F(ShadowUpdates, OnlyMapsThatTheChangeTouchesAreDrawn) {
    Scene scene;
    addInstance(scene, quadMesh({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}), {});
    addInstance(scene, quadMesh({-5, 6, 5}, {10, 0, 0}, {0, 0, -10}), {});  // keeps the bounds
    const auto card = addInstance(scene, quadMesh({-0.2f, -0.2f, 0}, {0.4f, 0, 0}, {0, 0.4f, 0}), {},
                                  glm::translate(glm::mat4(1), {3, 1, 0}));
    scene.lights.push_back({.position = {0, 1, 0}});  // six maps; the card is on its +x side
    scene.lights.push_back({.type = LightType::Spot, .position = {-4, 2, 0}});  // looks down at x = -4
    scene::GpuScene gpu(scene);
    light::ShadowMaps maps;
    EXPECT_EQ(redrawn(maps, gpu), 7);
    EXPECT_EQ(redrawn(maps, gpu), 0);

    // Within one side, then over to the opposite one: old and new side are drawn. Then under the spot.
    Instance moved = scene.instances[card];
    moved.worldFromObject = glm::translate(glm::mat4(1), {3, 1.3f, 0});
    gpu.setInstance(card, moved);
    EXPECT_EQ(redrawn(maps, gpu), 1);
    moved.worldFromObject = glm::translate(glm::mat4(1), {-2.2f, 3, 0});
    gpu.setInstance(card, moved);
    const int over = redrawn(maps, gpu);
    EXPECT_GE(over, 2);
    EXPECT_LE(over, 3);  // at most the upper side too
    moved.worldFromObject = glm::translate(glm::mat4(1), {-4, 1, 0});
    gpu.setInstance(card, moved);
    const int under = redrawn(maps, gpu);
    EXPECT_GE(under, 2);
    EXPECT_LE(under, 3);

    // Without a shadow: drawn once more without it, then moves cost nothing.
    moved.castsShadow = false;
    gpu.setInstance(card, moved);
    EXPECT_EQ(redrawn(maps, gpu), 2);
    moved.worldFromObject = glm::translate(glm::mat4(1), {3, 1, 0});
    gpu.setInstance(card, moved);
    EXPECT_EQ(redrawn(maps, gpu), 0);

    // A light that moves has its own maps drawn; one that changes colour none; another number of lights all.
    scene.lights[1].position.z = 0.5f;
    gpu.setLights(scene.lights);
    EXPECT_EQ(redrawn(maps, gpu), 1);
    scene.lights[0].intensity = glm::vec3(3);
    gpu.setLights(scene.lights);
    EXPECT_EQ(redrawn(maps, gpu), 0);
    scene.lights.pop_back();
    gpu.setLights(scene.lights);
    EXPECT_EQ(redrawn(maps, gpu), 6);
    scene.lights[0].castsShadow = false;
    gpu.setLights(scene.lights);
    EXPECT_EQ(redrawn(maps, gpu), 0);
}

}  // namespace
}  // namespace conelight::test
