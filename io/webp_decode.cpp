// SPDX-License-Identifier: MIT
// WebP through libwebp, whole and then row by row into a smaller picture. Of animations nothing is read.
#include <fmt/core.h>

#include <memory>

#include "io/picture_codec.h"

#ifdef CONELIGHT_HAS_WEBP
#include <webp/decode.h>
#endif

namespace conelight::io {

bool isWebp(std::span<const std::uint8_t> file) {
    const auto is = [&](std::size_t at, std::string_view letters) {
        for (std::size_t i = 0; i < letters.size(); ++i)
            if (file[at + i] != static_cast<std::uint8_t>(letters[i])) return false;
        return true;
    };
    return file.size() > 12 && is(0, "RIFF") && is(8, "WEBP");
}

#ifdef CONELIGHT_HAS_WEBP

DecodeResult decodeWebp(std::span<const std::uint8_t> file, const DecodeRequest& request, ByteImage& image) {
    WebPBitstreamFeatures features{};
    if (WebPGetFeatures(file.data(), file.size(), &features) != VP8_STATUS_OK)
        return {"cannot be decoded (not a WebP picture)", 0, 0};
    if (features.has_animation != 0) return {"is an animation; a still picture would be right", 0, 0};
    const std::string problem = sizeProblem(std::uint64_t(features.width), std::uint64_t(features.height),
                                            file.size(), request.maxInFile);
    if (!problem.empty()) return {problem, features.width, features.height};
    const int channels = request.channels == 4 || features.has_alpha != 0 ? 4 : 3;
    const std::size_t row = std::size_t(features.width) * std::size_t(channels);
    std::vector<std::uint8_t> whole(row * std::size_t(features.height));
    const auto decode = channels == 4 ? WebPDecodeRGBAInto : WebPDecodeRGBInto;
    if (decode(file.data(), file.size(), whole.data(), whole.size(), int(row)) == nullptr)
        return {"cannot be decoded (its data is damaged)", features.width, features.height};
    RowShrinker shrinker(features.width, features.height, channels,
                         halvings(features.width, features.height, request.maxPixels), image);
    for (std::size_t y = 0; y < std::size_t(features.height); ++y) shrinker.add(&whole[y * row]);
    return {{}, features.width, features.height, whole.size()};
}

#else

DecodeResult decodeWebp(std::span<const std::uint8_t>, const DecodeRequest&, ByteImage&) {
    return {"is WebP, and this build has no libwebp; build with libwebp-dev installed", 0, 0};
}

#endif

}  // namespace conelight::io
