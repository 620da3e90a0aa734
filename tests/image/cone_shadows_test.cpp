// SPDX-License-Identifier: MIT
// Soft shadows by cones in mode cones against the path tracer's shadows of a lamp of that size, and against
// what must not be there: shadows of nothing, rings about the lamp.
#include "support/gl_fixture.h"
#include "support/soft_shadow_rig.h"

namespace conelight::test {
namespace {

Settings shadowSettings(float aperture) {
    Settings settings;
    settings.mode = Mode::Cones;
    settings.component = Component::Direct;
    settings.cones.shadows = ConesShadows::Cones;
    settings.cones.shadowAperture = aperture;
    return settings;
}

using ConeShadowsTest = GlTest;

TEST_F(ConeShadowsTest, AreAsSoftAsThoseOfALampOfThatSize) {
    const std::vector<float> hard = visibleInTruth(lampOf(0.01f));
    for (const float aperture : {0.05f, 0.1f, 0.2f, 0.4f, 0.8f}) {
        const std::vector<float> truth = visibleInTruth(lampOf(aperture));
        const double ofCones =
            meanDifference(visibleByCones(plateScene(true), shadowSettings(aperture)), truth);
        // Measured: 0.052, 0.053, 0.058, 0.069, 0.050. The hard shadow: 0.028, 0.063, 0.130, 0.243, 0.340.
        EXPECT_LT(ofCones, 0.08) << aperture;
        if (aperture >= 0.2f) {
            EXPECT_LT(ofCones, 0.5 * meanDifference(hard, truth)) << aperture;
        }
    }
}

// A rectangle's size is its own.
TEST_F(ConeShadowsTest, RectanglesAreAsSoftAsTheyAreLarge) {
    for (const float aperture : {0.1f, 0.4f}) {
        Scene scene = plateScene(true);
        scene.lights = {lampOf(aperture)};
        const std::vector<float> truth = visibleInTruth(lampOf(aperture));
        EXPECT_LT(meanDifference(visibleByCones(scene, shadowSettings(0.01f)), truth), 0.09) << aperture;
    }
}

// In an empty closed room all light arrives everywhere: no walls that hide themselves, no rings.
TEST_F(ConeShadowsTest, NothingShadowsAnEmptyRoom) {
    for (const float aperture : {0.05f, 0.2f, 0.4f, 0.8f}) {
        const RoomShares shares = sharesInAnEmptyRoom(shadowSettings(aperture));
        // Corners darken a little: 0.89 at worst. A ring would be a jump; the thesis's were 0.1.
        EXPECT_GT(shares.least, aperture < 0.1f ? 0.99f : 0.85f) << aperture;
        EXPECT_LT(shares.jump, 0.02f) << aperture;
    }
}

}  // namespace
}  // namespace conelight::test
