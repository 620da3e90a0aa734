// SPDX-License-Identifier: MIT
// The GPU's picture for a screen against the CPU's: the same bytes but for the last place.
#include <epoxy/gl.h>

#include <algorithm>
#include <cstdlib>

#include "conelight/renderer.h"
#include "io/scene_file.h"
#include "support/gl_fixture.h"

namespace conelight::test {
namespace {

class DisplayTest : public GlTest {};

TEST_F(DisplayTest, AgreesWithToneMappedForAllCurves) {
    Scene scene = io::loadScene("builtin:cornell", {});
    completeScene(scene);
    Renderer renderer;
    renderer.setScene(scene);
    constexpr int kWidth = 70, kHeight = 50;
    Settings settings;
    settings.mode = Mode::Phong;
    EXPECT_EQ(renderer.displayTexture(settings.image), 0u);
    renderer.render(scene.cameras.front(), kWidth, kHeight, settings);
    const Image linear = renderer.readImage();
    for (const ToneMap curve :
         {ToneMap::None, ToneMap::Reinhard, ToneMap::Aces, ToneMap::Agx, ToneMap::Neutral})
        for (const bool srgb : {false, true}) {
            ImageSettings image;
            image.toneMap = curve;
            image.srgb = srgb;
            image.exposure = srgb ? AutoFloat{} : AutoFloat{false, 1.5f};
            const std::vector<std::uint8_t> expected = toneMapped(linear, image);
            std::vector<std::uint8_t> shown(4u * kWidth * kHeight);
            glGetTextureImage(renderer.displayTexture(image), 0, GL_RGBA, GL_UNSIGNED_BYTE,
                              static_cast<GLsizei>(shown.size()), shown.data());
            int worst = 0;
            for (std::size_t i = 0; i < expected.size(); ++i)
                worst = std::max(worst, std::abs(int(expected[i]) - int(shown[i / 3 * 4 + i % 3])));
            EXPECT_LE(worst, 1) << "curve " << static_cast<int>(curve) << " srgb " << srgb;
        }
}

TEST_F(DisplayTest, AgreesInWhiteBalanceAndChecksOfExposure) {
    Scene scene = io::loadScene("builtin:cornell", {});
    completeScene(scene);
    Renderer renderer;
    renderer.setScene(scene);
    constexpr int kWidth = 70, kHeight = 50;
    Settings settings;
    settings.mode = Mode::Phong;
    renderer.render(scene.cameras.front(), kWidth, kHeight, settings);
    const Image linear = renderer.readImage();
    for (const ExposureCheck check :
         {ExposureCheck::Off, ExposureCheck::Clipping, ExposureCheck::FalseColor}) {
        ImageSettings image;
        image.whiteBalance = 3200;
        image.tint = 7;
        image.check = check;
        const std::vector<std::uint8_t> expected = toneMapped(linear, image);
        std::vector<std::uint8_t> shown(4u * kWidth * kHeight);
        glGetTextureImage(renderer.displayTexture(image), 0, GL_RGBA, GL_UNSIGNED_BYTE,
                          static_cast<GLsizei>(shown.size()), shown.data());
        int differ = 0;
        for (std::size_t i = 0; i < expected.size(); ++i)
            differ += std::abs(int(expected[i]) - int(shown[i / 3 * 4 + i % 3])) > 1;
        EXPECT_LE(differ, 6) << "check " << static_cast<int>(check);  // pixels at a limit fall on either side
        image.check = ExposureCheck::Off;
        EXPECT_EQ(check == ExposureCheck::Off, expected == toneMapped(linear, image));
    }
}

}  // namespace
}  // namespace conelight::test
