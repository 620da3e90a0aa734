// SPDX-License-Identifier: MIT
// How many texels the pictures of a scene may have together: those that ask for more are made smaller while
// they are decoded, and that is said. Private to this room.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/image_file.h"

namespace conelight::io {

class TextureBudget {
  public:
    explicit TextureBudget(std::uint64_t texels) : whole_(texels), left_(texels), effort_(5 * texels) {}

    // As decodeRgba; a picture takes at most half of what is left, so that the next one has some too. One that
    // comes when the time for pictures is spent is an Error of kind BadInput.
    ByteImage decode(std::span<const std::uint8_t> encoded, const std::string& what,
                     std::vector<std::string>& notes);

  private:
    std::uint64_t whole_, left_;
    // Bytes of pixels that may still be unpacked: a few bytes of a file may hold a huge picture, and making it
    // smaller takes the time of all its pixels. Bytes that a file pays for (kFair) are free, so that scenes of
    // hundreds of pictures are read whole. Chosen by the time of PNG: grey takes 1.1 s of a core per 2^28 bytes,
    // four channels of 16 bits 0.6 s.
    static constexpr std::uint64_t kFair = 64;  // unpacked bytes of one in a file; photographs take 5 to 50
    std::uint64_t effort_;
};

}  // namespace conelight::io
