// SPDX-License-Identifier: MIT
// Mode `phong` through the whole renderer: the thesis's formula on a scene of its format.
#include <algorithm>
#include <cmath>

#include "conelight/renderer.h"
#include "support/gl_fixture.h"
#include "support/view_rig.h"

namespace conelight::test {
namespace {

using PhongTest = GlTest;

constexpr int kWidth = 64, kHeight = 48;
const glm::vec3 kColors[2] = {{1, 0.9f, 0.8f}, {0.2f, 0.1f, 0.5f}};
const glm::vec3 kPositions[2] = {{-0.2f, 1.5f, 0.1f}, {1, 0.7f, -0.5f}};

// A floor of the thesis's material below two lights, and a small quad between.
Scene thesisFloor() {
    Scene scene;
    scene.format = "thesis";
    Material material;
    material.phong.emplace().color = {0.3f, 0.6f, 0.9f};
    material.phong->shininess = 20;
    material.phong->ambientStrength = 0.08f;
    material.phong->diffuseStrength = 1.4f;
    material.phong->specularStrength = 0.7f;
    addInstance(scene, quadMesh({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), material);
    // Hangs between the first light and the floor: no shadow in scenes of this format.
    addInstance(scene, quadMesh({-0.2f, 1, 0}, {0.1f, 0, 0}, {0, 0, -0.1f}), material);
    for (int i = 0; i < 2; ++i) {
        Light light;
        light.position = kPositions[i];
        light.intensity = 3.14159265f * kColors[i];
        light.customFalloff = true;
        light.falloff = {1, 0.15f, 0.45f};
        scene.lights.push_back(light);
    }
    return scene;
}

// The thesis's formula for a point of that floor.
glm::dvec3 formulaAt(const glm::dvec3& p, const glm::dvec3& eye, const glm::dvec3& color) {
    const glm::dvec3 n(0, 1, 0), v = glm::normalize(eye - p);
    glm::dvec3 sum(0);
    for (int i = 0; i < 2; ++i) {
        glm::dvec3 l = glm::dvec3(kPositions[i]) - p;
        const double d = glm::length(l);
        l /= d;
        const double specular = std::pow(std::max(glm::dot(v, 2 * l.y * n - l), 0.0), 20.0);
        sum += (0.08 + 1.4 * std::max(l.y, 0.0) + 0.7 * specular) * glm::dvec3(kColors[i]) /
               (1 + 0.15 * d + 0.45 * d * d) * color;
    }
    return sum;
}

TEST_F(PhongTest, ThesisScenesShowItsFormula) {
    const Scene scene = thesisFloor();
    Camera camera;
    camera.eye = {0, 0.8f, 2};
    camera.target = {0, 0, 0};
    Settings settings;
    settings.mode = Mode::Phong;
    Image image;
    {
        Renderer renderer;
        renderer.setScene(scene);
        renderer.render(camera, kWidth, kHeight, settings);
        image = renderer.readImage();
    }
    double worst = 0;
    int compared = 0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const glm::vec4 got = image.pixels[static_cast<std::size_t>((kHeight - 1 - y) * kWidth + x)];
            const glm::dvec3 p = pixelOnPlane(camera, {kWidth, kHeight}, {x, y}, {0, 1, 0}, 0);
            // Inside the floor, and not where the small quad is seen.
            if (std::abs(p.x) > 1.9 || std::abs(p.z) > 1.9 || got.a == 0 || p.z < 0) continue;
            ++compared;
            const glm::dvec3 want = formulaAt(p, camera.eye, glm::dvec3(scene.materials[0].phong->color));
            for (int c = 0; c < 3; ++c)
                worst = std::max(worst, std::abs(static_cast<double>(got[c]) - want[c]) / want[c]);
        }
    EXPECT_GT(compared, kWidth * kHeight / 4);
    EXPECT_LE(worst, 1e-3);
}

TEST_F(PhongTest, UnlitSurfacesShowTheirColour) {
    Scene scene;
    Material material;
    material.unlit = true;
    material.baseColor = {0.9f, 0.4f, 0.2f, 1};
    addInstance(scene, quadMesh({-2, -2, 0}, {4, 0, 0}, {0, 4, 0}), material);
    scene.lights.emplace_back();
    Camera camera;
    Settings settings;
    settings.mode = Mode::Phong;
    Renderer renderer;
    renderer.setScene(scene);
    renderer.render(camera, 16, 16, settings);
    const glm::vec4 got = renderer.readImage().pixels[8 * 16 + 8];
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(got[c], material.baseColor[c], 1e-4f);
}

TEST_F(PhongTest, OtherScenesHaveShadowsUnlessSwitchedOff) {
    Scene scene;
    addInstance(scene, quadMesh({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), Material{});
    addInstance(scene, quadMesh({-0.4f, 1, 0.4f}, {0.8f, 0, 0}, {0, 0, -0.8f}), Material{});
    Light light;
    light.position = {0, 2, 0};
    scene.lights.push_back(light);
    Camera camera;
    camera.eye = {0, 0.4f, 1};
    camera.target = {0, 0, 0};
    Settings settings;
    settings.mode = Mode::Phong;
    Renderer renderer;
    renderer.setScene(scene);
    const auto centre = [&] {
        renderer.render(camera, 32, 32, settings);
        return renderer.readImage().pixels[16 * 32 + 16].g;
    };
    EXPECT_EQ(centre(), 0);
    settings.phong.shadows = Toggle::Off;
    EXPECT_GT(centre(), 0.01f);
    settings.phong.shadows = Toggle::On;
    scene.format = "thesis";
    renderer.setScene(scene);
    EXPECT_EQ(centre(), 0);
    settings.phong.shadows = Toggle::Auto;
    EXPECT_GT(centre(), 0.01f);
}

}  // namespace
}  // namespace conelight::test
