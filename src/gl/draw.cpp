// SPDX-License-Identifier: MIT
#include "gl/draw.h"

#include "base/assert.h"
#include "base/log.h"
#include "gl/gl.h"

namespace conelight::gl {

VertexArray::VertexArray(const Buffer& vertices, int stride, const std::vector<Attribute>& attributes,
                         const Buffer& indices, const std::string& label) {
    Name array = 0;
    glCreateVertexArrays(1, &array);
    adopt(array, label, 0);
    glVertexArrayVertexBuffer(array, 0, vertices.name(), 0, stride);
    glVertexArrayElementBuffer(array, indices.name());
    for (const Attribute& a : attributes) {
        glEnableVertexArrayAttrib(array, a.location);
        if (a.integer)
            glVertexArrayAttribIFormat(array, a.location, a.components, a.type, a.offset);
        else
            glVertexArrayAttribFormat(array, a.location, a.components, a.type, GL_FALSE, a.offset);
        glVertexArrayAttribBinding(array, a.location, 0);
    }
}

VertexArray::VertexArray(const std::string& label) {
    Name array = 0;
    glCreateVertexArrays(1, &array);
    adopt(array, label, 0);
}

void VertexArray::addPerDrawUint(unsigned location, const Buffer& values) {
    // One element per 2^20 instances: no draw has as many, so base instance alone selects the element.
    constexpr GLuint kBinding = 1;
    glVertexArrayVertexBuffer(name(), kBinding, values.name(), 0, sizeof(std::uint32_t));
    glEnableVertexArrayAttrib(name(), location);
    glVertexArrayAttribIFormat(name(), location, 1, GL_UNSIGNED_INT, 0);
    glVertexArrayAttribBinding(name(), location, kBinding);
    glVertexArrayBindingDivisor(name(), kBinding, 1u << 20);
}

void VertexArray::bind() const { glBindVertexArray(name()); }

namespace {

// Level 0 of a texture: all layers, or the first one.
void attach(Name framebuffer, GLenum attachment, const Texture& texture, bool layered) {
    const std::uint32_t target = texture.desc().target;
    if (layered || target == GL_TEXTURE_2D)
        glNamedFramebufferTexture(framebuffer, attachment, texture.name(), 0);
    else
        glNamedFramebufferTextureLayer(framebuffer, attachment, texture.name(), 0, 0);
}

const char* statusText(GLenum status) {
    switch (status) {
        case GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT:
            return "an attachment cannot be drawn to";
        case GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT:
            return "it has neither attachments nor a size";
        case GL_FRAMEBUFFER_INCOMPLETE_LAYER_TARGETS:
            return "some attachments are layered and some are not";
        case GL_FRAMEBUFFER_INCOMPLETE_MULTISAMPLE:
            return "attachments differ in samples";
        case GL_FRAMEBUFFER_UNSUPPORTED:
            return "the driver does not support these formats together";
        default:
            return "the driver does not say why";
    }
}

}  // namespace

Framebuffer::Framebuffer(const std::vector<const Texture*>& colors, const Texture* depth,
                         const std::string& label, bool layered) {
    const Texture* any = !colors.empty() ? colors.front() : depth;
    CONELIGHT_ASSERT(any != nullptr, "a framebuffer needs an attachment or a size");
    for (const Texture* color : colors)
        CONELIGHT_ASSERT(color->width() == any->width() && color->height() == any->height(),
                         "attachments have one size");
    CONELIGHT_ASSERT(depth == nullptr || (depth->width() == any->width() && depth->height() == any->height()),
                     "attachments have one size");
    Name framebuffer = 0;
    glCreateFramebuffers(1, &framebuffer);
    adopt(framebuffer, label, 0);
    std::vector<GLenum> buffers;
    for (std::size_t i = 0; i < colors.size(); ++i) {
        buffers.push_back(static_cast<GLenum>(GL_COLOR_ATTACHMENT0 + i));
        attach(framebuffer, buffers.back(), *colors[i], layered);
    }
    if (buffers.empty()) {
        glNamedFramebufferDrawBuffer(framebuffer, GL_NONE);
        glNamedFramebufferReadBuffer(framebuffer, GL_NONE);
    } else {
        glNamedFramebufferDrawBuffers(framebuffer, static_cast<GLsizei>(buffers.size()), buffers.data());
    }
    if (depth != nullptr) attach(framebuffer, GL_DEPTH_ATTACHMENT, *depth, layered);
    width_ = any->width();
    height_ = any->height();
    check(label);
}

Framebuffer::Framebuffer(int width, int height, const std::string& label) : width_(width), height_(height) {
    Name framebuffer = 0;
    glCreateFramebuffers(1, &framebuffer);
    adopt(framebuffer, label, 0);
    glNamedFramebufferParameteri(framebuffer, GL_FRAMEBUFFER_DEFAULT_WIDTH, width);
    glNamedFramebufferParameteri(framebuffer, GL_FRAMEBUFFER_DEFAULT_HEIGHT, height);
    check(label);
}

Framebuffer Framebuffer::depthLayer(const Texture& depth, int layer, const std::string& label,
                                    const Texture* color) {
    Framebuffer result;
    Name framebuffer = 0;
    glCreateFramebuffers(1, &framebuffer);
    result.adopt(framebuffer, label, 0);
    const GLenum buffer = color != nullptr ? GL_COLOR_ATTACHMENT0 : GL_NONE;
    glNamedFramebufferDrawBuffer(framebuffer, buffer);
    glNamedFramebufferReadBuffer(framebuffer, buffer);
    if (color != nullptr)
        glNamedFramebufferTextureLayer(framebuffer, GL_COLOR_ATTACHMENT0, color->name(), 0, layer);
    glNamedFramebufferTextureLayer(framebuffer, GL_DEPTH_ATTACHMENT, depth.name(), 0, layer);
    result.width_ = depth.width();
    result.height_ = depth.height();
    result.check(label);
    return result;
}

void Framebuffer::check(const std::string& label) const {
    const GLenum status = glCheckNamedFramebufferStatus(name(), GL_DRAW_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE)
        base::fail(ErrorKind::Runtime, "OpenGL: framebuffer '%s' of %d x %d is not complete: %s (0x%x)",
                   label.c_str(), width_, height_, statusText(status), status);
}

void Framebuffer::clearColor(int attachment, float r, float g, float b, float a) const {
    const float value[4] = {r, g, b, a};
    glClearNamedFramebufferfv(name(), GL_COLOR, attachment, value);
}
void Framebuffer::clearColorUint(int attachment, std::uint32_t r) const {
    const GLuint value[4] = {r, 0, 0, 0};
    glClearNamedFramebufferuiv(name(), GL_COLOR, attachment, value);
}
void Framebuffer::clearDepth(float depth) const { glClearNamedFramebufferfv(name(), GL_DEPTH, 0, &depth); }

namespace {
void setCapability(GLenum capability, bool on) { on ? glEnable(capability) : glDisable(capability); }
}  // namespace

void setCull(Cull cull) {
    setCapability(GL_CULL_FACE, cull != Cull::None);
    if (cull != Cull::None) glCullFace(cull == Cull::Back ? GL_BACK : GL_FRONT);
}

void setFrontFace(bool counterClockwise) { glFrontFace(counterClockwise ? GL_CCW : GL_CW); }

void drawIndexed(const IndexedDraw& draw) {
    const std::uintptr_t offset = static_cast<std::uintptr_t>(draw.firstIndex) * sizeof(std::uint32_t);
    glDrawElementsInstancedBaseVertexBaseInstance(GL_TRIANGLES, static_cast<GLsizei>(draw.count),
                                                  GL_UNSIGNED_INT, reinterpret_cast<const void*>(offset),
                                                  draw.instances, static_cast<GLint>(draw.firstVertex),
                                                  draw.baseInstance);
}

namespace {

// As GL reads it from the buffer.
struct DrawCommand {
    GLuint count, instances, firstIndex;
    GLint firstVertex;
    GLuint baseInstance;
};

}  // namespace

void DrawList::fill(std::span<const IndexedDraw> draws) {
    std::vector<DrawCommand> commands;
    commands.reserve(draws.size());
    for (const IndexedDraw& draw : draws)
        commands.push_back({draw.count, static_cast<GLuint>(draw.instances), draw.firstIndex,
                            static_cast<GLint>(draw.firstVertex), draw.baseInstance});
    const std::size_t bytes = commands.size() * sizeof(DrawCommand);
    if (!buffer_ || buffer_.bytes() < bytes) {
        buffer_ = {};
        buffer_ = Buffer(bytes + bytes / 4, "draw commands");
    }
    buffer_.update(0, commands.data(), bytes);
}

void DrawList::draw(std::size_t first, std::size_t count) const {
    CONELIGHT_ASSERT((first + count) * sizeof(DrawCommand) <= buffer_.bytes(),
                     "DrawList::draw: more than was filled");
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, buffer_.name());
    glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT,
                                reinterpret_cast<const void*>(first * sizeof(DrawCommand)),
                                static_cast<GLsizei>(count), sizeof(DrawCommand));
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
}

void drawTriangle(const VertexArray& empty) {
    empty.bind();
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void apply(const RasterState& state) {
    CONELIGHT_ASSERT(state.framebuffer != nullptr, "a raster pass needs a framebuffer");
    glBindFramebuffer(GL_FRAMEBUFFER, state.framebuffer->name());
    const int* v = state.viewport;
    const bool part = v[2] != 0;
    if (part) {
        glViewport(v[0], v[1], v[2], v[3]);
        glScissor(v[0], v[1], v[2], v[3]);
    } else {
        glViewport(0, 0, state.framebuffer->width(), state.framebuffer->height());
    }
    setCapability(GL_SCISSOR_TEST, part);
    setCapability(GL_DEPTH_TEST, state.depthTest);
    glClipControl(GL_LOWER_LEFT, state.reversedDepth ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
    glDepthFunc(state.reversedDepth ? GL_GEQUAL : GL_LEQUAL);
    glDepthMask(state.depthWrite ? GL_TRUE : GL_FALSE);
    glDepthRange(0.0, state.farthest);
    setCull(state.cull);
    glFrontFace(GL_CCW);
    const GLboolean color = state.colorWrite ? GL_TRUE : GL_FALSE;
    glColorMask(color, color, color, color);
    setCapability(GL_BLEND, state.blend);
    if (state.blend) glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    setCapability(GL_DEPTH_CLAMP, state.depthClamp);
    const bool bias = state.depthBiasSlope != 0.0f || state.depthBiasUnits != 0.0f;
    setCapability(GL_POLYGON_OFFSET_FILL, bias);
    if (bias) glPolygonOffset(state.depthBiasSlope, state.depthBiasUnits);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    setCapability(GL_STENCIL_TEST, false);
    setCapability(GL_FRAMEBUFFER_SRGB, false);
    setCapability(GL_MULTISAMPLE, true);
    setCapability(GL_DITHER, false);
    setCapability(GL_SAMPLE_ALPHA_TO_COVERAGE, false);
    setCapability(GL_RASTERIZER_DISCARD, false);
    setCapability(GL_PRIMITIVE_RESTART, false);
}

}  // namespace conelight::gl
