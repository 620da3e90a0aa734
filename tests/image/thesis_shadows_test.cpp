// SPDX-License-Identifier: MIT
// The occlusion cones of mode thesis: shadows as soft as `thesis.occlusion.aperture` says, against the path
// tracer's of a lamp of that size, and none of nothing. Rectangles that are as large as they are.
#include <algorithm>
#include <array>
#include <cmath>

#include "conelight/thesis/settings.h"
#include "support/gl_fixture.h"
#include "support/soft_shadow_rig.h"
#include "support/truth_rig.h"

namespace conelight::test {
namespace {

constexpr float kApertures[] = {0.05f, 0.1f, 0.2f, 0.4f, 0.6f, 0.8f};

Settings shadowSettings(float aperture) {
    Settings settings;
    settings.mode = thesis::kMode;
    settings.component = Component::Occlusion;
    settings.voxels.size = 64;
    settings.groups.of<thesis::ThesisSettings>().occlusion.aperture = {false, aperture};
    return settings;
}

thesis::ThesisDefects& defectsOf(Settings& settings) {
    return settings.groups.of<thesis::ThesisSettings>().defects;
}

using ThesisShadowsTest = GlTest;

TEST_F(ThesisShadowsTest, AreAsSoftAsThoseOfALampOfThatSize) {
    const std::vector<float> hard = visibleInTruth(lampOf(0.01f));
    for (const float aperture : kApertures) {
        const std::vector<float> truth = visibleInTruth(lampOf(aperture));
        const double ofCones =
            meanDifference(visibleByCones(plateScene(true), shadowSettings(aperture)), truth);
        // Measured: 0.107, 0.085, 0.063, 0.056, 0.026, 0.014. Below 0.2 a voxel is wider than the penumbra: it is 1/16
        // of the picture. The hard shadow: 0.028, 0.063, 0.130, 0.242, 0.305, 0.340.
        EXPECT_LT(ofCones, aperture < 0.2f ? 0.12 : 0.07) << aperture;
        if (aperture >= 0.2f) {
            EXPECT_LT(ofCones, 0.5 * meanDifference(hard, truth)) << aperture;
        }
    }
}

// A rectangle's size is its own; with the defect it has the aperture of a lamp without.
TEST_F(ThesisShadowsTest, RectanglesAreAsSoftAsTheyAreLarge) {
    for (const float aperture : {0.4f, 0.8f}) {
        Scene scene = plateScene(true);
        scene.lights = {lampOf(aperture)};
        const std::vector<float> truth = visibleInTruth(lampOf(aperture));
        Settings settings = shadowSettings(0.01f);
        EXPECT_LT(meanDifference(visibleByCones(scene, settings), truth), 0.08) << aperture;
        defectsOf(settings).pointlikeRectangles = true;
        EXPECT_GT(meanDifference(visibleByCones(scene, settings), truth), 0.12) << aperture;
    }
}

// The light of a rectangle that hangs low over a floor is the whole rectangle's, not its centre's.
TEST_F(ThesisShadowsTest, RectanglesLightFromAllOverThem) {
    Scene scene = plateScene(false);
    Light lamp = lampOf(0.8f);
    lamp.position = {0.8f, 0.3f, 0};
    scene.lights = {lamp};
    reference::PathTracerSettings tracer;
    tracer.samplesPerPixel = 64;
    tracer.bounces = 0;
    const Image truth = reference::PathTracer(scene)
                            .render(scene.cameras.front(), kShadowPixels, kShadowPixels, tracer)
                            .direct;
    Settings settings = shadowSettings(0.01f);
    settings.component = Component::Direct;
    settings.groups.of<thesis::ThesisSettings>().voxShadows = false;
    settings.groups.of<thesis::ThesisSettings>().phongSpecular = false;
    const double whole = relRmse(drawSmall(scene, settings), truth);
    defectsOf(settings).pointlikeRectangles = true;
    const double centre = relRmse(drawSmall(scene, settings), truth);
    EXPECT_LT(whole, 0.02);  // noise of the path tracer; measured: 0.009
    EXPECT_GT(centre, 1);
}

// A sheet hides a lamp from both of its sides.
TEST_F(ThesisShadowsTest, SheetsHideFromBothSides) {
    for (const bool turned : {false, true}) {
        Scene scene = plateScene(false);
        const glm::vec3 u(0.4f, 0, 0), v(0, 0, turned ? 0.4f : -0.4f);
        addInstance(scene, quadMesh({0.3f, 0.75f, turned ? -0.2f : 0.2f}, u, v),
                    diffuseMaterial(glm::vec3(0.8f)));
        std::vector<float> shares = visibleByCones(scene, shadowSettings(0.2f));
        const auto [least, most] = std::minmax_element(shares.begin(), shares.end());
        EXPECT_LT(*least, 0.05f) << turned;
        EXPECT_GT(*most, 0.98f) << turned;
    }
}

// In an empty closed room all light arrives everywhere: no walls that hide themselves, no rings.
TEST_F(ThesisShadowsTest, NothingShadowsAnEmptyRoom) {
    for (const float aperture : kApertures) {
        Settings settings = shadowSettings(aperture);
        const RoomShares shares = sharesInAnEmptyRoom(settings);
        // Corners darken a little, by an eighth at worst.
        EXPECT_GT(shares.least, aperture < 0.3f ? 0.98f : 0.85f) << aperture;
        EXPECT_LT(shares.jump, 0.02f) << aperture;
        if (aperture < 0.4f) continue;
        // As opaque from every side, walls beside the cone hide all light from others.
        defectsOf(settings).isotropicOpacity = true;
        EXPECT_LT(sharesInAnEmptyRoom(settings).least, 0.1f) << aperture;
    }
}

// Waves about the foot of the lamp: means over rings of a pixel's width, less the mean of those beside.
double radialRipple(const std::vector<float>& shares) {
    constexpr int kRings = kShadowPixels / 2;
    std::array<double, kRings> sums{}, counts{}, means{};
    for (int i = 0; i < kShadowPixels * kShadowPixels; ++i) {
        const double x = i % kShadowPixels + 0.5 - kRings, y = i / kShadowPixels + 0.5 - kRings;
        const auto ring = static_cast<std::size_t>(std::hypot(x, y));
        if (ring >= kRings) continue;
        sums[ring] += shares[static_cast<std::size_t>(i)];
        counts[ring] += 1;
    }
    for (std::size_t ring = 0; ring < kRings; ++ring) means[ring] = sums[ring] / counts[ring];
    double ripple = 0;
    for (std::size_t ring = 1; ring + 1 < kRings; ++ring)
        ripple = std::max(ripple, std::abs(means[ring] - 0.5 * (means[ring - 1] + means[ring + 1])));
    return ripple;
}

// No rings about the foot of a lamp below a ceiling, however wide the cones are; with all else as published, a last step
// that is cut makes them.
TEST_F(ThesisShadowsTest, NoRingsAboutTheFootOfTheLamp) {
    Scene scene = plateScene(false);
    scene.lights[0].position.y = 0.9f;
    Camera& camera = scene.cameras.front();
    const glm::vec3 aside = scene.lights[0].position * glm::vec3(1, 0, 1) - camera.target;
    camera.eye += aside;
    camera.target += aside;
    addInstance(scene, quadMesh({-1, 1, -1}, {2, 0, 0}, {0, 0, 2}), diffuseMaterial(glm::vec3(0.8f)));
    for (const float aperture : kApertures) {
        Settings settings = shadowSettings(aperture);
        const double mended = radialRipple(visibleByCones(scene, settings));
        for (bool* flag : thesis::thesisDefectFlags(defectsOf(settings))) *flag = true;
        const double published = radialRipple(visibleByCones(scene, settings));
        EXPECT_LT(mended, 2e-3) << aperture;  // measured: at most 0.0008
        if (aperture < 0.3f) {
            EXPECT_GT(published, 0.03) << aperture;  // measured: at least 0.05
        }
    }
}

// No light of a sun, nor of a lamp far away, comes through the walls of a closed room, however near they are.
TEST_F(ThesisShadowsTest, WallsShutTheSunOut) {
    Scene scene = closedBox(diffuseMaterial(glm::vec3(0.5f)));
    Light sun;
    sun.type = LightType::Directional;
    sun.direction = glm::normalize(glm::vec3(0.8f, -0.5f, -0.3f));
    Light lamp;
    lamp.position = scene.bounds().center() - 100.0f * sun.direction;
    for (const Light& light : {sun, lamp}) {
        scene.lights = {light};
        Settings settings = shadowSettings(0.05f);
        settings.groups.of<thesis::ThesisSettings>().occlusion.aperture = {};
        const Image image = drawSmall(scene, settings);
        // Measured: 0.019 and 0.056, in the edges, where a cone begins within the wall that it looks through.
        EXPECT_LT(meanOf(image), 0.08) << static_cast<int>(light.type);
    }
}

}  // namespace
}  // namespace conelight::test
