// SPDX-License-Identifier: MIT
// Pictures into what the host draws to. Colours go unchanged, in the target's own format; obeys no state but what
// HostStateGuard sets. Throw Error(Usage) for a target that is none, is not complete, or holds integers.
#pragma once

#include <glm/glm.hpp>

#include "gl/texture.h"

namespace conelight::gl {

// All colour buffers of a framebuffer of the context (0: the default one), lower left corner at `corner`. What lies
// outside of it is left out.
void copyToFramebuffer(const Texture& picture, Name framebuffer, const glm::ivec2& corner);
// Level 0 of a GL_TEXTURE_2D of the picture's size; turned: the last row first.
enum class Rows { AsTheyAre, Turned };
void copyToTexture(const Texture& picture, Name texture, Rows rows = Rows::AsTheyAre);

}  // namespace conelight::gl
