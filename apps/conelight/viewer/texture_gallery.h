// SPDX-License-Identifier: MIT
// A material's textures as thumbnails, and one of them large in a window of its own.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>

#include "platform/picture_texture.h"
#include "session/session.h"
#include "session/texture_preview.h"

namespace conelight::program {

class TextureGallery {
  public:
    // Into the current ImGui window; a click on one opens it.
    void showThumbnails(const Session& session, const Material& material);
    // The window with the one that is open.
    void showOpen(const Session& session);

  private:
    struct Large {
        std::size_t texture = 0;
        TextureChannel channel = TextureChannel::Color;
        bool drawn = false;
    };
    void follow(const Session& session);
    const platform::PictureTexture& thumbnail(const Session& session, std::size_t index);

    std::vector<std::uint64_t> revisions_;  // of the textures that are known
    std::uint64_t scene_ = 0;
    std::map<std::size_t, std::unique_ptr<platform::PictureTexture>> thumbnails_;
    std::optional<Large> open_;
    platform::PictureTexture large_;
};

}  // namespace conelight::program
