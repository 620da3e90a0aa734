// SPDX-License-Identifier: MIT
// HostStateGuard: everything it lists is set to odd values, changed by passes and by direct calls under the
// guard, and found again. The list here is written independently of the guard's own.
#include "gl/host_state.h"

#include <algorithm>
#include <cstdio>
#include <map>

#include "base/clock.h"
#include "gl/draw.h"
#include "gl/pass.h"
#include "support/gl_fixture.h"
#include "support/host_state.h"

namespace conelight::test {
namespace {

using HostStateTest = GlTest;  // which sets all state back after each test

constexpr char kVertexShader[] = R"(#version 450 core
void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0); }
)";
constexpr char kFragmentShader[] = R"(#version 450 core
layout(location = 0) out vec4 color;
void main() { color = vec4(0.25, 0.5, 0.75, 1.0); }
)";
constexpr char kComputeShader[] = R"(#version 450 core
layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D source;
layout(rgba8) uniform writeonly image2D target;
layout(std430) buffer Counter { uint count; };
layout(std140) uniform Scale { vec4 scale; };
void main() {
    imageStore(target, ivec2(gl_GlobalInvocationID.xy), texelFetch(source, ivec2(gl_GlobalInvocationID.xy), 0) * scale);
    atomicAdd(count, 1u);
}
)";

using Picture = std::vector<std::uint8_t>;  // 64 x 64 RGBA

// Proves that the host really changed everything. Of the image units one half is layered and the other is
// not, so that of either property (0x8f3c, 0x8f3d) one half keeps the default.
void expectAllChanged(const Snapshot& before, const Snapshot& odd) {
    int unchanged = 0;
    for (const auto& [key, value] : odd)
        if (value == before.at(key)) {
            ++unchanged;
            EXPECT_TRUE(key.rfind("0x8f3c", 0) == 0 || key.rfind("0x8f3d", 0) == 0)
                << key << " was not changed";
        }
    EXPECT_LE(unchanged, 16);
}

// A triangle that covers a picture, by a framebuffer with depth.
Picture drawFlat(gl::ProgramLibrary& programs, const gl::Texture& color) {
    const gl::Texture depth({GL_TEXTURE_2D, GL_DEPTH_COMPONENT32F, 64, 64}, "depth");
    gl::Framebuffer framebuffer({&color}, &depth, "framebuffer");
    framebuffer.clearColor(0, 1, 1, 1, 1);
    framebuffer.clearDepth(1);
    gl::RasterState state;
    state.framebuffer = &framebuffer;
    state.cull = gl::Cull::None;
    state.depthBiasSlope = 3;
    gl::apply(state);
    gl::VertexArray none("none");
    none.bind();
    programs.get({{"test/flat.vert.glsl", "test/flat.frag.glsl"}, {}}).use();
    glDrawArrays(GL_TRIANGLES, 0, 3);
    Picture picture(64 * 64 * 4);
    color.read(0, GL_RGBA, GL_UNSIGNED_BYTE, picture.data(), picture.size());
    return picture;
}

// The same picture through upload, texture, image, uniform, storage and indirect dispatch.
Picture copyByCompute(gl::ProgramLibrary& programs, gl::Texture& color, const Picture& picture) {
    gl::Texture target({GL_TEXTURE_2D, GL_RGBA8, 64, 64}, "target");
    color.upload(0, GL_RGBA, GL_UNSIGNED_BYTE, picture.data());
    const gl::Sampler sampler({GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE}, "sampler");
    const float one[4] = {1, 1, 1, 1};
    const gl::Buffer scale(one, sizeof one, "scale"), counter(16, "counter");
    const gl::Buffer groups(std::vector<std::uint32_t>{8, 8, 1}, "groups");
    programs.compute("test/scale.comp.glsl")
        .dispatchIndirect(gl::Inputs()
                              .texture("source", color, &sampler)
                              .image("target", target, gl::ImageUse::Write)
                              .uniform("Scale", scale)
                              .storage("Counter", counter),
                          groups);
    gl::barrier(gl::Access::Update);
    Picture copied(64 * 64 * 4);
    target.read(0, GL_RGBA, GL_UNSIGNED_BYTE, copied.data(), copied.size());
    EXPECT_EQ(counter.read<std::uint32_t>(1)[0], 64u * 64);
    return copied;
}

}  // namespace

TEST_F(HostStateTest, PassesUnderTheGuardLeaveNoTrace) {
    const HostState host;
    const Snapshot before = snapshot();
    host.set();
    const Snapshot odd = snapshot();
    expectAllChanged(before, odd);
    Picture picture, copied;
    {
        const gl::HostStateGuard guard;
        addShader("test/flat.vert.glsl", kVertexShader);
        addShader("test/flat.frag.glsl", kFragmentShader);
        addShader("test/scale.comp.glsl", kComputeShader);
        gl::Texture color({GL_TEXTURE_2D, GL_RGBA8, 64, 64}, "color");
        picture = drawFlat(programs(), color);
        copied = copyByCompute(programs(), color, picture);
    }
    // What the host had set did not reach our passes ...
    for (std::size_t i = 0; i < picture.size(); i += 4) {
        ASSERT_NEAR(picture[i], 64, 1) << "at pixel " << i / 4;
        ASSERT_NEAR(picture[i + 1], 128, 1);
        ASSERT_NEAR(picture[i + 2], 191, 1);
    }
    EXPECT_EQ(picture, copied);
    // ... and what our passes set did not reach the host.
    const Snapshot after = snapshot();
    for (const auto& [key, value] : after) EXPECT_EQ(value, odd.at(key)) << key;
}

// Not only what today's passes change: everything on the list.
TEST_F(HostStateTest, AnyChangeUnderTheGuardIsUndone) {
    const Snapshot fresh = snapshot();
    const HostState host;
    {
        const gl::HostStateGuard guard;
        host.set();
    }
    for (const auto& [key, value] : snapshot()) EXPECT_EQ(value, fresh.at(key)) << key;
}

// Saving and restoring takes no longer than this test's own list takes to ask for. The least of some rounds
// each, as other programs may run beside.
TEST_F(HostStateTest, CostsNoMoreThanAskingForTheState) {
    const HostState host;
    host.set();
    double guarded = 1e9, asked = 1e9;
    for (int round = 0; round < 20; ++round) {
        const double start = base::processCpuMs();
        for (int i = 0; i < 10; ++i) const gl::HostStateGuard guard;
        const double middle = base::processCpuMs();
        for (int i = 0; i < 10; ++i) snapshot();
        guarded = std::min(guarded, (middle - start) / 10);
        asked = std::min(asked, (base::processCpuMs() - middle) / 10);
    }
    RecordProperty("guardMs", std::to_string(guarded));
    RecordProperty("askedMs", std::to_string(asked));
    std::printf("HostStateGuard: %.4f ms; asking for the state: %.4f ms\n", guarded, asked);
    EXPECT_LT(guarded, asked);
}

}  // namespace conelight::test
