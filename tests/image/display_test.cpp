// SPDX-License-Identifier: MIT
// The GPU's picture for a screen against the CPU's: the same bytes but for the last place. Rows of all textures.
#include <epoxy/gl.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <vector>

#include "conelight/renderer.h"
#include "io/scene_file.h"
#include "support/gl_fixture.h"
#include "support/view_rig.h"

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
    // Where the texture has a pixel of a picture in memory: its lowest row comes first.
    static std::size_t texelOf(std::size_t pixel) {
        return (kHeight - 1 - pixel / kWidth) * kWidth + pixel % kWidth;
    }
    // How far each value that is shown is off.
    std::vector<int> errorsOf(const ImageSettings& look) {
        const std::vector<std::uint8_t> expected = toneMapped(linear_, look);
        std::vector<std::uint8_t> shown(4u * kWidth * kHeight);
        glGetTextureImage(renderer_->displayTexture(look), 0, GL_RGBA, GL_UNSIGNED_BYTE,
                          static_cast<GLsizei>(shown.size()), shown.data());
        std::vector<int> errors;
        for (std::size_t i = 0; i < expected.size(); ++i)
            errors.push_back(std::abs(int(expected[i]) - int(shown[texelOf(i / 3) * 4 + i % 3])));
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

// Texels of a host, in either order of rows: a floor that is white at its near, lower end.
TEST_F(DisplayTest, AllTexturesHaveOneOrderOfRows) {
    Scene scene;
    Material near, far;
    far.baseColor = {0.25f, 0, 0, 1};
    near.unlit = far.unlit = true;
    addInstance(scene, quadMesh({-1, -1, 0}, {2, 0, 0}, {0, 0.7f, 0}), near);
    addInstance(scene, quadMesh({-1, -0.3f, 0}, {2, 0, 0}, {0, 1.3f, 0}), far);
    scene.cameras = {Camera{}};
    scene.cameras[0].eye = {0, 0, 2};
    scene.cameras[0].target = {0, 0, 0};
    Settings settings;
    settings.mode = Mode::Phong;
    settings.image.toneMap = ToneMap::None;
    for (const RowOrder rows : {RowOrder::BottomFirst, RowOrder::TopFirst}) {
        RendererOptions options;
        options.rows = rows;
        Renderer renderer(options);
        renderer.setScene(scene);
        renderer.render(scene.cameras.front(), kWidth, kHeight, settings);
        const Image image = renderer.readImage();
        const std::vector<std::uint8_t> bytes = toneMapped(image, settings.image);
        gl::Texture own({GL_TEXTURE_2D, GL_RGBA32F, kWidth, kHeight}, "of the host");
        renderer.copyToTexture(own.name());
        std::vector<glm::vec4> copied(image.pixels.size()), linear(image.pixels.size());
        std::vector<std::uint8_t> shown(4 * image.pixels.size());
        const auto size = static_cast<GLsizei>(copied.size() * sizeof(glm::vec4));
        own.read(0, GL_RGBA, GL_FLOAT, copied.data(), copied.size() * sizeof(glm::vec4));
        glGetTextureImage(renderer.imageTexture(), 0, GL_RGBA, GL_FLOAT, size, linear.data());
        glGetTextureImage(renderer.displayTexture(settings.image), 0, GL_RGBA, GL_UNSIGNED_BYTE,
                          static_cast<GLsizei>(shown.size()), shown.data());
        EXPECT_EQ(copied, linear);
        int worst = 0;
        for (std::size_t pixel = 0; pixel < image.pixels.size(); ++pixel) {
            const std::size_t texel = rows == RowOrder::TopFirst ? pixel : texelOf(pixel);
            ASSERT_EQ(linear[texel], image.pixels[pixel]) << pixel;
            for (std::size_t c = 0; c < 3; ++c)
                worst = std::max(worst, std::abs(int(shown[4 * texel + c]) - int(bytes[3 * pixel + c])));
        }
        EXPECT_LE(worst, 1);
        // The floor of the scene is below.
        EXPECT_GT(image.pixels[(kHeight - 5) * kWidth + kWidth / 2].g, 0.5f);
        EXPECT_EQ(image.pixels[4 * kWidth + kWidth / 2].g, 0.0f);
    }
}

}  // namespace
}  // namespace conelight::test
