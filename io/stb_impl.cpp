// SPDX-License-Identifier: MIT
// The one place that compiles stb_image and stb_image_write (as static functions, so that they cannot meet
// the copies inside other libraries) and the few calls Conelight makes of them. See stb_impl.h.
#include "io/stb_impl.h"

#include <algorithm>
#include <climits>
#include <cstdlib>

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wmisleading-indentation"
#endif
// Only the decoders we need: fewer decoders, fewer ways for a broken file to hurt.
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_ONLY_HDR
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS 32768  // 2x the texture limit of today's GPUs
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb_image.h>
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb_image_write.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace conelight::io::stb {

namespace {

void append(void* context, void* data, int size) {
    auto& out = *static_cast<std::vector<std::uint8_t>*>(context);
    const auto* bytes = static_cast<const std::uint8_t*>(data);
    out.insert(out.end(), bytes, bytes + size);
}

// Largest picture we decode: 2^28 pixels (16384^2) are 1 GiB of RGBA.
constexpr long long kMaxPixels = 1LL << 28;

// A header may lie about its size. No format here packs more than about 1000 pixels into a byte (deflate's
// limit is 1032 to 1); beyond 4 million pixels a picture must be that plausible.
bool plausible(long long width, long long height, std::size_t fileBytes) {
    const long long pixels = width * height;
    return pixels > 0 && pixels <= kMaxPixels &&
           (pixels <= (1LL << 22) || pixels / 1100 <= static_cast<long long>(fileBytes));
}

}  // namespace

std::vector<std::uint8_t> encodePng(int width, int height, int channels, const std::uint8_t* pixels) {
    std::vector<std::uint8_t> out;
    stbi_write_png_compression_level = 8;
    if (stbi_write_png_to_func(append, &out, width, height, channels, pixels, width * channels) == 0)
        out.clear();
    return out;
}

std::vector<std::uint8_t> encodeJpg(int width, int height, int channels, const std::uint8_t* pixels,
                                    int quality) {
    std::vector<std::uint8_t> out;
    if (stbi_write_jpg_to_func(append, &out, width, height, channels, pixels, quality) == 0) out.clear();
    return out;
}

std::vector<std::uint8_t> encodeHdr(int width, int height, const float* rgb) {
    std::vector<std::uint8_t> out;
    if (stbi_write_hdr_to_func(append, &out, width, height, 3, rgb) == 0) out.clear();
    return out;
}

std::string decodeBytes(const std::uint8_t* data, std::size_t size, int wantedChannels, int& width,
                        int& height, int& channels, std::vector<std::uint8_t>& pixels) {
    if (size > INT_MAX) return "is larger than 2 GiB";
    int inFile = 0;
    if (stbi_info_from_memory(data, int(size), &width, &height, &inFile) == 0)
        return "is not a PNG, JPG, BMP or TGA picture";
    if (!plausible(width, height, size)) return "has an unusable size";
    int asked = wantedChannels;
    if (asked == 0) asked = inFile == 2 ? 4 : inFile;
    stbi_uc* decoded = stbi_load_from_memory(data, int(size), &width, &height, &inFile, asked);
    if (decoded == nullptr) return std::string("cannot be decoded (") + stbi_failure_reason() + ")";
    channels = asked;
    pixels.assign(decoded, decoded + std::size_t(width) * std::size_t(height) * std::size_t(asked));
    stbi_image_free(decoded);
    return {};
}

std::string decodeHdr(const std::uint8_t* data, std::size_t size, int& width, int& height,
                      std::vector<float>& rgb) {
    if (size > INT_MAX) return "is larger than 2 GiB";
    if (stbi_is_hdr_from_memory(data, int(size)) == 0) return "is not a Radiance HDR picture";
    int inFile = 0;
    if (stbi_info_from_memory(data, int(size), &width, &height, &inFile) == 0 ||
        !plausible(width, height, size))
        return "has an unusable size";
    float* decoded = stbi_loadf_from_memory(data, int(size), &width, &height, &inFile, 3);
    if (decoded == nullptr) return std::string("cannot be decoded (") + stbi_failure_reason() + ")";
    rgb.assign(decoded, decoded + 3 * std::size_t(width) * std::size_t(height));
    stbi_image_free(decoded);
    return {};
}

}  // namespace conelight::io::stb
