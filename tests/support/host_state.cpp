// SPDX-License-Identifier: MIT
#include "support/host_state.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace conelight::test {
namespace {

constexpr GLenum kSwitches[] = {GL_COLOR_LOGIC_OP,
                                GL_CULL_FACE,
                                GL_DEPTH_CLAMP,
                                GL_DEPTH_TEST,
                                GL_DITHER,
                                GL_FRAMEBUFFER_SRGB,
                                GL_LINE_SMOOTH,
                                GL_MULTISAMPLE,
                                GL_POLYGON_OFFSET_FILL,
                                GL_POLYGON_OFFSET_LINE,
                                GL_POLYGON_OFFSET_POINT,
                                GL_POLYGON_SMOOTH,
                                GL_PRIMITIVE_RESTART,
                                GL_PRIMITIVE_RESTART_FIXED_INDEX,
                                GL_PROGRAM_POINT_SIZE,
                                GL_RASTERIZER_DISCARD,
                                GL_SAMPLE_ALPHA_TO_COVERAGE,
                                GL_SAMPLE_ALPHA_TO_ONE,
                                GL_SAMPLE_COVERAGE,
                                GL_SAMPLE_MASK,
                                GL_SAMPLE_SHADING,
                                GL_STENCIL_TEST,
                                GL_TEXTURE_CUBE_MAP_SEAMLESS,
                                GL_CLIP_DISTANCE0,
                                GL_CLIP_DISTANCE7};

// Names of plain state with the number of values each returns.
constexpr std::pair<GLenum, int> kPlain[] = {{GL_CURRENT_PROGRAM, 1},
                                             {GL_VERTEX_ARRAY_BINDING, 1},
                                             {GL_DRAW_FRAMEBUFFER_BINDING, 1},
                                             {GL_READ_FRAMEBUFFER_BINDING, 1},
                                             {GL_ACTIVE_TEXTURE, 1},
                                             {GL_UNIFORM_BUFFER_BINDING, 1},
                                             {GL_SHADER_STORAGE_BUFFER_BINDING, 1},
                                             {GL_PIXEL_PACK_BUFFER_BINDING, 1},
                                             {GL_PIXEL_UNPACK_BUFFER_BINDING, 1},
                                             {GL_DRAW_INDIRECT_BUFFER_BINDING, 1},
                                             {GL_DISPATCH_INDIRECT_BUFFER_BINDING, 1},
                                             {GL_BLEND_COLOR, 4},
                                             {GL_DEPTH_WRITEMASK, 1},
                                             {GL_DEPTH_FUNC, 1},
                                             {GL_CULL_FACE_MODE, 1},
                                             {GL_FRONT_FACE, 1},
                                             {GL_POLYGON_MODE, 1},
                                             {GL_PROVOKING_VERTEX, 1},
                                             {GL_CLIP_ORIGIN, 1},
                                             {GL_CLIP_DEPTH_MODE, 1},
                                             {GL_POLYGON_OFFSET_FACTOR, 1},
                                             {GL_POLYGON_OFFSET_UNITS, 1},
                                             {GL_LINE_WIDTH, 1},
                                             {GL_PRIMITIVE_RESTART_INDEX, 1},
                                             {GL_PACK_ALIGNMENT, 1},
                                             {GL_PACK_ROW_LENGTH, 1},
                                             {GL_PACK_IMAGE_HEIGHT, 1},
                                             {GL_PACK_SKIP_PIXELS, 1},
                                             {GL_PACK_SKIP_ROWS, 1},
                                             {GL_PACK_SKIP_IMAGES, 1},
                                             {GL_PACK_SWAP_BYTES, 1},
                                             {GL_PACK_LSB_FIRST, 1},
                                             {GL_UNPACK_ALIGNMENT, 1},
                                             {GL_UNPACK_ROW_LENGTH, 1},
                                             {GL_UNPACK_IMAGE_HEIGHT, 1},
                                             {GL_UNPACK_SKIP_PIXELS, 1},
                                             {GL_UNPACK_SKIP_ROWS, 1},
                                             {GL_UNPACK_SKIP_IMAGES, 1},
                                             {GL_UNPACK_SWAP_BYTES, 1},
                                             {GL_UNPACK_LSB_FIRST, 1}};

struct Indexed {
    GLenum name;
    GLuint count;
    int values;
};
constexpr Indexed kIndexed[] = {{GL_TEXTURE_BINDING_2D, 32, 1},
                                {GL_TEXTURE_BINDING_2D_ARRAY, 32, 1},
                                {GL_TEXTURE_BINDING_3D, 32, 1},
                                {GL_TEXTURE_BINDING_CUBE_MAP, 32, 1},
                                {GL_TEXTURE_BINDING_CUBE_MAP_ARRAY, 32, 1},
                                {GL_TEXTURE_BINDING_BUFFER, 32, 1},
                                {GL_SAMPLER_BINDING, 32, 1},
                                {GL_IMAGE_BINDING_NAME, 8, 1},
                                {GL_IMAGE_BINDING_LEVEL, 8, 1},
                                {GL_IMAGE_BINDING_LAYERED, 8, 1},
                                {GL_IMAGE_BINDING_LAYER, 8, 1},
                                {GL_IMAGE_BINDING_ACCESS, 8, 1},
                                {GL_IMAGE_BINDING_FORMAT, 8, 1},
                                {GL_UNIFORM_BUFFER_BINDING, 8, 1},
                                {GL_UNIFORM_BUFFER_START, 8, 1},
                                {GL_UNIFORM_BUFFER_SIZE, 8, 1},
                                {GL_SHADER_STORAGE_BUFFER_BINDING, 16, 1},
                                {GL_SHADER_STORAGE_BUFFER_START, 16, 1},
                                {GL_SHADER_STORAGE_BUFFER_SIZE, 16, 1},
                                {GL_VIEWPORT, 16, 4},
                                {GL_DEPTH_RANGE, 16, 2},
                                {GL_SCISSOR_BOX, 16, 4},
                                {GL_SCISSOR_TEST, 16, 1},
                                {GL_BLEND, 8, 1},
                                {GL_BLEND_SRC_RGB, 8, 1},
                                {GL_BLEND_DST_RGB, 8, 1},
                                {GL_BLEND_SRC_ALPHA, 8, 1},
                                {GL_BLEND_DST_ALPHA, 8, 1},
                                {GL_BLEND_EQUATION_RGB, 8, 1},
                                {GL_BLEND_EQUATION_ALPHA, 8, 1},
                                {GL_COLOR_WRITEMASK, 8, 4}};

}  // namespace

Snapshot snapshot() {
    Snapshot state;
    char key[64];
    for (const GLenum name : kSwitches) {
        std::snprintf(key, sizeof key, "switch 0x%x", name);
        state[key] = {static_cast<double>(glIsEnabled(name))};
    }
    for (const auto& [name, values] : kPlain) {
        std::snprintf(key, sizeof key, "0x%x", name);
        double value[4] = {};
        glGetDoublev(name, value);
        state[key].assign(value, value + values);
    }
    for (const Indexed& one : kIndexed)
        for (GLuint i = 0; i < one.count; ++i) {
            std::snprintf(key, sizeof key, "0x%x[%u]", one.name, i);
            double value[4] = {};
            if (one.name == GL_BLEND || one.name == GL_SCISSOR_TEST)
                value[0] = glIsEnabledi(one.name, i);
            else if (one.name == GL_VIEWPORT || one.name == GL_DEPTH_RANGE)
                glGetDoublei_v(one.name, i, value);
            else {
                GLint integers[4] = {};
                glGetIntegeri_v(one.name, i, integers);
                std::copy(integers, integers + 4, value);
            }
            state[key].assign(value, value + one.values);
        }
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    return state;
}

HostState::HostState() {
    const GLenum targets[] = {GL_TEXTURE_2D, GL_TEXTURE_2D_ARRAY, GL_TEXTURE_3D, GL_TEXTURE_CUBE_MAP,
                              GL_TEXTURE_CUBE_MAP_ARRAY};
    glCreateBuffers(1, &buffer_);
    glNamedBufferStorage(buffer_, 65536, nullptr, GL_DYNAMIC_STORAGE_BIT);
    for (int i = 0; i < 5; ++i) {
        glCreateTextures(targets[i], 1, &textures_[i]);
        if (i == 0 || i == 3)
            glTextureStorage2D(textures_[i], 2, GL_RGBA8, 4, 4);
        else
            glTextureStorage3D(textures_[i], 2, GL_RGBA8, 4, 4, 6);
    }
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &textures_[5]);
    glTextureBuffer(textures_[5], GL_R32F, buffer_);
    glCreateSamplers(1, &sampler_);
    glCreateVertexArrays(1, &vertexArray_);
    glCreateFramebuffers(2, framebuffers_);
    const char* text =
        "#version 450 core\nout gl_PerVertex { vec4 gl_Position; };\nvoid main() { gl_Position = "
        "vec4(0); }";
    program_ = glCreateShaderProgramv(GL_VERTEX_SHADER, 1, &text);
}

HostState::~HostState() {
    glUseProgram(0);
    glDeleteProgram(program_);
    glDeleteFramebuffers(2, framebuffers_);
    glDeleteVertexArrays(1, &vertexArray_);
    glDeleteSamplers(1, &sampler_);
    glDeleteTextures(6, textures_);
    glDeleteBuffers(1, &buffer_);
}

void HostState::set() const {
    for (const GLenum name : kSwitches) glIsEnabled(name) == GL_TRUE ? glDisable(name) : glEnable(name);
    setBindings();
    setIndexed();
    glBlendColor(0.125f, 0.25f, 0.5f, 0.75f);
    glDepthMask(GL_FALSE);
    glDepthFunc(GL_GREATER);
    glCullFace(GL_FRONT);
    glFrontFace(GL_CW);
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    glProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
    glClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
    glPolygonOffset(1.5f, 2.5f);
    glLineWidth(2.0f);
    glPrimitiveRestartIndex(77);
    for (const GLenum pack :
         {GL_PACK_ROW_LENGTH, GL_PACK_IMAGE_HEIGHT, GL_PACK_SKIP_PIXELS, GL_PACK_SKIP_ROWS,
          GL_PACK_SKIP_IMAGES, GL_UNPACK_ROW_LENGTH, GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_SKIP_PIXELS,
          GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_IMAGES})
        glPixelStorei(pack, 3);
    for (const GLenum order :
         {GL_PACK_SWAP_BYTES, GL_PACK_LSB_FIRST, GL_UNPACK_SWAP_BYTES, GL_UNPACK_LSB_FIRST})
        glPixelStorei(order, GL_TRUE);
    glPixelStorei(GL_PACK_ALIGNMENT, 2);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 8);
}

void HostState::setBindings() const {
    glUseProgram(program_);
    glBindVertexArray(vertexArray_);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffers_[0]);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffers_[1]);
    for (GLuint unit = 0; unit < 32; ++unit) {
        for (const GLuint texture : textures_) glBindTextureUnit(unit, texture);
        glBindSampler(unit, sampler_);
    }
    glActiveTexture(GL_TEXTURE0 + 13);
    // One unit in two is layered: a layer is kept for the others only.
    for (GLuint unit = 0; unit < 8; ++unit)
        glBindImageTexture(unit, textures_[1], 1, unit % 2 == 0 ? GL_FALSE : GL_TRUE, 2, GL_WRITE_ONLY,
                           GL_RGBA8);
    for (GLuint i = 0; i < 8; ++i)
        glBindBufferRange(GL_UNIFORM_BUFFER, i, buffer_, 256 * (i + 1), 64 + 16 * i);
    for (GLuint i = 0; i < 16; ++i)
        glBindBufferRange(GL_SHADER_STORAGE_BUFFER, i, buffer_, 256 * (i + 1), 128 + 16 * i);
    for (const GLenum target :
         {GL_PIXEL_PACK_BUFFER, GL_PIXEL_UNPACK_BUFFER, GL_DRAW_INDIRECT_BUFFER, GL_DISPATCH_INDIRECT_BUFFER})
        glBindBuffer(target, buffer_);
}

void HostState::setIndexed() {
    for (GLuint i = 0; i < 16; ++i) {
        const float f = static_cast<float>(i);
        glViewportIndexedf(i, 1 + f, 2 + f, 30 + f, 40 + f);
        glDepthRangeIndexed(i, 0.25 + i / 64.0, 0.75);
        glScissorIndexed(i, static_cast<int>(i), 3, 5, 7);
        glEnablei(GL_SCISSOR_TEST, i);
    }
    for (GLuint i = 0; i < 8; ++i) {
        glEnablei(GL_BLEND, i);
        glBlendFuncSeparatei(i, i % 2 == 0 ? GL_DST_COLOR : GL_SRC_ALPHA, GL_ONE, GL_DST_ALPHA, GL_SRC_ALPHA);
        glBlendEquationSeparatei(i, GL_FUNC_SUBTRACT, GL_MAX);
        glColorMaski(i, GL_FALSE, i % 2 == 0, GL_FALSE, GL_FALSE);
    }
}

}  // namespace conelight::test
