// SPDX-License-Identifier: MIT
// Bounces of light in mode thesis: a furnace bounce by bounce, and emitters that light and whose light is passed
// on.
#include "conelight/renderer.h"
#include "conelight/thesis/settings.h"
#include "io/generated.h"
#include "support/gl_fixture.h"
#include "support/truth_rig.h"

namespace conelight::test {
namespace {

constexpr int kPixels = 48;

Settings bounceSettings(int bounces) {
    Settings settings;
    settings.mode = thesis::kMode;
    settings.voxels.size = 32;
    settings.light.shadowSize = 128;
    settings.light.emissiveQuads = false;
    settings.groups.of<thesis::ThesisSettings>().bounces = bounces;
    return settings;
}

Image draw(const Scene& scene, const Settings& settings) {
    Renderer renderer;
    renderer.setScene(scene);
    renderer.render(scene.cameras.front(), kPixels, kPixels, settings);
    return renderer.readImage();
}

using ThesisBouncesTest = GlTest;

// A closed box of albedo 1/2 that shines with radiance 1: n bounces see 1 + 1/2 + ... + 1/2^n.
TEST_F(ThesisBouncesTest, FurnaceBounceByBounce) {
    const Scene scene = io::generateScene("furnace?albedo=0.5&emission=1");
    double expected = 1, power = 1;
    for (int bounces = 1; bounces <= 8; ++bounces) {
        power *= 0.5;
        expected += power;
        if (bounces == 3 || (bounces > 4 && bounces < 8)) continue;
        const Image image = draw(scene, bounceSettings(bounces));
        // Albedo of 8 bits: 0.502. Eight bounces of it are 0.2 % brighter.
        EXPECT_NEAR(meanOf(image) / expected, 1, 0.005) << bounces;
    }
}

// A lamp that is a flat rectangle does not darken an emitter that is none, and is not in the volume itself.
TEST_F(ThesisBouncesTest, EmittersShineBesideRectangles) {
    const auto roomWith = [](float ofBox) {
        Scene scene;
        addInstance(scene, quadMesh({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}), diffuseMaterial(glm::vec3(0.5f)));
        addInstance(scene, quadMesh({-0.2f, 1, -0.2f}, {0.4f, 0, 0}, {0, 0, 0.4f}),
                    diffuseMaterial(glm::vec3(0), glm::vec3(2)));
        glm::mat4 place(0.1f);
        place[3] = glm::vec4(0, 0.5f, 0, 1);
        addInstance(scene, boxMesh(), diffuseMaterial(glm::vec3(0.5f), glm::vec3(ofBox)), place);
        scene.cameras = {cameraAbove({0, 0, 0}, 0.35f, 0.6f)};
        return scene;
    };
    Settings settings = bounceSettings(1);
    settings.component = Component::Diffuse;
    settings.light.emissiveQuads = true;
    const double dark = meanOf(draw(roomWith(0), settings)), bright = meanOf(draw(roomWith(5), settings));
    EXPECT_GT(bright, dark + 0.05);
    settings.groups.of<thesis::ThesisSettings>().defects.darkEmitters = true;
    EXPECT_NEAR(meanOf(draw(roomWith(5), settings)), meanOf(draw(roomWith(0), settings)), 1e-6);
}

// A small lamp lights a room as brightly as it is large from there: its far side is hidden by its near one. As opaque
// as it has surface it would be up to three times as bright.
TEST_F(ThesisBouncesTest, SmallEmittersShineAsFarAsTheyAreSeen) {
    for (const bool isBox : {false, true}) {
        Scene scene = closedBox(diffuseMaterial(glm::vec3(0.5f)));
        glm::mat4 place(isBox ? 0.05f : 0.06f);
        place[3] = glm::vec4(0.12f, 0.05f, -0.2f, 1);
        addInstance(scene, isBox ? boxMesh() : sphereMesh(24, 12),
                    diffuseMaterial(glm::vec3(0), glm::vec3(20)), place);
        reference::PathTracerSettings tracer;
        tracer.samplesPerPixel = 64;
        tracer.bounces = 1;
        const Camera& camera = scene.cameras.front();
        const double truth =
            meanOf(reference::PathTracer(scene).render(camera, kPixels, kPixels, tracer).indirect);
        Settings settings = bounceSettings(1);
        settings.component = Component::Diffuse;
        const double seen = meanOf(draw(scene, settings)) / truth;
        settings.groups.of<thesis::ThesisSettings>().defects.isotropicOpacity = true;
        const double counted = meanOf(draw(scene, settings)) / truth;
        // Measured: 1.69 and 1.42; 3.90 and 3.72. Five cones miss a lamp or meet it in full.
        EXPECT_NEAR(seen, 1.2, 0.6) << isBox;
        EXPECT_GT(counted, 2 * seen) << isBox;
    }
}

// What walls pass on lights the room further, and the same bits come out twice, whatever was drawn between.
TEST_F(ThesisBouncesTest, LightIsPassedOn) {
    const Scene scene = io::generateScene("cornell");
    Renderer renderer;
    renderer.setScene(scene);
    const auto picture = [&](int bounces) {
        Settings settings = bounceSettings(bounces);
        settings.component = Component::Diffuse;
        settings.light.emissiveQuads = true;
        renderer.render(scene.cameras.front(), kPixels, kPixels, settings);
        return renderer.readImage();
    };
    const Image once = picture(1), often = picture(3);
    EXPECT_GT(meanOf(often), 1.2 * meanOf(once));
    EXPECT_EQ(picture(1).pixels, once.pixels);
    EXPECT_EQ(picture(3).pixels, often.pixels);
}

}  // namespace
}  // namespace conelight::test
