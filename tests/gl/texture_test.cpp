// SPDX-License-Identifier: MIT
// Owners of textures, buffers, framebuffers and the rest: what goes in comes out, bounds hold, and creation
// that fails throws and leaves nothing alive.
#include "gl/texture.h"

#include <algorithm>
#include <numeric>

#include "conelight/error.h"
#include "gl/debug.h"
#include "gl/draw.h"
#include "gl/pass.h"
#include "support/gl_fixture.h"

namespace conelight::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

// 1, 2, 3 ... so that every byte has its place.
Bytes counting(std::size_t count) {
    Bytes bytes(count);
    std::iota(bytes.begin(), bytes.end(), std::uint8_t{1});
    return bytes;
}

template <class T>
std::vector<T> readBack(const gl::Texture& texture, int level, GLenum layout, GLenum type,
                        std::size_t count) {
    std::vector<T> data(count);
    texture.read(level, layout, type, data.data(), count * sizeof(T));
    return data;
}

// The message of the Error(Runtime) that `call` throws.
template <class Call>
std::string failureOf(Call call) {
    try {
        call();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Runtime);
        return error.what();
    }
    return "no error";
}

class TextureTest : public GlTest {};

template <class T>
void expectMoves(T a) {
    const gl::Name name = a.name();
    ASSERT_NE(name, 0u);
    ASSERT_EQ(gl::liveObjectCount(), 1u);
    T b(std::move(a));
    EXPECT_FALSE(a);  // NOLINT: the moved-from state is what is tested
    EXPECT_EQ(b.name(), name);
    T c;
    EXPECT_FALSE(c);
    c = std::move(b);
    EXPECT_FALSE(b);  // NOLINT
    EXPECT_EQ(c.name(), name);
    EXPECT_EQ(gl::liveObjectCount(), 1u);
    T& same = c;
    c = std::move(same);
    EXPECT_EQ(c.name(), name);
    c.reset();
    EXPECT_FALSE(c);
    EXPECT_EQ(gl::liveObjectCount(), 0u);
}

}  // namespace

TEST_F(TextureTest, EveryOwnerMovesAndDies) {
    expectMoves(gl::Buffer(64, "buffer"));
    expectMoves(gl::Texture({GL_TEXTURE_2D, GL_RGBA8, 4, 4}, "texture"));
    expectMoves(gl::Sampler({GL_LINEAR, GL_LINEAR, GL_REPEAT}, "sampler"));
    expectMoves(gl::VertexArray("array"));
    expectMoves(gl::Framebuffer(4, 4, "framebuffer"));
    expectMoves(gl::Query("query"));
    // Assignment frees what the target owned.
    gl::Buffer a(16, "a"), b(16, "b");
    b = std::move(a);
    EXPECT_EQ(gl::liveObjectCount(), 1u);
    EXPECT_EQ(gl::liveObjects()[0].label, "a");
}

TEST_F(TextureTest, RowsOfAnyLengthAreTight) {
    for (const int width : {1, 3, 5, 8}) {
        gl::Texture texture({GL_TEXTURE_2D, GL_R8, width, 3}, "odd");
        const Bytes data = counting(static_cast<std::size_t>(width) * 3);
        texture.upload(0, GL_RED, GL_UNSIGNED_BYTE, data.data());
        EXPECT_EQ(readBack<std::uint8_t>(texture, 0, GL_RED, GL_UNSIGNED_BYTE, data.size()), data) << width;
    }
}

TEST_F(TextureTest, LayersAndSlicesKeepTheirPlace) {
    for (const GLenum target :
         {GL_TEXTURE_3D, GL_TEXTURE_2D_ARRAY, GL_TEXTURE_CUBE_MAP, GL_TEXTURE_CUBE_MAP_ARRAY}) {
        const bool cube = target == GL_TEXTURE_CUBE_MAP || target == GL_TEXTURE_CUBE_MAP_ARRAY;
        gl::Texture texture({target, GL_RGBA8, 4, cube ? 4 : 2, target == GL_TEXTURE_CUBE_MAP ? 1 : 6, 2},
                            "layers");
        EXPECT_EQ(texture.depth(), 6);
        EXPECT_EQ(texture.depth(1), target == GL_TEXTURE_3D ? 3 : 6);
        Bytes data = counting(static_cast<std::size_t>(texture.width() * texture.height() * 6) * 4);
        texture.upload(0, GL_RGBA, GL_UNSIGNED_BYTE, data.data());
        const Bytes layer(static_cast<std::size_t>(texture.width() * texture.height()) * 4, 200);
        texture.uploadLayer(0, 4, GL_RGBA, GL_UNSIGNED_BYTE, layer.data());
        std::copy(layer.begin(), layer.end(), data.begin() + static_cast<std::ptrdiff_t>(4 * layer.size()));
        EXPECT_EQ(readBack<std::uint8_t>(texture, 0, GL_RGBA, GL_UNSIGNED_BYTE, data.size()), data)
            << std::hex << target;
    }
}

TEST_F(TextureTest, LevelsAreClearedAndReadApart) {
    gl::Texture volume({GL_TEXTURE_3D, GL_RGBA16F, 8, 4, 2, 0}, "volume");
    EXPECT_EQ(volume.desc().levels, 4);
    const float one[4] = {1, 2, 3, 4};
    for (int level = 0; level < 4; ++level) volume.clear(level, GL_RGBA, GL_FLOAT, nullptr);
    volume.clear(2, GL_RGBA, GL_FLOAT, one);
    EXPECT_EQ(volume.width(2), 2);
    EXPECT_EQ(volume.height(2), 1);
    EXPECT_EQ(volume.depth(2), 1);
    EXPECT_EQ(readBack<float>(volume, 2, GL_RGBA, GL_FLOAT, 8), (std::vector<float>{1, 2, 3, 4, 1, 2, 3, 4}));
    EXPECT_EQ(readBack<float>(volume, 3, GL_RGBA, GL_FLOAT, 4), std::vector<float>(4, 0.0f));
    EXPECT_EQ(readBack<float>(volume, 0, GL_RGBA, GL_FLOAT, 256), std::vector<float>(256, 0.0f));
}

TEST_F(TextureTest, StorageBytesCountAllLevelsAndLayers) {
    const auto bytes = [](const gl::TextureDesc& desc) { return gl::Texture::storageBytes(desc); };
    EXPECT_EQ(bytes({GL_TEXTURE_2D, GL_RGBA8, 16, 8}), 16u * 8 * 4);
    EXPECT_EQ(bytes({GL_TEXTURE_2D, GL_R8, 16, 8, 1, 0}), 128u + 32 + 8 + 2 + 1);
    EXPECT_EQ(bytes({GL_TEXTURE_3D, GL_RGBA16F, 8, 8, 8, 2}), (512u + 64) * 8);
    EXPECT_EQ(bytes({GL_TEXTURE_2D_ARRAY, GL_R16F, 8, 8, 5, 2}), (64u + 16) * 5 * 2);
    EXPECT_EQ(bytes({GL_TEXTURE_CUBE_MAP, GL_DEPTH_COMPONENT32F, 8, 8}), 64u * 6 * 4);
    EXPECT_EQ(bytes({GL_TEXTURE_CUBE_MAP_ARRAY, GL_DEPTH_COMPONENT16, 8, 8, 12}), 64u * 12 * 2);
    // Beyond 32 bits.
    EXPECT_EQ(bytes({GL_TEXTURE_3D, GL_RGBA32F, 2048, 2048, 2048}), std::size_t{1} << 37);
    const gl::Texture texture({GL_TEXTURE_2D, GL_RGBA8, 5, 7, 1, 0}, "texture");
    EXPECT_EQ(gl::liveObjects().at(0).bytes, (35u + 6 + 1) * 4);
}

TEST_F(TextureTest, BufferTexturesReadTheBuffer) {
    addShader("test/fetch.comp.glsl",
              "#version 450 core\nlayout(local_size_x = 8) in;\nuniform usamplerBuffer "
              "source;\n"
              "layout(std430) buffer Out { uint sums[8]; };\n"
              "void main() { uint i = gl_LocalInvocationIndex; uvec4 t = texelFetch(source, int(i)); sums[i] "
              "= t.x + 8u * t.y; }\n");
    std::vector<std::uint32_t> data(16);
    std::iota(data.begin(), data.end(), 1u);
    const gl::Buffer source(data, "source"), out(32, "out");
    const gl::Texture view(source, GL_RG32UI, "view");
    EXPECT_EQ(view.width(), 8);
    programs()
        .compute("test/fetch.comp.glsl")
        .dispatch(gl::Inputs().texture("source", view).storage("Out", out), 8);
    for (std::uint32_t i = 0; i < 8; ++i)
        EXPECT_EQ(out.read<std::uint32_t>(8)[i], (2 * i + 1) + 8 * (2 * i + 2));
}

TEST_F(TextureTest, SamplersHoldWhatTheyWereGiven) {
    gl::SamplerDesc desc{GL_LINEAR_MIPMAP_LINEAR, GL_NEAREST, GL_CLAMP_TO_EDGE,
                         GL_MIRRORED_REPEAT,      true,       4.0f};
    const gl::Sampler sampler(desc, "sampler");
    const auto parameter = [&](GLenum name) {
        GLint value = 0;
        glGetSamplerParameteriv(sampler.name(), name, &value);
        return static_cast<GLenum>(value);
    };
    EXPECT_EQ(parameter(GL_TEXTURE_MIN_FILTER), desc.minFilter);
    EXPECT_EQ(parameter(GL_TEXTURE_MAG_FILTER), desc.magFilter);
    EXPECT_EQ(parameter(GL_TEXTURE_WRAP_S), desc.wrap);
    EXPECT_EQ(parameter(GL_TEXTURE_WRAP_T), desc.wrapV);
    EXPECT_EQ(parameter(GL_TEXTURE_WRAP_R), desc.wrap);
    EXPECT_EQ(parameter(GL_TEXTURE_COMPARE_MODE), static_cast<GLenum>(GL_COMPARE_REF_TO_TEXTURE));
    EXPECT_EQ(parameter(GL_TEXTURE_COMPARE_FUNC), static_cast<GLenum>(GL_LEQUAL));
    if (epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic")) {
        EXPECT_EQ(parameter(GL_TEXTURE_MAX_ANISOTROPY_EXT), 4u);
    }
}

TEST_F(TextureTest, BuffersAreZeroWordsAndKeepUpdates) {
    gl::Buffer buffer(18, "18 bytes");
    EXPECT_EQ(buffer.bytes(), 20u);  // whole words
    EXPECT_EQ(buffer.read<std::uint8_t>(20), Bytes(20, 0));
    const Bytes piece{9, 8, 7};
    buffer.update(15, piece.data(), piece.size());
    EXPECT_EQ(buffer.read<std::uint8_t>(4, 14), (Bytes{0, 9, 8, 7}));
    buffer.fill(0x01020304u);
    EXPECT_EQ(buffer.read<std::uint32_t>(5), std::vector<std::uint32_t>(5, 0x01020304u));
    // Short data: the rest is zero; none: still something to bind.
    const gl::Buffer small(Bytes{1, 2, 3}, "3 bytes");
    EXPECT_EQ(small.read<std::uint8_t>(16), (Bytes{1, 2, 3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
    // What is written after a fill stays, whoever does the one and the other.
    for (const std::size_t bytes : {3, 4, 16, 4096}) {
        const Bytes some(bytes, 5);
        gl::Buffer filled(2 * bytes, "filled");
        filled.fill(0);
        filled.update(0, some.data(), bytes);
        EXPECT_EQ(filled.read<std::uint8_t>(bytes), some) << bytes;
    }
    const gl::Buffer empty(std::vector<float>{}, "empty");
    EXPECT_EQ(empty.bytes(), 16u);
    buffer.reset();
    EXPECT_EQ(buffer.bytes(), 0u);
}

using TextureDeathTest = TextureTest;

TEST_F(TextureDeathTest, RangesOutsideABufferStopTheProgram) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    gl::Buffer buffer(16, "buffer");
    std::uint8_t bytes[32] = {};
    EXPECT_DEATH(buffer.update(1, bytes, 16), "reaches past the end");
    EXPECT_DEATH(buffer.read(17, bytes, 0), "reaches past the end");
    // Offset + size wraps around to a small number.
    EXPECT_DEATH(buffer.read(8, bytes, ~std::size_t{0}), "reaches past the end");
    EXPECT_DEATH(gl::Texture({GL_TEXTURE_2D, GL_RGBA8, 0, 4}, "flat"), "at least one texel");
}

TEST_F(TextureTest, LabelsOfAnyLengthAreTaken) {
    const std::string label(1000, 'x');
    const gl::Buffer buffer(16, label), unnamed(16, "");
    EXPECT_EQ(gl::liveObjects().at(0).label, label);
    char got[300] = {};
    glGetObjectLabel(GL_BUFFER, buffer.name(), sizeof got, nullptr, got);
    EXPECT_EQ(std::string(got), std::string(255, 'x'));
}

TEST_F(TextureTest, FramebuffersDrawToLayersOrTheFirst) {
    gl::Texture array({GL_TEXTURE_2D_ARRAY, GL_RGBA8, 2, 2, 2}, "array");
    array.clear(0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    gl::Framebuffer({&array}, nullptr, "first").clearColor(0, 1, 1, 1, 1);
    Bytes expected(32, 0);
    std::fill_n(expected.begin(), 16, std::uint8_t{255});
    EXPECT_EQ(readBack<std::uint8_t>(array, 0, GL_RGBA, GL_UNSIGNED_BYTE, 32), expected);
    gl::Framebuffer({&array}, nullptr, "all", true).clearColor(0, 1, 1, 1, 1);
    EXPECT_EQ(readBack<std::uint8_t>(array, 0, GL_RGBA, GL_UNSIGNED_BYTE, 32), Bytes(32, 255));

    gl::Texture depth({GL_TEXTURE_2D_ARRAY, GL_DEPTH_COMPONENT32F, 2, 2, 3}, "depth");
    const float zero = 0;
    depth.clear(0, GL_DEPTH_COMPONENT, GL_FLOAT, &zero);
    const gl::Framebuffer layer = gl::Framebuffer::depthLayer(depth, 1, "layer");
    EXPECT_EQ(layer.width(), 2);
    layer.clearDepth(0.5f);
    EXPECT_EQ(readBack<float>(depth, 0, GL_DEPTH_COMPONENT, GL_FLOAT, 12),
              (std::vector<float>{0, 0, 0, 0, 0.5f, 0.5f, 0.5f, 0.5f, 0, 0, 0, 0}));
}

TEST_F(TextureTest, AnIncompleteFramebufferThrowsAndLeavesNothing) {
    {
        // Shared exponents can be read but not drawn to.
        const gl::Texture texture({GL_TEXTURE_2D, GL_RGB9_E5, 4, 4}, "texture");
        const std::string message =
            failureOf([&] { gl::Framebuffer framebuffer({&texture}, nullptr, "target"); });
        EXPECT_EQ(message.rfind("OpenGL: framebuffer 'target' of 4 x 4 is not complete: ", 0), 0u) << message;
        EXPECT_EQ(gl::liveObjectCount(), 1u);
    }
    EXPECT_EQ(gl::liveObjectCount(), 0u);
}

TEST_F(TextureTest, SizesBeyondTheDriverThrow) {
    const std::string message = failureOf([] {
        gl::Texture texture({GL_TEXTURE_2D, GL_RGBA8, 1 << 20, 1}, "wide");
    });
    EXPECT_EQ(message.rfind("OpenGL: texture 'wide' of 1048576 x 1 x 1; at most ", 0), 0u) << message;
    EXPECT_NE(failureOf([] {
                  gl::Texture texture({GL_TEXTURE_3D, GL_R8, 1, 1, 1 << 20}, "deep");
              }),
              "no error");
    EXPECT_NE(failureOf([] {
                  gl::Texture texture({GL_TEXTURE_2D_ARRAY, GL_R8, 1, 1, 1 << 20}, "many");
              }),
              "no error");
    EXPECT_EQ(failureOf([] {
                  gl::Texture texture({GL_TEXTURE_2D, GL_RGB565, 4, 4}, "odd");
              }),
              "texture format 0x8d62 has no known size");
    EXPECT_EQ(gl::liveObjectCount(), 0u);
}

TEST_F(TextureTest, NoMemoryIsAnErrorNotACrash) {
    // 8 TiB in one texture, 32 TiB in one buffer.
    const std::string texture = failureOf([] {
        gl::Texture t({GL_TEXTURE_2D_ARRAY, GL_RGBA32F, 16384, 16384, 2048}, "huge");
    });
    EXPECT_EQ(texture.rfind("OpenGL: no memory for 'huge' (8388608.0 MiB)", 0), 0u) << texture;
    const std::string buffer = failureOf([] { gl::Buffer b(std::size_t{1} << 45, "huge buffer"); });
    EXPECT_EQ(buffer.rfind("OpenGL: no memory for 'huge buffer' (33554432.0 MiB)", 0), 0u) << buffer;
    EXPECT_EQ(gl::liveObjectCount(), 0u);
    // The driver reported both, if it was asked, the error flag is clean, and the context goes on.
    if (!epoxy_has_gl_extension("GL_NVX_gpu_memory_info")) {
        EXPECT_GE(gl::debugErrorCount(), 2);
    }
    gl::resetDebugErrors();
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    const gl::Buffer small(16, "small");
    EXPECT_EQ(small.read<std::uint32_t>(4), std::vector<std::uint32_t>(4, 0));
}

}  // namespace conelight::test
