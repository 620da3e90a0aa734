// SPDX-License-Identifier: MIT
// Disks and spheres of light in the path tracer, in radiosity and in beams: closed forms, and the flux on all sides.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "conelight/error.h"
#include "reference/beam_scene.h"
#include "reference/lights.h"
#include "reference/radiosity_gather.h"
#include "support/truth_rig.h"

namespace conelight::test {
namespace {

using reference::Estimator;
using reference::LightSample;
using reference::LightTable;

constexpr double kPi = std::numbers::pi;

Light lamp(LightType type, const glm::vec3& position, float radius) {
    Light light;
    light.type = type;
    light.position = position;
    light.intensity = glm::vec3(2);
    light.halfU = {radius, 0, 0};
    light.halfV = {0, 0, radius};
    return light;
}

// Irradiance of a scene's one light by n^2 samples, without shadows.
double irradianceOf(const LightTable& table, const glm::vec3& at, const glm::vec3& normal, int n) {
    LightTable::Choice choice{};
    choice.probability[0] = 1;
    double sum = 0;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            LightSample s;
            const glm::vec2 u = (glm::vec2(x, y) + 0.5f) / static_cast<float>(n);
            if (!table.sample(choice, 0, at, 0.5f, u, s)) continue;
            const double cosine = std::max(glm::dot(s.toLight, normal), 0.0f);
            sum += static_cast<double>(s.radiance.g) * cosine / static_cast<double>(s.density);
        }
    return sum / (n * n);
}

double irradianceAt(const Scene& scene, const glm::vec3& point, Estimator estimator, int samples) {
    reference::PathTracerSettings settings;
    settings.samplesPerPixel = samples;
    settings.estimator = estimator;
    settings.bounces = 0;
    settings.filter = reference::PixelFilter::Box;
    return kPi *
           meanOf(reference::PathTracer(scene).render(cameraAbove(point, 0.1f, 0.001f), 8, 8, settings).full);
}

Scene floorUnder(const Light& light) {
    Scene scene;
    addInstance(scene, quadMesh({-10, 0, 10}, {20, 0, 0}, {0, 0, -20}), diffuseMaterial());
    scene.lights = {light};
    return scene;
}

// What arrives on a sphere about the lamp is its flux.
TEST(RoundLights, FluxArrivesOnAllSides) {
    for (const LightType type : {LightType::Disk, LightType::Sphere}) {
        Scene scene;
        scene.lights = {lamp(type, {0.3f, 0.2f, -0.1f}, 0.4f)};
        scene.lights[0].halfV.z = 0.25f;
        const LightTable table(scene, {}, true);
        constexpr int kPoints = 2000;
        constexpr float kRadius = 1.5f;
        double sum = 0;
        for (int i = 0; i < kPoints; ++i) {
            const double z = 1 - 2 * (i + 0.5) / kPoints, r = std::sqrt(1 - z * z),
                         phi = 2.399963229728653 * i;
            const glm::vec3 d(r * std::cos(phi), z, r * std::sin(phi));
            sum += irradianceOf(table, kRadius * d, -d, 8);
        }
        const double got = sum / kPoints * 4 * kPi * double(kRadius * kRadius);
        EXPECT_NEAR(got / static_cast<double>(radiantFlux(scene.lights[0])->g), 1, 2e-3)
            << static_cast<int>(type);
    }
}

// Below the middle: L pi r^2 / (r^2 + h^2) of a disk, L pi r^2 / h^2 of a sphere. Found by light samples, by rays that
// happen to meet the lamp, and by both.
TEST(RoundLights, AgreeWithClosedForms) {
    for (const LightType type : {LightType::Disk, LightType::Sphere}) {
        const Scene scene = floorUnder(lamp(type, {0, 1, 0}, 0.5f));
        const double truth = type == LightType::Disk ? 2 * kPi * 0.25 / 1.25 : 2 * kPi * 0.25;
        for (const Estimator estimator : {Estimator::Mis, Estimator::LightsOnly, Estimator::MaterialsOnly}) {
            const int samples = estimator == Estimator::MaterialsOnly ? 4096 : 256;
            EXPECT_NEAR(irradianceAt(scene, {0, 0, 0}, estimator, samples) / truth, 1, 0.01)
                << static_cast<int>(type) << ' ' << static_cast<int>(estimator);
        }
        Scene up = scene;
        up.lights[0].direction = {0, 1, 0};
        EXPECT_EQ(irradianceAt(up, {0, 0, 0}, Estimator::Mis, 16) > 0, type == LightType::Sphere);
    }
}

TEST(RoundLights, ASphereGivesNothingWithin) {
    const Scene scene = floorUnder(lamp(LightType::Sphere, {0, 0.3f, 0}, 0.5f));
    EXPECT_EQ(irradianceAt(scene, {0, 0, 0}, Estimator::Mis, 64), 0);
    EXPECT_GT(irradianceAt(scene, {0.6f, 0, 0}, Estimator::Mis, 64), 0);
}

// Beside a plate that throws a soft shadow, and in it.
TEST(RoundLights, RadiosityGivesWhatThePathTracerDoes) {
    for (const LightType type : {LightType::Disk, LightType::Sphere}) {
        Scene scene = floorUnder(lamp(type, {0.3f, 1, 0.1f}, 0.3f));
        addInstance(scene, quadMesh({-0.2f, 0.4f, 0.2f}, {0.4f, 0, 0}, {0, 0, -0.4f}), diffuseMaterial());
        const reference::RayScene rays(scene);
        const reference::RadiosityLights lights(scene, true);
        for (const float x : {-1.0f, -0.55f, 0.1f, 0.4f}) {
            std::uint64_t count = 0;
            const reference::Receiver at{{x, 0, 0}, {0, 1, 0}, {0, 1, 0}, true};
            const double got = lights.irradiance(rays, at, 1024, {true, false}, count).g;
            const double truth = irradianceAt(scene, {x, 0, 0}, Estimator::Mis, 512);
            EXPECT_NEAR(got / truth, 1, 0.02) << static_cast<int>(type) << ' ' << x;
        }
    }
}

// Beams end at flat lamps.
TEST(RoundLights, BeamsRefuseSpheres) {
    const Scene disk = floorUnder(lamp(LightType::Disk, {0, 1, 0}, 0.5f));
    EXPECT_NO_THROW(reference::BeamScene(disk, true, 4));
    const Scene sphere = floorUnder(lamp(LightType::Sphere, {0, 1, 0}, 0.5f));
    try {
        reference::BeamScene(sphere, true, 4);
        FAIL();
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(),
                     "mode beams: light '' is a sphere; a rect, a disk or a point would be right");
    }
}

}  // namespace
}  // namespace conelight::test
