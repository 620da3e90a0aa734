// SPDX-License-Identifier: MIT
// Light of a picture round the scene, in every mode: an even one is a constant sky, a small sun is found
// without noise, mirrors and the background show it sharp, a closed room keeps it out.
#include "support/environments.h"

#include <cmath>

#include "conelight/thesis/settings.h"
#include "support/scenes.h"
#include "support/traced_rig.h"

namespace conelight::test {
namespace {

class EnvironmentTest : public TracedModeTest {
  protected:
    // A white floor with a box on it.
    static Scene yard(const Material& material = diffuseMaterial(glm::vec3(0.6f))) {
        Scene scene;
        addInstance(scene, quadMesh({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), material);
        addInstance(scene, boxMesh(), diffuseMaterial(glm::vec3(0.7f, 0.5f, 0.3f)));
        scene.instances[1].worldFromObject[3] = glm::vec4(0.1f, 0.5f, 0, 1);
        Camera camera;
        camera.eye = {1.5f, 2.5f, 3.5f};
        camera.target = {0, 0.2f, 0};
        scene.cameras.push_back(camera);
        return scene;
    }
    static reference::PathTracedPicture truthOf(const Scene& scene, int samples = 512) {
        reference::PathTracerSettings settings;
        settings.samplesPerPixel = samples;
        return reference::PathTracer(scene).render(scene.cameras.at(0), kTracedPixels, kTracedPixels,
                                                   settings);
    }
};

// Rays, cones and pixels see the same as under a constant sky.
TEST_F(EnvironmentTest, AnEvenPictureIsASky) {
    for (const Mode mode : {Mode::Traced, Mode::Cones}) {
        Scene scene = yard();
        scene.sky = {0.5f, 1, 2};
        Settings settings = tracedSettings(Quality::Interactive);
        settings.mode = mode;
        const Image sky = draw(scene, settings);
        scene.environment = {"", evenEnvironment(64, scene.sky), 0.3f, 1};
        scene.sky = glm::vec3(0);
        EXPECT_LT(relRmse(draw(scene, settings), sky), 0.02) << mode.name();
    }
}

TEST_F(EnvironmentTest, ASmallSunIsFound) {
    Scene scene = yard();
    scene.environment = {"", sunnyEnvironment(128), 0.5f, 1};
    const reference::PathTracedPicture truth = truthOf(scene);
    Settings settings = tracedSettings(Quality::Interactive, Component::Indirect);
    settings.voxels.size = 64;
    settings.traced.passes = 64;
    settings.traced.filterLevels = 0;
    const Image image = draw(scene, settings);
    EXPECT_LT(indirectError(image, truth), 0.12);
    EXPECT_NEAR(meanOf(image) / meanOf(truth.indirect), 1, 0.02);
    // The same as a light of its own, with a sharp shadow.
    ASSERT_TRUE(splitSun(scene));
    settings.component = Component::Full;
    EXPECT_LT(relRmse(draw(scene, settings), truth.full), 0.15);
}

TEST_F(EnvironmentTest, SmoothMetalShowsIt) {
    Material metal = diffuseMaterial(glm::vec3(0.9f));
    metal.metallic = 1;
    metal.roughness = 0.15f;
    Scene scene = yard(metal);
    scene.environment = {"", evenEnvironment(64, glm::vec3(0.2f)), 0, 1};
    auto picture = std::make_shared<EnvironmentImage>(*scene.environment.image);
    // A bright quarter ahead, above the horizon.
    for (int y = 4; y < 14; ++y)
        for (int x = 24; x < 40; ++x)
            picture->radiance[static_cast<std::size_t>(64 * y + x)] = glm::vec3(3, 2, 1);
    scene.environment.image = picture;
    Settings settings = tracedSettings(Quality::Interactive, Component::Indirect);
    settings.voxels.size = 64;
    settings.traced.passes = 64;
    const Image image = draw(scene, settings);
    const reference::PathTracedPicture truth = truthOf(scene);
    EXPECT_LT(indirectError(image, truth), 0.08);
    EXPECT_NEAR(meanOf(image) / meanOf(truth.indirect), 1, 0.02);
}

TEST_F(EnvironmentTest, EveryModeShowsItBehind) {
    Scene scene;
    addInstance(scene, quadMesh({-0.1f, -0.1f, -1}, {0.2f, 0, 0}, {0, 0.2f, 0}), diffuseMaterial());
    scene.environment = {"", sunnyEnvironment(64), 0.4f, 2};
    Camera camera;
    camera.eye = {0, 0, 0};
    camera.target = {0, 0, -1};
    scene.cameras.push_back(camera);
    const Image truth = truthOf(scene, 2).full;
    for (const Mode mode : {Mode::Phong, Mode::Traced, Mode::Cones, thesis::kMode}) {
        Settings settings = tracedSettings(Quality::Draft);
        settings.mode = mode;
        const Image image = draw(scene, settings);
        std::size_t behind = 0;
        for (std::size_t i = 0; i < image.pixels.size(); ++i) {
            if (image.pixels[i].a != 0) continue;
            ++behind;
            EXPECT_NEAR(image.pixels[i].g / truth.pixels[i].g, 1, 0.03) << mode.name() << ' ' << i;
        }
        EXPECT_GT(behind, image.pixels.size() / 2) << mode.name();
    }
}

TEST_F(EnvironmentTest, AClosedRoomKeepsItOut) {
    Scene room = closedBox(diffuseMaterial(glm::vec3(0.5f)));
    room.environment = {"", sunnyEnvironment(64), 0, 1};
    const Image image = draw(room, tracedSettings(Quality::Interactive));
    // The mean radiance round the room is about 60 W/(sr m^2).
    EXPECT_LT(meanOf(image), 0.001 * 60);
}

}  // namespace
}  // namespace conelight::test
