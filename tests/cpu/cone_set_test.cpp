// SPDX-License-Identifier: MIT
// Cone sets against what they promise: weights that sum to pi, and exact irradiance from surroundings that
// are constant or linear in direction, when each cone averages what it covers.
#include "gather/cone_set.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace conelight::gather {
namespace {

struct Named {
    const char* name;
    DiffuseSet set;
    int count;
    std::size_t size;
};
constexpr Named kSets[] = {{"1", DiffuseSet::One, 1, 1},           {"5", DiffuseSet::Five, 1, 5},
                           {"6", DiffuseSet::Six, 1, 6},           {"9", DiffuseSet::Nine, 1, 9},
                           {"f1", DiffuseSet::Fibonacci, 1, 1},    {"f2", DiffuseSet::Fibonacci, 2, 2},
                           {"f3", DiffuseSet::Fibonacci, 3, 3},    {"f7", DiffuseSet::Fibonacci, 7, 7},
                           {"f16", DiffuseSet::Fibonacci, 16, 16}, {"f33", DiffuseSet::Fibonacci, 33, 33},
                           {"f64", DiffuseSet::Fibonacci, 64, 64}};

// Mean of a function of direction over the inside of a cone, by the midpoint rule in (cos, azimuth).
template <class F>
double coneMean(const Cone& cone, F&& radiance) {
    const glm::dvec3 axis(cone.direction);
    const glm::dvec3 side = std::abs(axis.x) > 0.5 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(axis, side));
    const glm::dvec3 v = glm::cross(axis, u);
    constexpr int kHeights = 32;
    constexpr int kAzimuths = 32;
    double sum = 0;
    for (int i = 0; i < kHeights; ++i) {
        const double z = 1 - (1 - static_cast<double>(cone.cosHalfAngle)) * (i + 0.5) / kHeights;
        const double r = std::sqrt(1 - z * z);
        for (int j = 0; j < kAzimuths; ++j) {
            const double azimuth = 2 * std::numbers::pi * (j + 0.5) / kAzimuths;
            sum += radiance(axis * z + (u * std::cos(azimuth) + v * std::sin(azimuth)) * r);
        }
    }
    return sum / (kHeights * kAzimuths);
}

template <class F>
double irradiance(const std::vector<Cone>& cones, F&& radiance) {
    double sum = 0;
    for (const Cone& cone : cones) sum += static_cast<double>(cone.weight) * coneMean(cone, radiance);
    return sum;
}

// int L(w) (n.w) dw over the hemisphere, by the midpoint rule (error below 1e-5 for what is tested).
template <class F>
double exactIrradiance(F&& radiance) {
    constexpr int kHeights = 256;
    constexpr int kAzimuths = 256;
    double sum = 0;
    for (int i = 0; i < kHeights; ++i) {
        const double z = (i + 0.5) / kHeights;
        const double r = std::sqrt(1 - z * z);
        for (int j = 0; j < kAzimuths; ++j) {
            const double azimuth = 2 * std::numbers::pi * (j + 0.5) / kAzimuths;
            sum += z * radiance(glm::dvec3(r * std::cos(azimuth), r * std::sin(azimuth), z));
        }
    }
    return sum * 2 * std::numbers::pi / (kHeights * kAzimuths);
}

TEST(ConeSet, FoundSetsHaveTheirCountAndWeightsThatSumToPi) {
    const std::pair<DiffuseSet, std::size_t> sets[] = {
        {DiffuseSet::Best6, 6}, {DiffuseSet::Best9, 9}, {DiffuseSet::Best12, 12}, {DiffuseSet::Best16, 16}};
    for (const auto& [set, count] : sets) {
        const std::vector<Cone> cones = coneSet(set, 1);
        EXPECT_EQ(cones.size(), count);
        glm::dvec3 mean(0);
        double sum = 0;
        for (const Cone& cone : cones) {
            EXPECT_NEAR(glm::length(cone.direction), 1, 1e-6);
            EXPECT_GT(cone.direction.z, 0);
            sum += double(cone.weight);
            mean += double(cone.weight) * glm::dvec3(cone.direction);
        }
        EXPECT_NEAR(sum, std::numbers::pi, 1e-5);
        // Even about the normal: light from one side counts as much as from another.
        EXPECT_NEAR(mean.x, 0, 1e-5);
        EXPECT_NEAR(mean.y, 0, 1e-5);
    }
}

TEST(ConeSet, HasTheCountAskedFor) {
    for (const Named& named : kSets)
        EXPECT_EQ(coneSet(named.set, named.count).size(), named.size) << named.name;
    for (int n = 1; n <= kMaxCones; ++n)
        EXPECT_EQ(coneSet(DiffuseSet::Fibonacci, n).size(), static_cast<std::size_t>(n));
}

TEST(ConeSet, DirectionsAreUnitAndAboveTheSurface) {
    for (const Named& named : kSets) {
        for (const Cone& cone : coneSet(named.set, named.count)) {
            EXPECT_NEAR(glm::length(cone.direction), 1.0f, 1e-6f) << named.name;  // float rounding
            EXPECT_GT(cone.direction.z, 0.0f) << named.name;
            EXPECT_GT(cone.weight, 0.0f) << named.name;
            EXPECT_GE(cone.cosHalfAngle, 0.333f) << named.name;
            EXPECT_LT(cone.cosHalfAngle, 1.0f) << named.name;
        }
    }
}

// A uniform surrounding L gives E = pi L, whatever the set.
TEST(ConeSet, WeightsSumToPi) {
    for (const Named& named : kSets) {
        double sum = 0;
        for (const Cone& cone : coneSet(named.set, named.count)) sum += static_cast<double>(cone.weight);
        EXPECT_NEAR(sum, std::numbers::pi, 64 * 1e-7) << named.name;  // float rounding of 64 weights
    }
}

// Opposite walls of different brightness: L = 1 + a.w is exact in every direction a, so no set prefers a
// side.
TEST(ConeSet, LinearSurroundingsAreExact) {
    const glm::dvec3 gradients[] = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}, {0.4, -0.7, 0.3}};
    for (const Named& named : kSets) {
        const auto cones = coneSet(named.set, named.count);
        for (const glm::dvec3& gradient : gradients) {
            const auto radiance = [&](const glm::dvec3& w) { return 1 + glm::dot(gradient, w); };
            const double exact = std::numbers::pi + gradient.z * 2 * std::numbers::pi / 3;
            // Cells integrated in closed form, or with 3e-5 (fibonacciCells); floats; the mean's quadrature.
            EXPECT_NEAR(irradiance(cones, radiance), exact, 3e-4) << named.name;
        }
    }
}

// Not promised to be exact, but larger sets must see sharper: a bright quarter of the sky, off the zenith.
TEST(ConeSet, MoreConesSeeSharper) {
    const auto patch = [](const glm::dvec3& w) { return w.x > 0.3 && w.y > 0.1 ? 1.0 : 0.0; };
    const double exact = exactIrradiance(patch);
    const auto error = [&](DiffuseSet set, int count) {
        return std::abs(irradiance(coneSet(set, count), patch) / exact - 1);
    };
    EXPECT_LT(error(DiffuseSet::Fibonacci, 64), 0.1);  // cones of 10 degrees against an edge of this length
    EXPECT_LT(error(DiffuseSet::Fibonacci, 64), error(DiffuseSet::One, 1));
}

// Cells that are caps keep their own solid angle: the polar cone of a set of N fills 2 pi / N.
TEST(ConeSet, PolarConeFillsItsShare) {
    EXPECT_NEAR(coneSet(DiffuseSet::Five, 1)[0].cosHalfAngle, 1 - 1.0 / 5, 0.02);
    EXPECT_NEAR(coneSet(DiffuseSet::Six, 1)[0].cosHalfAngle, 1 - 1.0 / 6, 0.02);
    EXPECT_NEAR(coneSet(DiffuseSet::Nine, 1)[0].cosHalfAngle, 1 - 1.0 / 9, 0.02);
    EXPECT_NEAR(coneSet(DiffuseSet::One, 1)[0].cosHalfAngle, 1.0 / 3, 1e-6);  // mean 2/3 of the cosine lobe
    double solidAngle = 0;
    for (const Cone& cone : coneSet(DiffuseSet::Fibonacci, 64))
        solidAngle += 2 * std::numbers::pi * (1 - static_cast<double>(cone.cosHalfAngle));
    EXPECT_NEAR(solidAngle, 2 * std::numbers::pi,
                0.06 * 2 * std::numbers::pi);  // cells are not round: their cones are a little wider
}

}  // namespace
}  // namespace conelight::gather
