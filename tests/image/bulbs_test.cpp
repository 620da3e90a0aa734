// SPDX-License-Identifier: MIT
// Small bulbs among thin things: pictures of mode `traced` beside the path tracer's.
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

class BulbsTest : public TracedModeTest {
  protected:
    static Settings settingsWith(bool spheres) {
        Settings settings = tracedSettings(Quality::Interactive);
        settings.light.emissiveSpheres = spheres;
        return settings;
    }
};

// The ceiling about the bulb, striped by its cage.
TEST_F(BulbsTest, ACagedBulbLightsTheCeiling) {
    const Scene scene = cagedBulb();
    reference::PathTracerSettings tracer;
    tracer.samplesPerPixel = 256;
    const Image truth =
        reference::PathTracer(scene).render(scene.cameras.front(), kTracedPixels, kTracedPixels, tracer).full;
    const double light = relRmse(draw(scene, settingsWith(true)), truth);
    const double voxels = relRmse(draw(scene, settingsWith(false)), truth);
    RecordProperty("light", std::to_string(light));
    RecordProperty("voxels", std::to_string(voxels));
    EXPECT_LT(light, 0.16);
    EXPECT_GT(voxels, 2 * light);
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
