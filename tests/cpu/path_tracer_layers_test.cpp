// SPDX-License-Identifier: MIT
// Coat and sheen in the path tracer: white furnaces, sampling against evaluation, the three ways of finding light, what
// a smooth coat mirrors, its own normals, and where there are no layers.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "math/sheen.h"
#include "reference/layers.h"
#include "reference/materials.h"
#include "reference/path_tracer.h"
#include "support/truth_rig.h"
#include "support/view_rig.h"

namespace conelight::test {
namespace {

using namespace reference;

constexpr double kPi = std::numbers::pi;

// Of albedo, coat and sheen.
Material layered(float albedo, float coat, float coatRoughness, float sheen, float sheenRoughness) {
    Material m = diffuseMaterial(glm::vec3(albedo));
    m.coat = coat;
    m.coatRoughness = coatRoughness;
    m.sheenColor = glm::vec3(sheen);
    m.sheenRoughness = sheenRoughness;
    return m;
}

Surface flatSurfaceOf(const Material& m) {
    Surface s;
    s.geometricNormal = s.shadingNormal = s.coatNormal = {0, 0, 1};
    s.material = &m;
    s.baseColor = glm::vec3(m.baseColor);
    s.metallic = m.metallic;
    s.roughness = m.roughness;
    s.dielectricF0 = glm::vec3(m.specular > 0 ? 0.04f : 0);
    s.coat = m.coat;
    s.coatRoughness = m.coatRoughness;
    s.sheenColor = m.sheenColor;
    s.sheenRoughness = m.sheenRoughness;
    return s;
}

glm::vec3 eyeAt(double cosine) {
    return {static_cast<float>(std::sqrt(1 - cosine * cosine)), 0, static_cast<float>(cosine)};
}

// Of f over the hemisphere, by cosines that are squares: sheen lies along the horizon.
template <class F>
double overHemisphere(const F& f) {
    constexpr int kCosines = 400, kTurns = 200;
    double sum = 0;
    for (int i = 0; i < kCosines; ++i) {
        const double u = (i + 0.5) / kCosines, z = u * u, sine = std::sqrt(1 - z * z);
        for (int j = 0; j < kTurns; ++j) {
            const double turn = 2 * kPi * (j + 0.5) / kTurns;
            sum += 2 * u * f(glm::vec3(sine * std::cos(turn), sine * std::sin(turn), z));
        }
    }
    return sum * 2 * kPi / (kCosines * kTurns);
}

TEST(PathTracerLayers, SheenSendsBackWhatItsTableSays) {
    for (const float roughness : {0.12f, 0.31f, 0.55f, 0.83f, 1.0f})
        for (const double cosine : {0.04, 0.17, 0.4, 0.77, 1.0}) {
            const glm::vec3 eye = eyeAt(cosine);
            const double truth = overHemisphere([&](const glm::vec3& l) {
                const glm::vec3 h = glm::normalize(l + eye);
                return static_cast<double>(math::sheenVisible(roughness, h.z, l.z, eye.z) * l.z);
            });
            const math::SheenShare share = math::sheenShare(eye.z, roughness);
            EXPECT_NEAR(static_cast<double>(share.albedo), std::min(truth, 1.0), 0.012)
                << roughness << " " << cosine;
            EXPECT_LE(share.albedo, 1.0f);
            EXPECT_NEAR(static_cast<double>(share.scale) * truth, static_cast<double>(share.albedo), 0.02);
        }
}

// What layers send on and what they take from the base is the same: a white surface is gone in a white furnace, and
// none sends back more than arrives.
TEST(PathTracerLayers, WhiteSurfacesVanishInTheWhiteFurnace) {
    const Material all[] = {layered(1, 1, 0, 0, 0),       layered(1, 1, 0.3f, 0, 0),
                            layered(1, 0.5f, 0.8f, 0, 0), layered(1, 0, 0, 1, 0.2f),
                            layered(1, 0, 0, 1, 0.7f),    layered(1, 1, 0.1f, 1, 0.5f),
                            layered(0.2f, 1, 0.4f, 1, 1)};
    for (const Material& material : all)
        for (const double angle : {0.1, 0.8, 1.3, 1.5}) {
            Scene scene;
            addInstance(scene, groundMesh(10), material);
            scene.sky = glm::vec3(1);
            PathTracerSettings settings;
            settings.samplesPerPixel = 8192;
            const PathTracedPicture picture = PathTracer(scene).render(cameraSlanted(angle), 4, 4, settings);
            EXPECT_EQ(picture.badSamples, 0u);
            const double sent = meanOf(picture.full);
            EXPECT_LE(sent, 1.012);
            if (material.baseColor.r == 1) {
                EXPECT_GE(sent, 0.985) << angle << " " << material.coatRoughness;
            }
        }
}

TEST(PathTracerLayers, SamplesFollowTheirDensity) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> uniform(0, 1);
    const Material all[] = {layered(0.5f, 1, 0.3f, 0, 0), layered(0.5f, 0, 0, 1, 0.4f),
                            layered(0.5f, 0.7f, 0.5f, 0.6f, 0.6f), layered(0, 1, 0.4f, 1, 0.5f)};
    for (const Material& material : all)
        for (const double z : {0.95, 0.5, 0.15}) {
            const Reflection reflection(flatSurfaceOf(material), eyeAt(z));
            constexpr int kSamples = 200000;
            double hemisphere = 0, sent = 0;
            for (int i = 0; i < kSamples; ++i) {
                const Reflection::Draw drawn =
                    reflection.draw(uniform(random), {uniform(random), uniform(random)});
                EXPECT_FALSE(drawn.alone);
                if (!(drawn.direction.z > 0)) continue;
                const Reflection::Value value = reflection.evaluate(drawn.direction);
                ASSERT_GT(value.density, 0);
                hemisphere += (1 + static_cast<double>(drawn.direction.x)) *
                              static_cast<double>(drawn.direction.z) / static_cast<double>(value.density);
                sent += static_cast<double>(value.sum().g) / static_cast<double>(value.density);
            }
            if (material.baseColor.r > 0) {
                EXPECT_NEAR(hemisphere / kSamples / kPi, 1, 0.03) << z;
            }
            const double truth = overHemisphere(
                [&](const glm::vec3& l) { return static_cast<double>(reflection.evaluate(l).sum().g); });
            EXPECT_NEAR(sent / kSamples / truth, 1, 0.02) << z;
        }
}

// Lights drawn, directions drawn and both together show the same of a coat and of sheen under a lamp.
TEST(PathTracerLayers, EveryWayOfFindingLightAgrees) {
    for (const Material& material : {layered(0.3f, 1, 0.35f, 0, 0), layered(0.1f, 0.5f, 0.6f, 0.8f, 0.4f)}) {
        Scene scene;
        addInstance(scene, groundMesh(3), material);
        Light lamp;
        lamp.type = LightType::Rect;
        lamp.position = {-1, 1, 0};
        lamp.direction = {0, -1, 0};
        lamp.halfU = {0.5f, 0, 0};
        lamp.halfV = {0, 0, 0.5f};
        lamp.intensity = glm::vec3(4);
        scene.lights.push_back(lamp);
        Camera camera;
        camera.eye = {1.2f, 1, 0};
        camera.target = {0, 0, 0};
        camera.up = {0, 0, 1};
        camera.fovY = 0.2f;
        double shown[3];
        for (const Estimator estimator : {Estimator::Mis, Estimator::LightsOnly, Estimator::MaterialsOnly}) {
            PathTracerSettings settings;
            settings.samplesPerPixel = 4096;
            settings.estimator = estimator;
            shown[static_cast<int>(estimator)] =
                meanOf(PathTracer(scene).render(camera, 8, 8, settings).direct);
        }
        const double mis = shown[static_cast<int>(Estimator::Mis)];
        for (const double other : shown) EXPECT_NEAR(other / mis, 1, 0.01);
    }
}

// Lacquer on black: of a glowing wall mirrored at an angle it shows Fresnel's share, and half of it where half is coated.
TEST(PathTracerLayers, ASmoothCoatMirrors) {
    for (const float coat : {1.0f, 0.5f}) {
        Material lacquer = layered(0, coat, 0, 0, 0);
        lacquer.specular = 0;
        Scene scene;
        addInstance(scene, groundMesh(2), lacquer);
        addInstance(scene, quadMesh({-3, 0.1f, -1.5f}, {0, 0, 3}, {0, 4, 0}),
                    diffuseMaterial(glm::vec3(0), glm::vec3(5)));
        scene.materials.back().doubleSided = true;
        const double angle = 1.1;
        PathTracerSettings settings;
        settings.samplesPerPixel = 512;
        const PathTracedPicture picture = PathTracer(scene).render(cameraSlanted(angle), 4, 4, settings);
        const double fresnel = 0.04 + 0.96 * std::pow(1 - std::cos(angle), 5);
        EXPECT_NEAR(meanOf(picture.full), 5 * static_cast<double>(coat) * fresnel, 0.005);
    }
}

// What glows below a coat is seen by what the coat lets through.
TEST(PathTracerLayers, EmissionIsSeenThroughTheLayers) {
    Scene scene;
    Material glowing = layered(0, 1, 0, 0, 0);
    glowing.emission = glm::vec3(3);
    addInstance(scene, groundMesh(2), glowing);
    PathTracerSettings settings;
    settings.samplesPerPixel = 4;
    const PathTracedPicture picture =
        PathTracer(scene).render(cameraAbove({0, 0, 0}, 1, 0.01f), 4, 4, settings);
    EXPECT_NEAR(meanOf(picture.full), 3 * 0.96, 1e-3);
}

Texture plainTexture(std::vector<std::uint8_t> rgba, bool srgb) {
    Texture t;
    t.width = t.height = 1;
    t.rgba = std::move(rgba);
    t.srgb = srgb;
    return t;
}

// Coats lie smoothly over a base whose normals a map bends, unless they have a map of their own.
TEST(PathTracerLayers, CoatsHaveNormalsAndTexturesOfTheirOwn) {
    Scene scene;
    Mesh ground = groundMesh(2);
    ground.uvs.assign(4, {0.5f, 0.5f});
    ground.tangents.assign(4, {1, 0, 0, 1});
    scene.textures = {plainTexture({230, 128, 180, 255}, false), plainTexture({51, 102, 0, 204}, false)};
    Material m = layered(0.5f, 1, 0.5f, 1, 0.5f);
    m.normalTexture.texture = 0;
    m.coatTexture.texture = m.coatRoughnessTexture.texture = m.sheenRoughnessTexture.texture = 1;
    m.sheenColorTexture.texture = 1;
    addInstance(scene, std::move(ground), m);
    const auto seen = [&] {
        const RayScene rays(scene);
        Ray ray;
        ray.origin = {0.1f, 1, 0.1f};
        ray.direction = {0, -1, 0};
        RayHit hit;
        EXPECT_TRUE(rays.intersect(RayKind::Camera, ray, hit, Blended::Met));
        return surfaceAt(scene, ray, hit);
    };
    const Surface s = seen();
    EXPECT_LT(s.shadingNormal.y, 0.9f);
    EXPECT_NEAR(s.coatNormal.y, 1, 1e-6);
    EXPECT_NEAR(s.coat, 0.2, 1e-6);
    EXPECT_NEAR(s.coatRoughness, 0.2, 1e-6);
    EXPECT_NEAR(s.sheenColor.g, 0.4, 1e-6);
    EXPECT_NEAR(s.sheenRoughness, 0.4, 1e-6);
    scene.materials[0].coatNormalTexture.texture = 0;
    EXPECT_NEAR(glm::distance(seen().coatNormal, s.shadingNormal), 0, 1e-6);
    scene.materials[0].transmission = 0.5f;  // glass has no layers
    EXPECT_FALSE(seen().layered());
}

// The one colour that voxels and radiosity know: no more than white, and that of the base without layers.
TEST(PathTracerLayers, OneColourKeepsTheEnergy) {
    EXPECT_EQ(math::evenLayers(0, 0.5f, glm::vec3(0), 0.5f).of(glm::vec3(0.3f)), glm::vec3(0.3f));
    for (const float roughness : {0.0f, 0.4f, 1.0f}) {
        const math::LayerAlbedo both = math::evenLayers(1, roughness, {1, 0.5f, 0.2f}, roughness);
        EXPECT_LE(both.of(glm::vec3(1)).r, 1 + 1e-6f);
        EXPECT_NEAR(both.of(glm::vec3(1)).r, 1, 1e-6);
        EXPECT_GT(both.of(glm::vec3(0)).r, both.of(glm::vec3(0)).b);
    }
}

}  // namespace
}  // namespace conelight::test
