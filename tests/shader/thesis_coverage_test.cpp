// SPDX-License-Identifier: MIT
// modes/thesis/shaders/coverage.glsl against polygon clipping on the CPU; march.glsl's frames and weights.
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <random>

#include "gl/pass.h"
#include "support/gl_fixture.h"

namespace conelight::test {
namespace {

using Polygon = std::vector<glm::dvec2>;

// Sutherland and Hodgman 1974: the part of `p` with n . x >= d.
Polygon clipped(const Polygon& p, const glm::dvec2& n, double d) {
    Polygon result;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const glm::dvec2 a = p[i], b = p[(i + 1) % p.size()];
        const double da = glm::dot(n, a) - d, db = glm::dot(n, b) - d;
        if (da >= 0) result.push_back(a);
        if ((da >= 0) != (db >= 0)) result.push_back(a + (b - a) * (da / (da - db)));
    }
    return result;
}

double coverage(const Polygon& triangle) {
    Polygon p = clipped(clipped(triangle, {1, 0}, 0), {-1, 0}, -1);
    p = clipped(clipped(p, {0, 1}, 0), {0, -1}, -1);
    double twice = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const glm::dvec2 a = p[i], b = p[(i + 1) % p.size()];
        twice += a.x * b.y - a.y * b.x;
    }
    return std::abs(0.5 * twice);
}

constexpr int kCount = 4096;

// Triangles of all sizes around the unit square, with vertical, horizontal and degenerate ones among them.
std::vector<glm::vec2> triangles() {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<glm::vec2> corners;
    for (int i = 0; i < kCount; ++i) {
        const float scale = std::exp2(std::floor(unit(random) * 16.0f) - 8.0f);  // 1/256 .. 128
        const glm::vec2 center(unit(random), unit(random));
        glm::vec2 c[3];
        for (glm::vec2& v : c) v = center + scale * (glm::vec2(unit(random), unit(random)) - 0.5f);
        if (i % 7 == 1) c[1].x = c[0].x;
        if (i % 7 == 2) c[1].y = c[0].y;
        if (i % 7 == 3) c[2] = c[0];
        if (i % 7 == 4) c[0] = glm::round(c[0]);
        corners.insert(corners.end(), c, c + 3);
    }
    return corners;
}

}  // namespace

using ThesisCoverageTest = GlTest;

TEST_F(ThesisCoverageTest, AreaEqualsClippedPolygon) {
    addShader("test/coverage.comp.glsl", R"(#version 450 core
#include "thesis/shaders/coverage.glsl"
layout(local_size_x = 64) in;
layout(std430) buffer Corners { vec2 corners[]; };
layout(std430) buffer Areas { vec4 areas[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    vec2 a = corners[3u * i], b = corners[3u * i + 1u], c = corners[3u * i + 2u];
    vec3 w = nearestBarycentrics(a, b, c, vec2(0.5));
    areas[i] = vec4(triangleCoverage(a, b, c), w);
}
)");
    const std::vector<glm::vec2> corners = triangles();
    const gl::Buffer in(corners, "corners");
    const gl::Buffer out(sizeof(glm::vec4) * kCount, "areas");
    programs()
        .compute("test/coverage.comp.glsl")
        .dispatch(gl::Inputs().storage("Corners", in).storage("Areas", out), kCount);
    gl::barrier(gl::Access::ShaderStorage);
    const std::vector<glm::vec4> areas = out.read<glm::vec4>(kCount);
    double largest = 0;
    for (std::size_t i = 0; i < kCount; ++i) {
        const Polygon triangle{corners[3 * i], corners[3 * i + 1], corners[3 * i + 2]};
        const double error = std::abs(double(areas[i].x) - coverage(triangle));
        largest = std::max(largest, error);
        // Weights are those of a point of the triangle.
        const glm::vec3 w(areas[i].y, areas[i].z, areas[i].w);
        ASSERT_NEAR(w.x + w.y + w.z, 1.0f, 1e-5f);
        ASSERT_GE(std::min({w.x, w.y, w.z}), 0.0f);
    }
    // Floats of up to 128 pixels leave about 1e-5 of a pixel.
    EXPECT_LT(largest, 5e-4);
}

TEST_F(ThesisCoverageTest, ConeFramesAreUnitAndFiniteForEveryNormal) {
    addShader("test/frame.comp.glsl", R"(#version 450 core
#include "thesis/shaders/march.glsl"
layout(local_size_x = 64) in;
layout(std430) buffer Normals { vec4 normals[]; };
layout(std430) buffer Cones { vec4 cones[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    ConeFrame f = coneFrame(normals[i].xyz);
    for (int k = 0; k < 9; ++k) cones[9u * i + uint(k)] = coneOfSets(k, 1, 4, normals[i].xyz, f, 0.27);
}
)");
    std::vector<glm::vec4> normals{{0, 0, 1, 0},  {0, 0, -1, 0}, {0, 1, 0, 0},
                                   {0, -1, 0, 0}, {1, 0, 0, 0},  {1e-6f, 1, 0, 0}};
    std::mt19937 random(11);
    std::normal_distribution<float> normal;
    while (normals.size() < 512)
        normals.emplace_back(glm::normalize(glm::vec3(normal(random), normal(random), normal(random))), 0.0f);
    const gl::Buffer in(normals, "normals");
    const gl::Buffer out(sizeof(glm::vec4) * 9 * normals.size(), "cones");
    const gl::Inputs given = gl::Inputs().storage("Normals", in).storage("Cones", out);
    const auto trace = [&](const gl::Defines& defines) {
        programs().compute("test/frame.comp.glsl", defines).dispatch(given, static_cast<int>(normals.size()));
        gl::barrier(gl::Access::ShaderStorage);
        return out.read<glm::vec4>(9 * normals.size());
    };
    const std::vector<glm::vec4> cones = trace({});
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const glm::vec3 n(normals[i]);
        for (std::size_t k = 0; k < 9; ++k) {
            const glm::vec3 d(cones[9 * i + k]);
            ASSERT_NEAR(glm::length(d), 1.0f, 1e-4f) << "normal " << i << " cone " << k;
            const float expected = k == 0 ? 1.0f : k < 5 ? 0.70710678f : 0.27f;
            ASSERT_NEAR(glm::dot(d, n), expected, 1e-4f) << "normal " << i << " cone " << k;
        }
        // The four cones of a set lie around the normal.
        glm::vec3 sum(0);
        for (std::size_t k = 1; k < 5; ++k) sum += glm::vec3(cones[9 * i + k]);
        ASSERT_NEAR(glm::length(sum - n * (4 * 0.70710678f)), 0.0f, 1e-3f);
    }
    // The original's axis is short: its tilted cones are not at 45 degrees.
    const std::vector<glm::vec4> original = trace({{"NAN_AXES", "1"}, {"SHORT_SIDE_AXIS", "1"}});
    int tilted = 0;
    for (std::size_t i = 6; i < normals.size(); ++i)
        tilted +=
            std::abs(glm::dot(glm::vec3(original[9 * i + 1]), glm::vec3(normals[i])) - 0.70710678f) > 0.02f
                ? 1
                : 0;
    EXPECT_GT(tilted, 100);
}

}  // namespace conelight::test
