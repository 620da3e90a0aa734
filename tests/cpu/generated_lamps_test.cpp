// SPDX-License-Identifier: MIT
// builtin:lamps: as many lamps as asked for, the same ones near the middle whatever their number.
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

#include "conelight/error.h"
#include "io/generated.h"
#include "reference/path_tracer.h"

namespace conelight {
namespace {

TEST(GeneratedLamps, HasAsManyAsAskedFor) {
    for (const int count : {1, 37, 1000, 10000}) {
        const Scene scene = io::generateScene("lamps?count=" + std::to_string(count));
        EXPECT_EQ(scene.lights.size(), std::size_t(count));
        EXPECT_LE(scene.meshes.size(), 3u);
        // One to 16 m^2, but for the rim.
        const glm::vec3 extent = scene.bounds().extent();
        EXPECT_GE(extent.x * extent.z, 16.0f * float(count));
        EXPECT_LE(extent.x, std::max(4 * std::sqrt(float(count)) + 24, 73.0f));
    }
    EXPECT_THROW(io::generateScene("lamps?count=0"), Error);
}

TEST(GeneratedLamps, MoreOfThemLeaveTheFirstOnesAlone) {
    const Scene few = io::generateScene("lamps?count=100"), many = io::generateScene("lamps?count=2000");
    for (std::size_t i = 0; i < few.lights.size(); ++i) {
        EXPECT_EQ(few.lights[i].position, many.lights[i].position) << i;
        EXPECT_EQ(few.lights[i].intensity, many.lights[i].intensity) << i;
    }
    EXPECT_EQ(few.cameras.front().eye, many.cameras.front().eye);
}

// Walls count: much of the light that lamps would give is in shadow.
TEST(GeneratedLamps, WallsHideLamps) {
    Scene scene = io::generateScene("lamps?count=400");
    reference::PathTracerSettings settings;
    settings.samplesPerPixel = 32;
    settings.bounces = 0;
    const auto meanOf = [&] {
        const auto picture = reference::PathTracer(scene).render(scene.cameras.front(), 32, 24, settings);
        double sum = 0;
        for (const auto& pixel : picture.direct.pixels) sum += pixel.g;
        return sum;
    };
    const double shadowed = meanOf();
    for (Instance& instance : scene.instances) instance.castsShadow = false;
    EXPECT_LT(shadowed, 0.75 * meanOf());
}

}  // namespace
}  // namespace conelight
