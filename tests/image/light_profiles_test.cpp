// SPDX-License-Identifier: MIT
// Lights with profiles: a wall washer in every mode beside the path tracer's picture.
#include <gtest/gtest.h>

#include "conelight/renderer.h"
#include "conelight/thesis/settings.h"
#include "io/light_profile_file.h"
#include "support/lamp_files.h"
#include "support/traced_rig.h"

namespace conelight::test {
namespace {

constexpr int kPixels = 40;

Scene washedWall(LightType type) {
    Scene scene;
    addInstance(scene, quadMesh({-1.5f, 0, 1.5f}, {3, 0, 0}, {0, 0, -3}), diffuseMaterial(glm::vec3(0.4f)));
    addInstance(scene, quadMesh({-1.5f, 0, -1.5f}, {3, 0, 0}, {0, 2.5f, 0}),
                diffuseMaterial(glm::vec3(0.8f)));
    Light light;
    io::setLightProfile(light, io::parseLightProfile("washer.ies", kWallWasher));
    light.type = type;
    light.outerAngle = 1.2f;
    light.innerAngle = 0.8f;
    light.position = {-0.5f, 2.2f, -0.9f};
    light.direction = {0, -1, 0};
    light.halfU = {1, 0, 0};  // 90 degrees lie along -z: to the wall
    Light other = light;
    other.position.x = 0.6f;
    other.halfU = glm::vec3(1, 0, 0.6f);
    scene.lights = {light, other};
    Camera camera;
    camera.eye = {0.4f, 1.4f, 2.6f};
    camera.target = {0, 1, -1.2f};
    camera.fovY = 0.9f;
    scene.cameras = {camera};
    return scene;
}

Image drawn(const Scene& scene, const Mode& mode, Component component) {
    Settings settings = tracedSettings(Quality::Interactive, component);
    settings.mode = mode;
    Renderer renderer;
    renderer.setScene(scene);
    renderer.render(scene.cameras.front(), kPixels, kPixels, settings);
    return renderer.readImage();
}

class LightProfilesTest : public GlTest {};

TEST_F(LightProfilesTest, EveryModeThrowsItOnTheWall) {
    for (const LightType type : {LightType::Point, LightType::Spot}) {
        const Scene scene = washedWall(type);
        reference::PathTracerSettings tracer;
        tracer.samplesPerPixel = 64;
        const reference::PathTracedPicture truth =
            reference::PathTracer(scene).render(scene.cameras.front(), kPixels, kPixels, tracer);
        for (const Mode mode : {Mode::Traced, Mode::Cones, Mode::Hybrid, Mode::Phong}) {
            const double error = relRmse(drawn(scene, mode, Component::Direct), truth.direct);
            RecordProperty("direct_" + std::string(mode.name()), std::to_string(error));
            EXPECT_LT(error, 0.005) << static_cast<int>(type) << ' ' << mode.name();
        }
        EXPECT_LT(relRmse(drawn(scene, Mode::Traced, Component::Full), truth.full), 0.04);
        // A profile is what makes the picture: without it another one.
        Scene even = scene;
        for (Light& light : even.lights) light.profile = nullptr;
        EXPECT_GT(relRmse(drawn(even, Mode::Traced, Component::Direct), truth.direct), 0.5);
    }
}

// The thesis's light has no 1/pi and no physical scale here: where it falls is the same.
TEST_F(LightProfilesTest, TheThesisModeHasThem) {
    const Scene scene = washedWall(LightType::Point);
    Scene even = scene;
    for (Light& light : even.lights) light.profile = nullptr;
    const Image with = drawn(scene, thesis::kMode, Component::Direct);
    const Image without = drawn(even, thesis::kMode, Component::Direct);
    const Image truth = drawn(scene, Mode::Traced, Component::Direct);
    const Image open = drawn(even, Mode::Traced, Component::Direct);
    double worst = 0;
    for (std::size_t i = 0; i < with.pixels.size(); i += 37)
        if (open.pixels[i].g > 1e-3f && without.pixels[i].g > 1e-3f)
            worst = std::max(worst, static_cast<double>(std::abs(with.pixels[i].g / without.pixels[i].g -
                                                                 truth.pixels[i].g / open.pixels[i].g)));
    EXPECT_LT(worst, 0.02);
}

}  // namespace
}  // namespace conelight::test
