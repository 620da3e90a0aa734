// SPDX-License-Identifier: MIT
// Memory that OpenGL objects may take: refused before the driver is asked, pictures made with less, and what is
// said when the driver itself has no more, or has lost the context.
#include "gl/storage.h"

#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

#include "conelight/memory.h"
#include "conelight/renderer.h"
#include "light/shadow_layout.h"
#include "platform/context_health.h"
#include "scene/gpu_lights.h"
#include "support/gl_fixture.h"
#include "support/scenes.h"

namespace conelight::test {
namespace {

constexpr std::size_t kMegabyte = std::size_t{1} << 20;
constexpr int kPixels = 32;

struct MemoryLimitTest : public GlTest {
    std::vector<std::string> warnings;

    void SetUp() override {
        GlTest::SetUp();
        setLogCallback([this](LogLevel level, std::string_view text) {
            if (level == LogLevel::Warning) warnings.emplace_back(text);
        });
    }
    void TearDown() override {
        setLogCallback({});
        setMemoryLimit(0);
        GlTest::TearDown();
    }

    // A room, its lamp and `lights` more of all kinds.
    static Scene room(int lights = 0) {
        Scene scene;
        addInstance(scene, boxMesh(), diffuseMaterial(glm::vec3(0.6f)),
                    glm::scale(glm::translate(glm::mat4(1), {0.2f, -0.8f, 0}), glm::vec3(0.4f)));
        addInstance(scene, quadMesh({-3, -1, 3}, {6, 0, 0}, {0, 0, -6}), diffuseMaterial(glm::vec3(0.5f)));
        scene.lights.push_back({.intensity = glm::vec3(4), .position = {0.5f, 1.5f, 0.5f}});
        for (int i = 0; i < lights; ++i) {
            Light light;
            light.type = i % 3 == 0 ? LightType::Point : i % 3 == 1 ? LightType::Spot : LightType::Rect;
            light.position = {-2.5f + 0.05f * static_cast<float>(i % 100), 1.5f,
                              -2.0f + 1.5f * static_cast<float>(i / 100)};
            light.direction = {0, -1, 0};
            light.intensity = glm::vec3(0.02f);
            scene.lights.push_back(light);
        }
        Camera camera;
        camera.eye = {0, 1, 2.5f};
        camera.target = {0, -1, 0};
        scene.cameras = {camera};
        return scene;
    }
    static Settings settings(Mode mode) {
        Settings settings;
        settings.mode = mode;
        settings.voxels.size = 64;
        settings.light.shadowSize = 256;
        settings.light.areaSamples = 1;
        settings.traced.passes = 1;
        settings.traced.cacheUpdates = 2;
        return settings;
    }
    static Image draw(Renderer& renderer, const Scene& scene, const Settings& settings) {
        renderer.setScene(scene);
        renderer.render(scene.cameras.at(0), kPixels, kPixels, settings);
        return renderer.readImage();
    }
};

std::string failureOf(const std::function<void()>& call) {
    try {
        call();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Runtime);
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        return error.what();
    }
    return {};
}

TEST_F(MemoryLimitTest, WhatIsBeyondIsNotAskedFor) {
    setMemoryLimit(gl::liveBytes() + kMegabyte);
    const std::size_t before = gl::liveObjectCount();
    const std::string failure = failureOf([] { gl::Buffer(2 * kMegabyte, "too much"); });
    EXPECT_NE(failure.find("'too much' of 2.0 MiB does not fit into the limit of 1 MiB"), std::string::npos)
        << failure;
    EXPECT_NE(failureOf([] { gl::Texture({GL_TEXTURE_2D, GL_RGBA32F, 512, 512}, "picture"); }), "");
    EXPECT_EQ(gl::liveObjectCount(), before);
    // What is left goes, what is freed comes back.
    gl::Buffer half(kMegabyte / 2, "half");
    EXPECT_NE(failureOf([] { gl::Buffer(kMegabyte, "no longer"); }), "");
    half = {};
    EXPECT_EQ(failureOf([] { gl::Buffer(kMegabyte, "again"); }), "");
    setMemoryLimit(0);
    EXPECT_EQ(failureOf([] { gl::Buffer(2 * kMegabyte, "without limit"); }), "");
}

TEST_F(MemoryLimitTest, PicturesAreDrawnWithLess) {
    for (const Mode mode : {Mode::Traced, Mode::Cones, Mode::Phong}) {
        std::size_t whole = 0;
        setMemoryLimit(0);
        {
            Renderer free;
            draw(free, room(), settings(mode));
            whole = gl::liveBytes();
        }
        warnings.clear();
        setMemoryLimit(whole * 3 / 4);
        Renderer renderer;
        const Image image = draw(renderer, room(), settings(mode));
        EXPECT_LE(gl::liveBytes(), memoryLimit()) << mode.name();
        ASSERT_EQ(warnings.size(), 1u) << mode.name();
        EXPECT_NE(warnings[0].find(" instead of "), std::string::npos) << warnings[0];
        // The next picture knows, and is the same; one without need of it is whole again.
        renderer.render(room().cameras.at(0), kPixels, kPixels, settings(mode));
        EXPECT_EQ(renderer.readImage().pixels, image.pixels) << mode.name();
        EXPECT_EQ(warnings.size(), 1u);
        Settings small = settings(mode);
        small.voxels.size = 16;
        small.light.shadowSize = 64;
        small.cones.storage = VolumeStorage::Octree;
        renderer.render(room().cameras.at(0), kPixels, kPixels, small);
        EXPECT_EQ(warnings.size(), 1u) << mode.name();
    }
}

TEST_F(MemoryLimitTest, WhatCannotFitIsOneLine) {
    setMemoryLimit(kMegabyte);
    Renderer renderer;
    const Scene scene = room();
    renderer.setScene(scene);
    const std::string failure =
        failureOf([&] { renderer.render(scene.cameras.at(0), 512, 512, settings(Mode::Traced)); });
    EXPECT_NE(failure.find("does not fit into the limit of 1 MiB"), std::string::npos) << failure;
    // It goes on with a picture that fits.
    EXPECT_EQ(failureOf([&] {
                  Settings phong = settings(Mode::Phong);
                  phong.light.shadowSize = 0;
                  renderer.render(scene.cameras.at(0), 16, 16, phong);
              }),
              "");
}

// 300 lights would take 3 GB at 1024 texels.
TEST_F(MemoryLimitTest, ManyLightsShareTheMemoryOfShadowMaps) {
    for (const int count : {1, 30, 300}) {
        std::vector<gpu::Light> lights = scene::packedLights(room(count).lights);
        const Aabb bounds{glm::vec3(-4), glm::vec3(4)};
        const light::ShadowLayout layout = light::layOutShadows(bounds, bounds, LightSettings{}, lights);
        EXPECT_LE(layout.bytes(layout.size), light::kMostShadowBytes) << count;
        if (count < 300) {
            EXPECT_EQ(layout.size, 1024) << count;
        } else {
            EXPECT_LT(layout.size, 1024);
            EXPECT_GT(layout.bytes(layout.size + 8), light::kMostShadowBytes);  // as large as fits
        }
    }
    std::vector<gpu::Light> lights = scene::packedLights(room(3000).lights);
    const std::string failure = failureOf([&] { light::layOutShadows({}, {}, LightSettings{}, lights); });
    EXPECT_NE(failure.find("3001 lights cast shadows"), std::string::npos) << failure;
    LightSettings unshadowed;
    unshadowed.shadowSize = 0;
    EXPECT_EQ(light::layOutShadows({}, {}, unshadowed, lights).layers, 0);
}

TEST_F(MemoryLimitTest, ThreeHundredLightsAreDrawn) {
    Renderer renderer;
    Settings wanted = settings(Mode::Phong);
    wanted.phong.shadows = Toggle::On;
    wanted.light.shadowSize = 1024;
    const Image image = draw(renderer, room(300), wanted);
    std::size_t maps = 0;
    for (const MemoryStats& object : renderer.stats().memory)
        if (object.label == "shadow maps" || object.label == "shadow surfaces") maps += object.bytes;
    EXPECT_LE(maps, light::kMostShadowBytes);
    EXPECT_GT(maps, light::kMostShadowBytes / 2);
    float sum = 0;
    for (const glm::vec4& pixel : image.pixels) {
        ASSERT_TRUE(std::isfinite(pixel.g));
        sum += pixel.g;
    }
    EXPECT_GT(sum, 1);
}

// The driver's own end of memory, and a lost context, as a driver tells them.
TEST_F(MemoryLimitTest, TheDriversTroubleIsSaid) {
    EXPECT_EQ(failureOf([&] { platform::requireHealthyContext(); }), "");
    static int pending = 0;
    const auto realError = epoxy_glGetError;
    pending = 1;
    epoxy_glGetError = []() -> GLenum { return pending-- > 0 ? GL_OUT_OF_MEMORY : GL_NO_ERROR; };
    EXPECT_NE(failureOf([&] { platform::requireHealthyContext(); }).find("out of memory"), std::string::npos);
    epoxy_glGetError = realError;

    const auto realStatus = epoxy_glGetGraphicsResetStatus;
    Renderer renderer;
    const Scene scene = room();
    renderer.setScene(scene);
    epoxy_glGetGraphicsResetStatus = []() -> GLenum { return GL_GUILTY_CONTEXT_RESET; };
    EXPECT_NE(failureOf([&] { platform::requireHealthyContext(); }).find("context is lost"),
              std::string::npos);
    EXPECT_NE(failureOf([&] {
                  renderer.render(scene.cameras.at(0), 8, 8, settings(Mode::Phong));
              }).find("context is lost, reset by what it was asked to do"),
              std::string::npos);
    epoxy_glGetGraphicsResetStatus = realStatus;
}

}  // namespace
}  // namespace conelight::test
