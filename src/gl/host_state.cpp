// SPDX-License-Identifier: MIT
// Three lists over one table of state: read it, set what we assume, write it back. Indexed state is saved
// per index, because the plain calls of our passes (glViewport, glBlendFunc ...) set all indices at once.
#include "gl/host_state.h"

#include <array>

#include "base/log.h"
#include "gl/debug.h"
#include "gl/gl.h"

namespace conelight::gl {
namespace {

constexpr GLuint kTextureUnits = 32;  // programs read fewer, here and below
constexpr GLuint kImageUnits = 8;     // GL minimum
constexpr GLuint kUniformBindings = 8;
constexpr GLuint kStorageBindings = 16;  // GL minimum is 8, so the driver is asked
constexpr GLuint kViewports = 16;        // GL minimum of GL_MAX_VIEWPORTS
constexpr GLuint kTargets = 8;           // GL minimum of GL_MAX_DRAW_BUFFERS

struct TextureTarget {
    GLenum target, binding;
};
constexpr TextureTarget kTextureTargets[] = {
    {GL_TEXTURE_2D, GL_TEXTURE_BINDING_2D},
    {GL_TEXTURE_2D_ARRAY, GL_TEXTURE_BINDING_2D_ARRAY},
    {GL_TEXTURE_3D, GL_TEXTURE_BINDING_3D},
    {GL_TEXTURE_CUBE_MAP, GL_TEXTURE_BINDING_CUBE_MAP},
    {GL_TEXTURE_CUBE_MAP_ARRAY, GL_TEXTURE_BINDING_CUBE_MAP_ARRAY},
    {GL_TEXTURE_BUFFER, GL_TEXTURE_BINDING_BUFFER},
};

struct Switch {
    GLenum name;
    bool assumed;
};
constexpr Switch kSwitches[] = {
    {GL_COLOR_LOGIC_OP, false},
    {GL_CULL_FACE, false},
    {GL_DEPTH_CLAMP, false},
    {GL_DEPTH_TEST, false},
    {GL_DITHER, false},
    {GL_FRAMEBUFFER_SRGB, false},
    {GL_LINE_SMOOTH, false},
    {GL_MULTISAMPLE, true},
    {GL_POLYGON_OFFSET_FILL, false},
    {GL_POLYGON_OFFSET_LINE, false},
    {GL_POLYGON_OFFSET_POINT, false},
    {GL_POLYGON_SMOOTH, false},
    {GL_PRIMITIVE_RESTART, false},
    {GL_PRIMITIVE_RESTART_FIXED_INDEX, false},
    {GL_PROGRAM_POINT_SIZE, false},
    {GL_RASTERIZER_DISCARD, false},
    {GL_SAMPLE_ALPHA_TO_COVERAGE, false},
    {GL_SAMPLE_ALPHA_TO_ONE, false},
    {GL_SAMPLE_COVERAGE, false},
    {GL_SAMPLE_MASK, false},
    {GL_SAMPLE_SHADING, false},
    {GL_STENCIL_TEST, false},
    {GL_TEXTURE_CUBE_MAP_SEAMLESS, true},
    {GL_CLIP_DISTANCE0, false},
    {GL_CLIP_DISTANCE1, false},
    {GL_CLIP_DISTANCE2, false},
    {GL_CLIP_DISTANCE3, false},
    {GL_CLIP_DISTANCE4, false},
    {GL_CLIP_DISTANCE5, false},
    {GL_CLIP_DISTANCE6, false},
    {GL_CLIP_DISTANCE7, false},
};

struct PixelStore {
    GLenum name;
    GLint assumed;
};
constexpr PixelStore kPixelStore[] = {
    {GL_PACK_ALIGNMENT, 4},    {GL_PACK_ROW_LENGTH, 0},     {GL_PACK_IMAGE_HEIGHT, 0},
    {GL_PACK_SKIP_PIXELS, 0},  {GL_PACK_SKIP_ROWS, 0},      {GL_PACK_SKIP_IMAGES, 0},
    {GL_PACK_SWAP_BYTES, 0},   {GL_PACK_LSB_FIRST, 0},      {GL_UNPACK_ALIGNMENT, 4},
    {GL_UNPACK_ROW_LENGTH, 0}, {GL_UNPACK_IMAGE_HEIGHT, 0}, {GL_UNPACK_SKIP_PIXELS, 0},
    {GL_UNPACK_SKIP_ROWS, 0},  {GL_UNPACK_SKIP_IMAGES, 0},  {GL_UNPACK_SWAP_BYTES, 0},
    {GL_UNPACK_LSB_FIRST, 0},
};

struct PlainBuffer {
    GLenum target, binding;
};
constexpr PlainBuffer kPlainBuffers[] = {
    {GL_PIXEL_PACK_BUFFER, GL_PIXEL_PACK_BUFFER_BINDING},
    {GL_PIXEL_UNPACK_BUFFER, GL_PIXEL_UNPACK_BUFFER_BINDING},
    {GL_DRAW_INDIRECT_BUFFER, GL_DRAW_INDIRECT_BUFFER_BINDING},
    {GL_DISPATCH_INDIRECT_BUFFER, GL_DISPATCH_INDIRECT_BUFFER_BINDING},
};

GLint integer(GLenum name) {
    GLint value[4] = {};  // some names return more than one
    glGetIntegerv(name, value);
    return value[0];
}
GLint integer(GLenum name, GLuint index) {
    GLint value[4] = {};
    glGetIntegeri_v(name, index, value);
    return value[0];
}
GLuint object(GLenum binding) { return static_cast<GLuint>(integer(binding)); }
GLuint object(GLenum binding, GLuint index) { return static_cast<GLuint>(integer(binding, index)); }
GLenum enumeration(GLenum name) { return static_cast<GLenum>(integer(name)); }
GLenum enumeration(GLenum name, GLuint index) { return static_cast<GLenum>(integer(name, index)); }
GLfloat number(GLenum name) {
    GLfloat value[4] = {};
    glGetFloatv(name, value);
    return value[0];
}
GLboolean flag(GLenum name) {
    GLboolean value = GL_FALSE;
    glGetBooleanv(name, &value);
    return value;
}

void enable(GLenum name, bool on) { on ? glEnable(name) : glDisable(name); }
void enable(GLenum name, GLuint index, bool on) { on ? glEnablei(name, index) : glDisablei(name, index); }

struct BufferRange {
    GLuint name;
    GLint64 start, size;  // size 0: the whole buffer
};

BufferRange bufferRange(GLenum binding, GLenum start, GLenum size, GLuint index) {
    BufferRange range{object(binding, index), 0, 0};
    if (range.name == 0) return range;
    glGetInteger64i_v(start, index, &range.start);
    glGetInteger64i_v(size, index, &range.size);
    return range;
}

void bindRange(GLenum target, GLuint index, const BufferRange& range) {
    if (range.name == 0 || range.size == 0)
        glBindBufferBase(target, index, range.name);
    else
        glBindBufferRange(target, index, range.name, static_cast<GLintptr>(range.start),
                          static_cast<GLsizeiptr>(range.size));
}

struct ImageUnit {
    GLuint name;
    GLint level, layer;
    GLboolean layered;
    GLenum access, format;
};

struct Viewport {
    GLfloat box[4];
    GLdouble depth[2];
    GLint scissor[4];
    bool scissorTest;
};

struct Target {
    bool blend;
    GLenum sourceRgb, targetRgb, sourceAlpha, targetAlpha, equationRgb, equationAlpha;
    GLboolean mask[4];
};

}  // namespace

struct HostStateGuard::State {
    GLuint program, vertexArray, drawFramebuffer, readFramebuffer;
    GLenum activeTexture;
    std::array<std::array<GLuint, std::size(kTextureTargets)>, kTextureUnits> textures;
    std::array<GLuint, kTextureUnits> samplers;
    std::array<ImageUnit, kImageUnits> images;
    GLuint storageCount;
    std::array<BufferRange, kUniformBindings> uniforms;
    std::array<BufferRange, kStorageBindings> storages;
    GLuint uniformPoint, storagePoint;
    std::array<GLuint, std::size(kPlainBuffers)> plainBuffers;
    std::array<Viewport, kViewports> viewports;
    std::array<Target, kTargets> targets;
    std::array<GLfloat, 4> blendColor;
    GLboolean depthMask;
    GLenum depthFunction, cullFace, frontFace, polygonMode, provokingVertex, clipOrigin, clipDepth;
    GLfloat offsetFactor, offsetUnits, lineWidth;
    GLuint restartIndex;
    std::array<bool, std::size(kSwitches)> switches;
    std::array<GLint, std::size(kPixelStore)> pixelStore;

    void save();
    void restore() const;
    static void setAssumed();

  private:
    void saveBindings();
    void saveIndexed();
    void restoreBindings() const;
    void restoreIndexed() const;
};

void HostStateGuard::State::saveBindings() {
    program = object(GL_CURRENT_PROGRAM);
    vertexArray = object(GL_VERTEX_ARRAY_BINDING);
    drawFramebuffer = object(GL_DRAW_FRAMEBUFFER_BINDING);
    readFramebuffer = object(GL_READ_FRAMEBUFFER_BINDING);
    activeTexture = enumeration(GL_ACTIVE_TEXTURE);
    for (GLuint unit = 0; unit < kTextureUnits; ++unit) {
        for (std::size_t i = 0; i < std::size(kTextureTargets); ++i)
            textures[unit][i] = object(kTextureTargets[i].binding, unit);
        samplers[unit] = object(GL_SAMPLER_BINDING, unit);
    }
    for (GLuint unit = 0; unit < kImageUnits; ++unit)
        images[unit] = {object(GL_IMAGE_BINDING_NAME, unit),
                        integer(GL_IMAGE_BINDING_LEVEL, unit),
                        integer(GL_IMAGE_BINDING_LAYER, unit),
                        static_cast<GLboolean>(integer(GL_IMAGE_BINDING_LAYERED, unit)),
                        enumeration(GL_IMAGE_BINDING_ACCESS, unit),
                        enumeration(GL_IMAGE_BINDING_FORMAT, unit)};
    for (GLuint i = 0; i < kUniformBindings; ++i)
        uniforms[i] =
            bufferRange(GL_UNIFORM_BUFFER_BINDING, GL_UNIFORM_BUFFER_START, GL_UNIFORM_BUFFER_SIZE, i);
    const GLuint driverCount = static_cast<GLuint>(integer(GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS));
    storageCount = driverCount < kStorageBindings ? driverCount : kStorageBindings;
    for (GLuint i = 0; i < storageCount; ++i)
        storages[i] = bufferRange(GL_SHADER_STORAGE_BUFFER_BINDING, GL_SHADER_STORAGE_BUFFER_START,
                                  GL_SHADER_STORAGE_BUFFER_SIZE, i);
    uniformPoint = object(GL_UNIFORM_BUFFER_BINDING);
    storagePoint = object(GL_SHADER_STORAGE_BUFFER_BINDING);
    for (std::size_t i = 0; i < std::size(kPlainBuffers); ++i)
        plainBuffers[i] = object(kPlainBuffers[i].binding);
}

void HostStateGuard::State::saveIndexed() {
    for (GLuint i = 0; i < kViewports; ++i) {
        glGetFloati_v(GL_VIEWPORT, i, viewports[i].box);
        glGetDoublei_v(GL_DEPTH_RANGE, i, viewports[i].depth);
        glGetIntegeri_v(GL_SCISSOR_BOX, i, viewports[i].scissor);
        viewports[i].scissorTest = glIsEnabledi(GL_SCISSOR_TEST, i) == GL_TRUE;
    }
    for (GLuint i = 0; i < kTargets; ++i) {
        Target& target = targets[i];
        target.blend = glIsEnabledi(GL_BLEND, i) == GL_TRUE;
        target.sourceRgb = enumeration(GL_BLEND_SRC_RGB, i);
        target.targetRgb = enumeration(GL_BLEND_DST_RGB, i);
        target.sourceAlpha = enumeration(GL_BLEND_SRC_ALPHA, i);
        target.targetAlpha = enumeration(GL_BLEND_DST_ALPHA, i);
        target.equationRgb = enumeration(GL_BLEND_EQUATION_RGB, i);
        target.equationAlpha = enumeration(GL_BLEND_EQUATION_ALPHA, i);
        glGetBooleani_v(GL_COLOR_WRITEMASK, i, target.mask);
    }
}

void HostStateGuard::State::save() {
    saveBindings();
    saveIndexed();
    glGetFloatv(GL_BLEND_COLOR, blendColor.data());
    depthMask = flag(GL_DEPTH_WRITEMASK);
    depthFunction = enumeration(GL_DEPTH_FUNC);
    cullFace = enumeration(GL_CULL_FACE_MODE);
    frontFace = enumeration(GL_FRONT_FACE);
    polygonMode = enumeration(GL_POLYGON_MODE);
    provokingVertex = enumeration(GL_PROVOKING_VERTEX);
    clipOrigin = enumeration(GL_CLIP_ORIGIN);
    clipDepth = enumeration(GL_CLIP_DEPTH_MODE);
    offsetFactor = number(GL_POLYGON_OFFSET_FACTOR);
    offsetUnits = number(GL_POLYGON_OFFSET_UNITS);
    lineWidth = number(GL_LINE_WIDTH);
    restartIndex = object(GL_PRIMITIVE_RESTART_INDEX);
    for (std::size_t i = 0; i < std::size(kSwitches); ++i)
        switches[i] = glIsEnabled(kSwitches[i].name) == GL_TRUE;
    for (std::size_t i = 0; i < std::size(kPixelStore); ++i) pixelStore[i] = integer(kPixelStore[i].name);
}

void HostStateGuard::State::setAssumed() {
    // What every raster pass sets for itself (RasterState) is set here too: clears stand before passes, and
    // they obey masks, scissors and the discard switch.
    for (const Switch& one : kSwitches) enable(one.name, one.assumed);
    enable(GL_SCISSOR_TEST, false);
    enable(GL_BLEND, false);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ZERO);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    glDepthRange(0.0, 1.0);
    glCullFace(GL_BACK);
    glFrontFace(GL_CCW);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glPolygonOffset(0.0f, 0.0f);
    glLineWidth(1.0f);
    glProvokingVertex(GL_LAST_VERTEX_CONVENTION);
    glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    for (const PixelStore& one : kPixelStore) glPixelStorei(one.name, one.assumed);
    for (const PlainBuffer& one : kPlainBuffers) glBindBuffer(one.target, 0);
}

void HostStateGuard::State::restoreBindings() const {
    // A program that the host deleted while it was current is gone for good once another took its place.
    glUseProgram(glIsProgram(program) == GL_TRUE ? program : 0);
    glBindVertexArray(vertexArray);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, drawFramebuffer);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, readFramebuffer);
    // Not glBindTextureUnit: with name 0 it would clear targets that are not ours.
    for (GLuint unit = 0; unit < kTextureUnits; ++unit) {
        glActiveTexture(GL_TEXTURE0 + unit);
        for (std::size_t i = 0; i < std::size(kTextureTargets); ++i)
            glBindTexture(kTextureTargets[i].target, textures[unit][i]);
        glBindSampler(unit, samplers[unit]);
    }
    glActiveTexture(activeTexture);
    for (GLuint unit = 0; unit < kImageUnits; ++unit) {
        const ImageUnit& image = images[unit];
        glBindImageTexture(unit, image.name, image.level, image.layered, image.layer, image.access,
                           image.format);
    }
    for (GLuint i = 0; i < kUniformBindings; ++i) bindRange(GL_UNIFORM_BUFFER, i, uniforms[i]);
    for (GLuint i = 0; i < storageCount; ++i) bindRange(GL_SHADER_STORAGE_BUFFER, i, storages[i]);
    glBindBuffer(GL_UNIFORM_BUFFER, uniformPoint);
    glBindBuffer(GL_SHADER_STORAGE_BUFFER, storagePoint);
    for (std::size_t i = 0; i < std::size(kPlainBuffers); ++i)
        glBindBuffer(kPlainBuffers[i].target, plainBuffers[i]);
}

void HostStateGuard::State::restoreIndexed() const {
    for (GLuint i = 0; i < kViewports; ++i) {
        glViewportIndexedfv(i, viewports[i].box);
        glDepthRangeIndexed(i, viewports[i].depth[0], viewports[i].depth[1]);
        glScissorIndexedv(i, viewports[i].scissor);
        enable(GL_SCISSOR_TEST, i, viewports[i].scissorTest);
    }
    for (GLuint i = 0; i < kTargets; ++i) {
        const Target& target = targets[i];
        enable(GL_BLEND, i, target.blend);
        glBlendFuncSeparatei(i, target.sourceRgb, target.targetRgb, target.sourceAlpha, target.targetAlpha);
        glBlendEquationSeparatei(i, target.equationRgb, target.equationAlpha);
        glColorMaski(i, target.mask[0], target.mask[1], target.mask[2], target.mask[3]);
    }
}

void HostStateGuard::State::restore() const {
    restoreBindings();
    restoreIndexed();
    glBlendColor(blendColor[0], blendColor[1], blendColor[2], blendColor[3]);
    glDepthMask(depthMask);
    glDepthFunc(depthFunction);
    glCullFace(cullFace);
    glFrontFace(frontFace);
    glPolygonMode(GL_FRONT_AND_BACK, polygonMode);
    glProvokingVertex(provokingVertex);
    glClipControl(clipOrigin, clipDepth);
    glPolygonOffset(offsetFactor, offsetUnits);
    glLineWidth(lineWidth);
    glPrimitiveRestartIndex(restartIndex);
    for (std::size_t i = 0; i < std::size(kSwitches); ++i) enable(kSwitches[i].name, switches[i]);
    for (std::size_t i = 0; i < std::size(kPixelStore); ++i)
        glPixelStorei(kPixelStore[i].name, pixelStore[i]);
}

HostStateGuard::HostStateGuard() : saved_(std::make_unique<State>()) {
    if (!hasCurrentContext())
        base::fail(ErrorKind::NoGl,
                   "OpenGL: no context is current on this thread; the renderer's would be right");
    saved_->save();
    State::setAssumed();
}

HostStateGuard::~HostStateGuard() { saved_->restore(); }

}  // namespace conelight::gl
