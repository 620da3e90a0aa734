// SPDX-License-Identifier: MIT
// Textures of a scene as small pictures, for editors.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "conelight/scene.h"

namespace conelight::program {

// What of a texture is shown.
enum class TextureChannel { Color, Red, Green, Blue, Opacity };

// The texture's size, or less: at most `most` pixels an edge, its proportions kept.
glm::ivec2 previewSize(const Texture& texture, int most);
// RGB bytes of that size as the file has them, means of the texels of a pixel; one channel as grey.
std::vector<std::uint8_t> previewOf(const Texture& texture, const glm::ivec2& size, TextureChannel channel);

// What a material has textures for, and the texture of each, -1: none.
struct TextureUse {
    const char* name;
    int texture = -1;
};
std::vector<TextureUse> texturesOf(const Material& material);
// "bricks, 512 x 256, sRGB, repeated"
std::string describe(const Texture& texture);

}  // namespace conelight::program
