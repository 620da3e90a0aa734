// SPDX-License-Identifier: MIT
// Light that dielectrics mirror onto other surfaces in mode `traced`, against the path tracer.
#include "support/scenes.h"
#include "support/traced_rig.h"

namespace conelight::test {
namespace {

class GlossTest : public TracedModeTest {
  protected:
    // A black, polished floor under a sun, before a white wall: all light on the wall is the floor's gloss.
    static Scene court() {
        Scene scene;
        Material stone = diffuseMaterial(glm::vec3(0));
        stone.specular = 1;
        stone.roughness = 0.35f;
        addInstance(scene, quadMesh({-1, 0, 1}, {2, 0, 0}, {0, 0, -1}), stone);
        addInstance(scene, quadMesh({-1, 0, 0}, {2, 0, 0}, {0, 1, 0}), diffuseMaterial(glm::vec3(0.5f)));
        Light sun;
        sun.type = LightType::Directional;
        sun.direction = glm::normalize(glm::vec3(0, -1, -0.6f));
        sun.intensity = glm::vec3(3);
        scene.lights = {sun};
        Camera camera;
        camera.eye = {0, 0.55f, 2.2f};
        camera.target = {0, 0.55f, 0};
        camera.fovY = 0.4f;
        scene.cameras = {camera};
        return scene;
    }
};

TEST_F(GlossTest, APolishedFloorThrowsTheSunOnTheWall) {
    const Scene scene = court();
    reference::PathTracerSettings truthSettings;
    truthSettings.samplesPerPixel = 1024;
    const reference::PathTracedPicture truth =
        reference::PathTracer(scene).render(scene.cameras.at(0), kTracedPixels, kTracedPixels, truthSettings);
    Settings settings = tracedSettings(Quality::Interactive, Component::Indirect);
    settings.traced.passes = 64;
    const double error = indirectError(draw(scene, settings), truth);
    settings.traced.exactHits = false;
    const double even = indirectError(draw(scene, settings), truth);
    // As even light of half the lobe's mean the wall has a wrong gradient.
    EXPECT_LT(error, 0.1);
    EXPECT_GT(even, 2 * error);
}

// A black, polished wall under a softbox: all light that the metal floor mirrors is the wall's gloss.
TEST_F(GlossTest, MirrorsShowSoftboxesInPolishedWalls) {
    Scene scene;
    Material stone = diffuseMaterial(glm::vec3(0));
    stone.specular = 1;
    stone.roughness = 0.3f;
    addInstance(scene, quadMesh({-1, 0, 0}, {2, 0, 0}, {0, 1.5f, 0}), stone);
    Material metal = diffuseMaterial(glm::vec3(0.9f));
    metal.metallic = 1;
    metal.roughness = 0.2f;
    addInstance(scene, quadMesh({-1, 0, 1.5f}, {2, 0, 0}, {0, 0, -1.5f}), metal);
    Light softbox;
    softbox.type = LightType::Rect;
    softbox.position = {0, 2.2f, 1.2f};
    softbox.direction = glm::normalize(glm::vec3(0, -1, -0.8f));
    softbox.halfU = {0.3f, 0, 0};
    softbox.halfV = 0.3f * glm::normalize(glm::cross(softbox.direction, glm::vec3(1, 0, 0)));
    softbox.intensity = glm::vec3(10);
    scene.lights = {softbox};
    Camera camera;
    camera.eye = {0, 1, 2.2f};
    camera.target = {0, 0, 0.7f};
    camera.fovY = 0.5f;
    scene.cameras = {camera};
    reference::PathTracerSettings truthSettings;
    truthSettings.samplesPerPixel = 1024;
    const reference::PathTracedPicture truth =
        reference::PathTracer(scene).render(camera, kTracedPixels, kTracedPixels, truthSettings);
    const Image image = draw(scene, tracedSettings(Quality::Interactive, Component::Indirect));
    EXPECT_NEAR(meanOf(image) / meanOf(truth.indirect), 1.0, 0.1);
    EXPECT_LT(indirectError(image, truth), 0.25);
}

// The roughest lobe is not that of a diffuse surface. Files whose materials say nothing have such metal.
TEST_F(GlossTest, RoughMetalIsNotDiffuse) {
    Scene scene = court();
    Material& floor = scene.materials[0];
    floor.baseColor = glm::vec4(0.9f, 0.9f, 0.9f, 1);
    floor.metallic = 1;
    floor.roughness = 1;
    reference::PathTracerSettings truthSettings;
    truthSettings.samplesPerPixel = 256;
    const reference::PathTracedPicture truth =
        reference::PathTracer(scene).render(scene.cameras.at(0), kTracedPixels, kTracedPixels, truthSettings);
    EXPECT_LT(indirectError(draw(scene, tracedSettings(Quality::Interactive, Component::Indirect)), truth),
              0.1);
}

// Lights that send nothing change nothing, though more than four are looked up in a loop.
TEST_F(GlossTest, FurtherLightsLeaveHitsExact) {
    Scene scene = court();
    const Settings settings = tracedSettings(Quality::Interactive, Component::Indirect);
    const Image one = draw(scene, settings);
    for (int i = 0; i < 5; ++i) {
        Light dark;
        dark.type = LightType::Point;
        dark.position = {0, 0.5f, 0.5f};
        dark.intensity = glm::vec3(1e-6f);
        scene.lights.push_back(dark);
    }
    const Image six = draw(scene, settings);
    double difference = 0, sum = 0;
    for (std::size_t i = 0; i < one.pixels.size(); ++i) {
        difference += std::abs(one.pixels[i].g - six.pixels[i].g);
        sum += one.pixels[i].g;
    }
    EXPECT_GT(sum, 0);
    EXPECT_LT(difference, 1e-3 * sum);
}

}  // namespace
}  // namespace conelight::test
