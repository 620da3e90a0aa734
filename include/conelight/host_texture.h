// SPDX-License-Identifier: MIT
// A texture that the host has on the GPU, by its GL name: its texels need no way over the CPU.
// docs/guide/light_field.md
#pragma once

#include <cstdint>
#include <string>

#include "conelight/scene.h"

namespace conelight {

// A GL_TEXTURE_2D whose format gives floats or normalized numbers, compressed ones too. It counts as samplers read it:
// base level, swizzle, sRGB decoding. So colours lie in an sRGB format, or are linear; what is beyond [0, 1] is cut.
// Texels of the base level are read during the call, after what the host's commands have written: a copy of 256 x 256
// is what light sees. Pictures and shadow maps read the texture itself, and its mipmaps where it has all of them. So it
// stays alive until another takes its place or the scene is gone. After its texels have changed, set it again. As a normal
// map it keeps the roughness of its material: how far normals spread within a pixel is told of a Texture alone.
struct HostTexture {
    std::string name;
    std::uint32_t texture = 0;  // GL name
    TextureWrap wrapU = TextureWrap::Repeat;
    TextureWrap wrapV = TextureWrap::Repeat;
    TextureFilter filter = TextureFilter::Linear;
};

}  // namespace conelight
