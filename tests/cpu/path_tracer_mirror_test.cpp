// SPDX-License-Identifier: MIT
// Ideal mirrors in the path tracer: surfaces below the least roughness show the exactly mirrored direction, no
// highlight of lamps without extent, and return all light that they should.
#include <gtest/gtest.h>

#include <cmath>

#include "math/brdf.h"
#include "reference/path_tracer.h"
#include "support/truth_rig.h"

namespace conelight::test {
namespace {

using namespace reference;

Material smooth(float metallic, float roughness, const glm::vec3& color = glm::vec3(1)) {
    Material m;
    m.baseColor = glm::vec4(color, 1);
    m.metallic = metallic;
    m.roughness = roughness;
    return m;
}

PathTracedPicture render(const Scene& scene, const Camera& camera, int size, int samples,
                         PathTracerSettings settings = {}) {
    settings.samplesPerPixel = samples;
    return PathTracer(scene).render(camera, size, size, settings);
}

// The eye looks at a mirror on the floor and in it at a glowing patch on an unlit wall.
Scene patchInMirror(float roughness) {
    Scene scene;
    addInstance(scene, quadMesh({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), smooth(1, roughness, {0.9f, 0.7f, 0.5f}));
    addInstance(scene, quadMesh({-0.4f, 0.5f, -2}, {0.8f, 0, 0}, {0, 0.6f, 0}),
                diffuseMaterial(glm::vec3(0), glm::vec3(3)));
    return scene;
}

Camera towardsFloor() {
    Camera camera;
    camera.eye = {0.1f, 1, 2.5f};
    camera.target = {0.05f, 0, 0};
    camera.fovY = 0.6f;
    return camera;
}

TEST(PathTracerMirror, ShowsThePatchExactlyWhereItIsMirrored) {
    const Scene scene = patchInMirror(0);
    const Camera camera = towardsFloor();
    constexpr int kSize = 32;
    const PathTracedPicture picture = render(scene, camera, kSize, 2);
    const glm::dvec3 eye(camera.eye), forward = glm::normalize(glm::dvec3(camera.target) - eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, {0, 1, 0})), up = glm::cross(right, forward);
    const double slope = std::tan(0.5 * static_cast<double>(camera.fovY));
    int shown = 0;
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            const glm::dvec2 clip = (glm::dvec2(x, y) + 0.5) * (2.0 / kSize) - 1.0;
            glm::dvec3 way = glm::normalize(forward + slope * (clip.x * right - clip.y * up));
            // Seen straight or in the mirror: the wall is at z = -2.
            const bool mirrored = way.y < 0 && eye.z - eye.y / way.y * way.z > -2;
            const double cosine = -way.y;
            const glm::dvec3 from = mirrored ? eye - way * (eye.y / way.y) : eye;
            if (mirrored) way.y = -way.y;
            const glm::dvec3 at = from + way * ((-2 - from.z) / way.z);
            const bool onMirror = !mirrored || (std::fabs(from.x) < 2 && std::fabs(from.z) < 2);
            const bool meets = onMirror && std::fabs(at.x) < 0.4 && at.y > 0.5 && at.y < 1.1;
            glm::dvec3 truth(meets ? 3 : 0);
            const glm::dvec3 f0(0.9f, 0.7f, 0.5f);
            if (mirrored) truth *= f0 + (1.0 - f0) * std::pow(1 - cosine, 5);  // Schlick
            const glm::vec4& pixel = picture.full.pixels[static_cast<std::size_t>(y * kSize + x)];
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(static_cast<double>(pixel[c]), truth[c], 2e-5) << x << " " << y;
            shown += meets && mirrored ? 1 : 0;
        }
    EXPECT_GT(shown, 40);
    // No light without extent is mirrored; just rough enough, the lobe spreads the patch and shows lamps.
    EXPECT_GT(relRmse(render(patchInMirror(math::kMinRoughness), camera, kSize, 256).full, picture.full),
              0.01);
}

TEST(PathTracerMirror, LampsWithoutExtentMakeNoHighlight) {
    Light lamp;
    lamp.position = {0.1f, 1, -2.5f};  // where the eye's image looks
    for (const bool ideal : {true, false}) {
        Scene scene;
        addInstance(scene, quadMesh({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), smooth(1, ideal ? 0.04f : 0.045f));
        scene.lights.push_back(lamp);
        const double shown = meanOf(render(scene, towardsFloor(), 64, 2).full);
        if (ideal)
            EXPECT_EQ(shown, 0.0);
        else
            EXPECT_GT(shown, 0.0);
    }
}

// White in a white furnace: what the mirror leaves is diffuse, to the last digit.
TEST(PathTracerMirror, VanishesInTheWhiteFurnace) {
    for (const float metallic : {0.0f, 0.5f, 1.0f}) {
        Scene scene;
        addInstance(scene, quadMesh({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), smooth(metallic, 0));
        scene.sky = glm::vec3(1);
        const PathTracedPicture picture = render(scene, towardsFloor(), 16, 512);
        // Which part a path takes is drawn: 0.1 % for 131,072 paths.
        EXPECT_NEAR(meanOf(picture.full), 1, metallic == 1.0f ? 1e-5 : 0.004) << metallic;
    }
}

// A coat over paint under a rectangle, its mirror image among what is seen: light found by lamps, by materials, by both.
TEST(PathTracerMirror, EstimatorsAgree) {
    Scene scene;
    addInstance(scene, quadMesh({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), smooth(0, 0, {0.5f, 0.3f, 0.2f}));
    addInstance(scene, quadMesh({-1.5f, 1.3f, -2}, {3, 0, 0}, {0, 0, 3}),
                diffuseMaterial(glm::vec3(0), glm::vec3(3)));
    Light lamp;
    lamp.type = LightType::Rect;
    lamp.position = {0.8f, 0.5f, -1};
    lamp.direction = {-1, 0, 0};
    lamp.halfU = {0, 0.4f, 0};
    lamp.halfV = {0, 0, 0.6f};
    lamp.intensity = glm::vec3(2);
    scene.lights.push_back(lamp);
    for (const int bounces : {0, -1}) {
        PathTracerSettings settings;
        settings.bounces = bounces;
        const double mis = meanOf(render(scene, towardsFloor(), 16, 1024, settings).full);
        EXPECT_GT(mis, 0.01);
        for (const Estimator other : {Estimator::LightsOnly, Estimator::MaterialsOnly}) {
            settings.estimator = other;
            // The noise of 262,144 paths, of which many miss the lamps when materials alone draw them.
            EXPECT_NEAR(meanOf(render(scene, towardsFloor(), 16, 1024, settings).full) / mis, 1, 0.01)
                << bounces;
        }
    }
}

// Paths::Mirrors leaves what came over walls: two walls that see each other, one of them in a mirror.
TEST(PathTracerMirror, MirrorsAloneLeaveDiffuseLightOut) {
    Scene scene = patchInMirror(0);
    scene.materials[1] = diffuseMaterial(glm::vec3(0.8f));
    addInstance(scene, quadMesh({-1, 0.2f, -1}, {0, 1, 0}, {0, 0, 1}), diffuseMaterial(glm::vec3(0.8f)));
    Light lamp;
    lamp.position = {0.5f, 1.5f, 0};
    scene.lights.push_back(lamp);
    PathTracerSettings settings;
    const PathTracedPicture all = render(scene, towardsFloor(), 16, 128, settings);
    settings.paths = Paths::Mirrors;
    const PathTracedPicture mirrors = render(scene, towardsFloor(), 16, 128, settings);
    settings.bounces = 0;
    const PathTracedPicture direct = render(scene, towardsFloor(), 16, 128, settings);
    EXPECT_LT(meanOf(mirrors.full), 0.99 * meanOf(all.full));
    EXPECT_GT(meanOf(mirrors.full), 1.2 * meanOf(direct.full));
    EXPECT_EQ(meanOf(mirrors.diffuse), 0);
    EXPECT_EQ(mirrors.direct.pixels, direct.direct.pixels);
}

}  // namespace
}  // namespace conelight::test
