// SPDX-License-Identifier: MIT
// Radiosity against closed forms (furnace, form factors of Howell's catalogue), against the path tracer, and
// its promises: the same bits for any number of threads, a valid scene, stops and refusals.
#include "reference/radiosity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "conelight/error.h"
#include "io/generated.h"
#include "reference/path_tracer.h"
#include "reference/radiosity_form_factor.h"
#include "support/truth_rig.h"

namespace conelight::test {
namespace {

using namespace reference;

RadiositySettings quick() {
    RadiositySettings s;
    s.patchRays = 64;
    s.gatherRays = 64;
    s.maxSubdivision = 0;
    s.patchSize = 0.5f;
    return s;
}

// Of the unit square at height `b`, or standing on the edge of the receiver: mean of the exact
// point-to-polygon factors over the receiver's cell centres.
double squareFactor(const std::array<glm::dvec3, 4>& source) {
    constexpr int kCells = 200;
    double sum = 0;
    for (int y = 0; y < kCells; ++y)
        for (int x = 0; x < kCells; ++x)
            sum += polygonFormFactor({(x + 0.5) / kCells, 0, (y + 0.5) / kCells}, {0, 1, 0}, source);
    return sum / (kCells * kCells);
}

TEST(Radiosity, FormFactorsOfSquares) {
    // Howell's catalogue, C-11 (parallel squares one edge apart) and C-14 (perpendicular, common edge).
    EXPECT_NEAR(squareFactor({{{0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}}}) / 0.19982, 1, 0.0005);
    EXPECT_NEAR(squareFactor({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}) / 0.20004, 1, 0.002);
    // A polygon cut by the horizon counts with its upper part; one below it not at all.
    const std::array<glm::dvec3, 4> wall{{{0, -1, 0}, {1, -1, 0}, {1, 1, 0}, {0, 1, 0}}};
    EXPECT_NEAR(squareFactor(wall) / 0.20004, 1, 0.002);
    const std::array<glm::dvec3, 4> below{{{0, -1, 0}, {1, -1, 0}, {1, -1, 1}, {0, -1, 1}}};
    EXPECT_EQ(squareFactor(below), 0);
}

TEST(Radiosity, FurnaceShowsTheGeometricSum) {
    for (const float rho : {0.1f, 0.5f, 0.9f}) {
        const Scene lit = bakeRadiosity(closedBox(diffuseMaterial(glm::vec3(rho), glm::vec3(1))), quick());
        for (const Mesh& mesh : lit.meshes)
            for (const glm::vec4& c : mesh.colors) EXPECT_NEAR(c.g * (1 - rho), 1, 0.01) << rho;
    }
}

// Bounce n gives rho^n: the sum up to N is exact in a furnace whose emitters are direct light.
TEST(Radiosity, BouncesAreCounted) {
    const Scene box = closedBox(diffuseMaterial(glm::vec3(0.5f), glm::vec3(1)));
    for (const int bounces : {0, 1, 3}) {
        RadiositySettings s = quick();
        s.bounces = bounces;
        const Scene lit = bakeRadiosity(box, s);
        // Emission seen, its reflection, and each bounce.
        EXPECT_NEAR(lit.meshes.back().colors[0].g, 2 - std::pow(0.5, bounces + 1), 0.01) << bounces;
    }
}

TEST(Radiosity, SameBitsForAnyNumberOfThreads) {
    const Scene scene = io::generateScene("cornell");
    RadiositySettings s = quick();
    s.patchSize = 0.1f;
    s.maxSubdivision = 1;
    s.threads = 1;
    const Scene a = bakeRadiosity(scene, s);
    s.threads = 3;
    const Scene b = bakeRadiosity(scene, s);
    ASSERT_EQ(a.meshes.size(), b.meshes.size());
    for (std::size_t i = 0; i < a.meshes.size(); ++i) {
        EXPECT_EQ(a.meshes[i].positions, b.meshes[i].positions);
        EXPECT_EQ(a.meshes[i].colors, b.meshes[i].colors);
    }
    s.seed = 2;
    EXPECT_NE(bakeRadiosity(scene, s).meshes.back().colors, a.meshes.back().colors);
}

TEST(Radiosity, CornellAgreesWithThePathTracer) {
    Scene scene = io::generateScene("cornell");
    // Off the axis: no pixel's centre lies exactly on an edge between walls.
    scene.cameras[0].eye.x += 0.003f;
    RadiositySettings s;
    s.patchRays = 128;
    s.gatherRays = 128;
    s.maxSubdivision = 3;
    RadiosityStats stats;
    const Scene lit = bakeRadiosity(scene, s, &stats);
    EXPECT_NO_THROW(lit.validate());
    EXPECT_GT(stats.rays, 0u);
    PathTracerSettings few;
    few.samplesPerPixel = 2;  // unlit surfaces have no noise
    const Image image = PathTracer(lit).render(scene.cameras[0], 64, 64, few).full;
    PathTracerSettings many;
    many.samplesPerPixel = 256;
    const PathTracedPicture truth = PathTracer(scene).render(scene.cameras[0], 64, 64, many);
    EXPECT_NEAR(meanOf(image) / meanOf(truth.full), 1, 0.01);
    // The path tracer's own noise, as its halves tell it, is no error of the radiosity.
    const double error = relRmse(image, truth.full);
    EXPECT_LT(std::sqrt(std::max(error * error - truth.noise * truth.noise, 0.0)), 0.03);
}

TEST(Radiosity, StopsWhenTold) {
    int calls = 0;
    const Scene scene = io::generateScene("cornell");
    const Scene lit =
        bakeRadiosity(scene, {}, nullptr, [&](const RadiosityProgress&) { return ++calls < 2; });
    EXPECT_EQ(calls, 2);
    EXPECT_NO_THROW(lit.validate());
}

TEST(Radiosity, RefusesSettingsOutOfRange) {
    RadiositySettings s;
    s.maxSubdivision = 9;
    EXPECT_THROW(bakeRadiosity(closedBox(diffuseMaterial()), s), Error);
}

}  // namespace
}  // namespace conelight::test
