// SPDX-License-Identifier: MIT
// PNG, JPEG and WebP from memory through libpng, libjpeg and libwebp, which are made for damaged and hostile
// files. Pictures larger than wanted are made smaller row by row while they are decoded. Private to this room.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/image_file.h"

namespace conelight::io {

// Largest picture that is decoded: 16384 x 16384, a gigabyte as RGBA.
constexpr std::uint64_t kMostPixels = std::uint64_t(1) << 28;

struct DecodeRequest {
    int channels = 0;                       // 4: RGBA; 0: 1, 3 or 4, as in the file
    std::uint64_t maxPixels = kMostPixels;  // more: halved until it fits
    std::uint64_t maxInFile = kMostPixels;  // more: not decoded at all
};

struct DecodeResult {
    std::string failure;         // "" or what is wrong
    int width = 0, height = 0;   // in the file
    std::uint64_t unpacked = 0;  // bytes of its pixels, as the decoder makes them
};

bool isPng(std::span<const std::uint8_t> file);
bool isJpeg(std::span<const std::uint8_t> file);
bool isWebp(std::span<const std::uint8_t> file);
DecodeResult decodePng(std::span<const std::uint8_t> file, const DecodeRequest& request, ByteImage& image);
// An encoded PNG with the picture's attributes as its texts; empty when memory runs out.
std::vector<std::uint8_t> encodePng(const ByteImage& image);
std::vector<std::uint8_t> encodePng16(const WordImage& image);
DecodeResult decodeJpeg(std::span<const std::uint8_t> file, const DecodeRequest& request, ByteImage& image);
DecodeResult decodeWebp(std::span<const std::uint8_t> file, const DecodeRequest& request, ByteImage& image);

// PNG, JPEG, WebP and what stb_image reads (stb_impl.h).
DecodeResult decodePicture(std::span<const std::uint8_t> file, const DecodeRequest& request,
                           ByteImage& image);

// Why a picture of that size cannot be in so many bytes, or has more than `maxInFile` pixels; "" when it is
// decoded. A header may lie.
std::string sizeProblem(std::uint64_t width, std::uint64_t height, std::size_t fileBytes,
                        std::uint64_t maxInFile = kMostPixels);

// How many times a size must be halved to have at most so many pixels.
int halvings(int width, int height, std::uint64_t maxPixels);

// Takes rows from the top, makes a picture of means over squares of 2^halvings pixels. The means are of the
// stored values, not of light: what a texture means is not known here.
class RowShrinker {
  public:
    RowShrinker(int width, int height, int channels, int halvings, ByteImage& image);
    void add(const std::uint8_t* row);

  private:
    void finishRow();

    ByteImage& image_;
    int width_, height_, halvings_;
    int row_ = 0, summed_ = 0;
    std::vector<std::uint32_t> sums_;  // 2^15 rows and columns of 255 stay below 2^32 with 12 halvings
};

}  // namespace conelight::io
