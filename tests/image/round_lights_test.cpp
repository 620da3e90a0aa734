// SPDX-License-Identifier: MIT
// Disks and spheres of light: pictures of the modes beside the path tracer's, with rectangles as what to be as good as.
#include <gtest/gtest.h>

#include <glm/gtc/constants.hpp>

#include "conelight/renderer.h"
#include "support/traced_rig.h"

namespace conelight::test {
namespace {

constexpr int kPixels = 48;

Light lamp(LightType type, float radius) {
    Light light;
    light.type = type;
    light.position = {0.1f, 1.2f, 0.2f};
    light.direction = {0, -1, 0};
    light.halfU = {radius, 0, 0};
    light.halfV = {0, 0, radius};
    // All send 10 W.
    setRadiantFlux(light, glm::vec3(10));
    return light;
}

// A table on a floor before a wall, under a lamp.
Scene tableScene(const Light& light, float roughness = 1) {
    Scene scene;
    Material wood = diffuseMaterial(glm::vec3(0.6f));
    if (roughness < 1) {
        wood.specular = 1;
        wood.metallic = 1;
        wood.roughness = roughness;
    }
    addInstance(scene, quadMesh({-2, 0, 2}, {4, 0, 0}, {0, 0, -3.2f}), wood);
    addInstance(scene, quadMesh({-2, 0, -1.2f}, {4, 0, 0}, {0, 2.4f, 0}), diffuseMaterial(glm::vec3(0.7f)));
    glm::mat4 place(1);
    place[0][0] = 0.45f;
    place[1][1] = 0.02f;
    place[2][2] = 0.3f;
    place[3] = glm::vec4(0, 0.5f, 0, 1);
    addInstance(scene, boxMesh(), diffuseMaterial(glm::vec3(0.5f, 0.3f, 0.2f)), place);
    scene.lights = {light};
    Camera camera;
    camera.eye = {1.2f, 1.1f, 2.4f};
    camera.target = {0, 0.3f, -0.2f};
    scene.cameras = {camera};
    return scene;
}

Image drawn(const Scene& scene, Mode mode, Component component = Component::Full) {
    Settings settings = tracedSettings(Quality::Interactive, component);
    settings.mode = mode;
    settings.light.areaSamples = 16;
    Renderer renderer;
    renderer.setScene(scene);
    renderer.render(scene.cameras.front(), kPixels, kPixels, settings);
    return renderer.readImage();
}

reference::PathTracedPicture truthOf(const Scene& scene, int bounces) {
    reference::PathTracerSettings tracer;
    tracer.samplesPerPixel = 128;
    tracer.bounces = bounces;
    return reference::PathTracer(scene).render(scene.cameras.front(), kPixels, kPixels, tracer);
}

class RoundLightsTest : public GlTest {};

// Shadow of the table, light on the wall, light that bounces.
TEST_F(RoundLightsTest, PicturesAreThePathTracers) {
    for (const LightType type : {LightType::Rect, LightType::Disk, LightType::Sphere}) {
        const Scene scene = tableScene(lamp(type, 0.25f));
        const double traced = relRmse(drawn(scene, Mode::Traced), truthOf(scene, -1).full);
        const double phong = relRmse(drawn(scene, Mode::Phong), truthOf(scene, 0).direct);
        RecordProperty("traced" + std::to_string(static_cast<int>(type)), std::to_string(traced));
        RecordProperty("phong" + std::to_string(static_cast<int>(type)), std::to_string(phong));
        EXPECT_LT(traced, 0.05) << static_cast<int>(type);
        EXPECT_LT(phong, 0.05) << static_cast<int>(type);
    }
}

// A metal floor shows the lamp's shape: an even glow, or nearly its picture.
TEST_F(RoundLightsTest, ReflectionsAreThePathTracers) {
    for (const LightType type : {LightType::Rect, LightType::Disk, LightType::Sphere})
        for (const float roughness : {0.1f, 0.4f}) {
            const Scene scene = tableScene(lamp(type, 0.15f), roughness);
            const Image got = drawn(scene, Mode::Traced, Component::Direct);
            const double error = relRmse(got, truthOf(scene, 0).direct);
            const std::string name =
                std::to_string(static_cast<int>(type)) + (roughness < 0.2f ? "narrow" : "wide");
            RecordProperty("direct" + name, std::to_string(error));
            EXPECT_LT(error, 0.08) << name;
        }
}

// Other modes: the same light in the mean.
TEST_F(RoundLightsTest, OtherModesGiveTheSameLight) {
    for (const LightType type : {LightType::Disk, LightType::Sphere}) {
        const Scene scene = tableScene(lamp(type, 0.2f));
        const double truth = meanOf(truthOf(scene, 0).direct);
        for (const Mode mode : {Mode::Cones, Mode::Hybrid})
            EXPECT_NEAR(meanOf(drawn(scene, mode, Component::Direct)) / truth, 1, 0.03)
                << static_cast<int>(type);
    }
}

// Half of a sphere below the floor's plane, seen by what lies beside it; and nothing within it.
TEST_F(RoundLightsTest, AHorizonCutsASphere) {
    Scene scene;
    addInstance(scene, quadMesh({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), diffuseMaterial());
    Light light = lamp(LightType::Sphere, 0.4f);
    light.position = {0, 0.1f, 0};
    light.castsShadow = false;
    scene.lights = {light};
    scene.cameras = {cameraAbove({0.2f, 0, 0}, 2, 1.8f)};
    const Image got = drawn(scene, Mode::Phong), traced = drawn(scene, Mode::Traced, Component::Direct);
    const reference::PathTracedPicture truth = truthOf(scene, 0);
    EXPECT_LT(relRmse(traced, truth.direct), 0.03);
    EXPECT_EQ(traced.pixels[kPixels * kPixels / 2 + kPixels / 2 - 5].g, 0);  // within
    EXPECT_GT(meanOf(got), 0);
}

// Any number of sample points keeps the light.
TEST_F(RoundLightsTest, EveryNumberOfPointsSpreads) {
    const Scene scene = tableScene(lamp(LightType::Sphere, 0.2f));
    const Image truth = truthOf(scene, 0).direct;
    for (const int points : {1, 9, 16, 64}) {
        Settings settings = tracedSettings(Quality::Interactive, Component::Direct);
        settings.light.areaSamples = points;
        Renderer renderer;
        renderer.setScene(scene);
        renderer.render(scene.cameras.front(), kPixels, kPixels, settings);
        const double error = relRmse(renderer.readImage(), truth);
        RecordProperty("points" + std::to_string(points), std::to_string(error));
        EXPECT_LT(error, points == 1 ? 0.3 : points == 9 ? 0.06 : 0.03) << points;
    }
}

}  // namespace
}  // namespace conelight::test
