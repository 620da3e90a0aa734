// SPDX-License-Identifier: MIT
// Picture A beside the live picture B: one that was kept, or a picture file with its layers, and how it is shown in the
// live one's place: as a whole, or enlarged, with the numbers of its pixels.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "conelight/renderer.h"
#include "picture_input.h"
#include "platform/picture_texture.h"

namespace conelight::program {

class KeptPicture {
  public:
    // `label`: what it is.
    void keep(const Image& picture, const std::string& label);
    // A picture file. `layer` empty: the picture itself. Throws Error(BadInput): what there was stays.
    void open(const std::string& file, const std::string& layer);
    void chooseLayer(std::size_t layer);

    bool shown = false;  // in place of the live one
    bool any() const { return !layers_.empty(); }
    bool shows() const { return shown && any(); }
    const Image& linear() const { return layers_[layer_].image; }
    std::uint64_t version() const { return version_; }  // grows with every other picture
    std::uint32_t texture(const ImageSettings& look);
    std::string label() const;
    std::string text() const;  // and size, layers, enlargement

    // Over `size` at `at`, window units: wheel and drag enlarge and move it, when `hovered`.
    void show(const ImageSettings& look, const glm::vec2& at, const glm::vec2& size, bool hovered);
    void showWhole();

  private:
    struct Frame {
        glm::vec2 low{0};  // of the picture's first pixel, window units
        float pixel = 1;   // its edge
    };
    Frame frameIn(const glm::vec2& at, const glm::vec2& size) const;
    void takeMouse(const glm::vec2& at, const glm::vec2& size);
    void showNumbers(const Frame& frame, const glm::vec2& at, const glm::vec2& size) const;
    void showPixel(const Frame& frame, const glm::vec2& at, const glm::vec2& size) const;
    void showLayers(const glm::vec2& at, const glm::vec2& size);
    glm::vec4 at(const glm::ivec2& pixel) const;

    std::vector<PictureLayer> layers_;
    std::size_t layer_ = 0;
    std::string label_;
    std::uint64_t version_ = 0;
    platform::PictureTexture texture_;
    std::uint64_t textureVersion_ = 0;
    ImageSettings look_;
    float zoom_ = 1;          // 1: as a whole
    glm::vec2 middle_{0.5f};  // what is in the middle, in parts of the picture
};

}  // namespace conelight::program
