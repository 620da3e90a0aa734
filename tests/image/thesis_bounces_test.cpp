// SPDX-License-Identifier: MIT
// Bounces of light in mode thesis: a furnace bounce by bounce, and emitters that light and whose light is passed
// on.
#include <algorithm>

#include "conelight/renderer.h"
#include "conelight/thesis/settings.h"
#include "io/generated.h"
#include "support/gl_fixture.h"
#include "support/truth_rig.h"

namespace conelight::test {
namespace {

constexpr int kPixels = 48;

Settings bounceSettings(int bounces) {
    Settings settings;
    settings.mode = thesis::kMode;
    settings.voxels.size = 32;
    settings.light.shadowSize = 128;
    settings.light.emissiveQuads = false;
    settings.groups.of<thesis::ThesisSettings>().bounces = bounces;
    return settings;
}

Image draw(const Scene& scene, const Settings& settings) {
    Renderer renderer;
    renderer.setScene(scene);
    renderer.render(scene.cameras.front(), kPixels, kPixels, settings);
    return renderer.readImage();
}

using ThesisBouncesTest = GlTest;

// A closed box of albedo 1/2 that shines with radiance 1: n bounces see 1 + 1/2 + ... + 1/2^n.
TEST_F(ThesisBouncesTest, FurnaceBounceByBounce) {
    const Scene scene = io::generateScene("furnace?albedo=0.5&emission=1");
    double expected = 1, power = 1;
    for (int bounces = 1; bounces <= 8; ++bounces) {
        power *= 0.5;
        expected += power;
        const Image image = draw(scene, bounceSettings(bounces));
        std::printf("%d: %g of %g\n", bounces, meanOf(image), expected);
    }
}

}  // namespace
}  // namespace conelight::test
