// SPDX-License-Identifier: MIT
// Temporal accumulation: edges at rest, ghosts, flicker on the way, and what must not change.
#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include "conelight/renderer.h"
#include "support/gl_fixture.h"
#include "support/scenes.h"
#include "support/truth_rig.h"

namespace conelight::test {
namespace {

constexpr int kPixels = 64;
constexpr float kDistance = 4;

using TemporalPictureTest = GlTest;

Material unlitMaterial(const glm::vec3& radiance) {
    Material material;
    material.unlit = true;
    material.baseColor = glm::vec4(radiance, 1);
    return material;
}

Material diffuseMaterial(const glm::vec3& albedo) {
    Material material;
    material.baseColor = glm::vec4(albedo, 1);
    return material;
}

// Bright spokes, thinner than a pixel and up to three, before a dark wall. At the target's depth a pixel is 4 / 64 m.
Scene spokes(Material (*materialOf)(const glm::vec3&) = unlitMaterial) {
    Scene scene;
    addInstance(scene, quadMesh({-6, -6, -2}, {12, 0, 0}, {0, 12, 0}), materialOf(glm::vec3(0.05f)));
    for (int i = 0; i < 7; ++i) {
        const float width = 0.02f + 0.025f * static_cast<float>(i);
        const glm::mat4 turned =
            glm::rotate(glm::mat4(1), glm::radians(11.0f + 25.0f * static_cast<float>(i)), {0, 0, 1});
        addInstance(scene, quadMesh({0.3f, -0.5f * width, 0}, {1.5f, 0, 0}, {0, width, 0}),
                    materialOf({1, 0.8f, 0.6f}), turned);
    }
    Camera camera;
    camera.eye = {0, 0, kDistance};
    camera.fovY = 2 * std::atan(0.5f);
    scene.cameras = {camera};
    Light light;
    light.position = {1, 2, 3};
    light.intensity = glm::vec3(1);
    scene.lights = {light};
    return scene;
}

Settings settingsOf(Mode mode, bool temporal) {
    Settings settings;
    settings.mode = mode;
    settings.voxels.size = 32;
    settings.light.shadowSize = 64;
    settings.traced.budgeted = true;
    settings.image.temporal = temporal ? Toggle::On : Toggle::Off;
    return settings;
}

Image drawn(Renderer& renderer, const Camera& camera, const Settings& settings) {
    renderer.render(camera, kPixels, kPixels, settings);
    return renderer.readImage();
}

// The mean of 64 views.
Image truthOf(Renderer& renderer, const Camera& camera, Settings settings) {
    settings.image.temporal = Toggle::Off;
    settings.traced.budgeted = false;
    settings.image.antialiasing = 64;
    return drawn(renderer, camera, settings);
}

TEST_F(TemporalPictureTest, ARestingViewBecomesTheAntialiasedStillInEveryMode) {
    // Unlit surfaces are the same in every mode; lit ones have what the mode gathers, jittered with the view.
    for (const auto& [materialOf, name] : {std::pair{&unlitMaterial, "unlit"}, {&diffuseMaterial, "lit"}}) {
        const Scene scene = spokes(materialOf);
        const Camera& camera = scene.cameras.front();
        for (const Mode mode : {Mode::Phong, Mode::Cones, Mode::Hybrid, Mode::Traced}) {
            Renderer renderer;
            renderer.setScene(scene);
            const Image truth = truthOf(renderer, camera, settingsOf(mode, false));
            const double stairs = relRmse(drawn(renderer, camera, settingsOf(mode, false)), truth);
            Image smooth;
            for (int i = 0; i < 32; ++i) smooth = drawn(renderer, camera, settingsOf(mode, true));
            const double error = relRmse(smooth, truth);
            const std::string what = std::string(mode.name()) + " " + name;
            RecordProperty(what + " stairs", std::to_string(stairs));
            RecordProperty(what + " after 32 frames", std::to_string(error));
            EXPECT_LT(error, 0.15 * stairs) << what << ": " << error << ", without " << stairs;
        }
    }
}

TEST_F(TemporalPictureTest, TheFirstFrameAndOneAfterACutAreWithoutAPast) {
    const Scene scene = spokes();
    const Camera& camera = scene.cameras.front();
    Camera behind = camera;
    behind.target = {0.5f, 0, 2 * kDistance};
    Camera near = camera;
    near.eye.z = 3;
    Renderer renderer;
    renderer.setScene(scene);
    const Settings off = settingsOf(Mode::Phong, false), on = settingsOf(Mode::Phong, true);
    const Image still = drawn(renderer, camera, off);
    EXPECT_EQ(drawn(renderer, camera, on).pixels, still.pixels);
    EXPECT_NE(drawn(renderer, camera, on).pixels, still.pixels);
    drawn(renderer, behind, on);
    EXPECT_EQ(drawn(renderer, camera, on).pixels, still.pixels) << "after a cut";
    renderer.render(camera, 32, 32, on);
    EXPECT_EQ(drawn(renderer, camera, on).pixels, still.pixels) << "after another size";
    renderer.setScene(scene);
    EXPECT_EQ(drawn(renderer, camera, on).pixels, still.pixels) << "after another scene";
}

// One goes, another comes in its place, and a third moves: nobody takes the new one for the old one that moved.
TEST_F(TemporalPictureTest, AnObjectInThePlaceOfAnotherHasNoPast) {
    const Scene scene = spokes();
    const Camera& camera = scene.cameras.front();
    Renderer renderer;
    renderer.setScene(scene);
    const Settings off = settingsOf(Mode::Phong, false), on = settingsOf(Mode::Phong, true);
    for (int i = 0; i < 3; ++i) drawn(renderer, camera, on);
    Instance next = scene.instances[3], moved = scene.instances[5];
    renderer.removeInstance(3);
    next.worldFromObject = glm::translate(glm::mat4(1), {0.2f, 0, 0}) * next.worldFromObject;
    ASSERT_EQ(renderer.addInstance(next), 3u);
    moved.worldFromObject = glm::translate(glm::mat4(1), {0, 0.2f, 0}) * moved.worldFromObject;
    renderer.setInstance(5, moved);
    const Image picture = drawn(renderer, camera, on);
    EXPECT_EQ(picture.pixels, drawn(renderer, camera, off).pixels);
}

// What moves is in focus; little of it is left in a view that has rested for some frames.
TEST_F(TemporalPictureTest, ALensFocusesSoonAfterTheCameraStops) {
    const Scene scene = spokes();
    Camera camera = scene.cameras.front(), pinhole = camera;
    camera.lensDiameter = 0.5f;
    camera.focusDistance = 0.5f * kDistance;
    Renderer renderer;
    renderer.setScene(scene);
    const Settings off = settingsOf(Mode::Phong, false), on = settingsOf(Mode::Phong, true);
    const Image truth = truthOf(renderer, camera, off);
    const double inFocus = relRmse(truthOf(renderer, pinhole, off), truth);
    Image picture;
    for (int i = 0; i < 40; ++i) {
        Camera now = camera;
        now.eye.x += 0.01f * static_cast<float>(std::max(16 - i, 0));
        picture = drawn(renderer, now, on);
    }
    EXPECT_LT(relRmse(picture, truth), 0.3 * inFocus) << inFocus;
}

TEST_F(TemporalPictureTest, TheSameCallsGiveTheSameBits) {
    const Scene scene = spokes();
    Image images[2];
    for (Image& image : images) {
        Renderer renderer;
        renderer.setScene(scene);
        Camera camera = scene.cameras.front();
        for (int i = 0; i < 6; ++i) {
            image = drawn(renderer, camera, settingsOf(Mode::Traced, true));
            if (i > 2) camera.eye.x += 0.02f;
        }
    }
    EXPECT_EQ(images[0].pixels, images[1].pixels);
}

// A bright square crosses a dark wall, 1.5 pixels a frame.
TEST_F(TemporalPictureTest, AMovingObjectLeavesNothingBehind) {
    Scene scene;
    addInstance(scene, quadMesh({-6, -6, -0.5f}, {12, 0, 0}, {0, 12, 0}), unlitMaterial(glm::vec3(0.05f)));
    constexpr float kEdge = 0.5f, kStep = 1.5f * 4 / kPixels;
    const std::size_t square = addInstance(scene, quadMesh({-1.9f, -0.25f, 0}, {kEdge, 0, 0}, {0, kEdge, 0}),
                                           unlitMaterial(glm::vec3(1)));
    Camera camera;
    camera.eye = {0, 0, kDistance};
    camera.fovY = 2 * std::atan(0.5f);
    const Settings on = settingsOf(Mode::Phong, true);
    Renderer renderer;
    renderer.setScene(scene);
    Instance moving = scene.instances[square];
    constexpr int kFrames = 24;
    Image image;
    for (int i = 0; i < kFrames; ++i) {
        moving.worldFromObject = glm::translate(glm::mat4(1), {kStep * static_cast<float>(i), 0, 0});
        renderer.setInstance(square, moving);
        image = drawn(renderer, camera, on);
    }
    // Where its left edge is now, and an object's width behind.
    const float left = (-1.9f + kStep * (kFrames - 1) + 2) * kPixels / 4;
    const int end = static_cast<int>(left - kEdge * kPixels / 4);
    float ghost = 0, close = 0;
    for (int y = 0; y < kPixels; ++y)
        for (int x = 0; x < static_cast<int>(left) - 1; ++x) {
            const float over =
                std::abs(image.pixels[static_cast<std::size_t>(y * kPixels + x)].r - 0.05f) / 0.95f;
            close = std::max(close, over);
            if (x < end) ghost = std::max(ghost, over);
        }
    RecordProperty("ghost", std::to_string(ghost));
    EXPECT_LT(ghost, 0.005f);
    EXPECT_LT(close, 0.05f) << "right behind it";
    // And it is still there.
    const auto inside = static_cast<std::size_t>(kPixels / 2 * kPixels) + static_cast<std::size_t>(left + 3);
    EXPECT_NEAR(image.pixels[inside].r, 1, 1e-3);
}

double flickerOf(const std::vector<Image>& pictures, const std::vector<Image>& truths) {
    double square = 0, mean = 0, count = 0;
    for (std::size_t f = 1; f < pictures.size(); ++f)
        for (std::size_t i = 0; i < pictures[f].pixels.size(); ++i) {
            const double now = pictures[f].pixels[i].g - truths[f].pixels[i].g;
            const double before = pictures[f - 1].pixels[i].g - truths[f - 1].pixels[i].g;
            square += (now - before) * (now - before);
            mean += truths[f].pixels[i].g;
            ++count;
        }
    return std::sqrt(square / count) / (mean / count);
}

// A tenth of a pixel a frame: error that comes and goes from frame to frame. Parallel rays see as much at the target.
void expectLessFlicker(float orthographicHeight) {
    Scene scene = spokes();
    scene.cameras.front().orthographicHeight = orthographicHeight;
    Renderer renderer, plain;
    renderer.setScene(scene);
    plain.setScene(scene);
    std::vector<Image> smooth, stairs, truths;
    double error = 0, errorBefore = 0;
    for (int i = 0; i < 24; ++i) {
        Camera camera = scene.cameras.front();
        camera.eye.x += 0.1f * 4 / kPixels * static_cast<float>(i);
        camera.target.x = camera.eye.x;
        const Image now = drawn(renderer, camera, settingsOf(Mode::Phong, true));
        if (i < 8) continue;
        smooth.push_back(now);
        stairs.push_back(drawn(plain, camera, settingsOf(Mode::Phong, false)));
        truths.push_back(truthOf(plain, camera, settingsOf(Mode::Phong, false)));
        error += relRmse(smooth.back(), truths.back());
        errorBefore += relRmse(stairs.back(), truths.back());
    }
    const double with = flickerOf(smooth, truths), without = flickerOf(stairs, truths);
    const std::string kind = orthographicHeight > 0 ? " by parallel rays" : "";
    testing::Test::RecordProperty("flicker" + kind,
                                  std::to_string(with) + ", without " + std::to_string(without));
    testing::Test::RecordProperty(
        "error" + kind, std::to_string(error / 16) + ", without " + std::to_string(errorBefore / 16));
    EXPECT_LT(with, 0.4 * without);
    EXPECT_LT(error, 0.75 * errorBefore);
}

TEST_F(TemporalPictureTest, ThinThingsFlickerLessWhileTheCameraMoves) {
    expectLessFlicker(0);
    expectLessFlicker(4);
}

// Of a shape that has changed twice since the last picture nobody knows where its points were; of one that has changed
// once its vertices tell.
void expectNothingBehindAJump(int changes) {
    Scene scene;
    addInstance(scene, quadMesh({-6, -6, -2}, {12, 0, 0}, {0, 12, 0}), unlitMaterial(glm::vec3(0.05f)));
    const std::size_t sheet =
        addInstance(scene, quadMesh({-1.5f, -1, 0}, {1, 0, 0}, {0, 2, 0}), unlitMaterial(glm::vec3(1)));
    Camera camera;
    camera.eye = {0, 0, kDistance};
    camera.fovY = 2 * std::atan(0.5f);
    Renderer renderer;
    renderer.setScene(scene);
    const Settings on = settingsOf(Mode::Phong, true);
    for (int i = 0; i < 8; ++i) drawn(renderer, camera, on);
    for (int i = 1; i <= changes; ++i) {
        const float to = 0.5f - 0.7f * static_cast<float>(changes - i);
        renderer.setMesh(static_cast<std::size_t>(scene.instances[sheet].mesh),
                         quadMesh({to, -1, 0}, {1, 0, 0}, {0, 2, 0}));
    }
    const Image image = drawn(renderer, camera, on);
    const auto redAt = [&](float x) {
        return image
            .pixels[static_cast<std::size_t>(kPixels / 2 * kPixels) +
                    static_cast<std::size_t>((x + 2) * kPixels / 4)]
            .r;
    };
    EXPECT_NEAR(redAt(-1), 0.05f, 1e-3) << changes;
    EXPECT_NEAR(redAt(1), 1, 1e-3) << changes;
}

TEST_F(TemporalPictureTest, AShapeThatJumpsLeavesNothingBehind) {
    expectNothingBehindAJump(1);
    expectNothingBehindAJump(2);
}

// The levels that it moves hold the same scene.
TEST_F(TemporalPictureTest, AnAnchorOfVoxelsMayMove) {
    const Scene scene = spokes();
    const auto last = [&](bool moves) {
        Renderer renderer;
        renderer.setScene(scene);
        Settings on = settingsOf(Mode::Phong, true);
        Image image;
        for (int i = 0; i < 4; ++i) {
            if (moves) on.voxels.anchor = VoxelAnchor::at({static_cast<float>(i), 0, 0});
            image = drawn(renderer, scene.cameras.front(), on);
        }
        return image;
    };
    EXPECT_EQ(last(true).pixels, last(false).pixels);
}

TEST_F(TemporalPictureTest, OffItKeepsNoMemory) {
    const Scene scene = spokes();
    Renderer renderer;
    renderer.setScene(scene);
    const auto bytes = [&](bool temporal) {
        drawn(renderer, scene.cameras.front(), settingsOf(Mode::Phong, temporal));
        drawn(renderer, scene.cameras.front(), settingsOf(Mode::Phong, temporal));
        std::size_t sum = 0;
        for (const MemoryStats& object : renderer.stats().memory) sum += object.bytes;
        return sum;
    };
    const std::size_t before = bytes(false), with = bytes(true), after = bytes(false);
    EXPECT_GE(with, before + 40u * kPixels * kPixels);
    EXPECT_EQ(after, before);
}

TEST_F(TemporalPictureTest, PicturesOfSurfacesAreAsBefore) {
    const Scene scene = spokes();
    Renderer renderer;
    renderer.setScene(scene);
    for (const Component component : {Component::Normal, Component::Depth, Component::Albedo}) {
        Settings off = settingsOf(Mode::Phong, false), on = settingsOf(Mode::Phong, true);
        off.component = on.component = component;
        const Image plain = drawn(renderer, scene.cameras.front(), off);
        for (int i = 0; i < 3; ++i)
            EXPECT_EQ(drawn(renderer, scene.cameras.front(), on).pixels, plain.pixels);
    }
}

}  // namespace
}  // namespace conelight::test
