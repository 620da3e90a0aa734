// SPDX-License-Identifier: MIT
// What Conelight uses of stb_image and stb_image_write, behind plain functions; private to this room.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/image_file.h"

namespace conelight::io::stb {

// Encoded file as bytes; empty when out of memory.
std::vector<std::uint8_t> encodeJpg(int width, int height, int channels, const std::uint8_t* pixels,
                                    int quality);
std::vector<std::uint8_t> encodeHdr(int width, int height, const float* rgb);

// BMP and TGA. Decodes into `image`; returns "" or what is wrong. wantedChannels 0: as in the file (1, 3, 4).
std::string decodeBytes(std::span<const std::uint8_t> file, int wantedChannels, ByteImage& image);
// Decodes into the given variables; returns "" or what is wrong.
std::string decodeHdr(const std::uint8_t* data, std::size_t size, int& width, int& height,
                      std::vector<float>& rgb);

}  // namespace conelight::io::stb
