// SPDX-License-Identifier: MIT
// The GPU's picture for a screen against the CPU's: the same bytes but for the last place.
#include <epoxy/gl.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <vector>

#include "conelight/renderer.h"
#include "io/scene_file.h"
#include "support/gl_fixture.h"

namespace conelight::test {
namespace {

constexpr int kWidth = 70, kHeight = 50;

// A picture of builtin:cornell, as the GPU shows it and as toneMapped does.
class DisplayTest : public GlTest {
  protected:
    void SetUp() override {
        GlTest::SetUp();
        if (IsSkipped() || HasFatalFailure()) return;
        Scene scene = io::loadScene("builtin:cornell", {});
        completeScene(scene);
        renderer_ = std::make_unique<Renderer>();
        renderer_->setScene(scene);
        Settings settings;
        settings.mode = Mode::Phong;
        EXPECT_EQ(renderer_->displayTexture(settings.image), 0u) << "before the first picture";
        renderer_->render(scene.cameras.front(), kWidth, kHeight, settings);
        linear_ = renderer_->readImage();
    }
    void TearDown() override {
        renderer_.reset();
        GlTest::TearDown();
    }
    // How far each value that is shown is off.
    std::vector<int> errorsOf(const ImageSettings& look) {
        const std::vector<std::uint8_t> expected = toneMapped(linear_, look);
        std::vector<std::uint8_t> shown(4u * kWidth * kHeight);
        glGetTextureImage(renderer_->displayTexture(look), 0, GL_RGBA, GL_UNSIGNED_BYTE,
                          static_cast<GLsizei>(shown.size()), shown.data());
        std::vector<int> errors;
        for (std::size_t i = 0; i < expected.size(); ++i)
            errors.push_back(std::abs(int(expected[i]) - int(shown[i / 3 * 4 + i % 3])));
        return errors;
    }

    std::unique_ptr<Renderer> renderer_;
    Image linear_;
};

TEST_F(DisplayTest, AgreesWithToneMappedForAllCurves) {
    for (const ToneMap curve :
         {ToneMap::None, ToneMap::Reinhard, ToneMap::Aces, ToneMap::Agx, ToneMap::Neutral})
        for (const bool srgb : {false, true}) {
            ImageSettings image;
            image.toneMap = curve;
            image.srgb = srgb;
            image.exposure = srgb ? AutoFloat{} : AutoFloat{false, 1.5f};
            EXPECT_LE(std::ranges::max(errorsOf(image)), 1)
                << "curve " << static_cast<int>(curve) << " srgb " << srgb;
        }
}

TEST_F(DisplayTest, AgreesInWhiteBalanceAndChecksOfExposure) {
    for (const ExposureCheck check :
         {ExposureCheck::Off, ExposureCheck::Clipping, ExposureCheck::FalseColor}) {
        ImageSettings image;
        image.whiteBalance = 3200;
        image.tint = 7;
        image.check = check;
        // Pixels at a limit fall on either side.
        EXPECT_LE(std::ranges::count_if(errorsOf(image), [](int error) { return error > 1; }), 6)
            << "check " << static_cast<int>(check);
        const std::vector<std::uint8_t> checked = toneMapped(linear_, image);
        image.check = ExposureCheck::Off;
        EXPECT_EQ(check == ExposureCheck::Off, checked == toneMapped(linear_, image));
    }
}

}  // namespace
}  // namespace conelight::test
