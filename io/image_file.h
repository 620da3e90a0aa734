// SPDX-License-Identifier: MIT
// Image files: 8-bit pictures (PNG, JPG) and float pictures (EXR, HDR). Rows run from the top; the first row
// in memory is the first row of the picture. Every file is written beside its place and renamed, so it is
// never half-written. Errors are conelight::Error with one line that starts with the path: Usage for an
// extension nobody knows, BadInput for a file that cannot be read, Runtime for one that cannot be written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "conelight/export.h"

namespace conelight::io {

enum class ImageFormat { Png, Jpg, Exr, Hdr };

// Format by extension (.png .jpg .jpeg .exr .hdr, any case). Throws Error(Usage) that names the known ones.
CONELIGHT_API ImageFormat imageFormatOf(const std::filesystem::path& path);

// 8 bits per channel, interleaved; rgb is sRGB-encoded by whoever fills it, alpha linear.
struct ByteImage {
    int width = 0;
    int height = 0;
    int channels = 3;                  // 1 grey, 3 RGB, 4 RGBA
    std::vector<std::uint8_t> pixels;  // channels * width * height
    // PNG only, UTF-8: key of 1 to 79 characters of Latin-1, text.
    std::vector<std::pair<std::string, std::string>> attributes;
};

// 16 bits per channel, interleaved, in the meaning of whoever fills it.
struct WordImage {
    int width = 0;
    int height = 0;
    int channels = 3;                                             // 1 grey, 3 RGB, 4 RGBA
    std::vector<std::uint16_t> pixels;                            // channels * width * height
    std::vector<std::pair<std::string, std::string>> attributes;  // as of ByteImage
};

// A further layer of an EXR file. Channel names in the file: NAME (1 channel), NAME.X .Y (2), NAME.R .G .B
// (3), NAME.R .G .B .A (4).
struct ImageLayer {
    std::string name;
    int channels = 3;
    std::vector<float> pixels;
};

// Linear floats, Rec.709 primaries, interleaved.
struct FloatImage {
    int width = 0;
    int height = 0;
    int channels = 3;  // 1 grey, 3 RGB, 4 RGBA
    std::vector<float> pixels;
    std::vector<ImageLayer> layers;                               // EXR only
    std::vector<std::pair<std::string, std::string>> attributes;  // EXR only: name, text
};

// The bytes of a PNG file. Throws Error(Runtime) when memory runs out.
CONELIGHT_API std::vector<std::uint8_t> pngBytes(const ByteImage& image);
CONELIGHT_API void writePng(const std::filesystem::path& path, const ByteImage& image);
// A PNG file of 16 bits. readByteImage gives its upper bytes.
CONELIGHT_API void writePng16(const std::filesystem::path& path, const WordImage& image);
CONELIGHT_API void writeJpg(const std::filesystem::path& path, const ByteImage& image, int quality = 92);

// Scanline EXR, 32-bit float, ZIP, first row on top, with the Rec.709 chromaticities. Values are stored as
// they are (negative, infinite and NaN included).
CONELIGHT_API void writeExr(const std::filesystem::path& path, const FloatImage& image);
// RGBE, 8 bits mantissa: alpha and layers are dropped, negatives become 0.
CONELIGHT_API void writeHdr(const std::filesystem::path& path, const FloatImage& image);

// All float, half and uint channels of the first part; R,G,B(,A) or Y become `pixels`, others layers (sorted
// by name). A file without either has its first layer copied to `pixels`.
CONELIGHT_API FloatImage readExr(const std::filesystem::path& path);

// PNG or JPG (and what else stb reads: BMP, TGA), with 1, 3 or 4 channels as in the file.
CONELIGHT_API ByteImage readByteImage(const std::filesystem::path& path);

// Any known file as linear floats: EXR and HDR as they are, 8-bit ones sRGB-decoded.
CONELIGHT_API FloatImage readImage(const std::filesystem::path& path);

// Encoded 8-bit picture in memory as RGBA; used for textures. `what` starts the error line.
CONELIGHT_API ByteImage decodeRgba(std::span<const std::uint8_t> encoded, const std::string& what);

// sRGB transfer function (IEC 61966-2-1) of one channel, both ways; [0,1] in, [0,1] out.
CONELIGHT_API float linearFromSrgb(float encoded);
CONELIGHT_API float srgbFromLinear(float linear);

}  // namespace conelight::io
