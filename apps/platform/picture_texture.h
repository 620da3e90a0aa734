// SPDX-License-Identifier: MIT
// Pictures made on the CPU as textures of the window's context, for the GUI to show.
#pragma once

#include <cstdint>
#include <vector>

namespace conelight::platform {

class PictureTexture {
  public:
    PictureTexture() = default;
    ~PictureTexture();
    PictureTexture(const PictureTexture&) = delete;
    PictureTexture& operator=(const PictureTexture&) = delete;

    // RGB or RGBA bytes, as their number says, first row on top.
    void update(int width, int height, const std::vector<std::uint8_t>& bytes);
    std::uint32_t name() const { return name_; }  // 0: empty
    int width() const { return width_; }
    int height() const { return height_; }

  private:
    std::uint32_t name_ = 0;
    int width_ = 0, height_ = 0;
};

}  // namespace conelight::platform
