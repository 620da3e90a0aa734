// SPDX-License-Identifier: MIT
// Surroundings as pictures: where directions lie, light that is kept, draws in proportion to it, the path
// tracer's light of them, the sun that is split off, files and generated skies.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "conelight/error.h"
#include "io/environment_file.h"
#include "io/gltf.h"
#include "io/gltf_write.h"
#include "io/image_file.h"
#include "io/scene_stream.h"
#include "reference/path_tracer.h"
#include "scene/surroundings.h"
#include "support/environments.h"
#include "support/scenes.h"
#include "support/truth_rig.h"

namespace conelight::test {
namespace {

double brightness(const glm::vec3& c) { return static_cast<double>(c.r + c.g + c.b) / 3; }

Scene under(std::shared_ptr<const EnvironmentImage> image, float rotation = 0, float strength = 1) {
    Scene scene;
    scene.environment = {"test", std::move(image), rotation, strength};
    return scene;
}

double flux(const EnvironmentImage& image) {
    double sum = 0;
    for (std::size_t i = 0; i < image.radiance.size(); ++i)
        sum +=
            brightness(image.radiance[i]) * scene::texelSolidAngle(image, static_cast<int>(i) / image.width);
    return sum;
}

// f over all directions, by a fine grid.
template <class F>
double integral(const F& f, int rows = 512) {
    double sum = 0;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < 2 * rows; ++x) {
            const glm::vec3 d =
                environmentDirection({(static_cast<float>(x) + 0.5f) / static_cast<float>(2 * rows),
                                      (static_cast<float>(y) + 0.5f) / static_cast<float>(rows)});
            const double solidAngle =
                std::numbers::pi / rows *
                (std::cos(std::numbers::pi * y / rows) - std::cos(std::numbers::pi * (y + 1) / rows));
            sum += f(d) * solidAngle;
        }
    return sum;
}

TEST(Environment, PlacesOfDirections) {
    const auto expectAt = [](const glm::vec3& direction, const glm::vec2& uv) {
        EXPECT_NEAR(glm::length(environmentUv(direction) - uv), 0, 1e-6);
    };
    expectAt({0, 0, -1}, {0.5f, 0.5f});
    expectAt({1, 0, 0}, {0.75f, 0.5f});
    expectAt({-1, 0, 0}, {0.25f, 0.5f});
    EXPECT_NEAR(environmentUv({0, 1, 0}).y, 0, 1e-6);
    EXPECT_NEAR(environmentUv({0, -1, 0}).y, 1, 1e-6);
    for (const glm::vec3 raw : {glm::vec3(1, 2, 3), glm::vec3(-4, 1, 0.5f), glm::vec3(0.1f, -3, -2)}) {
        const glm::vec3 d = glm::normalize(raw);
        EXPECT_NEAR(glm::length(environmentDirection(environmentUv(d)) - d), 0, 1e-6);
    }
    // Turned counter-clockwise as seen from above: what was seen ahead is seen to the left.
    auto image = evenEnvironment(64, glm::vec3(0));
    for (int y = 0; y < 32; ++y)
        for (int x = 31; x < 33; ++x) image->radiance[static_cast<std::size_t>(64 * y + x)] = glm::vec3(1);
    const scene::Surroundings turned(under(image, static_cast<float>(std::numbers::pi / 2), 3));
    EXPECT_NEAR(turned.radiance({-1, 0, 0}).r, 3, 1e-3);
    EXPECT_EQ(turned.radiance({0, 0, -1}).r, 0);
}

TEST(Environment, OtherSizesKeepTheLight) {
    const auto image = sunnyEnvironment(128);
    for (const glm::ivec2 size :
         {glm::ivec2(64, 32), glm::ivec2(100, 37), glm::ivec2(1, 1), glm::ivec2(300, 150)})
        EXPECT_NEAR(flux(scene::resampled(*image, size.x, size.y)) / flux(*image), 1, 1e-5) << size.x;
}

TEST(Environment, DrawsFollowTheLight) {
    const Scene scene = under(sunnyEnvironment(128), 1.0f, 2.0f);
    const scene::Surroundings surroundings(scene);
    EXPECT_NEAR(integral([&](const glm::vec3& d) { return surroundings.density(d); }), 1, 1e-3);
    double estimate = 0;
    constexpr int kDraws = 4096;
    for (int i = 0; i < kDraws; ++i) {
        const glm::vec2 u(static_cast<float>(i) / kDraws,
                          std::fmod(static_cast<float>(i) * 0.61803399f, 1.0f));
        const auto draw = surroundings.draw(u);
        ASSERT_GT(draw.density, 0);
        EXPECT_NEAR(glm::length(draw.direction), 1, 1e-5);
        estimate += brightness(surroundings.radiance(draw.direction)) / static_cast<double>(draw.density);
    }
    const double all =
        integral([&](const glm::vec3& d) { return brightness(surroundings.radiance(d)); }, 1024);
    EXPECT_NEAR(estimate / kDraws / all, 1, 0.03);
}

// A texel of 10^5 : 1 costs the path tracer no noise to speak of.
TEST(Environment, ThePathTracerFindsASmallSun) {
    Scene scene = under(sunnyEnvironment(128), 0.5f);
    addInstance(scene, quadMesh({-10, 0, 10}, {20, 0, 0}, {0, 0, -20}), diffuseMaterial(glm::vec3(0.6f)));
    const scene::Surroundings surroundings(scene);
    const double irradiance = integral(
        [&](const glm::vec3& d) {
            return brightness(surroundings.radiance(d)) * std::max(static_cast<double>(d.y), 0.0);
        },
        1024);
    for (const auto estimator : {reference::Estimator::Mis, reference::Estimator::LightsOnly}) {
        reference::PathTracerSettings settings;
        settings.samplesPerPixel = 256;
        settings.estimator = estimator;
        const auto picture =
            reference::PathTracer(scene).render(cameraAbove({0, 0, 0}, 2, 1), 8, 8, settings);
        EXPECT_NEAR(meanOf(picture.diffuse) / (0.6 * irradiance / std::numbers::pi), 1, 0.01);
        double least = 1e30, most = 0;
        for (const glm::vec4& pixel : picture.diffuse.pixels) {
            least = std::min(least, static_cast<double>(pixel.r));
            most = std::max(most, static_cast<double>(pixel.r));
        }
        EXPECT_LT(most / least, 1.2);
    }
}

TEST(Environment, TheSunBecomesALight) {
    Scene scene = under(sunnyEnvironment(128), 0.7f, 0.5f);
    const scene::Surroundings before(scene);
    const auto irradianceOn = [](const scene::Surroundings& s, const glm::vec3& n) {
        return integral([&](const glm::vec3& d) {
            return brightness(s.radiance(d)) * std::max(static_cast<double>(glm::dot(d, n)), 0.0);
        });
    };
    ASSERT_TRUE(splitSun(scene));
    ASSERT_EQ(scene.lights.size(), 1u);
    const Light& sun = scene.lights[0];
    const scene::Surroundings after(scene);
    EXPECT_LT(brightness(after.radiance(-sun.direction)), 2);
    EXPECT_GT(brightness(before.radiance(-sun.direction)), 1e3);
    for (const glm::vec3 n : {glm::vec3(0, 1, 0), glm::normalize(glm::vec3(1, 1, 1)), glm::vec3(-1, 0, 0)}) {
        const double fromSun =
            brightness(sun.intensity) * std::max(-static_cast<double>(glm::dot(sun.direction, n)), 0.0);
        EXPECT_NEAR((irradianceOn(after, n) + fromSun) / irradianceOn(before, n), 1, 0.02);
    }
    Scene even = under(evenEnvironment(64, glm::vec3(1)));
    EXPECT_FALSE(splitSun(even));
    EXPECT_TRUE(even.lights.empty());
}

TEST(Environment, GeneratedSkies) {
    // Noon at the equinox: the sun stands as far from the zenith as the place from the equator, in the south.
    const io::LoadedEnvironment noon = io::loadEnvironment("builtin:sky?latitude=48&day=81&hour=12");
    ASSERT_TRUE(noon.sun);
    EXPECT_NEAR(glm::degrees(std::asin(-noon.sun->direction.y)), 42, 0.1);
    EXPECT_LT(noon.sun->direction.z, 0);
    EXPECT_NEAR(noon.sun->direction.x, 0, 1e-5);
    // It rises in the east, redder.
    const io::LoadedEnvironment morning = io::loadEnvironment("builtin:sky?latitude=48&day=81&hour=6.5");
    EXPECT_LT(morning.sun->direction.x, -0.9);
    EXPECT_GT(morning.sun->intensity.r, 2 * morning.sun->intensity.b);
    EXPECT_NEAR(noon.sun->intensity.r / noon.sun->intensity.b, 1.2, 0.2);
    // Blue above, brighter beside the sun than away from it.
    const scene::Surroundings sky(under(noon.environment.image));
    EXPECT_GT(sky.radiance({0, 1, 0}).b, 1.5f * sky.radiance({0, 1, 0}).r);
    EXPECT_GT(brightness(sky.radiance(-noon.sun->direction)),
              3 * brightness(sky.radiance(glm::normalize(glm::vec3(0, 1, -1)))));
    // A clear day gives about 100,000 lux.
    const double lux =
        683 * (integral([&](const glm::vec3& d) {
                   return d.y > 0 ? brightness(sky.radiance(d)) * static_cast<double>(d.y) : 0.0;
               }) -
               brightness(noon.sun->intensity) * static_cast<double>(noon.sun->direction.y));
    EXPECT_GT(lux, 5e4);
    EXPECT_LT(lux, 1.2e5);
    EXPECT_THROW(io::loadEnvironment("builtin:sky?hour=25"), Error);
    EXPECT_THROW(io::loadEnvironment("builtin:sky?hours=9"), Error);
    EXPECT_THROW(io::loadEnvironment("builtin:moon"), Error);
    EXPECT_FALSE(io::loadEnvironment("builtin:studio").sun);
}

// From noon to midnight: hour by hour the sky and its sun give the ground less, and never nothing; the
// sun leaves as its disc sinks.
TEST(Environment, LightFallsFromNoonToNight) {
    double last = 1e9, lastSun = 1e9;
    double luxAt[2] = {0, 0};
    for (const double hour :
         {12.0, 15.0, 17.0, 17.5, 17.75, 18.0, 18.25, 18.5, 18.75, 19.0, 19.5, 20.0, 24.0}) {
        const io::LoadedEnvironment loaded =
            io::loadEnvironment("builtin:sky?latitude=0&day=81&hour=" + std::to_string(hour));
        const auto& texels = loaded.environment.image->radiance;
        EXPECT_TRUE(std::all_of(texels.begin(), texels.end(), [](const glm::vec3& texel) {
            return std::isfinite(texel.r + texel.g + texel.b) &&
                   glm::all(glm::greaterThan(texel, glm::vec3(0)));
        })) << hour;
        const scene::Surroundings sky(under(loaded.environment.image));
        const double fromSky =
            683 * integral([&](const glm::vec3& d) {
                return d.y > 0 ? brightness(sky.radiance(d)) * static_cast<double>(d.y) : 0.0;
            });
        const double sun = loaded.sun ? -683 * brightness(loaded.sun->intensity) *
                                            static_cast<double>(loaded.sun->direction.y)
                                      : 0;
        EXPECT_GT(fromSky, 1e-4) << hour;
        EXPECT_LE(fromSky + sun, 1.001 * last) << hour;
        EXPECT_LE(sun, lastSun) << hour;
        EXPECT_EQ(loaded.sun.has_value(), hour < 18.02) << hour;
        // On the equator at the equinox the sun sinks by 15 degrees an hour.
        if (hour == 18.25) luxAt[0] = fromSky;
        if (hour == 20) luxAt[1] = fromSky;
        last = fromSky + sun;
        lastSun = sun;
    }
    // The circular's 71 lux at -3.75 degrees, and a night of 0.0006.
    EXPECT_NEAR(luxAt[0], 50, 25);
    EXPECT_NEAR(luxAt[1], 6.5e-4, 2e-4);
}

class EnvironmentFiles : public testing::Test {
  protected:
    void SetUp() override {
        folder_ =
            std::filesystem::temp_directory_path() / ("conelight_environment_" + std::to_string(getpid()));
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }
    std::string written(const char* name, int width, int height, float value) const {
        io::FloatImage image{
            width, height, 3, std::vector<float>(static_cast<std::size_t>(3 * width * height), 1), {}, {}};
        image.pixels[4] = value;
        const std::string path = (folder_ / name).string();
        path.ends_with(".exr") ? io::writeExr(path, image) : io::writeHdr(path, image);
        return path;
    }
    static std::string refusal(const std::string& path) {
        try {
            io::loadEnvironment(path);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }
    std::filesystem::path folder_;
};

TEST_F(EnvironmentFiles, AreReadOrRefusedWithOneLine) {
    for (const char* name : {"a.exr", "a.hdr"}) {
        const io::LoadedEnvironment loaded = io::loadEnvironment(written(name, 16, 8, 0.5f));
        EXPECT_EQ(loaded.environment.image->width, 16);
        EXPECT_NEAR(loaded.environment.image->radiance[1].g, 0.5f, 0.01f);
    }
    EXPECT_EQ(io::loadEnvironment(written("n.exr", 16, 8, -1)).environment.image->radiance[1].g, 0);
    EXPECT_NE(refusal(written("square.exr", 8, 8, 1)).find("twice as wide as high"), std::string::npos);
    EXPECT_NE(refusal(written("nan.exr", 16, 8, NAN)).find("pixel (1, 0) is not finite"), std::string::npos);
    EXPECT_NE(refusal((folder_ / "no.exr").string()).find("no.exr"), std::string::npos);
    EXPECT_NE(refusal((folder_ / "no.txt").string()).find(".exr"), std::string::npos);
}

TEST_F(EnvironmentFiles, ScenesKeepTheirSurroundings) {
    Scene scene = under(sunnyEnvironment(32), 0.25f, 1.5f);
    addInstance(scene, quadMesh({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), diffuseMaterial());
    const auto expectKept = [&](const Scene& read) {
        ASSERT_TRUE(read.environment.image);
        EXPECT_EQ(read.environment.image->radiance, scene.environment.image->radiance);
        EXPECT_EQ(read.environment.rotation, 0.25f);
        EXPECT_EQ(read.environment.strength, 1.5f);
        EXPECT_EQ(read.environment.file, scene.environment.file);
    };
    expectKept(io::sceneFromBytes(io::bytesFromScene(scene)));
    for (const char* name : {"a.glb", "a.gltf"}) {
        const std::string path = (folder_ / name).string();
        io::writeGltf(path, scene, true);
        expectKept(io::loadScene(path));
    }
    scene.environment = io::loadEnvironment("builtin:studio").environment;
    scene.environment.rotation = 0.25f;
    scene.environment.strength = 1.5f;
    io::writeGltf((folder_ / "b.glb").string(), scene, true);
    expectKept(io::loadScene((folder_ / "b.glb").string()));
    EXPECT_LT(std::filesystem::file_size(folder_ / "b.glb"), 10000u);
}

}  // namespace
}  // namespace conelight::test
