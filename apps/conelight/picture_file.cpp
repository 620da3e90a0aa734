// SPDX-License-Identifier: MIT
#include "picture_file.h"

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

void writePicture(const std::string& path, const Image& image, const ImageSettings& settings,
                  const PictureTexts& texts, const PictureLayers& layers) {
    const WritingScope writing;
    const io::ImageFormat format = io::imageFormatOf(path);
    if (format == io::ImageFormat::Png || format == io::ImageFormat::Jpg) {
        const io::ByteImage bytes{image.width, image.height, 3, toneMapped(image, settings), texts};
        format == io::ImageFormat::Png ? io::writePng(path, bytes) : io::writeJpg(path, bytes);
        return;
    }
    io::FloatImage floats;
    floats.width = image.width;
    floats.height = image.height;
    floats.pixels = rgbOf(image);
    floats.attributes = texts;
    for (const auto& [name, layer] : layers) floats.layers.push_back({name, 3, rgbOf(layer)});
    format == io::ImageFormat::Exr ? io::writeExr(path, floats) : io::writeHdr(path, floats);
}

}  // namespace conelight::program
