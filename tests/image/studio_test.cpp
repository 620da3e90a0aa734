// SPDX-License-Identifier: MIT
// The first picture of a model without light: it stands on a ground whose rim is not seen, and shades it.
#include <algorithm>
#include <cmath>

#include "conelight/renderer.h"
#include "conelight/studio.h"
#include "reference/path_tracer.h"
#include "support/gl_fixture.h"
#include "support/scenes.h"
#include "support/truth_rig.h"

namespace conelight::test {
namespace {

class StudioTest : public GlTest {};

TEST_F(StudioTest, ABoxStandsOnTheGround) {
    Scene scene;
    addInstance(scene, boxMesh(), diffuseMaterial());
    Scene bare = scene;
    completeScene(scene);
    completeScene(bare, {.ground = false});
    Settings settings;
    settings.voxels.size = 64;
    constexpr int kWidth = 96, kHeight = 72;
    Renderer renderer;
    const auto picture = [&](const Scene& shown) {
        renderer.setScene(shown);
        renderer.render(scene.cameras.front(), kWidth, kHeight, settings);
        return renderer.readImage();
    };
    const Image with = picture(scene), without = picture(bare);
    const auto at = [&](const Image& image, int x, int y) {
        return image.pixels[static_cast<std::size_t>((kHeight - 1 - y) * kWidth + x)].y;
    };
    // `y` counts from the lower edge. Beside the box and before it, in the light: as without a ground.
    const float open = at(with, 3, 2) / at(without, 3, 2);
    EXPECT_NEAR(open, 1, 0.12f);  // the box hides a part of the surroundings
    EXPECT_NEAR(at(with, 3, kHeight - 3) / at(without, 3, kHeight - 3), 1, 1e-3f);
    // Where the shade touches the box.
    float darkest = 1;
    for (int x = 0; x < kWidth; ++x)
        for (int y = 0; y < kHeight / 3; ++y) darkest = std::min(darkest, at(with, x, y) / at(without, x, y));
    EXPECT_LT(darkest, 0.6f * open);
}

// The studio's lamp is 80 times as far away as the scene is large: its shadow still touches what casts it.
TEST_F(StudioTest, TheLampsShadowIsThatOfThePathTracer) {
    Scene scene;
    addInstance(scene, sphereMesh(48, 32), diffuseMaterial());
    completeScene(scene);
    constexpr int kWidth = 96, kHeight = 72;
    reference::PathTracerSettings traced;
    traced.samplesPerPixel = 64;
    traced.bounces = 0;
    const Image truth =
        reference::PathTracer(scene).render(scene.cameras.front(), kWidth, kHeight, traced).direct;
    Renderer renderer;
    renderer.setScene(scene);
    for (const Mode mode : {Mode::Traced, Mode::Phong}) {
        Settings settings;
        settings.mode = mode;
        settings.component = Component::Direct;
        settings.voxels.size = 64;
        renderer.render(scene.cameras.front(), kWidth, kHeight, settings);
        EXPECT_LT(relRmse(renderer.readImage(), truth), 0.05) << mode.name();
    }
}

}  // namespace
}  // namespace conelight::test
