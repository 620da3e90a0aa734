// SPDX-License-Identifier: MIT
// Picture files as images to compare.
#pragma once

#include <string>
#include <vector>

#include "conelight/renderer.h"

namespace conelight::program {

// Whether the name ends like a picture's.
bool isPictureFile(const std::string& path);

// Linear colours of .exr and .hdr as they are, of 8-bit files sRGB-decoded; grey is spread over the channels,
// alpha kept. `layer` names a layer of an .exr; empty: the picture itself. Throws Error(BadInput).
Image readPicture(const std::string& path, const std::string& layer = {});

// A picture file's pictures: itself first, without a name, then its layers. Layers of two channels have no blue. Throws
// Error(BadInput).
struct PictureLayer {
    std::string name;
    Image image;
};
std::vector<PictureLayer> readLayers(const std::string& path);

// Throws Error(BadInput) that names both files.
void requireSameSize(const Image& a, const std::string& nameA, const Image& b, const std::string& nameB);

}  // namespace conelight::program
