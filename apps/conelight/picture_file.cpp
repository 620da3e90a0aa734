// SPDX-License-Identifier: MIT
#include "picture_file.h"

#include <cmath>
#include <limits>

#include "command.h"
#include "conelight/error.h"
#include "io/image_file.h"

namespace conelight::program {

std::vector<float> rgbOf(const Image& image) {
    std::vector<float> values;
    values.reserve(image.pixels.size() * 3);
    for (const glm::vec4& pixel : image.pixels) values.insert(values.end(), {pixel.r, pixel.g, pixel.b});
    return values;
}

template <class Value>
std::vector<Value> shownWithAlpha(const Image& image, const ImageSettings& look) {
    constexpr auto kMost = static_cast<float>(std::numeric_limits<Value>::max());
    Image own = image;
    for (glm::vec4& pixel : own.pixels)
        if (pixel.a > 0) pixel = glm::vec4(glm::vec3(pixel) / pixel.a, pixel.a);
    std::vector<Value> rgb;
    if constexpr (sizeof(Value) == 1)
        rgb = toneMapped(own, look);
    else
        rgb = toneMapped16(own, look);
    std::vector<Value> rgba;
    rgba.reserve(4 * own.pixels.size());
    for (std::size_t i = 0; i < own.pixels.size(); ++i) {
        rgba.insert(rgba.end(), &rgb[3 * i], &rgb[3 * i] + 3);
        rgba.push_back(static_cast<Value>(std::lround(own.pixels[i].a * kMost)));
    }
    return rgba;
}
template std::vector<std::uint8_t> shownWithAlpha(const Image& image, const ImageSettings& look);
template std::vector<std::uint16_t> shownWithAlpha(const Image& image, const ImageSettings& look);

WrittenPicture pictureFor(const PictureFormat& format, const Image& image, const Scene& scene,
                          const Camera& camera, const ImageSettings& look) {
    WrittenPicture written{image, look};
    if (!format.alpha) return written;
    if (look.exposure.isAuto) written.look.exposure = {false, autoExposure(image)};
    written.image = foreground(image, scene, camera);
    return written;
}

void writePicture(const std::string& path, const Image& image, const ImageSettings& settings,
                  const PictureTexts& texts, const PictureLayers& layers, const PictureFormat& format) {
    const WritingScope writing;
    const io::ImageFormat kind = io::imageFormatOf(path);
    const int channels = format.alpha ? 4 : 3;
    if (kind == io::ImageFormat::Png && format.bits == 16) {
        io::writePng16(path, {image.width, image.height, channels,
                              format.alpha ? shownWithAlpha<std::uint16_t>(image, settings)
                                           : toneMapped16(image, settings),
                              texts});
        return;
    }
    if (kind == io::ImageFormat::Png || kind == io::ImageFormat::Jpg) {
        const io::ByteImage bytes{
            image.width, image.height, channels,
            format.alpha ? shownWithAlpha<std::uint8_t>(image, settings) : toneMapped(image, settings),
            texts};
        kind == io::ImageFormat::Png ? io::writePng(path, bytes) : io::writeJpg(path, bytes);
        return;
    }
    io::FloatImage floats;
    floats.width = image.width;
    floats.height = image.height;
    floats.channels = channels;
    if (format.alpha)
        for (const glm::vec4& pixel : image.pixels)
            floats.pixels.insert(floats.pixels.end(), {pixel.r, pixel.g, pixel.b, pixel.a});
    else
        floats.pixels = rgbOf(image);
    floats.attributes = texts;
    for (const auto& [name, layer] : layers) floats.layers.push_back({name, 3, rgbOf(layer)});
    kind == io::ImageFormat::Exr ? io::writeExr(path, floats) : io::writeHdr(path, floats);
}

}  // namespace conelight::program
