// SPDX-License-Identifier: MIT
// Orthographic cameras: surfaces, light, glass and edges by parallel rays in each mode, against the path tracer's.
#include <algorithm>
#include <cmath>

#include "conelight/error.h"
#include "conelight/thesis/settings.h"
#include "io/generated.h"
#include "reference/lens.h"
#include "reference/surface.h"
#include "support/scenes.h"
#include "support/traced_rig.h"

namespace conelight::test {
namespace {

using OrthographicTest = TracedModeTest;

// The Cornell box from aside and above, as high at its target as in perspective.
Scene cornell(bool parallel) {
    Scene scene = io::generateScene("cornell");
    Camera& camera = scene.cameras.at(0);
    camera.eye += glm::vec3(0.3f, 0.35f, 0);
    if (parallel) camera.orthographicHeight = camera.heightAt(glm::distance(camera.eye, camera.target));
    return scene;
}

reference::PathTracedPicture truthOf(const Scene& scene, int samples, bool box = false) {
    reference::PathTracerSettings settings;
    settings.samplesPerPixel = samples;
    settings.filter = box ? reference::PixelFilter::Box : reference::PixelFilter::Center;
    return reference::PathTracer(scene).render(scene.cameras.at(0), kTracedPixels, kTracedPixels, settings);
}

TEST_F(OrthographicTest, SurfacesAreThoseThatParallelRaysMeet) {
    Scene scene = cornell(true);
    // Far from the origin, as towns are.
    const glm::vec3 far(300, -20, 500);
    for (Instance& instance : scene.instances) instance.worldFromObject[3] += glm::vec4(far, 0);
    scene.cameras[0].eye += far;
    scene.cameras[0].target += far;
    Renderer renderer;
    renderer.setScene(scene);
    const Image depth = draw(renderer, scene, tracedSettings(Quality::Draft, Component::Depth));
    const Image normal = draw(renderer, scene, tracedSettings(Quality::Draft, Component::Normal));
    const reference::RayScene rays(scene);
    const reference::Lens lens(scene.cameras[0], kTracedPixels, kTracedPixels);
    int seen = 0, other = 0;
    for (int y = 0; y < kTracedPixels; ++y)
        for (int x = 0; x < kTracedPixels; ++x) {
            const glm::dvec2 at = (glm::dvec2(x, y) + 0.5) / double(kTracedPixels) * 2.0 - 1.0;
            const reference::Ray ray = lens.ray({at.x, -at.y});
            reference::RayHit hit;
            const bool meets = rays.intersect(reference::RayKind::Camera, ray, hit);
            const auto pixel = static_cast<std::size_t>(y * kTracedPixels + x);
            const glm::vec3 drawn = 2.0f * glm::vec3(normal.pixels[pixel]) - 1.0f;
            seen += meets ? 1 : 0;
            const bool same =
                meets ? std::abs(depth.pixels[pixel].r - hit.t) < 1e-3f &&
                            glm::distance(drawn, reference::surfaceAt(scene, ray, hit).shadingNormal) < 1e-3f
                      : depth.pixels[pixel].r == 0;
            other += same ? 0 : 1;
        }
    EXPECT_GT(seen, kTracedPixels * kTracedPixels / 2);
    EXPECT_LE(other, 12) << "at edges";
}

// The error is that of the same look in perspective.
TEST_F(OrthographicTest, LightIsAsNearThePathTracersAsInPerspective) {
    for (const Component component : {Component::Direct, Component::Indirect}) {
        double errors[2];
        for (const bool parallel : {false, true}) {
            const Scene scene = cornell(parallel);
            const reference::PathTracedPicture truth = truthOf(scene, 256);
            const Image drawn = draw(scene, tracedSettings(Quality::Interactive, component));
            errors[parallel ? 1 : 0] =
                component == Component::Direct ? relRmse(drawn, truth.direct) : indirectError(drawn, truth);
        }
        RecordProperty(component == Component::Direct ? "direct" : "indirect",
                       std::to_string(errors[1]) + ", in perspective " + std::to_string(errors[0]));
        EXPECT_LT(errors[1], 1.3 * errors[0] + 0.01) << static_cast<int>(component);
    }
}

// Every mode draws the floor where it is: a pixel of it shows what the same place shows in perspective.
TEST_F(OrthographicTest, AllModesShowTheSamePlacesAlike) {
    for (const Mode mode : {Mode::Phong, Mode::Cones, Mode::Hybrid, Mode::Traced, thesis::kMode}) {
        glm::vec3 shown[2];
        for (const bool parallel : {false, true}) {
            Scene scene = cornell(parallel);
            Settings settings = tracedSettings(Quality::Interactive);
            settings.mode = mode;
            const Image image = draw(scene, settings);
            EXPECT_TRUE(std::isfinite(meanOf(image)));
            // At the target, where both are as large.
            glm::vec4 sum(0);
            for (int i = 0; i < 16; ++i)
                sum += image.pixels[static_cast<std::size_t>((kTracedPixels / 2 - 2 + i / 4) * kTracedPixels +
                                                             kTracedPixels / 2 - 2 + i % 4)];
            shown[parallel ? 1 : 0] = glm::vec3(sum) / 16.0f;
        }
        EXPECT_LT(glm::distance(shown[0], shown[1]), 0.12f * glm::length(shown[0])) << mode.name();
        EXPECT_GT(glm::length(shown[0]), 0.01f) << mode.name();
    }
}

// A tinted pane before the left half of a wall that shines.
TEST_F(OrthographicTest, GlassIsWhereItsRaysPassIt) {
    Scene scene;
    Material bright;
    bright.unlit = true;
    bright.baseColor = glm::vec4(1);
    addInstance(scene, quadMesh({-2, -2, -1}, {4, 0, 0}, {0, 4, 0}), bright);
    Material pane;
    pane.baseColor = {0.5f, 0.5f, 0.5f, 1};
    pane.roughness = 0;
    pane.transmission = 1;
    pane.doubleSided = true;
    pane.ior = 1.0001f;  // next to nothing is reflected
    addInstance(scene, quadMesh({-2, -2, 0}, {2, 0, 0}, {0, 4, 0}), pane);
    Camera camera;
    camera.orthographicHeight = 3;
    scene.cameras = {camera};
    const auto at = [](const Image& image, int x, int y) {
        return image.pixels[static_cast<std::size_t>(y * kTracedPixels + x)].g;
    };
    const Image truth = truthOf(scene, 32).full;
    for (const Mode mode : {Mode::Phong, Mode::Cones, Mode::Traced}) {
        Settings settings = tracedSettings(Quality::Interactive);
        settings.mode = mode;
        const Image image = draw(scene, settings);
        for (const int x : {2, 12, 22, 26, 36, 45})
            for (const int y : {2, 24, 45})
                EXPECT_NEAR(at(image, x, y), at(truth, x, y), 0.08f) << mode.name() << " " << x << " " << y;
    }
    EXPECT_NEAR(at(truth, 2, 2), 0.5f, 0.05f);
    EXPECT_NEAR(at(truth, 45, 2), 1, 1e-3f);
}

// A ball of glass refracts parallel rays as the path tracer's, in its own size.
TEST_F(OrthographicTest, GlassRefractsParallelRays) {
    double errors[2];
    for (const bool parallel : {false, true}) {
        Scene scene = io::generateScene("glass");
        Camera& camera = scene.cameras.at(0);
        if (parallel) camera.orthographicHeight = camera.heightAt(glm::distance(camera.eye, camera.target));
        const Image drawn = draw(scene, tracedSettings(Quality::Interactive));
        errors[parallel ? 1 : 0] = relRmse(drawn, truthOf(scene, 64).full);
    }
    RecordProperty("error", std::to_string(errors[1]) + ", in perspective " + std::to_string(errors[0]));
    EXPECT_LT(errors[1], 1.4 * errors[0]);
}

TEST_F(OrthographicTest, EdgesAreSmoothAndALensChangesNothing) {
    Scene scene;
    Material bright;
    bright.unlit = true;
    bright.baseColor = glm::vec4(1);
    addInstance(scene, quadMesh({-0.7f, -0.6f, 0}, {1.2f, 0.3f, -2}, {-0.4f, 1.1f, 0}), bright);
    scene.instances[0].voxelized = true;
    scene.materials[0].doubleSided = true;
    Camera camera;
    camera.orthographicHeight = 2;
    scene.cameras = {camera};
    Settings settings = tracedSettings(Quality::Draft);
    settings.mode = Mode::Phong;
    const Image truth = truthOf(scene, 1024, true).full;
    const Image stairs = draw(scene, settings);
    settings.image.antialiasing = 32;
    const Image smooth = draw(scene, settings);
    EXPECT_LT(relRmse(smooth, truth), 0.02);
    EXPECT_GT(relRmse(stairs, truth), 5 * relRmse(smooth, truth));
    scene.cameras[0].lensDiameter = 0.5f;
    scene.cameras[0].focusDistance = 1;
    EXPECT_EQ(draw(scene, settings).pixels, smooth.pixels);
    EXPECT_EQ(truthOf(scene, 1024, true).full.pixels, truth.pixels);
}

// All of the sky behind is in one direction.
TEST_F(OrthographicTest, TheSkyIsSeenInOneDirection) {
    Scene scene;
    addInstance(scene, quadMesh({-0.1f, -0.1f, 0}, {0.2f, 0, 0}, {0, 0.2f, 0}), diffuseMaterial());
    EnvironmentImage picture{64, 32, std::vector<glm::vec3>(64 * 32)};
    for (std::size_t i = 0; i < picture.radiance.size(); ++i)
        picture.radiance[i] = {float(i % 64) / 64, float(i / 64) / 32, 0.2f};
    scene.environment.image = std::make_shared<const EnvironmentImage>(picture);
    Camera camera;
    camera.eye = {1, 1, 2};
    camera.orthographicHeight = 2;
    scene.cameras = {camera};
    const Image drawn = draw(scene, tracedSettings(Quality::Draft)), truth = truthOf(scene, 1).full;
    const glm::vec4 corner = drawn.pixels.front();
    EXPECT_EQ(corner, drawn.pixels.back());
    EXPECT_LT(glm::distance(glm::vec3(corner), glm::vec3(truth.pixels.front())), 0.02f);
}

TEST_F(OrthographicTest, HeightsThatSayNothingAreRefused) {
    Scene scene = cornell(true);
    Renderer renderer;
    renderer.setScene(scene);
    for (const float height : {-1.0f, NAN, INFINITY}) {
        scene.cameras[0].orthographicHeight = height;
        EXPECT_THROW(draw(renderer, scene, tracedSettings(Quality::Draft)), Error) << height;
    }
}

}  // namespace
}  // namespace conelight::test
