// SPDX-License-Identifier: MIT
// Shadow maps after a change: only maps that the change can touch are drawn. That the picture is the right
// one is the matter of tests/image/scene_changes_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>

#include "conelight/renderer.h"
#include "light/lights.h"
#include "scene/gpu_scene.h"
#include "support/gl_fixture.h"
#include "support/view_rig.h"

namespace conelight::test {
namespace {

struct ShadowUpdates : public GlTest {
    LightSettings settings{.shadowSize = 128};

    // Maps that an update draws; none where the lights have not changed.
    int redrawn(light::Lights& lights, scene::GpuScene& scene) {
        const base::Revision before = lights.revision();
        lights.update(device(), scene, {.settings = settings});
        return lights.revision() == before ? 0 : lights.redrawnShadowMaps();
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
    light::Lights maps;
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

// A material that glows or is painted draws no map anew, as in films of a day; one that lets light through draws its own.
TEST_F(ShadowUpdates, ColoursOfCastersDrawNoMaps) {
    Scene scene;
    addInstance(scene, quadMesh({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}), {});
    Mesh bent = quadMesh({2, 0.5f, 0}, {0.4f, 0, 0}, {0, 0.4f, 0});
    bent.positions[2].z += 0.1f;  // no rectangle of the light table
    addInstance(scene, bent, {.name = "card"});
    scene.lights.push_back({.position = {0, 1, 0}});
    scene::GpuScene gpu(scene);
    light::Lights maps;
    EXPECT_EQ(redrawn(maps, gpu), 6);
    Material card = scene.materials[static_cast<std::size_t>(scene.instances[1].material)];
    const auto recoloured = [&](auto change) {
        change(card);
        gpu.setMaterial(static_cast<std::size_t>(scene.instances[1].material), card);
        return redrawn(maps, gpu);
    };
    EXPECT_EQ(recoloured([](Material& m) { m.emission = glm::vec3(5); }), 0);
    EXPECT_EQ(recoloured([](Material& m) {
                  m.baseColor = {1, 0, 0, 0.3f};
              }),
              0);  // opaque, whatever its alpha
    EXPECT_EQ(recoloured([](Material& m) { m.alphaMode = AlphaMode::Blend; }), 1);
    EXPECT_EQ(recoloured([](Material& m) { m.baseColor.a = 0.8f; }), 1);
}

// A shell with every other patch left out, around a lamp: each of its six maps sees a sixth of the mesh, some
// parts of it and not the others. The shadows on the walls are those of the shell in pieces, which are drawn
// whole.
TEST_F(ShadowUpdates, PartsOfAMeshAreDrawnWhereAMapSeesThem) {
    constexpr int kRows = 48, kColumns = 96;
    const auto corner = [](int row, int column) {
        const float theta = 3.14159265f * (static_cast<float>(row) + 0.5f) / (kRows + 1);
        const float phi = 6.2831853f * static_cast<float>(column) / kColumns;
        return 0.5f *
               glm::vec3(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
    };
    const auto picture = [&](bool inPieces) {
        Scene scene;
        for (int axis = 0; axis < 3; ++axis) {
            glm::vec3 origin(-2), u(0), v(0);
            u[(axis + 1) % 3] = 4;
            v[(axis + 2) % 3] = 4;
            addInstance(scene, quadMesh(origin, u, v), {.doubleSided = true});
            origin[axis] = 2;
            addInstance(scene, quadMesh(origin, u, v), {.doubleSided = true});
        }
        Mesh shell;
        for (int row = 0; row < kRows; ++row) {
            for (int column = 0; column < kColumns; ++column) {
                if ((row / 4 + column / 4) % 2 != 0) continue;
                const auto first = static_cast<std::uint32_t>(shell.positions.size());
                for (const int k : {0, 1, 2, 3})
                    shell.positions.push_back(corner(row + k / 2, column + k % 2));
                for (const std::uint32_t k : {0u, 1u, 2u, 2u, 1u, 3u}) shell.indices.push_back(first + k);
            }
            if (inPieces) addInstance(scene, std::exchange(shell, {}), {.doubleSided = true});
        }
        if (!inPieces) addInstance(scene, shell, {.doubleSided = true});
        scene.lights.push_back({.intensity = glm::vec3(5), .position = {0.05f, 0.02f, -0.03f}});
        Settings phong;
        phong.mode = Mode::Phong;
        phong.light.shadowSize = 512;
        Camera camera;
        camera.eye = {-1.9f, 1.7f, -1.8f};
        camera.target = {0.8f, -0.7f, 0.7f};
        Renderer renderer;
        renderer.setScene(scene);
        renderer.render(camera, 160, 120, phong);
        return renderer.readImage();
    };
    const Image whole = picture(false), pieces = picture(true);
    EXPECT_TRUE(whole.pixels == pieces.pixels);
    const auto dark = std::count_if(whole.pixels.begin(), whole.pixels.end(),
                                    [](const glm::vec4& pixel) { return pixel.g == 0; });
    EXPECT_GT(dark, 160 * 120 / 5);
    EXPECT_LT(dark, 160 * 120 * 4 / 5);
}

}  // namespace
}  // namespace conelight::test
