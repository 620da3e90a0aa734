// SPDX-License-Identifier: MIT
// Direct light through the passes that the modes use (shadow maps, G-buffer, direct light) against closed
// forms, and the two classical faults of shadow maps: acne and peter-panning.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "gather/direct_light.h"
#include "support/gl_fixture.h"
#include "support/view_rig.h"

namespace conelight::test {
namespace {

// White, and without specular lobe: radiance = irradiance / pi.
Material lambert() {
    Material material;
    material.baseColor = {1, 1, 1, 1};
    material.specular = 0;
    return material;
}

Camera cameraAt(const glm::vec3& eye, const glm::vec3& target) {
    Camera camera;
    camera.eye = eye;
    camera.target = target;
    camera.up = std::abs(glm::normalize(target - eye).y) > 0.99f ? glm::vec3(0, 0, -1) : glm::vec3(0, 1, 0);
    return camera;
}

// The plane y = 0, 2 * half wide.
Mesh floorMesh(float half) { return quadMesh({-half, 0, half}, {2 * half, 0, 0}, {0, 0, -2 * half}); }

Light pointLight(const glm::vec3& position, float intensity) {
    Light light;
    light.position = position;
    light.intensity = glm::vec3(intensity);
    return light;
}

class DirectLightTest : public GlTest {
  protected:
    static constexpr int kWidth = 96, kHeight = 64;

    // Irradiance (red) per pixel, row 0 at the bottom; -1 in the background.
    std::vector<float> irradiance(const Scene& scene, const Camera& camera,
                                  const LightSettings& settings = {}) {
        ViewRig rig(scene, camera, kWidth, kHeight);
        rig.wanted = {.settings = settings, .emissiveQuads = false};
        rig.draw(device());
        gather::DirectLight direct;
        direct.draw(device(), {rig.gpuScene, rig.lights, rig.surfaces});
        gl::barrier(gl::Access::TextureFetch);
        std::vector<glm::vec4> pixels(kWidth * kHeight);
        direct.diffuse().read(0, GL_RGBA, GL_FLOAT, pixels.data(), pixels.size() * sizeof(glm::vec4));
        std::vector<float> result;
        for (const glm::vec4& pixel : pixels)
            result.push_back(pixel.a > 0 ? pixel.r * static_cast<float>(std::numbers::pi) : -1.0f);
        return result;
    }

    static glm::dvec3 floorPoint(const Camera& camera, int x, int y) {
        return pixelOnPlane(camera, {kWidth, kHeight}, {x, y}, {0, 1, 0}, 0);
    }

    // Largest relative difference from expected(point on the floor) over all pixels where that is positive.
    template <class Expected>
    void expectFloor(const Scene& scene, const Camera& camera, double tolerance, Expected expected,
                     const LightSettings& settings = {}) {
        const std::vector<float> got = irradiance(scene, camera, settings);
        double worst = 0;
        int compared = 0;
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                const double value = static_cast<double>(got[static_cast<std::size_t>(y * kWidth + x)]);
                if (value < 0) continue;
                const double want = expected(floorPoint(camera, x, y));
                if (!(want > 0)) continue;
                ++compared;
                worst = std::max(worst, std::abs(value - want) / want);
            }
        EXPECT_GT(compared, kWidth * kHeight / 4);
        EXPECT_LE(worst, tolerance);
        RecordProperty("largest_relative_error", std::to_string(worst));
    }
};

TEST_F(DirectLightTest, PointLightFollowsTheInverseSquare) {
    Scene scene;
    addInstance(scene, floorMesh(3), lambert());
    scene.lights.push_back(pointLight({0.4f, 1.3f, -0.2f}, 7));
    expectFloor(scene, cameraAt({0, 3, 3}, {0, 0, 0}), 0.005, [&](const glm::dvec3& p) {
        const glm::dvec3 l = glm::dvec3(scene.lights[0].position) - p;
        const double d = glm::length(l);
        return 7.0 * l.y / (d * d * d);
    });
}

TEST_F(DirectLightTest, PointLightWithTheThesisFalloffAndARange) {
    Scene scene;
    addInstance(scene, floorMesh(3), lambert());
    scene.lights.push_back(pointLight({0.4f, 1.3f, -0.2f}, 7));
    scene.lights[0].customFalloff = true;
    scene.lights[0].range = 9;
    expectFloor(scene, cameraAt({0, 3, 3}, {0, 0, 0}), 0.005, [&](const glm::dvec3& p) {
        const glm::dvec3 l = glm::dvec3(scene.lights[0].position) - p;
        const double d = glm::length(l);
        return 7.0 * (l.y / d) / (1 + 0.15 * d + 0.45 * d * d) * (1 - std::pow(d / 9, 4));
    });
}

TEST_F(DirectLightTest, SpotLightsNarrowAndWide) {
    for (const double outer : {0.6, 1.4}) {
        Scene scene;
        addInstance(scene, floorMesh(3), lambert());
        Light light = pointLight({0.2f, 1.5f, 0.1f}, 5);
        light.type = LightType::Spot;
        light.direction = glm::normalize(glm::vec3(0.1f, -1, -0.2f));
        light.innerAngle = 0.3f;
        light.outerAngle = static_cast<float>(outer);
        scene.lights.push_back(light);
        expectFloor(scene, cameraAt({0, 1.6f, 0.6f}, {0, 0, 0}), 0.005, [&](const glm::dvec3& p) {
            const glm::dvec3 l = glm::dvec3(light.position) - p;
            const double d = glm::length(l);
            const double c = -glm::dot(l / d, glm::dvec3(light.direction));
            const double t = std::clamp((c - std::cos(outer)) / (std::cos(0.3) - std::cos(outer)), 0.0, 1.0);
            // Near the outer edge a relative comparison of what vanishes there says nothing.
            return t < 0.05 ? 0.0 : 5.0 * l.y / (d * d * d) * t * t;
        });
    }
}

TEST_F(DirectLightTest, SunFollowsTheCosine) {
    Scene scene;
    addInstance(scene, floorMesh(3), lambert());
    Light light;
    light.type = LightType::Directional;
    light.direction = glm::normalize(glm::vec3(1, -0.5f, 0.3f));
    light.intensity = glm::vec3(3);
    scene.lights.push_back(light);
    expectFloor(scene, cameraAt({0, 3, 3}, {0, 0, 0}), 0.005,
                [&](const glm::dvec3&) { return -3.0 * static_cast<double>(light.direction.y); });
}

// Form factor of a point to a parallel rectangle with a corner straight above it (a, b: edges over distance;
// configuration B-4 of Howell's catalogue).
double cornerFormFactor(double a, double b) {
    const double u = std::sqrt(1 + a * a), v = std::sqrt(1 + b * b);
    return (a / u * std::atan(b / u) + b / v * std::atan(a / v)) / (2 * std::numbers::pi);
}

Light rectangle(const glm::vec3& position, const glm::vec3& direction, const glm::vec3& halfU,
                const glm::vec3& halfV, float radiance) {
    Light light = pointLight(position, radiance);
    light.type = LightType::Rect;
    light.direction = direction;
    light.halfU = halfU;
    light.halfV = halfV;
    return light;
}

TEST_F(DirectLightTest, RectangleAboveAParallelPlane) {
    Scene scene;
    addInstance(scene, floorMesh(3), lambert());
    const Light light = rectangle({0.1f, 1, -0.1f}, {0, -1, 0}, {0.5f, 0, 0}, {0, 0, 0.3f}, 4);
    scene.lights.push_back(light);
    expectFloor(scene, cameraAt({0, 2.5f, 2.5f}, {0, 0, 0}), 0.01, [&](const glm::dvec3& p) {
        // Signed sum over the four corners.
        const glm::dvec3 c = glm::dvec3(light.position) - p;
        const auto f = [&](double x, double z) {
            return std::copysign(cornerFormFactor(std::abs(x) / c.y, std::abs(z) / c.y), x * z);
        };
        const double x0 = c.x - 0.5, x1 = c.x + 0.5, z0 = c.z - 0.3, z1 = c.z + 0.3;
        return 4.0 * std::numbers::pi * (f(x1, z1) - f(x0, z1) - f(x1, z0) + f(x0, z0));
    });
}

TEST_F(DirectLightTest, RectangleThatTheHorizonCuts) {
    // An upright light that reaches 0.4 below the floor, against a dense sum over its visible part.
    Scene scene;
    addInstance(scene, floorMesh(3), lambert());
    scene.lights.push_back(rectangle({0, 0.1f, -1}, {0, 0, 1}, {0.7f, 0, 0}, {0, 0.5f, 0}, 4));
    LightSettings settings;
    settings.shadowSize = 0;
    const auto expected = [&](const glm::dvec3& p) {
        if (p.z < -0.8) return 0.0;
        double sum = 0;
        const int n = 100;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                const glm::dvec3 q(0.7 * (2 * (i + 0.5) / n - 1), 0.6 * (j + 0.5) / n, -1.0);
                const glm::dvec3 l = q - p;
                const double d2 = glm::dot(l, l);
                sum += l.y * -l.z / (d2 * d2);
            }
        return 4.0 * sum * (1.4 * 0.6 / (n * n));
    };
    expectFloor(scene, cameraAt({0, 2, 2.5f}, {0, 0, 0}), 0.01, expected, settings);
}

// ---- Shadows ----------------------------------------------------------------------------------------------

std::vector<Light> grazingLights() {
    Light spot = pointLight({-1.9f, 0.05f, 0.1f}, 1);
    spot.type = LightType::Spot;
    spot.direction = glm::normalize(glm::vec3(1, -0.02f, 0.02f));
    spot.outerAngle = 0.9f;
    Light sun;
    sun.type = LightType::Directional;
    sun.direction = glm::normalize(glm::vec3(1, -0.01f, 0.37f));
    return {pointLight({0.05f, 0.04f, -0.1f}, 1), spot, sun,
            rectangle({-0.3f, 0.1f, 0.2f}, {1, 0.1f, 0}, {0, 0, 0.2f}, {-0.002f, 0.02f, 0}, 1)};
}

// Everything about the vertical axis.
Light turned(Light light, float angle) {
    const auto rotate = [&](glm::vec3& v) {
        v = {std::cos(angle) * v.x + std::sin(angle) * v.z, v.y,
             -std::sin(angle) * v.x + std::cos(angle) * v.z};
    };
    rotate(light.position);
    rotate(light.direction);
    rotate(light.halfU);
    rotate(light.halfV);
    return light;
}

TEST_F(DirectLightTest, NoAcneOnAPlaneInGrazingLight) {
    const Camera camera = cameraAt({0, 1.2f, 2.4f}, {0, 0, 0.2f});
    LightSettings none;
    none.shadowSize = 0;
    // In several directions, so that no axis of a map is special.
    for (const float angle : {0.0f, 0.3f, 0.7853982f})
        for (const Light& base : grazingLights()) {
            Scene scene;
            addInstance(scene, floorMesh(2), lambert());
            scene.lights.push_back(turned(base, angle));
            const std::vector<float> lit = irradiance(scene, camera, none);
            for (const int filter : {0, 2, 4}) {
                LightSettings settings;
                settings.shadowSize = 512;
                settings.shadowFilter = filter;
                const std::vector<float> shadowed = irradiance(scene, camera, settings);
                int dark = 0, seen = 0;
                float least = 1;
                std::string where;
                for (std::size_t i = 0; i < lit.size(); ++i) {
                    if (!(lit[i] > 1e-6f)) continue;
                    ++seen;
                    least = std::min(least, shadowed[i] / lit[i]);
                    if (shadowed[i] >= 0.999f * lit[i]) continue;
                    if (++dark <= 5)
                        where +=
                            fmt::format(" ({}, {}): {} of {}", i % kWidth, i / kWidth, shadowed[i], lit[i]);
                }
                EXPECT_GT(seen, kWidth * kHeight / 10);
                EXPECT_EQ(dark, 0) << "light kind " << static_cast<int>(base.type) << ", turned by " << angle
                                   << ", filter " << filter << ", of " << seen << ", least " << least << ","
                                   << where;
            }
        }
}

TEST_F(DirectLightTest, ShadowsBeginAtTheFootOfABox) {
    // A box on the floor, the light behind it and above: the floor in front of the box is dark from the foot
    // on. The camera looks straight down at the foot; pixels are far smaller than shadow texels.
    Light sun;
    sun.type = LightType::Directional;
    sun.direction = glm::normalize(glm::vec3(0, -1, 1));
    const glm::vec3 position(0, 1.4f, -1.5f);
    const Camera camera = cameraAt({0, 0.5f, 0.1f}, {0, 0, 0.1f});
    LightSettings none, settings;
    none.shadowSize = 0;
    settings.shadowSize = 512;
    struct Case {
        Light light;
        double texel;  // at the foot: tangent per texel times the distance along the side's axis (1.5 m), or
                       // bounds / size
    };
    const Case cases[] = {
        {pointLight(position, 1), 1.5 * 2 / (256 - 2 * 9)},
        {sun, 2 * 2.83 / 512},
        {rectangle(position, {0, -0.7f, 1}, {0.01f, 0, 0}, {0, 0.01f, 0.007f}, 100), 2.0 / 60}};
    for (const Case& one : cases) {
        Scene scene;
        addInstance(scene, floorMesh(2), lambert());
        // Front side of the box at z = 0; 0.3 high and deep.
        addInstance(scene, quadMesh({-1, 0, 0}, {2, 0, 0}, {0, 0.3f, 0}), lambert());
        addInstance(scene, quadMesh({-1, 0.3f, 0}, {2, 0, 0}, {0, 0, -0.3f}), lambert());
        addInstance(scene, quadMesh({1, 0, -0.3f}, {-2, 0, 0}, {0, 0.3f, 0}), lambert());
        scene.lights.push_back(one.light);
        const std::vector<float> got = irradiance(scene, camera, settings);
        const std::vector<float> open = irradiance(scene, camera, none);
        double farthestLit = 0;
        int dark = 0;
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                const glm::dvec3 p = floorPoint(camera, x, y);
                const auto at = static_cast<std::size_t>(y * kWidth + x);
                // The shadow is 0.3 deep: look at its first third, with a pixel's distance from the foot.
                if (p.z < 5e-3 || p.z > 0.1 || open[at] <= 0) continue;
                if (got[at] < 0.5f * open[at])
                    ++dark;
                else
                    farthestLit = std::max(farthestLit, p.z);
            }
        EXPECT_GT(dark, 100) << "light kind " << static_cast<int>(one.light.type);
        EXPECT_LE(farthestLit, 1.5 * one.texel) << "light kind " << static_cast<int>(one.light.type);
    }
}

TEST_F(DirectLightTest, MaskedTexelsCastNoShadow) {
    // A quad above the floor whose right half is cut away, seen from below.
    Scene scene;
    addInstance(scene, floorMesh(2), lambert());
    Material leaf = lambert();
    leaf.alphaMode = AlphaMode::Mask;
    leaf.baseColorTexture.texture = 0;
    Texture texture;
    texture.width = 2;
    texture.height = 1;
    texture.filter = TextureFilter::Nearest;
    texture.wrapU = texture.wrapV = TextureWrap::Clamp;
    texture.rgba = {255, 255, 255, 255, 255, 255, 255, 0};
    scene.textures.push_back(texture);
    addInstance(scene, quadMesh({-0.5f, 0.5f, 0.5f}, {1, 0, 0}, {0, 0, -1}), leaf);
    Light sun;
    sun.type = LightType::Directional;
    sun.direction = {0, -1, 0};
    scene.lights.push_back(sun);
    const Camera camera = cameraAt({0, 0.45f, 0}, {0, 0, 0});
    const std::vector<float> got = irradiance(scene, camera);
    for (int x = 0; x < kWidth; ++x) {
        const glm::dvec3 p = floorPoint(camera, x, kHeight / 2);
        if (std::abs(p.x) < 0.03) continue;
        EXPECT_NEAR(got[static_cast<std::size_t>(kHeight / 2 * kWidth + x)], p.x < 0 ? 0.0f : 1.0f, 0.005f)
            << p.x;
    }
}

TEST_F(DirectLightTest, HalfOfARectangleBehindAWallGivesHalfItsLight) {
    // A wall up to the light's plane hides the half beyond it from the floor at its foot.
    Scene scene;
    addInstance(scene, floorMesh(2), lambert());
    addInstance(scene, quadMesh({0, 0, 2}, {0, 0, -4}, {0, 0.99f, 0}), lambert());
    scene.lights.push_back(rectangle({0, 1, 0}, {0, -1, 0}, {0.3f, 0, 0}, {0, 0, 0.3f}, 1));
    LightSettings none;
    none.shadowSize = 0;
    const Camera camera = cameraAt({0.2f, 0.4f, 0}, {0.03f, 0, 0});
    const auto centre = static_cast<std::size_t>(kHeight / 2 * kWidth + kWidth / 2);
    const float whole = irradiance(scene, camera, none)[centre];
    EXPECT_NEAR(irradiance(scene, camera)[centre] / whole, 0.5f, 0.05f);
}

// The shadow of a screen half way up to the light, whose edge is turned by `degrees` against the light's
// sides: along the penumbra the visible share falls evenly, not in the steps of the light's sample points.
TEST_F(DirectLightTest, PenumbrasAreEvenForEdgesOfAnyDirection) {
    constexpr double kHalf = 0.2;
    const Camera camera = cameraAt({0, 0.45f, 0.35f}, {0, 0, 0});
    double worst = 0;
    for (int degrees = 0; degrees < 180; degrees += 15) {
        const double angle = degrees * std::numbers::pi / 180;
        const glm::dvec3 open(std::cos(angle), 0, std::sin(angle));  // the side that is not covered
        const glm::vec3 edge(-open.z, 0, open.x);
        Scene scene;
        addInstance(scene, floorMesh(2), lambert());
        addInstance(scene, quadMesh(glm::vec3(0, 0.5f, 0) - edge, 2.0f * edge, -glm::vec3(open)), lambert());
        scene.lights.push_back(
            rectangle({0, 1, 0}, {0, -1, 0}, {float{kHalf}, 0, 0}, {0, 0, float{kHalf}}, 1));
        const std::vector<float> got = irradiance(scene, camera);
        LightSettings none;
        none.shadowSize = 0;
        const std::vector<float> whole = irradiance(scene, camera, none);
        double squares = 0;
        int count = 0;
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                const glm::dvec3 p = floorPoint(camera, x, y);
                const double limit = -glm::dot(open, p);
                if (std::abs(limit) > 1.3 * kHalf) continue;
                constexpr int kCells = 40;
                int visible = 0;
                for (int i = 0; i < kCells * kCells; ++i) {
                    const glm::dvec3 q(kHalf * (2 * (i % kCells + 0.5) / kCells - 1), 0,
                                       kHalf * (2 * (i / kCells + 0.5) / kCells - 1));
                    visible += glm::dot(open, q) > limit;
                }
                const auto at = static_cast<std::size_t>(y * kWidth + x);
                const double error =
                    got[at] / static_cast<double>(whole[at]) - visible / double{kCells * kCells};
                squares += error * error;
                ++count;
            }
        ASSERT_GT(count, 1000);
        worst = std::max(worst, std::sqrt(squares / count));
    }
    EXPECT_LT(worst, 0.04);
}

}  // namespace
}  // namespace conelight::test
