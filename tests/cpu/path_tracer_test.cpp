// SPDX-License-Identifier: MIT
// The path tracer as an estimator: furnace, energy per bounce, estimators that agree, halves that differ as
// the noise says, the same bits for any number of threads, stops and refusals. Lights and materials have
// tests of their own (path_tracer_light_test.cpp, path_tracer_material_test.cpp).
#include "reference/path_tracer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "conelight/error.h"
#include "io/generated.h"
#include "support/truth_rig.h"
#include "support/view_rig.h"

namespace conelight::test {
namespace {

using namespace reference;

PathTracedPicture render(const Scene& scene, int width, int height, const PathTracerSettings& settings) {
    return PathTracer(scene).render(scene.cameras.at(0), width, height, settings);
}

// A closed box whose walls all have albedo rho and emission e shows e / (1 - rho) everywhere.
TEST(PathTracer, FurnaceShowsTheGeometricSum) {
    for (const float rho : {0.1f, 0.5f, 0.8f, 0.95f}) {
        const Scene scene = closedBox(mattMaterial(glm::vec3(rho), glm::vec3(1)));
        for (const bool quads : {true, false}) {
            PathTracerSettings settings;
            settings.samplesPerPixel = rho > 0.9f ? 1024 : 512;
            settings.emissiveQuads = quads;
            const PathTracedPicture picture = render(scene, 16, 16, settings);
            const double truth = 1 / (1 - static_cast<double>(rho));
            EXPECT_NEAR(meanOf(picture.full) / truth, 1, 0.002) << rho << (quads ? " quads" : " triangles");
            EXPECT_EQ(picture.badSamples, 0u);
            EXPECT_EQ(picture.samplesPerPixel, settings.samplesPerPixel);
        }
    }
}

// With every emitter indirect, bounce n gives rho^n.
TEST(PathTracer, EnergyPerBounceFallsGeometricallyInTheFurnace) {
    const double rho = 0.6;
    const Scene scene = closedBox(mattMaterial(glm::vec3(0.6f), glm::vec3(1)));
    PathTracerSettings settings;
    settings.samplesPerPixel = 1024;
    settings.emissiveQuads = false;
    settings.perBounce = 5;
    const PathTracedPicture picture = render(scene, 16, 16, settings);
    EXPECT_NEAR(meanOf(picture.direct), 1, 1e-5);
    double sum = 0;
    for (int n = 1; n <= 5; ++n) {
        const double energy = meanOf(picture.bounces[static_cast<std::size_t>(n) - 1]);
        // Of 262,144 paths rho^n reach bounce n: three standard deviations of their number.
        EXPECT_NEAR(energy / std::pow(rho, n), 1, 3 / std::sqrt(262144 * std::pow(rho, n))) << "bounce " << n;
        sum += energy;
    }
    // The rest of the series is in `indirect`, and nothing is counted twice.
    EXPECT_NEAR(meanOf(picture.indirect) - sum, std::pow(rho, 6) / (1 - rho), 0.003);

    // Stopped after N bounces, the first N are unchanged.
    for (const int bounces : {0, 1, 3}) {
        settings.bounces = bounces;
        EXPECT_NEAR(meanOf(render(scene, 16, 16, settings).full),
                    (1 - std::pow(rho, bounces + 1)) / (1 - rho), 0.004)
            << bounces;
    }
}

}  // namespace
}  // namespace conelight::test
