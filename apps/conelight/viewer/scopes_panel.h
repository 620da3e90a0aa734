// SPDX-License-Identifier: MIT
// Histograms and waveform over the lower right corner of the picture, and the key to false colours.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <string>

#include "platform/picture_texture.h"
#include "viewer/scopes.h"

namespace conelight::program {

class ScopesPanel {
  public:
    bool open = false;
    // A picture: its number, which another one has not, and how to get it.
    struct Source {
        std::string name;
        std::uint64_t version = 0;
        std::function<const Image&()> read;
    };
    // Over a picture at that place, window units. Draws into ImGui's current window.
    void show(const Source& source, const ImageSettings& look, const glm::vec2& at, const glm::vec2& size);
    // Of the picture, whether open or not.
    const Scopes& follow(const Source& source, const ImageSettings& look);

  private:
    float showLuminance(const glm::vec2& at, float width) const;
    float showChannels(const glm::vec2& at, float width) const;

    Scopes scopes_;
    std::string name_;
    std::uint64_t version_ = 0;
    ImageSettings look_;
    bool drawn_ = false;  // the texture is of scopes_
    platform::PictureTexture waveform_;
};

// A box per stop with its number, along the lower edge of the picture.
void showFalseColorKey(const glm::vec2& at, const glm::vec2& size);

}  // namespace conelight::program
