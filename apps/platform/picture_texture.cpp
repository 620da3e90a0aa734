// SPDX-License-Identifier: MIT
#include "platform/picture_texture.h"

#include <epoxy/gl.h>

namespace conelight::platform {

PictureTexture::~PictureTexture() {
    if (name_ != 0) glDeleteTextures(1, &name_);
}

void PictureTexture::update(int width, int height, const std::vector<std::uint8_t>& bytes) {
    if (name_ == 0 || width != width_ || height != height_) {
        if (name_ != 0) glDeleteTextures(1, &name_);
        glCreateTextures(GL_TEXTURE_2D, 1, &name_);
        glTextureStorage2D(name_, 1, GL_RGBA8, width, height);
        glTextureParameteri(name_, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        glTextureParameteri(name_, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        glTextureParameteri(name_, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        glTextureParameteri(name_, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
        width_ = width;
        height_ = height;
    }
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    glTextureSubImage2D(name_, 0, 0, 0, width, height, bytes.size() == 4 * pixels ? GL_RGBA : GL_RGB,
                        GL_UNSIGNED_BYTE, bytes.data());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

}  // namespace conelight::platform
