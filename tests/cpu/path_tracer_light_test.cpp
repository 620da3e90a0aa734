// SPDX-License-Identifier: MIT
// Irradiance from every kind of light against closed forms. Form factors: J. R. Howell, "A Catalog of
// Radiation Heat Transfer Configuration Factors", sections B-3, C-11, C-14.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reference/path_tracer.h"
#include "support/truth_rig.h"
#include "support/view_rig.h"

namespace conelight::test {
namespace {

using namespace reference;
constexpr double kTolerance = 0.005;

// A white diffuse floor at y = 0, 20 m wide.
Scene floorScene() {
    Scene scene;
    addInstance(scene, quadMesh({-10, 0, 10}, {20, 0, 0}, {0, 0, -20}), diffuseMaterial());
    return scene;
}

Light light(LightType type, const glm::vec3& position, float intensity) {
    Light l;
    l.type = type;
    l.position = position;
    l.intensity = glm::vec3(intensity);
    return l;
}

// Mean irradiance on a square of the floor, `width` wide, about `point`: pi times what a white floor shows.
double irradianceAt(const Scene& scene, const glm::vec3& point, PathTracerSettings settings = {},
                    float width = 0.001f) {
    settings.filter = PixelFilter::Box;
    if (settings.samplesPerPixel == PathTracerSettings{}.samplesPerPixel) settings.samplesPerPixel = 64;
    const PathTracedPicture picture =
        PathTracer(scene).render(cameraAbove(point, 0.5f, width), 8, 8, settings);
    EXPECT_EQ(picture.badSamples, 0u);
    return std::numbers::pi * meanOf(picture.full);
}

PathTracerSettings samples(int count, bool quads = true) {
    PathTracerSettings settings;
    settings.samplesPerPixel = count;
    settings.emissiveQuads = quads;
    return settings;
}

// What counts as direct light of small lamps changes no picture, only its parts.
TEST(PathTracerLight, SmallLampsAreDirectLightWhereAsked) {
    const auto scaled = [](Mesh mesh, const glm::vec3& size) {
        for (glm::vec3& p : mesh.positions) p = size * p + glm::vec3(0, 0.5f, 0);
        return mesh;
    };
    for (const Mesh& lampMesh :
         {scaled(sphereMesh(16, 8), glm::vec3(0.05f)), scaled(boxMesh(), {0.1f, 0.005f, 0.2f})}) {
        Scene scene = floorScene();
        addInstance(scene, lampMesh, diffuseMaterial(glm::vec3(0), glm::vec3(100)));
        PathTracerSettings settings = samples(64);
        const Camera camera = cameraAbove({0.3f, 0, 0}, 0.4f, 0.2f);
        const PathTracedPicture lamp = PathTracer(scene).render(camera, 8, 8, settings);
        settings.smallLamps = false;
        const PathTracedPicture emitter = PathTracer(scene).render(camera, 8, 8, settings);
        EXPECT_EQ(lamp.full.pixels, emitter.full.pixels);
        EXPECT_GT(meanOf(lamp.direct), 0.98 * meanOf(lamp.full));
        EXPECT_EQ(meanOf(emitter.direct), 0);
    }
}

TEST(PathTracerLight, PointFollowsTheInverseSquare) {
    Scene scene = floorScene();
    scene.lights.push_back(light(LightType::Point, {0.5f, 1.5f, -0.25f}, 3));
    const double d2 = 0.25 + 2.25 + 0.0625;
    EXPECT_NEAR(irradianceAt(scene, {0, 0, 0}) / (3 * 1.5 / std::pow(d2, 1.5)), 1, kTolerance);
    // glTF's range: 1 - (d / range)^4.
    scene.lights[0].range = 2;
    EXPECT_NEAR(irradianceAt(scene, {0, 0, 0}) / (3 * 1.5 / std::pow(d2, 1.5) * (1 - d2 * d2 / 16)), 1,
                kTolerance);
    scene.lights[0].range = 1.5f;
    EXPECT_EQ(irradianceAt(scene, {0, 0, 0}), 0);
    // The thesis's falloff instead.
    scene.lights[0].range = 0;
    scene.lights[0].customFalloff = true;
    const double d = std::sqrt(d2);
    EXPECT_NEAR(irradianceAt(scene, {0, 0, 0}) / (3 * 1.5 / d / (1 + 0.15 * d + 0.45 * d2)), 1, kTolerance);
}

TEST(PathTracerLight, SpotFadesBetweenItsAngles) {
    Scene scene = floorScene();
    scene.lights.push_back(light(LightType::Spot, {0, 2, 0}, 5));
    scene.lights[0].direction = {0, -1, 0};
    scene.lights[0].innerAngle = 0.3f;
    scene.lights[0].outerAngle = 0.6f;
    for (const double angle : {0.0, 0.25, 0.35, 0.45, 0.55}) {
        const double x = 2 * std::tan(angle);
        const double t = std::min((std::cos(angle) - std::cos(0.6)) / (std::cos(0.3) - std::cos(0.6)), 1.0);
        const double truth = 5 * std::pow(std::cos(angle), 3) / 4 * t * t;
        EXPECT_NEAR(irradianceAt(scene, {static_cast<float>(x), 0, 0}) / truth, 1, kTolerance) << angle;
    }
    EXPECT_EQ(irradianceAt(scene, {2 * std::tan(0.62f), 0, 0}), 0);
}

TEST(PathTracerLight, SunFollowsTheCosine) {
    Scene scene = floorScene();
    scene.lights.push_back(light(LightType::Directional, {0, 0, 0}, 7));
    for (const float angle : {0.0f, 0.5f, 1.2f}) {
        scene.lights[0].direction = {std::sin(angle), -std::cos(angle), 0};
        EXPECT_NEAR(irradianceAt(scene, {0, 0, 0}) / (7 * std::cos(static_cast<double>(angle))), 1,
                    kTolerance);
    }
}

// Element to a parallel rectangle whose corner is above it, at distance 1 (Howell B-3).
double cornerFactor(double x, double y) {
    const double rx = std::sqrt(1 + x * x), ry = std::sqrt(1 + y * y);
    return (x / rx * std::atan(y / rx) + y / ry * std::atan(x / ry)) / (2 * std::numbers::pi);
}

// A rectangle 0.8 m x 1.2 m, 1 m above the floor, a corner of it above the origin.
TEST(PathTracerLight, RectanglesAgreeWithTheClosedForm) {
    const double truth = std::numbers::pi * 2 * cornerFactor(0.8, 1.2);
    Scene scene = floorScene();
    scene.lights.push_back(light(LightType::Rect, {0.4f, 1, 0.6f}, 2));
    scene.lights[0].halfU = {0.4f, 0, 0};
    scene.lights[0].halfV = {0, 0, 0.6f};
    scene.lights[0].direction = {0, -1, 0};
    const glm::vec3 at(0, 0, 0);
    EXPECT_NEAR(irradianceAt(scene, at, samples(256)) / truth, 1, kTolerance);
    PathTracerSettings byMaterials = samples(4096);
    byMaterials.estimator = Estimator::MaterialsOnly;
    EXPECT_NEAR(irradianceAt(scene, at, byMaterials) / truth, 1, kTolerance);
    // It shines to one side only.
    scene.lights[0].direction = {0, 1, 0};
    EXPECT_EQ(irradianceAt(scene, at), 0);

    // The same as a quad of the scene: direct light, or light like any other.
    Scene quad = floorScene();
    addInstance(quad, quadMesh({0, 1, 0}, {0.8f, 0, 0}, {0, 0, 1.2f}),
                diffuseMaterial(glm::vec3(0), glm::vec3(2)));
    EXPECT_NEAR(irradianceAt(quad, at, samples(256)) / truth, 1, kTolerance);
    EXPECT_NEAR(irradianceAt(quad, at, samples(256, false)) / truth, 1, kTolerance);
    // Blockers of direct light and of bounces differ: then quads are met analytically.
    addInstance(quad, quadMesh({5, 1, 5}, {1, 0, 0}, {0, 0, 1}), diffuseMaterial());
    quad.instances.back().voxelized = false;
    EXPECT_NEAR(irradianceAt(quad, at, samples(256)) / truth, 1, kTolerance);
    // Turned inside out by its transform: glTF's front stays the front, so it shines up.
    quad.instances.pop_back();
    quad.instances[1].worldFromObject[1][1] = -1;
    quad.instances[1].worldFromObject[3][1] = 2;
    EXPECT_EQ(irradianceAt(quad, at, samples(256)), 0);
    EXPECT_EQ(irradianceAt(quad, at, samples(256, false)), 0);
    quad.materials[1].doubleSided = true;
    EXPECT_NEAR(irradianceAt(quad, at, samples(256)) / truth, 1, kTolerance);
    EXPECT_NEAR(irradianceAt(quad, at, samples(256, false)) / truth, 1, kTolerance);
}

// Half of the rectangle shines, by its texture; the emitter is chosen by its mean, and read where it is hit.
TEST(PathTracerLight, TexturedEmissionIsExactAtTheSample) {
    Scene scene = floorScene();
    Mesh mesh = quadMesh({0, 1, 0}, {0.8f, 0, 0}, {0, 0, 1.2f});
    mesh.uvs.resize(4);
    for (std::size_t i = 0; i < 4; ++i) mesh.uvs[i] = {mesh.positions[i].x > 0.4f ? 1 : 0, 0.5f};
    Texture texture;
    texture.width = 2;
    texture.height = 1;
    texture.srgb = true;
    texture.filter = TextureFilter::Nearest;
    texture.wrapU = TextureWrap::Clamp;
    texture.rgba = {255, 255, 255, 255, 0, 0, 0, 255};
    scene.textures.push_back(texture);
    Material material = diffuseMaterial(glm::vec3(0), glm::vec3(2));
    material.emissiveTexture.texture = 0;
    addInstance(scene, std::move(mesh), material);
    const double truth = std::numbers::pi * 2 * cornerFactor(0.4, 1.2);
    for (const Estimator estimator : {Estimator::Mis, Estimator::LightsOnly, Estimator::MaterialsOnly}) {
        PathTracerSettings settings = samples(4096);
        settings.estimator = estimator;
        EXPECT_NEAR(irradianceAt(scene, {0, 0, 0}, settings) / truth, 1, kTolerance)
            << static_cast<int>(estimator);
    }
}

// A glowing sphere of radius r at distance d: pi L (r / d)^2. The mesh is blown up to the sphere's area: the
// mean shadow of a convex body is a quarter of its area (Cauchy), so that it gives as much light.
TEST(PathTracerLight, SphereAgreesWithTheClosedForm) {
    const double radius = 0.4, distance = 1.5;
    Mesh mesh = sphereMesh(48, 24);
    double area = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3 a(mesh.positions[mesh.indices[i]]), b(mesh.positions[mesh.indices[i + 1]]),
            c(mesh.positions[mesh.indices[i + 2]]);
        area += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
    const auto scale = static_cast<float>(radius * std::sqrt(4 * std::numbers::pi / area));
    Scene scene = floorScene();
    glm::mat4 place(scale);
    place[3] = {0, distance, 0, 1};
    addInstance(scene, std::move(mesh), diffuseMaterial(glm::vec3(0), glm::vec3(3)), place);
    // Seen from beside the sphere, so that it does not hide the floor.
    Camera camera = cameraAbove({0, 0, 0}, 2, 0.001f);
    camera.eye = {1.5f, 1.2f, 0};
    camera.fovY = 0.002f;
    const PathTracedPicture picture = PathTracer(scene).render(camera, 8, 8, samples(512));
    EXPECT_NEAR(meanOf(picture.full) / (3 * radius * radius / distance / distance), 1, kTolerance);
    EXPECT_NEAR(meanOf(picture.direct), 0, 1e-9);  // no quads: all of it is indirect
}

// Mean irradiance on a unit square from another of radiance 1 is pi F (Howell C-11, C-14, both of edge 1).
TEST(PathTracerLight, FormFactorsOfSquares) {
    const double s2 = std::sqrt(2.0);
    const double parallel = 2 / std::numbers::pi *
                            (std::log(std::sqrt(4.0 / 3)) + 2 * s2 * std::atan(1 / s2) - 2 * std::atan(1.0));
    const double perpendicular =
        (2 * std::atan(1.0) - s2 * std::atan(1 / s2) + 0.25 * std::log(4.0 / 3 * 0.75 * 0.75)) /
        std::numbers::pi;
    EXPECT_NEAR(parallel, 0.19982, 1e-5);
    EXPECT_NEAR(perpendicular, 0.20004, 1e-5);

    Scene above, beside;
    const Mesh receiver = quadMesh({-0.5f, 0, 0.5f}, {1, 0, 0}, {0, 0, -1});
    const Material glow = diffuseMaterial(glm::vec3(0), glm::vec3(1));
    addInstance(above, receiver, diffuseMaterial());
    addInstance(above, quadMesh({-0.5f, 1, -0.5f}, {1, 0, 0}, {0, 0, 1}), glow);
    addInstance(beside, receiver, diffuseMaterial());
    addInstance(beside, quadMesh({-0.5f, 0, 0.5f}, {0, 0, -1}, {0, 1, 0}), glow);
    for (const bool quads : {true, false}) {
        EXPECT_NEAR(irradianceAt(above, {0, 0, 0}, samples(512, quads), 1) / std::numbers::pi / parallel, 1,
                    kTolerance);
        EXPECT_NEAR(
            irradianceAt(beside, {0, 0, 0}, samples(512, quads), 1) / std::numbers::pi / perpendicular, 1,
            kTolerance);
    }
}

TEST(PathTracerLight, SkyLightsAPlaneWithItsRadiance) {
    Scene scene;
    addInstance(scene, quadMesh({-10, 0, 10}, {20, 0, 0}, {0, 0, -20}), diffuseMaterial(glm::vec3(0.6f)));
    scene.sky = {1, 2, 3};
    for (const Estimator estimator : {Estimator::Mis, Estimator::LightsOnly, Estimator::MaterialsOnly}) {
        PathTracerSettings settings = samples(1024);
        settings.estimator = estimator;
        const PathTracedPicture picture =
            PathTracer(scene).render(cameraAbove({0, 0, 0}, 2, 1), 8, 8, settings);
        const glm::dvec3 mean = meanColorOf(picture.diffuse);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c] / (0.6 * (c + 1)), 1, kTolerance);
        EXPECT_EQ(meanOf(picture.direct), 0);
    }
    // Looked at from below, single-sided ground is not there: the sky behind is direct, and has no surface.
    Camera camera;
    camera.eye = {0, -1, 0};
    camera.target = {0, 0, 0};
    const PathTracedPicture picture = PathTracer(scene).render(camera, 4, 4, samples(2));
    EXPECT_NEAR(meanOf(picture.direct), 2, 1e-6);
    EXPECT_EQ(picture.full.pixels[0].a, 0);
}

// By power alone the noise of these pixels would be 49 %.
TEST(PathTracerLight, OfManyLampsThoseNearbyAreDrawn) {
    Scene scene = floorScene();
    const float height = 0.4f;
    double expected = 0.7;
    scene.lights.push_back(light(LightType::Directional, {}, 0.7f));
    for (int i = 0; i < 14 * 14; ++i) {
        const glm::vec3 at(1.4f * static_cast<float>(i % 14 - 7) + 0.6f, height,
                           1.4f * static_cast<float>(i / 14 - 7) + 0.5f);
        scene.lights.push_back(light(LightType::Point, at, 1));
        expected += static_cast<double>(height) / std::pow(static_cast<double>(glm::length(at)), 3.0);
    }
    PathTracerSettings settings = samples(64);
    settings.filter = PixelFilter::Box;
    const Image seen = PathTracer(scene).render(cameraAbove({0, 0, 0}, 0.5f, 0.001f), 8, 8, settings).full;
    Image truth = seen;
    for (glm::vec4& pixel : truth.pixels) pixel = glm::vec4(static_cast<float>(expected / std::numbers::pi));
    EXPECT_NEAR(meanOf(seen) / meanOf(truth), 1, 0.04);
    EXPECT_LT(relRmse(seen, truth), 0.2);
}

// Their densities are those of the tree, however a lamp is found.
TEST(PathTracerLight, WaysToManyLampsAgree) {
    Scene scene = floorScene();
    for (int i = 0; i < 49; ++i) {
        const float lift = 0.3f + 0.1f * static_cast<float>(i * 5 % 7);
        addInstance(
            scene,
            quadMesh({0.6f * static_cast<float>(i % 7 - 3), lift, 0.6f * static_cast<float>(i / 7 - 3)},
                     {0.3f, 0, 0}, {0, 0, 0.3f}),
            diffuseMaterial(glm::vec3(0), glm::vec3(1 + static_cast<float>(i % 3))));
    }
    for (const bool quads : {false, true}) {
        PathTracerSettings settings = samples(256, quads);
        settings.estimator = Estimator::MaterialsOnly;
        const double truth = irradianceAt(scene, {0, 0, 0}, settings);
        for (const Estimator way : {Estimator::Mis, Estimator::LightsOnly}) {
            settings.estimator = way;
            EXPECT_NEAR(irradianceAt(scene, {0, 0, 0}, settings) / truth, 1, 0.02);
        }
    }
}

// castsShadow: light that comes straight from lights; voxelized: all other light.
TEST(PathTracerLight, BlockersAreThoseOfTheFlags) {
    const auto lit = [](bool castsShadow, bool voxelized, bool lightCasts) {
        Scene scene = floorScene();
        scene.lights.push_back(light(LightType::Point, {0, 2, 0}, 4));
        scene.lights[0].castsShadow = lightCasts;
        scene.sky = glm::vec3(1);
        addInstance(scene, quadMesh({-50, 1, 50}, {0, 0, -100}, {100, 0, 0}), diffuseMaterial(glm::vec3(0)));
        scene.instances.back().castsShadow = castsShadow;
        scene.instances.back().voxelized = voxelized;
        Camera camera = cameraAbove({0.2f, 0, 0}, 0.5f, 0.001f);  // below the blocker
        const PathTracedPicture picture = PathTracer(scene).render(camera, 4, 4, samples(256));
        return std::pair(meanOf(picture.direct) * std::numbers::pi > 0.9, meanOf(picture.indirect) > 0.9);
    };
    EXPECT_EQ(lit(true, true, true), std::pair(false, false));
    EXPECT_EQ(lit(false, true, true), std::pair(true, false));
    EXPECT_EQ(lit(true, false, true), std::pair(false, true));
    EXPECT_EQ(lit(true, true, false), std::pair(true, false));
}

}  // namespace
}  // namespace conelight::test
