// SPDX-License-Identifier: MIT
// What surfaces do with light in the path tracer: white furnaces of the GGX lobe against a quadrature of
// src/math/brdf.h, sampling against density, textures, masks, normal maps, unlit and mirrored instances, and
// scenes whose normals are nonsense.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "math/brdf.h"
#include "reference/materials.h"
#include "reference/path_tracer.h"
#include "support/truth_rig.h"
#include "support/view_rig.h"

namespace conelight::test {
namespace {

using namespace reference;

PathTracedPicture render(const Scene& scene, const Camera& camera, int samples, int size = 4) {
    PathTracerSettings settings;
    settings.samplesPerPixel = samples;
    const PathTracedPicture picture = PathTracer(scene).render(camera, size, size, settings);
    EXPECT_EQ(picture.badSamples, 0u);
    return picture;
}

Surface flatSurface(const Material& m) {
    Surface s;
    s.geometricNormal = s.shadingNormal = {0, 0, 1};
    s.material = &m;
    s.baseColor = glm::vec3(m.baseColor);
    s.metallic = m.metallic;
    s.roughness = m.roughness;
    return s;
}

// Reflected share of a white furnace by the specular lobe: midpoint rule over the half vectors' slopes
// tan(theta) = alpha sqrt(u / (1 - u)), which spreads the points as GGX does; |dl / dh| = 4 (v.h).
double specularQuadrature(const math::Brdf& brdf, const glm::vec3& toEye) {
    constexpr int kU = 800, kPhi = 360;
    const double alpha = static_cast<double>(brdf.alpha);
    double sum = 0;
    for (int i = 0; i < kU; ++i) {
        const double u = (i + 0.5) / kU;
        const double slope2 = alpha * alpha * u / (1 - u);
        const double cosine = 1 / std::sqrt(1 + slope2), sine = std::sqrt(1 - cosine * cosine);
        // Density of h per solid angle of these points: D cos.
        const double d = cosine * cosine * (slope2 / (alpha * alpha) + 1);
        const double density = cosine / (std::numbers::pi * alpha * alpha * d * d);
        for (int j = 0; j < kPhi; ++j) {
            const double phi = 2 * std::numbers::pi * (j + 0.5) / kPhi;
            const glm::dvec3 h(sine * std::cos(phi), sine * std::sin(phi), cosine);
            const double VoH = glm::dot(glm::dvec3(toEye), h);
            if (VoH <= 0) continue;
            const glm::dvec3 l = 2 * VoH * h - glm::dvec3(toEye);
            if (l.z <= 0) continue;
            const glm::vec3 f = math::brdfSpecular(brdf, {0, 0, 1}, glm::vec3(l), toEye);
            sum += static_cast<double>(f.g) * l.z * 4 * VoH / density / kU / kPhi;
        }
    }
    return sum;
}

TEST(PathTracerMaterial, WhiteFurnaceOfTheLobeIsTheQuadrature) {
    for (const float metallic : {0.0f, 1.0f})
        for (const float roughness : {0.15f, 0.4f, 0.7f, 1.0f})
            for (const double angle : {0.2, 1.0, 1.4}) {
                Material material;
                material.baseColor = {1, 1, 1, 1};
                material.metallic = metallic;
                material.roughness = roughness;
                Scene scene;
                addInstance(scene, groundMesh(10), material);
                scene.sky = glm::vec3(1);
                const PathTracedPicture picture = render(scene, cameraSlanted(angle), 4096);

                const glm::vec3 toEye(std::sin(angle), 0, std::cos(angle));
                const math::Brdf brdf =
                    math::makeBrdf(glm::vec3(1), metallic, roughness, glm::vec3(0.04f), toEye.z);
                const double truth = specularQuadrature(brdf, toEye);
                EXPECT_NEAR(meanOf(picture.specular) / truth, 1, 0.005)
                    << "metallic " << metallic << " roughness " << roughness << " angle " << angle;
                EXPECT_NEAR(meanOf(picture.diffuse), static_cast<double>(brdf.diffuse.g), 0.005);
                // Nothing is lost but by the fit of the compensation (0.6 %, lib/brdf.glsl).
                EXPECT_NEAR(meanOf(picture.full), 1, 0.012);
            }
}

// The density that sample() has is the one that evaluate() tells: means of 1 / density count the hemisphere.
TEST(PathTracerMaterial, SamplesFollowTheirDensity) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(0, 1);
    for (const float roughness : {0.3f, 1.0f})
        for (const float z : {0.9f, 0.2f, -0.3f}) {  // below the horizon as well: clamped to grazing
            Material material;
            material.roughness = roughness;
            const Surface surface = flatSurface(material);
            const glm::vec3 toEye(std::sqrt(1 - z * z), 0, z);
            const Reflection reflection(surface, toEye);
            constexpr int kSamples = 200000;
            double above = 0, weighted = 0;
            for (int i = 0; i < kSamples; ++i) {
                const glm::vec3 l = reflection.sample(uniform(random), {uniform(random), uniform(random)});
                EXPECT_NEAR(glm::length(l), 1, 1e-4);
                if (l.z <= 0) continue;
                above += 1;
                // Of light that grows towards the horizon on one side: a smooth test function.
                weighted += (1 + static_cast<double>(l.x)) * static_cast<double>(l.z) /
                            static_cast<double>(reflection.evaluate(l).density);
            }
            // Integral of (1 + x) z over the hemisphere is pi.
            EXPECT_NEAR(weighted / kSamples / std::numbers::pi, 1, 0.02) << roughness << " " << z;
            EXPECT_GT(above / kSamples, 0.5);
        }
}

// A mirror shows what it mirrors: a glowing wall at 45 degrees over white metal of least roughness.
TEST(PathTracerMaterial, SmoothMetalMirrorsAnEmitter) {
    Material metal;
    metal.baseColor = {1, 1, 1, 1};
    metal.metallic = 1;
    metal.roughness = 0;
    Scene scene;
    addInstance(scene, groundMesh(2), metal);
    addInstance(scene, quadMesh({-3, 0.1f, -1.5f}, {0, 0, 3}, {0, 4, 0}),
                diffuseMaterial(glm::vec3(0), glm::vec3(5)));
    scene.materials.back().doubleSided = true;
    const PathTracedPicture picture = render(scene, cameraSlanted(0.7854), 256);
    EXPECT_NEAR(meanOf(picture.direct), 5, 0.05);
    EXPECT_NEAR(meanOf(picture.indirect), 0, 1e-6);
}

Texture texture(int width, int height, std::vector<std::uint8_t> rgba, bool srgb) {
    Texture t;
    t.width = width;
    t.height = height;
    t.rgba = std::move(rgba);
    t.srgb = srgb;
    t.filter = TextureFilter::Nearest;
    t.wrapU = t.wrapV = TextureWrap::Clamp;
    return t;
}

Light sun(const glm::vec3& direction, float irradiance) {
    Light light;
    light.type = LightType::Directional;
    light.direction = glm::normalize(direction);
    light.intensity = glm::vec3(irradiance);
    return light;
}

TEST(PathTracerMaterial, MaskedTexelsAreNotThere) {
    Scene scene;
    addInstance(scene, groundMesh(4), diffuseMaterial());
    Mesh blocker = quadMesh({-1, 1, 1}, {2, 0, 0}, {0, 0, -2});
    blocker.uvs.resize(4);
    for (std::size_t i = 0; i < 4; ++i) blocker.uvs[i] = {blocker.positions[i].x > 0 ? 1 : 0, 0.5f};
    scene.textures.push_back(texture(2, 1, {255, 255, 255, 0, 255, 255, 255, 255}, true));
    Material mask = diffuseMaterial(glm::vec3(0));
    mask.alphaMode = AlphaMode::Mask;
    mask.doubleSided = true;
    mask.baseColorTexture.texture = 0;
    addInstance(scene, std::move(blocker), mask);
    scene.lights.push_back(sun({0, -1, 0}, 3));
    // Below the blocker: light falls where x < 0. From above, the same half is seen through.
    for (const float height : {0.5f, 2.0f}) {
        const auto shown = [&](float x) {
            return meanOf(render(scene, cameraAbove({x, 0, 0}, height, 0.01f), 2).direct) * std::numbers::pi;
        };
        EXPECT_NEAR(shown(-0.5f), 3, 1e-4);
        EXPECT_NEAR(shown(0.5f), 0, 1e-6);
    }
}

// A normal map that leans by 0.5 rad along the tangent: cos(0.5) of the sun above, cos(0.2) at 0.3 rad.
TEST(PathTracerMaterial, NormalMapsTurnTheNormal) {
    Scene scene;
    Mesh ground = groundMesh(4);
    ground.uvs.assign(4, {0.5f, 0.5f});
    ground.tangents.assign(4, {1, 0, 0, 1});
    const auto encoded = [](double c) {
        return static_cast<std::uint8_t>(std::lround((c * 0.5 + 0.5) * 255));
    };
    scene.textures.push_back(
        texture(1, 1, {encoded(std::sin(0.5)), encoded(0), encoded(std::cos(0.5)), 255}, false));
    Material material = diffuseMaterial();
    material.normalTexture.texture = 0;
    addInstance(scene, std::move(ground), material);
    for (const float angle : {0.0f, 0.3f}) {
        scene.lights.assign(1, sun({-std::sin(angle), -std::cos(angle), 0}, 2));
        EXPECT_NEAR(meanOf(render(scene, cameraAbove({0, 0, 0}, 1, 0.01f), 2).direct) * std::numbers::pi,
                    2 * std::cos(0.5 - static_cast<double>(angle)), 0.01);  // 8 bits: 0.004 per component
    }
}

// Unlit: shown as it is, lights nothing, blocks light.
TEST(PathTracerMaterial, UnlitIsSeenAndLightsNothing) {
    Scene scene;
    addInstance(scene, groundMesh(4), diffuseMaterial());
    Material unlit;
    unlit.baseColor = {0.25f, 0.5f, 0.75f, 1};
    unlit.unlit = true;
    unlit.doubleSided = true;
    addInstance(scene, quadMesh({-1, 1, 1}, {2, 0, 0}, {0, 0, -2}), unlit);
    scene.lights.push_back(sun({0, -1, 0}, 3));
    const glm::dvec3 seen = meanColorOf(render(scene, cameraAbove({0, 0, 0}, 2, 0.1f), 4).full);
    EXPECT_NEAR(seen.r, 0.25, 1e-5);
    EXPECT_NEAR(seen.g, 0.5, 1e-5);
    EXPECT_NEAR(seen.b, 0.75, 1e-5);
    EXPECT_EQ(meanOf(render(scene, cameraAbove({0, 0, 0}, 0.5f, 0.1f), 64).full), 0);
}

// Smooth sphere in a white furnace: white diffuse shows 1, but for what coarse silhouettes hide below the
// geometric horizon.
TEST(PathTracerMaterial, SphereVanishesInTheWhiteFurnace) {
    Scene scene;
    addInstance(scene, sphereMesh(64, 32), diffuseMaterial());
    scene.sky = glm::vec3(1);
    // Mirrored instances keep their front.
    for (const float x : {1.0f, -1.0f}) {
        scene.instances[0].worldFromObject = glm::mat4(1);
        scene.instances[0].worldFromObject[0][0] = x;
        Camera camera = cameraSlanted(1.2);
        camera.eye *= 3.0f;
        camera.fovY = 0.9f;
        const PathTracedPicture picture = render(scene, camera, 64, 24);
        EXPECT_NEAR(meanOf(picture.full), 1, 0.005);
        EXPECT_GT(picture.full.pixels[12 * 24 + 12].a, 0.99f);
    }
}

// Zero and inverted normals, triangles without area, lights on surfaces, sizes far from a metre, a camera in
// a wall: every pixel is a number, and nothing is brighter than the sum of the series allows.
TEST(PathTracerMaterial, NastyScenesGiveNumbers) {
    for (const float scale : {1e-4f, 1.0f, 1e5f}) {
        Material glossy;
        glossy.roughness = 0;
        glossy.metallic = 1;
        glossy.baseColor = {0.9f, 0.9f, 0.9f, 1};
        Scene scene = closedBox(glossy);
        for (Mesh& mesh : scene.meshes)
            for (glm::vec3& p : mesh.positions) p *= scale;
        scene.meshes[0].normals.assign(4, glm::vec3(0));
        scene.meshes[1].normals.assign(4, -scene.meshes[1].normals[0]);
        scene.meshes[2].normals.assign(4, glm::normalize(glm::vec3(1, 0.001f, 0)));
        scene.meshes[3].tangents.assign(4, glm::vec4(0));
        scene.meshes[3].uvs.assign(4, glm::vec2(1e30f, -1e30f));
        scene.textures.push_back(texture(1, 1, {0, 0, 0, 255}, false));
        scene.materials[3].normalTexture.texture = 0;
        Mesh sliver;
        sliver.positions = {{0, 0, 0}, {scale, 0, 0}, {2 * scale, 0, 0}, {0, 0, 0}};
        sliver.indices = {0, 1, 2, 0, 0, 3};
        addInstance(scene, sliver, diffuseMaterial(glm::vec3(0.5f), glm::vec3(1)));
        Light light;
        light.position = scale * glm::vec3(0, -1, 0);  // in the floor
        light.intensity = glm::vec3(scale * scale);
        scene.lights.push_back(light);
        light.type = LightType::Spot;
        light.direction = glm::vec3(0);
        scene.lights.push_back(light);
        light.type = LightType::Rect;
        light.position = glm::vec3(0);
        light.halfU = light.halfV = {scale, 0, 0};  // no area
        light.intensity = glm::vec3(1);
        scene.lights.push_back(light);
        scene.sky = glm::vec3(1);
        Camera camera = scene.cameras[0];
        camera.eye = scale * glm::vec3(1, 0, 0);
        camera.target = scale * glm::vec3(-1, 0.1f, 0.2f);
        camera.zNear = 1e-3f * scale;
        camera.zFar = 1e3f * scale;
        const PathTracedPicture picture = render(scene, camera, 64, 12);
        for (const glm::vec4& p : picture.full.pixels)
            EXPECT_TRUE(std::isfinite(p.r) && p.r >= 0) << scale << ": " << p.r;
    }
}

}  // namespace
}  // namespace conelight::test
