// SPDX-License-Identifier: MIT
#include "gl/copy.h"

#include "base/log.h"
#include "gl/gl.h"

namespace conelight::gl {
namespace {

// A framebuffer for one texture, gone at its end.
struct Attached {
    GLuint name = 0;
    explicit Attached(Name texture) {
        glCreateFramebuffers(1, &name);
        glNamedFramebufferTexture(name, GL_COLOR_ATTACHMENT0, texture, 0);
    }
    ~Attached() { glDeleteFramebuffers(1, &name); }
    Attached(const Attached&) = delete;
    Attached& operator=(const Attached&) = delete;
};

bool holdsIntegers(Name framebuffer) {
    if (framebuffer == 0) return false;
    GLint attachments = 0;
    glGetIntegerv(GL_MAX_COLOR_ATTACHMENTS, &attachments);
    for (GLint i = 0; i < attachments; ++i) {
        const GLenum attachment = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i);
        GLint kind = GL_NONE, type = GL_NONE;
        glGetNamedFramebufferAttachmentParameteriv(framebuffer, attachment,
                                                   GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, &kind);
        if (kind == GL_NONE) continue;
        glGetNamedFramebufferAttachmentParameteriv(framebuffer, attachment,
                                                   GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE, &type);
        if (type == GL_INT || type == GL_UNSIGNED_INT) return true;
    }
    return false;
}

void blit(const Texture& picture, Name target, const glm::ivec2& corner, Rows rows, const char* call) {
    if (glCheckNamedFramebufferStatus(target, GL_DRAW_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        base::fail(ErrorKind::Usage,
                   "%s: the target is not complete; one that can be drawn to would be right", call);
    if (holdsIntegers(target))
        base::fail(ErrorKind::Usage, "%s: the target holds integers; colours would be right", call);
    const Attached source(picture.name());
    const int width = picture.width(), height = picture.height();
    const int low = corner.y, high = corner.y + height;
    const bool turned = rows == Rows::Turned;
    glBlitNamedFramebuffer(source.name, target, 0, 0, width, height, corner.x, turned ? high : low,
                           corner.x + width, turned ? low : high, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

}  // namespace

void copyToFramebuffer(const Texture& picture, Name framebuffer, const glm::ivec2& corner) {
    if (framebuffer != 0 && glIsFramebuffer(framebuffer) == GL_FALSE)
        base::fail(ErrorKind::Usage, "copyToFramebuffer: %u is no framebuffer of this context", framebuffer);
    blit(picture, framebuffer, corner, Rows::AsTheyAre, "copyToFramebuffer");
}

void copyToTexture(const Texture& picture, Name texture, Rows rows) {
    if (glIsTexture(texture) == GL_FALSE)
        base::fail(ErrorKind::Usage, "copyToTexture: %u is no texture of this context", texture);
    GLint target = 0, width = 0, height = 0;
    glGetTextureParameteriv(texture, GL_TEXTURE_TARGET, &target);
    if (target == GL_TEXTURE_2D) {
        glGetTextureLevelParameteriv(texture, 0, GL_TEXTURE_WIDTH, &width);
        glGetTextureLevelParameteriv(texture, 0, GL_TEXTURE_HEIGHT, &height);
    }
    if (width != picture.width() || height != picture.height())
        base::fail(ErrorKind::Usage,
                   "copyToTexture: not a GL_TEXTURE_2D of %d x %d; such a one would be right",
                   picture.width(), picture.height());
    const Attached attached(texture);
    blit(picture, attached.name, {0, 0}, rows, "copyToTexture");
}

}  // namespace conelight::gl
