// SPDX-License-Identifier: MIT
// The BRDF: GLSL against its C++ twin, and both against the white furnace.
#include "math/brdf.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gl/pass.h"
#include "support/gl_fixture.h"

namespace conelight::test {
namespace {

// Share of light that the lobe sends from a uniform environment to an eye at `NoV`, by the midpoint rule over
// the half vector's distribution: theta of the half vector is spaced by the GGX distribution, so that narrow
// lobes are resolved as well as wide ones.
glm::dvec3 reflectedOfFurnace(const math::Brdf& brdf, double NoV) {
    const int rings = 400, sectors = 256;
    const double a2 = static_cast<double>(brdf.alpha) * static_cast<double>(brdf.alpha);
    const glm::dvec3 eye(std::sqrt(1 - NoV * NoV), 0, NoV);
    glm::dvec3 sum(0);
    for (int i = 0; i < rings; ++i) {
        // Inverse of the cumulative distribution of D cos over the sphere of half vectors.
        const double u = (i + 0.5) / rings;
        const double cos2 = (1 - u) / (1 + (a2 - 1) * u);
        const double cosTheta = std::sqrt(cos2), sinTheta = std::sqrt(1 - cos2);
        const double d = a2 / (std::numbers::pi * std::pow(cos2 * (a2 - 1) + 1, 2));
        for (int j = 0; j < sectors; ++j) {
            const double phi = 2 * std::numbers::pi * (j + 0.5) / sectors;
            const glm::dvec3 h(sinTheta * std::cos(phi), sinTheta * std::sin(phi), cosTheta);
            const double VoH = glm::dot(eye, h);
            const glm::dvec3 l = 2 * VoH * h - eye;
            if (VoH <= 0 || l.z <= 0) continue;
            // Density over light directions: D cos(theta) / (4 VoH).
            const double density = d * cosTheta / (4 * VoH);
            const glm::vec3 f = math::brdfSpecular(brdf, {0, 0, 1}, glm::vec3(l), glm::vec3(eye));
            sum += glm::dvec3(f) * (l.z / density);
        }
    }
    return sum / static_cast<double>(rings * sectors);
}

TEST(BrdfTest, WhiteMetalReturnsTheWhiteFurnace) {
    for (const float roughness : {0.1f, 0.2f, 0.35f, 0.5f, 0.7f, 0.85f, 1.0f})
        for (const float NoV : {0.05f, 0.15f, 0.3f, 0.5f, 0.75f, 1.0f}) {
            const math::Brdf brdf = math::makeBrdf(glm::vec3(1), 1, roughness, glm::vec3(0.04f), NoV);
            EXPECT_NEAR(reflectedOfFurnace(brdf, static_cast<double>(NoV)).x, 1, 0.01)
                << "roughness " << roughness << ", NoV " << NoV;
            EXPECT_EQ(brdf.diffuse, glm::vec3(0));
        }
}

TEST(BrdfTest, WhiteDielectricReturnsTheWhiteFurnace) {
    for (const float roughness : {0.1f, 0.2f, 0.35f, 0.5f, 0.7f, 0.85f, 1.0f})
        for (const float NoV : {0.1f, 0.3f, 0.5f, 0.75f, 1.0f}) {
            const math::Brdf brdf = math::makeBrdf(glm::vec3(1), 0, roughness, glm::vec3(0.04f), NoV);
            const double total =
                reflectedOfFurnace(brdf, static_cast<double>(NoV)).x + static_cast<double>(brdf.diffuse.x);
            EXPECT_NEAR(total, 1, 0.01) << "roughness " << roughness << ", NoV " << NoV;
        }
}

// A white surface sends all light back; a black dielectric half (kEvenLobe) of what its lobe reflects in even
// light, the mean of its directional albedo by the cosine.
TEST(BrdfTest, EvenAlbedoIsHalfTheLobeOverTheBase) {
    for (const float roughness : {0.05f, 0.2f, 0.4f, 0.6f, 0.8f, 1.0f}) {
        const glm::vec3 f0(0.04f);
        EXPECT_NEAR(math::evenAlbedo(glm::vec3(1), 0, roughness, f0).x, 1.0f, 1e-5f);
        EXPECT_EQ(math::evenAlbedo(glm::vec3(0.3f), 1, roughness, f0), glm::vec3(0.3f));
        EXPECT_EQ(math::evenAlbedo(glm::vec3(0.3f), 0, roughness, glm::vec3(0)), glm::vec3(0.3f));
        double mean = 0;
        const int steps = 1000;
        for (int i = 0; i < steps; ++i) {
            const float NoV = (static_cast<float>(i) + 0.5f) / steps;
            mean +=
                2.0 * static_cast<double>(NoV * math::makeBrdf(glm::vec3(0), 0, roughness, f0, NoV).albedo.x);
        }
        mean /= steps;
        EXPECT_NEAR(static_cast<double>(math::evenAlbedo(glm::vec3(0), 0, roughness, f0).x), 0.5 * mean,
                    0.0015)
            << "roughness " << roughness;
    }
}

// What rays are told of a dielectric reflects what it does, body and lobe, whatever its F0.
TEST(BrdfTest, MetallicSurfacesReflectTheSame) {
    for (const float f0 : {0.0f, 0.02f, 0.04f, 0.06f, 0.17f, 0.5f, 0.8f, 1.0f})
        for (const float base : {0.0f, 0.1f, 0.5f, 1.0f}) {
            const math::MetallicSurface told = math::metallicSurface(glm::vec3(base), 0, glm::vec3(f0));
            if (f0 <= 0.04f) {
                EXPECT_EQ(told.baseColor, glm::vec3(base));
                EXPECT_EQ(told.metallic, 0.0f);
                EXPECT_EQ(told.dielectricF0, glm::vec3(f0));
            }
            const math::Brdf is = math::makeBrdf(glm::vec3(base), 0, 0.3f, glm::vec3(f0), 0.8f);
            const math::Brdf as =
                math::makeBrdf(told.baseColor, told.metallic, 0.3f, told.dielectricF0, 0.8f);
            EXPECT_NEAR(as.f0.x, is.f0.x, 0.02f) << f0 << ' ' << base;
            EXPECT_NEAR(as.diffuse.x, is.diffuse.x, 0.03f) << f0 << ' ' << base;
        }
    const math::MetallicSurface metal = math::metallicSurface(glm::vec3(0.7f), 1, glm::vec3(0.5f));
    EXPECT_EQ(metal.metallic, 1.0f);
    EXPECT_EQ(metal.baseColor, glm::vec3(0.7f));
}

TEST(BrdfTest, NoSpecularMeansLambert) {
    const math::Brdf brdf = math::makeBrdf(glm::vec3(0.7f), 0, 0.5f, glm::vec3(0), 0.3f);
    EXPECT_FLOAT_EQ(brdf.diffuse.x, 0.7f);
    EXPECT_EQ(math::brdfSpecular(brdf, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}), glm::vec3(0));
}

TEST(BrdfTest, SpecularAlbedoPredictsTheFurnace) {
    for (const float roughness : {0.2f, 0.6f, 1.0f})
        for (const float NoV : {0.2f, 0.6f, 1.0f}) {
            const math::Brdf brdf = math::makeBrdf({0.9f, 0.6f, 0.3f}, 1, roughness, glm::vec3(0.04f), NoV);
            const glm::dvec3 got = reflectedOfFurnace(brdf, static_cast<double>(NoV));
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(got[c], static_cast<double>(brdf.albedo[c]), 0.01);
        }
}

class BrdfShaderTest : public GlTest {};

TEST_F(BrdfShaderTest, ShaderEqualsItsTwin) {
    addShader("test/brdf.comp.glsl", R"(#version 450 core
#include "lib/brdf.glsl"
layout(local_size_x = 64) in;
layout(std430) buffer Data { vec4 data[]; };
void main() {
    uint i = gl_GlobalInvocationID.x * 4u;
    vec4 a = data[i], b = data[i + 1u], c = data[i + 2u];
    Brdf brdf = makeBrdf(vec3(a.x, 0.5, 1.0), a.y, a.z, vec3(a.w, 0.04, 0.0), dot(c.xyz, vec3(0, 0, 1)));
    data[i + 3u] = vec4(brdfSpecular(brdf, vec3(0, 0, 1), b.xyz, c.xyz), brdf.diffuse.g);
}
)");
    std::vector<glm::vec4> data;
    std::uint32_t state = 12345;
    const auto next = [&] {
        state = state * 1664525u + 1013904223u;
        return static_cast<float>(state >> 8) / 16777216.0f;
    };
    const auto direction = [&] {
        const float z = 0.02f + 0.98f * next(), phi = 6.2831853f * next(), s = std::sqrt(1 - z * z);
        return glm::vec3(s * std::cos(phi), s * std::sin(phi), z);
    };
    const std::size_t count = 256;
    for (std::size_t i = 0; i < count; ++i) {
        data.emplace_back(next(), i % 3 == 0 ? 1.0f : next(), 0.05f + 0.95f * next(), 0.1f * next());
        data.emplace_back(direction(), 0);
        data.emplace_back(direction(), 0);
        data.emplace_back(0);
    }
    gl::Buffer buffer(data, "brdf cases");
    programs()
        .compute("test/brdf.comp.glsl")
        .dispatch(gl::Inputs().storage("Data", buffer), static_cast<int>(count));
    gl::barrier(gl::Access::ShaderStorage);
    const std::vector<glm::vec4> got = buffer.read<glm::vec4>(data.size());
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec4 a = data[4 * i];
        const glm::vec3 l(data[4 * i + 1]), v(data[4 * i + 2]);
        const math::Brdf brdf = math::makeBrdf({a.x, 0.5f, 1.0f}, a.y, a.z, {a.w, 0.04f, 0.0f}, v.z);
        const glm::vec3 want = math::brdfSpecular(brdf, {0, 0, 1}, l, v);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(got[4 * i + 3][c], want[c], 2e-4f * want[c] + 1e-5f) << "case " << i;
        EXPECT_NEAR(got[4 * i + 3].w, brdf.diffuse.g, 1e-4f) << "case " << i;
    }
}

}  // namespace
}  // namespace conelight::test
