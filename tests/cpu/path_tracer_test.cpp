// SPDX-License-Identifier: MIT
// The path tracer as an estimator: furnace, energy per bounce, estimators that agree, halves that differ as
// the noise says, the same bits for any number of threads, stops and refusals. Lights and materials have
// tests of their own (path_tracer_light_test.cpp, path_tracer_material_test.cpp).
#include "reference/path_tracer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "conelight/error.h"
#include "io/generated.h"
#include "support/truth_rig.h"
#include "support/view_rig.h"

namespace conelight::test {
namespace {

using namespace reference;

PathTracedPicture render(const Scene& scene, int width, int height, const PathTracerSettings& settings) {
    return PathTracer(scene).render(scene.cameras.at(0), width, height, settings);
}

// A closed box whose walls all have albedo rho and emission e shows e / (1 - rho) everywhere.
TEST(PathTracer, FurnaceShowsTheGeometricSum) {
    for (const float rho : {0.2f, 0.5f, 0.8f, 0.9f}) {
        const Scene scene = closedBox(diffuseMaterial(glm::vec3(rho), glm::vec3(1)));
        // The number of bounces spreads as much as its mean: 0.1 % for the last 590,000 paths.
        const int size = rho > 0.85f ? 24 : 16;
        for (const bool quads : {true, false}) {
            PathTracerSettings settings;
            settings.samplesPerPixel = rho > 0.85f ? 1024 : 512;
            settings.emissiveQuads = quads;
            const PathTracedPicture picture = render(scene, size, size, settings);
            const double truth = 1 / (1 - static_cast<double>(rho));
            EXPECT_NEAR(meanOf(picture.full) / truth, 1, 0.002) << rho << (quads ? " quads" : " triangles");
            EXPECT_EQ(picture.badSamples, 0u);
            EXPECT_EQ(picture.samplesPerPixel, settings.samplesPerPixel);
        }
    }
}

// From the middle of the box its edges lie on the picture's diagonals, through centres of pixels: points
// there, rounded, lie in the neighbouring wall. They once were black.
TEST(PathTracer, EdgesBetweenWallsAreLit) {
    Scene scene = closedBox(diffuseMaterial(glm::vec3(0.5f), glm::vec3(1)));
    for (const float offset : {0.0f, 0.7f}) {
        for (Instance& instance : scene.instances)
            instance.worldFromObject[3] = glm::vec4(glm::vec3(offset), 1);
        Camera camera;
        camera.eye = glm::vec3(offset);
        camera.target = camera.eye - glm::vec3(0, 0, 1);
        camera.fovY = 2.0f;
        PathTracerSettings settings;
        settings.samplesPerPixel = 256;
        const PathTracedPicture picture = PathTracer(scene).render(camera, 24, 24, settings);
        for (std::size_t i = 0; i < 24; ++i)
            for (const std::size_t x : {i, 23 - i})
                EXPECT_NEAR(picture.full.pixels[24 * i + x].g, 2, 0.35) << x;
    }
}

// With every emitter indirect, bounce n gives rho^n.
TEST(PathTracer, EnergyPerBounceFallsGeometricallyInTheFurnace) {
    const double rho = 0.6;
    const Scene scene = closedBox(diffuseMaterial(glm::vec3(0.6f), glm::vec3(1)));
    PathTracerSettings settings;
    settings.samplesPerPixel = 1024;
    settings.emissiveQuads = false;
    settings.perBounce = 5;
    const PathTracedPicture picture = render(scene, 16, 16, settings);
    EXPECT_NEAR(meanOf(picture.direct), 1, 1e-5);
    double sum = 0;
    for (int n = 1; n <= 5; ++n) {
        const double energy = meanOf(picture.bounces[static_cast<std::size_t>(n) - 1]);
        // Of 262,144 paths rho^n reach bounce n: three standard deviations of their number.
        EXPECT_NEAR(energy / std::pow(rho, n), 1, 3 / std::sqrt(262144 * std::pow(rho, n))) << "bounce " << n;
        sum += energy;
    }
    // The rest of the series is in `indirect`, and nothing is counted twice.
    EXPECT_NEAR(meanOf(picture.indirect) - sum, std::pow(rho, 6) / (1 - rho), 0.003);

    // Stopped after N bounces, the first N are unchanged.
    for (const int bounces : {0, 1, 3}) {
        settings.bounces = bounces;
        EXPECT_NEAR(meanOf(render(scene, 16, 16, settings).full),
                    (1 - std::pow(rho, bounces + 1)) / (1 - rho), 0.004)
            << bounces;
    }
}

// A room with every kind of light, a glossy floor, a textured and a curved emitter, and a window to the sky.
Scene mixedScene() {
    Scene scene = closedBox(diffuseMaterial(glm::vec3(0.7f, 0.6f, 0.5f)));
    scene.instances.erase(scene.instances.begin() + 5);  // the wall behind the camera
    scene.sky = {0.3f, 0.4f, 0.6f};
    scene.materials[2].roughness = 0.3f;
    scene.materials[2].specular = 1;
    scene.materials[2].metallic = 0.5f;
    addInstance(scene, quadMesh({-0.3f, 0.98f, -0.8f}, {0.6f, 0, 0}, {0, 0, 0.5f}),
                diffuseMaterial(glm::vec3(0), glm::vec3(4)));
    glm::mat4 place(0.2f);
    place[3] = {-0.5f, -0.6f, -0.4f, 1};
    addInstance(scene, sphereMesh(12, 6), diffuseMaterial(glm::vec3(0.5f), glm::vec3(2, 1, 0.5f)), place);
    Light light;
    light.position = {0.6f, 0.3f, 0.2f};
    light.intensity = glm::vec3(0.3f);
    scene.lights.push_back(light);
    light.type = LightType::Rect;
    light.position = {0.95f, 0, -0.2f};
    light.direction = {-1, 0, 0};
    light.halfU = {0, 0.3f, 0};
    light.halfV = {0, 0.1f, 0.3f};  // a skewed parallelogram
    light.intensity = glm::vec3(3);
    scene.lights.push_back(light);
    return scene;
}

// Standard deviation of the mean of a picture's pixels, from its own noise estimate.
double meanError(const PathTracedPicture& picture) {
    return picture.noise * meanOf(picture.full) / std::sqrt(static_cast<double>(picture.full.pixels.size()));
}

TEST(PathTracer, EstimatorsAgree) {
    const Scene scene = mixedScene();
    std::vector<PathTracedPicture> pictures;
    for (const Estimator estimator : {Estimator::Mis, Estimator::LightsOnly, Estimator::MaterialsOnly}) {
        PathTracerSettings settings;
        settings.samplesPerPixel = 1024;
        settings.bounces = 3;
        settings.estimator = estimator;
        pictures.push_back(render(scene, 16, 16, settings));
    }
    for (std::size_t i = 1; i < pictures.size(); ++i) {
        const double allowed = 3.5 * std::hypot(meanError(pictures[0]), meanError(pictures[i]));
        EXPECT_LT(allowed, 0.03 * meanOf(pictures[0].full));  // or it would show nothing
        EXPECT_NEAR(meanOf(pictures[i].full), meanOf(pictures[0].full), allowed) << i;
        EXPECT_NEAR(meanOf(pictures[i].direct), meanOf(pictures[0].direct), allowed) << i;
        EXPECT_NEAR(meanOf(pictures[i].specular), meanOf(pictures[0].specular), allowed) << i;
        EXPECT_GE(pictures[i].noise, pictures[0].noise);
    }
}

// Whatever counts as direct, the sum is the same; and the parts are parts of the whole.
TEST(PathTracer, PartsAddUp) {
    const Scene scene = mixedScene();
    PathTracerSettings settings;
    settings.samplesPerPixel = 512;
    settings.perBounce = 2;
    settings.bounces = 2;
    const PathTracedPicture quads = render(scene, 16, 16, settings);
    settings.emissiveQuads = false;
    const PathTracedPicture triangles = render(scene, 16, 16, settings);
    EXPECT_GT(meanOf(quads.direct), 1.1 * meanOf(triangles.direct));
    for (const PathTracedPicture* p : {&quads, &triangles})
        for (std::size_t i = 0; i < p->full.pixels.size(); ++i)
            for (int c = 0; c < 3; ++c) {
                const float full = p->full.pixels[i][c];
                EXPECT_NEAR(p->direct.pixels[i][c] + p->indirect.pixels[i][c], full, 1e-5f * full);
                EXPECT_NEAR(p->diffuse.pixels[i][c] + p->specular.pixels[i][c], p->indirect.pixels[i][c],
                            1e-5f * full);
                EXPECT_NEAR(p->bounces[0].pixels[i][c] + p->bounces[1].pixels[i][c], p->indirect.pixels[i][c],
                            1e-4f * full);
                EXPECT_NEAR(0.5f * (p->halfA.pixels[i][c] + p->halfB.pixels[i][c]), full, 1e-5f * full);
            }
}

// The noise of the picture tells its distance from a much better one, and the halves err independently.
TEST(PathTracer, HalvesDifferAsTheNoiseSays) {
    const Scene scene = mixedScene();
    PathTracerSettings settings;
    settings.seed = 99;
    settings.samplesPerPixel = 1024;
    const PathTracedPicture truth = render(scene, 24, 24, settings);
    settings.seed = 5;
    settings.samplesPerPixel = 32;
    const PathTracedPicture picture = render(scene, 24, 24, settings);
    const double distance = relRmse(picture.full, truth.full);
    // 576 pixels of long-tailed errors.
    EXPECT_NEAR(picture.noise / distance, 1, 0.2);
    EXPECT_LT(truth.noise, 0.3 * picture.noise);
    EXPECT_NEAR(meanOf(picture.full), meanOf(truth.full), 4 * meanError(picture));

    double ab = 0, aa = 0, bb = 0;
    for (std::size_t i = 0; i < truth.full.pixels.size(); ++i) {
        const double a = static_cast<double>(picture.halfA.pixels[i].g - truth.full.pixels[i].g);
        const double b = static_cast<double>(picture.halfB.pixels[i].g - truth.full.pixels[i].g);
        ab += a * b;
        aa += a * a;
        bb += b * b;
    }
    EXPECT_LT(std::abs(ab / std::sqrt(aa * bb)), 4 / std::sqrt(576.0));
}

bool sameBits(const Image& a, const Image& b) { return a.pixels == b.pixels; }

TEST(PathTracer, SameBitsForAnyNumberOfThreads) {
    const Scene scene = mixedScene();
    PathTracerSettings settings;
    settings.samplesPerPixel = 24;
    settings.filter = PixelFilter::Box;
    settings.threads = 1;
    const PathTracedPicture one = render(scene, 40, 37, settings);
    settings.threads = 2;
    const PathTracer tracer(scene);
    const PathTracedPicture two =
        tracer.render(scene.cameras[0], 40, 37, settings, [](const PathTracerProgress&) { return true; });
    EXPECT_TRUE(sameBits(one.full, two.full));
    EXPECT_TRUE(sameBits(one.specular, two.specular));
    EXPECT_TRUE(sameBits(one.halfB, two.halfB));
    EXPECT_EQ(one.rays, two.rays);
    settings.seed = 2;
    EXPECT_FALSE(sameBits(one.full, render(scene, 40, 37, settings).full));
}

TEST(PathTracer, StopsAtTheNoiseAskedForAndWhenTold) {
    const Scene scene = mixedScene();
    PathTracerSettings settings;
    settings.samplesPerPixel = 1 << 14;
    settings.noise = 0.08;
    const PathTracedPicture quiet = render(scene, 16, 16, settings);
    EXPECT_LE(quiet.noise, 0.08);
    EXPECT_LT(quiet.samplesPerPixel, settings.samplesPerPixel);
    EXPECT_EQ(quiet.samplesPerPixel, render(scene, 16, 16, settings).samplesPerPixel);

    settings.noise = 0;
    int calls = 0;
    const PathTracedPicture told =
        PathTracer(scene).render(scene.cameras[0], 16, 16, settings, [&](const PathTracerProgress& progress) {
            EXPECT_GE(progress.samplesDone, 0);
            EXPECT_EQ(progress.samplesPlanned, 1 << 14);
            return ++calls < 3;
        });
    EXPECT_EQ(calls, 3);
    EXPECT_LT(told.samplesPerPixel, 1 << 14);
    EXPECT_GT(meanOf(told.full), 0);
}

TEST(PathTracer, RefusesWhatItCannotDo) {
    const Scene scene = closedBox(diffuseMaterial());
    PathTracerSettings settings;
    const auto refused = [&](int width, const PathTracerSettings& s) {
        try {
            render(scene, width, 4, s);
        } catch (const Error& error) {
            return error.kind() == ErrorKind::Usage;
        }
        return false;
    };
    EXPECT_TRUE(refused(0, settings));
    settings.samplesPerPixel = 0;
    EXPECT_TRUE(refused(4, settings));
    settings.samplesPerPixel = 4;
    settings.noise = std::nan("");
    EXPECT_TRUE(refused(4, settings));
    Scene broken = scene;
    broken.instances[0].mesh = 77;
    EXPECT_THROW(PathTracer{broken}, Error);
}

// Nothing to see, nothing that shines; and walls of albedo 1, between which paths once went on for ever.
TEST(PathTracer, EmptyAndDarkScenesAreBlack) {
    Scene empty;
    empty.cameras.push_back(Camera{});
    PathTracerSettings settings;
    settings.samplesPerPixel = 2;
    EXPECT_EQ(meanOf(render(empty, 4, 4, settings).full), 0);
    const PathTracedPicture dark = render(closedBox(diffuseMaterial()), 4, 4, settings);
    EXPECT_EQ(meanOf(dark.full), 0);
    EXPECT_EQ(dark.noise, 0);
}

}  // namespace
}  // namespace conelight::test
