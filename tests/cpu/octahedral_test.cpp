// SPDX-License-Identifier: MIT
// Octahedral unit vectors: the decoded vector is the encoded one, up to what the numbers can hold.
#include "math/octahedral.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace conelight::test {
namespace {

// Directions spread evenly over the sphere (Fibonacci), the axes and the diagonals.
std::vector<glm::vec3> directions() {
    std::vector<glm::vec3> all;
    constexpr int kCount = 20000;
    for (int i = 0; i < kCount; ++i) {
        const double z = 1 - (2.0 * i + 1) / kCount;
        const double angle = i * 2.399963229728653;  // golden angle
        const double r = std::sqrt(1 - z * z);
        all.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
    }
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z)
                if (x != 0 || y != 0 || z != 0) all.push_back(glm::normalize(glm::vec3(x, y, z)));
    return all;
}

// Between unit vectors; exact for small angles, unlike acos.
double angleBetween(const glm::vec3& a, const glm::vec3& b) {
    return 2 * std::asin(std::min(1.0, 0.5 * glm::length(glm::dvec3(a) - glm::dvec3(b))));
}

}  // namespace

TEST(OctahedralTest, FloatsRoundTrip) {
    for (const glm::vec3& n : directions()) {
        const glm::vec2 p = math::octEncode(n);
        ASSERT_LE(std::abs(p.x), 1.0f);
        ASSERT_LE(std::abs(p.y), 1.0f);
        const glm::vec3 back = math::octDecode(p);
        EXPECT_NEAR(glm::length(back), 1.0f, 1e-6f);
        EXPECT_LT(angleBetween(back, n), 1e-6) << n.x << " " << n.y << " " << n.z;
    }
}

TEST(OctahedralTest, AxesAreExact) {
    for (int axis = 0; axis < 3; ++axis)
        for (const float sign : {-1.0f, 1.0f}) {
            glm::vec3 n(0);
            n[axis] = sign;
            EXPECT_EQ(math::octDecode(math::octEncode(n)), n);
            const glm::vec2 stored = math::unpackSnorm2x16(math::packSnorm2x16(math::octEncode(n)));
            EXPECT_EQ(math::octDecode(stored), n);
        }
}

// Half a step d = 0.5/32767 in both coordinates moves a point of the octahedron by (d, d, -2d), across the
// ray at a face's centre, which is 1/sqrt(3) away: sqrt(6) d sqrt(3) is the largest angle.
TEST(OctahedralTest, SixteenBitsKeepTheDirection) {
    double worst = 0;
    for (const glm::vec3& n : directions()) {
        const glm::vec2 stored = math::unpackSnorm2x16(math::packSnorm2x16(math::octEncode(n)));
        worst = std::max(worst, angleBetween(math::octDecode(stored), n));
    }
    EXPECT_LT(worst, std::sqrt(18.0) * 0.5 / 32767 + 1e-6);
    EXPECT_GT(worst, 1e-6) << "better than 16 bits: the test measures something else";
}

TEST(OctahedralTest, SnormIsTheOneOfGlsl) {
    EXPECT_EQ(math::packSnorm2x16({0, 0}), 0u);
    EXPECT_EQ(math::packSnorm2x16({1, 0}), 0x00007fffu);
    EXPECT_EQ(math::packSnorm2x16({0, 1}), 0x7fff0000u);
    EXPECT_EQ(math::packSnorm2x16({-1, -1}), 0x80018001u);
    EXPECT_EQ(math::packSnorm2x16({2, -2}), 0x80017fffu);  // clamped
    // -32768 is out of the range that packing makes, and decodes to -1.
    EXPECT_EQ(math::unpackSnorm2x16(0x80008001u), glm::vec2(-1, -1));
    for (std::uint32_t bits = 0; bits < 65536; ++bits) {
        if (bits == 0x8000) continue;
        ASSERT_EQ(math::packSnorm2x16(math::unpackSnorm2x16(bits | bits << 16)), bits | bits << 16);
    }
}

}  // namespace conelight::test
