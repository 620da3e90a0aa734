// SPDX-License-Identifier: MIT
// Many lamps in mode `traced`: a few of them are drawn for each place, and rays tell their shadows
// (docs/theory/3_light.md, "Many lamps"). Against the same lamps asked one by one, by shadow maps.
#include <algorithm>
#include <cmath>
#include <set>

#include "conelight/error.h"
#include "gl/program.h"
#include "io/generated.h"
#include "reference/metrics.h"
#include "support/traced_rig.h"

namespace conelight::test {
namespace {

class ManyLamps : public TracedModeTest {
  protected:
    // A floor and a wall that parts it, below `count` lamps of several colours and strengths, one of them much brighter.
    static Scene yard(int count, bool shadows = true) {
        Scene scene;
        Material floor = diffuseMaterial({0.6f, 0.5f, 0.4f});
        floor.specular = 1;
        floor.roughness = 0.5f;
        addInstance(scene, quadMesh({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}), floor);
        addInstance(scene, boxMesh(), diffuseMaterial(glm::vec3(0.5f)),
                    glm::scale(glm::translate(glm::mat4(1), {0, 0.8f, 0}), {0.1f, 0.8f, 3}));
        for (int i = 0; i < count; ++i) {
            const auto at = static_cast<float>(i);
            Light lamp;
            lamp.type = i % 5 == 4 ? LightType::Spot : LightType::Point;
            lamp.direction = {0.3f, -1, 0};
            lamp.innerAngle = 0.3f;
            lamp.outerAngle = 0.9f;
            lamp.position = {8 * glm::fract(0.618034f * at) - 4, 0.4f + 2 * glm::fract(0.35f * at),
                             8 * glm::fract(0.414214f * at) - 4};
            lamp.intensity =
                (i == 7 ? 5.0f : 0.3f) * glm::vec3(1, 0.5f + 0.1f * static_cast<float>(i % 5), 0.6f);
            lamp.castsShadow = shadows;
            scene.lights.push_back(lamp);
        }
        Camera camera;
        camera.eye = {1.5f, 4, 5};
        camera.target = {0.2f, 0, 0};
        camera.fovY = 0.9f;
        scene.cameras = {camera};
        return scene;
    }
    // All asked one by one, or none of them.
    static Settings settings(bool exact, Component component = Component::Direct) {
        Settings settings = tracedSettings(Quality::Interactive, component);
        settings.light.exactLamps = exact ? 1000000 : 0;
        settings.light.shadowSize = 512;
        settings.traced.filterLevels = 0;
        return settings;
    }
    // relRMSE of means of 4x4 pixels.
    static double blockError(const Image& image, const Image& truth) {
        reference::MetricOptions options;
        options.flip = false;
        return reference::compareImages(image, truth, options).blockRelRmse;
    }
};

// Nothing in the way: what is drawn for nodes, and which candidates are kept, must come out right in the mean.
TEST_F(ManyLamps, MeanOfDrawsIsTheSumOverAllLamps) {
    const Scene scene = yard(300, false);
    const Image truth = draw(scene, settings(true));
    Settings drawn = settings(false);
    drawn.traced.passes = 16;
    const double few = relRmse(draw(scene, drawn), truth);
    drawn.traced.passes = 256;
    const Image many = draw(scene, drawn);
    EXPECT_NEAR(meanOf(many) / meanOf(truth), 1, 0.003);
    // Of independent draws the error falls to a quarter; these complement each other.
    EXPECT_LT(relRmse(many, truth), 0.4 * few);
    EXPECT_LT(relRmse(many, truth), 0.02);
}

TEST_F(ManyLamps, ShadowsAreThoseOfMaps) {
    const Scene scene = yard(60);
    const Image truth = draw(scene, settings(true));
    Settings drawn = settings(false);
    drawn.traced.passes = 128;
    const Image image = draw(scene, drawn);
    EXPECT_NEAR(meanOf(image) / meanOf(truth), 1, 0.005);
    EXPECT_LT(blockError(image, truth), 0.02);
    // The wall hides a good part of the light.
    EXPECT_GT(meanOf(draw(yard(60, false), settings(true))), 1.1 * meanOf(truth));
}

// Views beside the pixels' centres take what those have gathered.
TEST_F(ManyLamps, EdgesAreSmoothed) {
    const Scene scene = yard(60);
    Settings drawn = settings(false), exact = settings(true);
    drawn.traced.passes = 64;
    drawn.image.antialiasing = exact.image.antialiasing = 4;
    const Image truth = draw(scene, exact), image = draw(scene, drawn);
    EXPECT_NEAR(meanOf(image) / meanOf(truth), 1, 0.01);
    EXPECT_LT(blockError(image, truth), 0.03);
    exact.image.antialiasing = 0;
    EXPECT_GT(relRmse(draw(scene, exact), truth), 0.02);  // edges differ
}

// What faces hold, and so all light that comes by a bounce. Lamps nearer to the wall than three voxels are left out: asked
// one by one they light its faces by their triangles, drawn by chance at their middles.
TEST_F(ManyLamps, IndirectLightIsThatOfAllLamps) {
    Scene scene = yard(60);
    std::erase_if(scene.lights, [](const Light& lamp) { return std::abs(lamp.position.x) < 0.5f; });
    EXPECT_GT(scene.lights.size(), 48u);
    Settings exact = settings(true, Component::Indirect), drawn = settings(false, Component::Indirect);
    exact.traced.filterLevels = drawn.traced.filterLevels = 2;
    const Image truth = draw(scene, exact), image = draw(scene, drawn);
    EXPECT_NEAR(meanOf(image) / meanOf(truth), 1, 0.03);
    EXPECT_LT(blockError(image, truth), 0.1);
}

// A room without an opening, and 40 lamps outside.
TEST_F(ManyLamps, NoneShinesThroughAWall) {
    Scene scene = closedBox(diffuseMaterial(glm::vec3(0.7f)));
    for (int i = 0; i < 40; ++i) {
        Light lamp;
        lamp.type = LightType::Point;
        lamp.position =
            2.5f * glm::vec3(std::cos(0.7f * i), 0.05f * static_cast<float>(i) - 1, std::sin(0.7f * i));
        lamp.intensity = glm::vec3(20);
        scene.lights.push_back(lamp);
    }
    Settings drawn = settings(false, Component::Full);
    const Image image = draw(scene, drawn);
    const auto lit = [](const Image& one) {
        return std::count_if(one.pixels.begin(), one.pixels.end(),
                             [](const glm::vec4& pixel) { return pixel.g > 0; });
    };
    EXPECT_EQ(lit(image), 0);
    EXPECT_EQ(lit(draw(scene, settings(false, Component::Direct))), 0);
    for (Instance& instance : scene.instances) instance.castsShadow = false;
    EXPECT_GT(meanOf(draw(scene, drawn)), 0.1);
}

TEST_F(ManyLamps, MapsAreForOtherLights) {
    Scene scene = yard(2000);
    Renderer renderer;
    renderer.setScene(scene);
    Settings drawn = tracedSettings(Quality::Draft, Component::Full);
    const auto mapBytes = [&] {
        std::size_t bytes = 0;
        for (const MemoryStats& object : renderer.stats().memory)
            if (object.label == "shadow maps" || object.label == "shadow surfaces") bytes += object.bytes;
        return bytes;
    };
    EXPECT_GT(meanOf(draw(renderer, scene, drawn)), 0.01);
    EXPECT_LT(mapBytes(), 4096u);
    Light sun;
    sun.type = LightType::Directional;
    sun.direction = {0.2f, -1, 0.1f};
    renderer.setLights([&] {
        std::vector<Light> lights = scene.lights;
        lights.push_back(sun);
        return lights;
    }());
    const double lit = meanOf(draw(renderer, scene, drawn));
    EXPECT_GT(lit, 0.01);
    EXPECT_GT(mapBytes(), std::size_t{256} * 256 * 4);
    // Modes that have maps alone refuse what maps cannot hold.
    drawn.mode = Mode::Phong;
    drawn.phong.shadows = Toggle::On;
    EXPECT_THROW(draw(renderer, scene, drawn), Error);
}

// Nor does one that moves; the picture follows.
TEST_F(ManyLamps, OneMoreBuildsNoProgram) {
    Scene scene = io::generateScene("lamps?count=10000");
    Renderer renderer;
    renderer.setScene(scene);
    Settings drawn = tracedSettings(Quality::Draft, Component::Direct);
    draw(renderer, scene, drawn);
    const gl::ProgramCounts before = gl::programCounts();
    scene.lights.push_back(scene.lights.front());
    scene.lights.back().position = scene.cameras.front().eye + glm::vec3(-0.8f, 0.3f, -0.8f);
    scene.lights.back().intensity = glm::vec3(40);
    renderer.setLights(scene.lights);
    const Image more = draw(renderer, scene, drawn);
    const gl::ProgramCounts after = gl::programCounts();
    EXPECT_EQ(after.built, before.built);
    EXPECT_TRUE(more.pixels == draw(scene, drawn).pixels);
    scene.lights.back().intensity = glm::vec3(0);
    renderer.setLight(scene.lights.size() - 1, scene.lights.back());
    EXPECT_LT(meanOf(draw(renderer, scene, drawn)), 0.95 * meanOf(more));
}

// What casts shadows and is not in the voxels is seen by maps alone: all is as with few lamps.
TEST_F(ManyLamps, CastersOutsideVoxelsKeepMaps) {
    Scene scene = yard(40);
    scene.instances.back().voxelized = false;
    EXPECT_EQ(draw(scene, settings(false)).pixels, draw(scene, settings(true)).pixels);
}

// Frame by frame the picture goes to the one that is finished at once.
TEST_F(ManyLamps, FramesAddUp) {
    const Scene scene = yard(200);
    const Image truth = draw(scene, settings(true));
    Settings moving = settings(false);
    moving.traced.budgeted = true;
    moving.traced.passes = 64;
    Renderer renderer;
    renderer.setScene(scene);
    const double first = relRmse(draw(renderer, scene, moving), truth);
    double last = 0;
    for (int frame = 0; frame < 64; ++frame) last = relRmse(draw(renderer, scene, moving), truth);
    EXPECT_LT(last, 0.3 * first);
}

}  // namespace
}  // namespace conelight::test
