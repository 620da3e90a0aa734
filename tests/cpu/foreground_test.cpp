// SPDX-License-Identifier: MIT
// The picture without what is behind it: sky and environment taken off pixels that are covered in part.
#include <gtest/gtest.h>

#include "conelight/renderer.h"

namespace conelight::test {
namespace {

TEST(ForegroundTest, TakesTheSurroundingsOffWhatIsCoveredInPart) {
    Scene scene;
    scene.sky = {0.2f, 0.4f, 0.8f};
    const glm::vec3 surface(1, 2, 3);
    Image image{4, 1, {}};
    for (const float alpha : {0.0f, 0.25f, 0.75f, 1.0f})
        image.pixels.emplace_back(alpha * surface + (1 - alpha) * scene.sky, alpha);
    const Image alone = foreground(image, scene, Camera{});
    for (const glm::vec4& pixel : alone.pixels) {
        const glm::vec3 expected = pixel.a * surface;
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(pixel[i], expected[i], 1e-5f) << pixel.a;
    }
    EXPECT_EQ(alone.pixels[0], glm::vec4(0));
    EXPECT_EQ(alone.pixels[3], image.pixels[3]);
}

// Looking along -z: the middle of an unturned environment. Its right half is red, the left one blue.
TEST(ForegroundTest, LooksTheEnvironmentUpWhereThePixelLooks) {
    Scene scene;
    auto picture = std::make_shared<EnvironmentImage>();
    picture->width = 4;
    picture->height = 2;
    for (int i = 0; i < 8; ++i)
        picture->radiance.push_back(i % 4 < 2 ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0));
    scene.environment.image = picture;
    Image image{2, 1, {glm::vec4(0.25f, 0.25f, 0.25f, 0.5f), glm::vec4(0.25f, 0.25f, 0.25f, 0.5f)}};
    Camera camera;
    camera.fovY = 1.5f;
    const Image alone = foreground(image, scene, camera);
    EXPECT_LT(alone.pixels[0].b, alone.pixels[0].r) << "blue is behind the left one";
    EXPECT_LT(alone.pixels[1].r, alone.pixels[1].b) << "red is behind the right one";
}

TEST(ForegroundTest, SixteenBitsAreTheSamePicture) {
    Image image{3, 1, {glm::vec4(0.18f), glm::vec4(0.5f), glm::vec4(2)}};
    const std::vector<std::uint8_t> bytes = toneMapped(image, {});
    const std::vector<std::uint16_t> words = toneMapped16(image, {});
    ASSERT_EQ(words.size(), bytes.size());
    for (std::size_t i = 0; i < words.size(); ++i) EXPECT_NEAR(words[i] / 257.0, bytes[i], 0.51);
    ImageSettings plain;
    plain.toneMap = ToneMap::None;
    plain.exposure = {false, 0};
    EXPECT_EQ(toneMapped16(image, plain).back(), 65535);
}

}  // namespace
}  // namespace conelight::test
