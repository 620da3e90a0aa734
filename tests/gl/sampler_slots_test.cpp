// SPDX-License-Identifier: MIT
// llvmpipe builds a kernel once, whatever ran before it and however large its buffers are: the kernels that it keeps on
// disk are as many after another order as after the first.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "gl/pass.h"
#include "scene/gpu_materials.h"
#include "support/gl_fixture.h"

namespace conelight::test {
namespace {

struct SamplerSlotsTest : GlTest {
    void SetUp() override {
        GlTest::SetUp();
        addShader("test/fetch.comp.glsl", text("usamplerBuffer", "float(texelFetch(source, 0).x)"));
        addShader("test/sample.comp.glsl", text("sampler2D", "textureLod(source, vec2(0.3), 0.0).x"));
        addShader("test/surface.comp.glsl",
                  "#version 450 core\nlayout(local_size_x = 1) in;\nuniform sampler2DArray surfaceArray;\n"
                  "layout(std430) writeonly buffer Out { float value; };\n"
                  "void main() { value = textureLod(surfaceArray, vec3(0.3), 0.0).x; }\n");
        addShader("test/voxel.comp.glsl", text("usampler3D", "float(texelFetch(source, ivec3(0), 0).x)"));
    }
    static std::string text(const std::string& type, const std::string& read) {
        return "#version 450 core\nlayout(local_size_x = 1) in;\nuniform " + type +
               " source;\nlayout(std430) writeonly buffer Out { float value; };\nvoid main() { value = " +
               read + "; }\n";
    }
    void fetch(std::size_t bytes) {
        const gl::Buffer source(bytes, "source");
        const gl::Texture texels(source, GL_R32UI, "source");
        run("test/fetch.comp.glsl", texels);
    }
    void sample(int filter) {
        const gl::Texture texture({GL_TEXTURE_2D, GL_R8, 3, 3}, "source");
        const gl::Sampler sampler(
            {static_cast<GLenum>(filter), static_cast<GLenum>(filter), GL_CLAMP_TO_EDGE}, "sampler");
        run("test/sample.comp.glsl", texture, &sampler);
    }
    void voxel(int edge) {
        gl::Texture texture({GL_TEXTURE_3D, GL_R32UI, edge, edge, edge, 1, true}, "source");
        texture.parameter(GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        texture.parameter(GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        run("test/voxel.comp.glsl", texture);
    }
    // The textures of a scene that has some, or none.
    void surface(bool some) {
        const Texture white{.name = "white", .width = 1, .height = 1, .rgba = {255, 255, 255, 255}};
        const scene::SceneTextures textures(some ? std::vector<Texture>{white} : std::vector<Texture>{},
                                            {false});
        const gl::Buffer out(4, "out");
        gl::Inputs inputs;
        textures.declare(inputs);
        programs().compute("test/surface.comp.glsl").dispatch(inputs.storage("Out", out), 1);
    }
    void run(const std::string& file, const gl::Texture& source, const gl::Sampler* sampler = nullptr) {
        const gl::Buffer out(4, "out");
        programs().compute(file).dispatch(gl::Inputs().texture("source", source, sampler).storage("Out", out),
                                          1);
    }
};

// In a process of their own, whose driver keeps its kernels in a folder of its own.
TEST_F(SamplerSlotsTest, DISABLED_OneOrder) {
    fetch(12);
    sample(GL_LINEAR);
    sample(GL_NEAREST);
    voxel(3);
    surface(false);
}
TEST_F(SamplerSlotsTest, DISABLED_AnotherOrder) {
    for (const int filter : {GL_LINEAR, GL_NEAREST}) {
        sample(filter);
        for (const std::size_t bytes : {20u, 32u, 65536u}) fetch(bytes);
    }
    for (const int edge : {4, 5, 16}) voxel(edge);
    for (const bool some : {true, false}) surface(some);
}

TEST_F(SamplerSlotsTest, KernelsAreBuiltOnce) {
    if (!gl::isSoftwareDriver()) GTEST_SKIP() << "a driver of a GPU";
    const std::string cache = scratchDir() + "/kernels";
    const auto kernelsAfter = [&](const std::string& test) {
        const CommandResult result =
            runCommand("MESA_SHADER_CACHE_DIR='" + cache + "' '" +
                       std::filesystem::read_symlink("/proc/self/exe").string() +
                       "' --gtest_also_run_disabled_tests --gtest_filter=SamplerSlotsTest.DISABLED_" + test);
        EXPECT_EQ(result.status, 0) << result.output;
        int files = 0;
        if (!std::filesystem::exists(cache)) return files;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(cache))
            files += entry.is_regular_file() ? 1 : 0;
        return files;
    };
    // Twice: a program that Mesa finds on disk may have another kernel than the one it was made of.
    kernelsAfter("OneOrder");
    const int one = kernelsAfter("OneOrder");
    if (one == 0) GTEST_SKIP() << "the driver keeps no kernels on disk";
    EXPECT_EQ(kernelsAfter("AnotherOrder"), one);
}

}  // namespace
}  // namespace conelight::test
