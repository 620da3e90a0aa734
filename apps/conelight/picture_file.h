// SPDX-License-Identifier: MIT
// A rendered image as a file: 8-bit formats through the tone map, float formats as linear radiance.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "conelight/renderer.h"
#include "session/picture_format.h"

namespace conelight::program {

// Texts of a file's header, by name.
using PictureTexts = std::vector<std::pair<std::string, std::string>>;

// Further layers of an .exr, by name.
using PictureLayers = std::vector<std::pair<std::string, Image>>;

// Format by extension; throws Error(Usage) for an unknown one. Layers are kept by .exr only, `texts` by .png
// and .exr. With alpha `image` is foreground()'s; .exr keeps it so, .png has the surfaces' own colour.
void writePicture(const std::string& path, const Image& image, const ImageSettings& settings,
                  const PictureTexts& texts = {}, const PictureLayers& layers = {},
                  const PictureFormat& format = {});

// What is written of a picture of this scene and camera: with alpha its foreground, at the exposure of the whole.
struct WrittenPicture {
    Image image;
    ImageSettings look;
};
WrittenPicture pictureFor(const PictureFormat& format, const Image& image, const Scene& scene,
                          const Camera& camera, const ImageSettings& look);

// RGBA of foreground()'s picture as a screen shows it; alpha is not multiplied in.
template <class Value>
std::vector<Value> shownWithAlpha(const Image& image, const ImageSettings& look);

// rgb without the coverage in a, interleaved.
std::vector<float> rgbOf(const Image& image);

}  // namespace conelight::program
