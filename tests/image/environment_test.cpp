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

// Rays, cones, bounces and pixels see the same as under a constant sky.
TEST_F(EnvironmentTest, AnEvenPictureIsASky) {
    for (const Mode mode : {Mode::Traced, Mode::Cones, thesis::kMode}) {
        Scene scene = yard();
        scene.sky = {0.5f, 1, 2};
        Settings settings = tracedSettings(Quality::Interactive);
        settings.mode = mode;
        settings.groups.of<thesis::ThesisSettings>().bounces = 2;
        const Image sky = draw(scene, settings);
        scene.environment = {"", evenEnvironment(64, scene.sky), 0.3f, 1};
        scene.sky = glm::vec3(0);
        EXPECT_GT(meanOf(sky), 0.2) << mode.name();
        EXPECT_LT(relRmse(draw(scene, settings), sky), 0.02) << mode.name();
    }
}

// Light from one side comes from that side, in every mode that has cones or rays, at surfaces that look there.
TEST_F(EnvironmentTest, SurfacesSeeTheirSideOfIt) {
    for (const Mode mode : {Mode::Traced, Mode::Cones, thesis::kMode}) {
        double means[2];
        for (const int side : {0, 1}) {
            Scene scene;
            addInstance(scene, quadMesh({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), diffuseMaterial());
            auto picture = std::make_shared<EnvironmentImage>(*evenEnvironment(64, glm::vec3(0)));
            // Ahead of the wall, or behind it.
            for (int y = 0; y < 32; ++y)
                for (int x = 0; x < 64; ++x)
                    if ((x >= 16 && x < 48) == (side == 1))
                        picture->radiance[static_cast<std::size_t>(64 * y + x)] = glm::vec3(1);
            scene.environment = {"", picture, 0, 1};
            Camera camera;
            camera.eye = {0, 0, 2};
            camera.target = {0, 0, 0};
            camera.fovY = 0.5f;
            scene.cameras.push_back(camera);
            Settings settings = tracedSettings(Quality::Interactive, Component::Indirect);
            settings.mode = mode;
            means[side] = meanOf(draw(scene, settings));
        }
        EXPECT_NEAR(means[0], 1, mode == thesis::kMode ? 0.3 : 0.15) << mode.name();
        EXPECT_LT(means[1], 0.15) << mode.name();
    }
}

// White inside and out under an even map of 1: what is seen is 1 everywhere.
TEST_F(EnvironmentTest, AFurnaceUnderAMapIsOne) {
    Scene scene = yard(diffuseMaterial());
    scene.instances[1].material = scene.instances[0].material;
    scene.environment = {"", evenEnvironment(64, glm::vec3(1)), 0, 1};
    EXPECT_NEAR(meanOf(truthOf(scene, 256).full), 1, 0.005);
    for (const Mode mode : {Mode::Traced, Mode::Cones}) {
        Settings settings = tracedSettings(Quality::High);
        settings.mode = mode;
        settings.voxels.size = 64;
        settings.cones.bounces = 8;
        EXPECT_NEAR(meanOf(draw(scene, settings)), 1, mode == Mode::Traced ? 0.02 : 0.1) << mode.name();
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
