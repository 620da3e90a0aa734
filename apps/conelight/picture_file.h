// SPDX-License-Identifier: MIT
// A rendered image as a file: 8-bit formats through the tone map, float formats as linear radiance.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "conelight/renderer.h"

namespace conelight::program {

// Texts of a file's header, by name.
using PictureTexts = std::vector<std::pair<std::string, std::string>>;

// Further layers of an .exr, by name.
using PictureLayers = std::vector<std::pair<std::string, Image>>;

// Format by extension; throws Error(Usage) for an unknown one. Layers are kept by .exr only, `texts` by .png
// and .exr.
void writePicture(const std::string& path, const Image& image, const ImageSettings& settings,
                  const PictureTexts& texts = {}, const PictureLayers& layers = {});

// rgb without the coverage in a, interleaved.
std::vector<float> rgbOf(const Image& image);

}  // namespace conelight::program
