// SPDX-License-Identifier: MIT
#include "io/texture_budget.h"

#include <fmt/core.h>

#include <algorithm>

#include "conelight/error.h"
#include "io/files.h"
#include "io/picture_codec.h"

namespace conelight::io {

ByteImage TextureBudget::decode(std::span<const std::uint8_t> encoded, const std::string& what,
                                std::vector<std::string>& notes) {
    constexpr std::uint64_t kMostOfOne = std::uint64_t(1) << 26;  // 8192 x 8192: 256 MiB
    constexpr std::uint64_t kLeastOfOne = 64 * 64;                // chosen: still a texture
    const std::uint64_t most = std::max(std::min(kMostOfOne, left_ / 2), kLeastOfOne);
    if (effort_ == 0)
        throw Error(ErrorKind::BadInput,
                    fmt::format("{}: is left out, as the pictures before it are huge and take few bytes; "
                                "smaller ones would be right",
                                what));
    ByteImage image;
    const DecodeResult result = decodePicture(encoded, {4, most}, image);
    if (!result.failure.empty())
        throw Error(ErrorKind::BadInput, fmt::format("{}: {}", what, result.failure));
    const std::uint64_t fair = kFair * encoded.size();
    effort_ -= std::min(effort_, result.unpacked - std::min(result.unpacked, fair));
    left_ -= std::min(left_, std::uint64_t(image.width) * std::uint64_t(image.height));
    if (image.width != result.width || image.height != result.height)
        notes.push_back(
            fmt::format("{}: has {}x{} pixels, read as {}x{}; the textures of a scene have {} "
                        "million together at most",
                        what, result.width, result.height, image.width, image.height, whole_ / 1'000'000));
    return image;
}

}  // namespace conelight::io
