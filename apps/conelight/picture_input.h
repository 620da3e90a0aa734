// SPDX-License-Identifier: MIT
// Picture files as images to compare.
#pragma once

#include <string>

#include "conelight/renderer.h"

namespace conelight::program {

// Whether the name ends like a picture's.
bool isPictureFile(const std::string& path);

// Linear colours of .exr and .hdr as they are, of 8-bit files sRGB-decoded; grey is spread over the channels,
// alpha kept. `layer` names a layer of an .exr; empty: the picture itself. Throws Error(BadInput).
Image readPicture(const std::string& path, const std::string& layer = {});

// Throws Error(BadInput) that names both files.
void requireSameSize(const Image& a, const std::string& nameA, const Image& b, const std::string& nameB);

}  // namespace conelight::program
