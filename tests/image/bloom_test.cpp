// SPDX-License-Identifier: MIT
// Bloom: light is kept, radii follow the picture's height, none is none, and the GPU shows what the CPU does.
#include "image/bloom.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "support/gl_fixture.h"
#include "support/scenes.h"

namespace conelight::test {
namespace {

using BloomTest = GlTest;

// Black but for a square of `edge` pixels in the middle.
Image spot(int width, int height, int edge) {
    Image image{width, height, std::vector<glm::vec4>(static_cast<std::size_t>(width * height))};
    for (int y = (height - edge) / 2; y < (height + edge) / 2; ++y)
        for (int x = (width - edge) / 2; x < (width + edge) / 2; ++x)
            image.pixels[static_cast<std::size_t>(y * width + x)] = {100, 50, 25, 1};
    return image;
}

double lightOf(const Image& image) {
    double sum = 0;
    for (const glm::vec4& pixel : image.pixels) sum += static_cast<double>(pixel.r + pixel.g + pixel.b);
    return sum;
}

// Root of the mean squared distance from the middle, as part of the height.
double radiusOf(const Image& image) {
    double sum = 0, squares = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double light =
                static_cast<double>(image.pixels[static_cast<std::size_t>(y * image.width + x)].r);
            const double dx = x + 0.5 - 0.5 * image.width, dy = y + 0.5 - 0.5 * image.height;
            sum += light;
            squares += light * (dx * dx + dy * dy);
        }
    return std::sqrt(squares / sum) / image.height;
}

TEST_F(BloomTest, LightIsKept) {
    for (const auto& [width, height] : {std::pair{256, 256}, {320, 200}, {333, 251}}) {
        const Image image = spot(width, height, 8);
        for (const float strength : {0.05f, 1.0f})
            EXPECT_NEAR(lightOf(image::bloomed(image, strength)) / lightOf(image), 1, 0.01)
                << width << " x " << height << ", strength " << strength;
    }
    // Where all is alike nothing changes.
    Image even{70, 50, std::vector<glm::vec4>(3500, glm::vec4(2, 1, 0.5f, 1))};
    for (const glm::vec4& pixel : image::bloomed(even, 0.7f).pixels) EXPECT_NEAR(pixel.r, 2, 1e-4);
}

TEST_F(BloomTest, ItsRadiusIsAPartOfThePicturesHeight) {
    const double small = radiusOf(image::bloomed(spot(192, 192, 6), 1));
    for (const int height : {256, 300, 384, 768})
        EXPECT_NEAR(radiusOf(image::bloomed(spot(height, height, height / 32), 1)) / small, 1, 0.08)
            << height;
}

// The bytes of each pixel as if it were a picture of its own: no light comes from its neighbours.
std::vector<std::uint8_t> toneMappedAlone(const Image& image, const ImageSettings& settings) {
    std::vector<std::uint8_t> bytes;
    for (const glm::vec4& pixel : image.pixels) {
        const std::vector<std::uint8_t> one = toneMapped(Image{1, 1, {pixel}}, settings);
        bytes.insert(bytes.end(), one.begin(), one.end());
    }
    return bytes;
}

TEST_F(BloomTest, WithoutItEveryPixelIsItsOwn) {
    const Image image = spot(64, 48, 6);
    EXPECT_EQ(image::bloomed(image, 0).pixels, image.pixels);
    ImageSettings off, on;
    on.bloom = 0.2f;
    EXPECT_EQ(off.bloom, 0) << "no picture blooms unless it is asked to";
    EXPECT_EQ(toneMapped(image, off), toneMappedAlone(image, off));
    EXPECT_NE(toneMapped(image, on), toneMappedAlone(image, on));
}

TEST_F(BloomTest, APixelThatIsNoNumberStaysAlone) {
    Image image = spot(64, 64, 6);
    image.pixels[5] = glm::vec4(std::nanf(""));
    const Image with = image::bloomed(image, 0.5f);
    int bad = 0;
    for (const glm::vec4& pixel : with.pixels) bad += std::isfinite(pixel.r) ? 0 : 1;
    EXPECT_EQ(bad, 1);
}

TEST_F(BloomTest, TheGpuShowsWhatTheCpuDoes) {
    Scene scene;
    Material bright;
    bright.unlit = true;
    bright.baseColor = {1, 0.7f, 0.4f, 1};
    addInstance(scene, quadMesh({-0.3f, -0.2f, 0}, {0.5f, 0.1f, 0}, {0, 0.4f, 0}), bright);
    scene.sky = glm::vec3(0.02f);
    scene.cameras = {Camera{}};
    Renderer renderer;
    renderer.setScene(scene);
    Settings settings;
    settings.mode = Mode::Phong;
    for (const auto& [width, height] : {std::pair{70, 51}, {128, 96}}) {
        renderer.render(scene.cameras.front(), width, height, settings);
        const Image linear = renderer.readImage();
        ImageSettings image;
        image.bloom = 0.3f;
        const std::vector<std::uint8_t> expected = toneMapped(linear, image);
        std::vector<std::uint8_t> shown(static_cast<std::size_t>(4 * width * height));
        glGetTextureImage(renderer.displayTexture(image), 0, GL_RGBA, GL_UNSIGNED_BYTE,
                          static_cast<GLsizei>(shown.size()), shown.data());
        int worst = 0;
        const auto across = static_cast<std::size_t>(width);
        for (std::size_t i = 0; i < expected.size(); ++i) {
            // The texture's lowest row comes first.
            const std::size_t pixel = i / 3, row = static_cast<std::size_t>(height) - 1 - pixel / across;
            const std::size_t texel = row * across + pixel % across;
            worst = std::max(worst, std::abs(int(expected[i]) - int(shown[texel * 4 + i % 3])));
        }
        EXPECT_LE(worst, 1);
        EXPECT_EQ(renderer.readImage().pixels, linear.pixels) << "linear radiance stays";
        image.bloom = 0;
        EXPECT_NE(toneMapped(linear, image), expected);
    }
}

}  // namespace
}  // namespace conelight::test
