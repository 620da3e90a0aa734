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
    explicit TextureBudget(std::uint64_t texels) : whole_(texels), left_(texels), decoded_(6 * texels) {}

    // As decodeRgba; a picture takes at most half of what is left, so that the next one has some too.
    ByteImage decode(std::span<const std::uint8_t> encoded, const std::string& what,
                     std::vector<std::string>& notes);

  private:
    std::uint64_t whole_, left_;
    // Pixels in files that are still decoded: small textures of huge pictures cost time too. Six times the texels
    // are ninety-six pictures of 4096 x 4096. As PNG they take 5 s of a core in grey and 12 s in RGB.
    std::uint64_t decoded_;
};

}  // namespace conelight::io
