// SPDX-License-Identifier: MIT
// Image files except EXR (exr_file.cpp): format by extension, PNG and JPG through picture_codec.h, HDR and
// what is written through stb, sRGB transfer curve.
#include "io/image_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "conelight/error.h"
#include "io/files.h"
#include "io/picture_codec.h"
#include "io/stb_impl.h"

namespace conelight::io {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void failRead(const std::string& what, const std::string& why) {
    throw Error(ErrorKind::BadInput, fmt::format("{}: {}", what, why));
}

void writeEncoded(const fs::path& path, const std::vector<std::uint8_t>& bytes) {
    if (bytes.empty())
        throw Error(ErrorKind::Runtime,
                    fmt::format("{}: out of memory while encoding", oneLine(path.string())));
    writeFile(path, bytes);
}

std::size_t valueCount(int width, int height, int channels) {
    return std::size_t(width) * std::size_t(height) * std::size_t(channels);
}

}  // namespace

ImageFormat imageFormatOf(const fs::path& path) {
    const std::string extension = lowerExtension(path);
    if (extension == ".png") return ImageFormat::Png;
    if (extension == ".jpg" || extension == ".jpeg") return ImageFormat::Jpg;
    if (extension == ".exr") return ImageFormat::Exr;
    if (extension == ".hdr") return ImageFormat::Hdr;
    throw Error(ErrorKind::Usage,
                fmt::format("{}: unknown picture extension '{}'; known: .png .jpg .jpeg .exr .hdr",
                            oneLine(path.string()), oneLine(extension)));
}

std::vector<std::uint8_t> pngBytes(const ByteImage& image) {
    assert(image.pixels.size() == valueCount(image.width, image.height, image.channels));
    std::vector<std::uint8_t> bytes = encodePng(image);
    if (bytes.empty()) throw Error(ErrorKind::Runtime, "out of memory while encoding a picture");
    return bytes;
}

void writePng(const fs::path& path, const ByteImage& image) {
    assert(image.pixels.size() == valueCount(image.width, image.height, image.channels));
    writeEncoded(path, encodePng(image));
}

void writePng16(const fs::path& path, const WordImage& image) {
    assert(image.pixels.size() == valueCount(image.width, image.height, image.channels));
    writeEncoded(path, encodePng16(image));
}

void writeJpg(const fs::path& path, const ByteImage& image, int quality) {
    assert(image.pixels.size() == valueCount(image.width, image.height, image.channels));
    writeEncoded(path, stb::encodeJpg(image.width, image.height, image.channels, image.pixels.data(),
                                      std::clamp(quality, 1, 100)));
}

void writeHdr(const fs::path& path, const FloatImage& image) {
    assert(image.pixels.size() == valueCount(image.width, image.height, image.channels));
    const std::size_t count = valueCount(image.width, image.height, 1);
    std::vector<float> rgb(3 * count);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            const float value = image.pixels[i * std::size_t(image.channels) + (image.channels < 3 ? 0 : c)];
            // RGBE holds no negative, no NaN and nothing above 2^127.
            rgb[3 * i + c] = value > 0.0f ? std::min(value, 1.0e38f) : 0.0f;
        }
    writeEncoded(path, stb::encodeHdr(image.width, image.height, rgb.data()));
}

ByteImage decodeRgba(std::span<const std::uint8_t> encoded, const std::string& what) {
    ByteImage image;
    const DecodeResult result = decodePicture(encoded, {4, kMostPixels}, image);
    if (!result.failure.empty()) failRead(what, result.failure);
    return image;
}

ByteImage readByteImage(const fs::path& path) {
    const Bytes bytes = readFile(path);
    ByteImage image;
    const DecodeResult result = decodePicture(bytes, {0, kMostPixels}, image);
    if (!result.failure.empty()) failRead(oneLine(path.string()), result.failure);
    return image;
}

FloatImage readImage(const fs::path& path) {
    const std::string extension = lowerExtension(path);
    if (extension == ".exr") return readExr(path);
    FloatImage image;
    if (extension == ".hdr") {
        const Bytes bytes = readFile(path);
        const std::string why =
            stb::decodeHdr(bytes.data(), bytes.size(), image.width, image.height, image.pixels);
        if (!why.empty()) failRead(oneLine(path.string()), why);
        return image;
    }
    imageFormatOf(path);
    const ByteImage encoded = readByteImage(path);
    image.width = encoded.width;
    image.height = encoded.height;
    image.channels = encoded.channels;
    std::array<float, 256> linear;
    for (int i = 0; i < 256; ++i) linear[std::size_t(i)] = linearFromSrgb(float(i) / 255.0f);
    image.pixels.resize(encoded.pixels.size());
    for (std::size_t i = 0; i < encoded.pixels.size(); ++i) {
        const bool alpha = encoded.channels == 4 && i % 4 == 3;
        image.pixels[i] = alpha ? float(encoded.pixels[i]) / 255.0f : linear[encoded.pixels[i]];
    }
    return image;
}

float linearFromSrgb(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

float srgbFromLinear(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

}  // namespace conelight::io
