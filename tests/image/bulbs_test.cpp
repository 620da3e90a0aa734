// SPDX-License-Identifier: MIT
// Small lamps beside other things: pictures of mode `traced` beside the path tracer's.
#include <glm/gtc/matrix_transform.hpp>

#include "support/traced_rig.h"

namespace conelight::test {
namespace {

// A bulb of 3 cm in a cage of eight rods, 8 cm below the ceiling of a room of 2 m. 32 voxels are twice as wide.
Scene cagedBulb() {
    Scene scene = closedBox(diffuseMaterial(glm::vec3(0.5f)));
    const glm::vec3 place(0.1f, 0.92f, -0.1f);
    const auto at = [](const glm::vec3& position, const glm::vec3& size) {
        return glm::scale(glm::translate(glm::mat4(1), position), size);
    };
    addInstance(scene, sphereMesh(16, 8), diffuseMaterial(glm::vec3(0), glm::vec3(200)),
                at(place, glm::vec3(0.015f)));
    for (int i = 0; i < 8; ++i) {
        const float angle = 0.785398f * static_cast<float>(i);
        const glm::vec3 aside(0.035f * std::cos(angle), 0, 0.035f * std::sin(angle));
        addInstance(scene, boxMesh(), diffuseMaterial(glm::vec3(0.2f)),
                    at(place + aside, {0.002f, 0.04f, 0.002f}));
    }
    Camera& camera = scene.cameras.front();
    camera.eye = {-0.2f, 0.6f, 0.3f};
    camera.target = {0.1f, 0.95f, -0.1f};
    camera.fovY = 0.8f;
    return scene;
}

// A panel of 2 cm, 4 cm below the ceiling. 32 voxels are 6 cm wide.
Scene panelLamp() {
    Scene scene = closedBox(diffuseMaterial(glm::vec3(0.5f)));
    addInstance(scene, boxMesh(), diffuseMaterial(glm::vec3(0), glm::vec3(5)),
                glm::scale(glm::translate(glm::mat4(1), {0.1f, 0.95f, -0.1f}), {0.3f, 0.01f, 0.2f}));
    Camera& camera = scene.cameras.front();
    camera.eye = {-0.2f, 0.2f, 0.6f};
    camera.target = {0.1f, 0.95f, -0.1f};
    camera.fovY = 0.9f;
    return scene;
}

class BulbsTest : public TracedModeTest {
  protected:
    static Settings settingsWith(bool lamps) {
        Settings settings = tracedSettings(Quality::Interactive);
        settings.light.smallLamps = lamps;
        return settings;
    }
    // relRMSE with and without lights that stand for lamps.
    glm::dvec2 errorsOf(const Scene& scene) {
        reference::PathTracerSettings tracer;
        tracer.samplesPerPixel = 256;
        const Image truth = reference::PathTracer(scene)
                                .render(scene.cameras.front(), kTracedPixels, kTracedPixels, tracer)
                                .full;
        const glm::dvec2 errors(relRmse(draw(scene, settingsWith(true)), truth),
                                relRmse(draw(scene, settingsWith(false)), truth));
        RecordProperty("light", std::to_string(errors.x));
        RecordProperty("voxels", std::to_string(errors.y));
        return errors;
    }
};

// The ceiling about the bulb, striped by its cage.
TEST_F(BulbsTest, ACagedBulbLightsTheCeiling) {
    const glm::dvec2 errors = errorsOf(cagedBulb());
    EXPECT_LT(errors.x, 0.16);
    EXPECT_GT(errors.y, 2 * errors.x);
}

// The gap above it, which is less than a voxel.
TEST_F(BulbsTest, APanelLightsTheCeilingAboveIt) {
    const glm::dvec2 errors = errorsOf(panelLamp());
    EXPECT_LT(errors.x, 0.03);
    EXPECT_GT(errors.y, 2 * errors.x);
}

// The bulb itself is seen with its own radiance.
TEST_F(BulbsTest, ABulbIsSeenAsItIs) {
    const Scene scene = cagedBulb();
    const auto brightest = [](const Image& image) {
        float most = 0;
        for (const glm::vec4& p : image.pixels) most = std::max(most, p.x);
        return most;
    };
    Settings settings = settingsWith(true);
    settings.component = Component::Direct;
    EXPECT_NEAR(brightest(draw(scene, settings)), 200, 1);
}

}  // namespace
}  // namespace conelight::test
