// SPDX-License-Identifier: MIT
#include "picture_input.h"

#include <fmt/core.h>

#include "conelight/error.h"
#include "io/image_file.h"

namespace conelight::program {
namespace {

const std::vector<float>& layerPixels(const io::FloatImage& file, const std::string& path,
                                      const std::string& name, int& channels) {
    std::string known;
    for (const io::ImageLayer& layer : file.layers) {
        if (layer.name == name) {
            channels = layer.channels;
            return layer.pixels;
        }
        known += (known.empty() ? "" : ", ") + layer.name;
    }
    throw Error(ErrorKind::BadInput, fmt::format("{}: --layer: has no layer '{}'; {}", path, name,
                                                 known.empty() ? "it has none at all" : "it has " + known));
}

Image imageOf(const io::FloatImage& file, const std::vector<float>& values, int channels) {
    Image image{file.width, file.height, {}};
    image.pixels.reserve(values.size() / std::size_t(channels));
    for (std::size_t i = 0; i < values.size(); i += std::size_t(channels)) {
        const float* v = &values[i];
        image.pixels.emplace_back(v[0], channels > 1 ? v[1] : v[0],
                                  channels > 2    ? v[2]
                                  : channels == 2 ? 0.0f
                                                  : v[0],
                                  channels == 4 ? v[3] : 1.0f);
    }
    return image;
}

}  // namespace

bool isPictureFile(const std::string& path) {
    try {
        io::imageFormatOf(path);
        return true;
    } catch (const Error&) {
        return false;
    }
}

Image readPicture(const std::string& path, const std::string& layer) {
    const io::FloatImage file = io::readImage(path);
    int channels = file.channels;
    const std::vector<float>& values = layer.empty() ? file.pixels : layerPixels(file, path, layer, channels);
    if (channels == 2)
        throw Error(ErrorKind::BadInput,
                    path + ": has two channels; a grey or colour picture would be right");
    return imageOf(file, values, channels);
}

std::vector<PictureLayer> readLayers(const std::string& path) {
    const io::FloatImage file = io::readImage(path);
    std::vector<PictureLayer> layers{{"", imageOf(file, file.pixels, file.channels)}};
    for (const io::ImageLayer& layer : file.layers)
        layers.push_back({layer.name, imageOf(file, layer.pixels, layer.channels)});
    return layers;
}

void requireSameSize(const Image& a, const std::string& nameA, const Image& b, const std::string& nameB) {
    if (a.width != b.width || a.height != b.height)
        throw Error(ErrorKind::BadInput,
                    fmt::format("{}: is {}x{} pixels, but {} is {}x{}; the same size would be right", nameA,
                                a.width, a.height, nameB, b.width, b.height));
}

}  // namespace conelight::program
