// SPDX-License-Identifier: MIT
// The one place that compiles stb_image and stb_image_write (as static functions, so that they cannot meet
// the copies inside other libraries) and the few calls Conelight makes of them. See stb_impl.h.
#include "io/stb_impl.h"

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "io/picture_codec.h"

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wmisleading-indentation"
#endif
// Only the decoders we need: fewer decoders, fewer ways for a broken file to hurt.
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
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

}  // namespace

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

std::string decodeBytes(std::span<const std::uint8_t> file, int wantedChannels, ByteImage& image) {
    const std::uint8_t* const data = file.data();
    const std::size_t size = file.size();
    if (size > INT_MAX) return "is larger than 2 GiB";
    int inFile = 0;
    if (stbi_info_from_memory(data, int(size), &image.width, &image.height, &inFile) == 0)
        return "is not a PNG, JPG, BMP or TGA picture";
    const std::string problem = sizeProblem(std::uint64_t(image.width), std::uint64_t(image.height), size);
    if (!problem.empty()) return problem;
    int asked = wantedChannels;
    if (asked == 0) asked = inFile == 2 ? 4 : inFile;
    stbi_uc* decoded = stbi_load_from_memory(data, int(size), &image.width, &image.height, &inFile, asked);
    if (decoded == nullptr) return std::string("cannot be decoded (") + stbi_failure_reason() + ")";
    image.channels = asked;
    image.pixels.assign(decoded,
                        decoded + std::size_t(image.width) * std::size_t(image.height) * std::size_t(asked));
    stbi_image_free(decoded);
    return {};
}

// Radiance RGBE (Ward 1991), read here because stb_image of 2022 never returns from a file that ends within a
// run. Scanlines are flat or run-length coded per channel; only the usual "-Y height +X width" order is read.
std::string decodeHdr(const std::uint8_t* data, std::size_t size, int& width, int& height,
                      std::vector<float>& rgb) {
    std::size_t at = 0;
    const auto line = [&] {
        std::string text;
        while (at < size && data[at] != '\n') text.push_back(static_cast<char>(data[at++]));
        ++at;
        return text;
    };
    if (line().rfind("#?", 0) != 0) return "is not a Radiance HDR picture";
    while (at < size && !line().empty()) {
    }
    if (std::sscanf(line().c_str(), "-Y %d +X %d", &height, &width) != 2) return "has no usable size line";
    if (width <= 0 || height <= 0 || !sizeProblem(std::uint64_t(width), std::uint64_t(height), size).empty())
        return "has an unusable size";
    rgb.assign(3 * std::size_t(width) * std::size_t(height), 0.0f);
    std::vector<std::uint8_t> row(4 * std::size_t(width));
    const auto w = std::size_t(width);
    for (int y = 0; y < height; ++y) {
        const bool coded = width >= 8 && width < 32768 && at + 4 <= size && data[at] == 2 &&
                           data[at + 1] == 2 && (std::size_t(data[at + 2]) << 8 | data[at + 3]) == w;
        if (!coded) {
            if (at > size || size - at < row.size()) return "ends early";
            std::copy_n(data + at, row.size(), row.begin());
            at += row.size();
        } else {
            at += 4;
            for (std::size_t c = 0; c < 4; ++c)
                for (std::size_t x = 0; x < w;) {
                    if (at + 2 > size) return "ends early";
                    const std::size_t head = data[at++];
                    const bool isRun = head > 128;
                    const std::size_t count = isRun ? head - 128 : head;
                    if (count == 0 || count > w - x || (!isRun && count > size - at))
                        return "has a broken run";
                    for (std::size_t i = 0; i < count; ++i)
                        row[4 * x++ + c] = isRun ? data[at] : data[at + i];
                    at += isRun ? 1 : count;
                }
        }
        for (std::size_t x = 0; x < w; ++x) {
            // value = mantissa / 256 * 2^(exponent - 128); exponent 0 is black.
            const float scale =
                row[4 * x + 3] == 0 ? 0.0f : std::ldexp(1.0f, int(row[4 * x + 3]) - (128 + 8));
            for (std::size_t c = 0; c < 3; ++c)
                rgb[3 * (std::size_t(y) * w + x) + c] = float(row[4 * x + c]) * scale;
        }
    }
    return {};
}

}  // namespace conelight::io::stb
