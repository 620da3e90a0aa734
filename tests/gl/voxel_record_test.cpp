// SPDX-License-Identifier: MIT
// Twins in C++ and GLSL of the functions that pack and unpack what voxels hold (voxels/voxel_record.h,
// lib/voxel_record.glsl): the same bits, addresses and numbers for thousands of random values.
#include "voxels/voxel_record.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <random>

#include "gl/pass.h"
#include "support/gl_fixture.h"
#include "voxels/voxel_grid.h"

namespace conelight::test {
namespace {

using VoxelRecordTest = GlTest;

constexpr std::size_t kCount = 4096;

// What C++ packs of the values of one invocation of test/pack.comp.glsl.
std::array<std::uint32_t, 8> packed(const glm::vec4& v) {
    const glm::vec3 a(v);
    const glm::vec3 b(v.y, v.z, v.x);
    const glm::ivec3 voxel(a * 1023.0f);
    const gpu::FaceMaterial material = voxels::packFaceMaterial(a, a * 1000.0f, v.w * 4.0f);
    return {voxels::packOffsetWeight(v.x * 2.0f - 1.0f, v.w * 4.0f),
            voxels::packBounds(glm::min(a, b), glm::max(a, b)),
            material.albedo,
            voxels::packRgb9e5(a * std::exp2(std::floor(v.w * 40.0f - 20.0f))),
            material.emission,
            material.emissionBArea,
            voxels::packVoxel(voxel),
            voxels::bitOfVoxel(voxel) | (voxels::brickIndex(voxel / 4, glm::ivec3(256)) << 6)};
}

// Both halves of a word within so many steps.
void expectHalvesNear(std::uint32_t got, std::uint32_t expected, int lowSteps, int highSteps) {
    const auto half = [](std::uint32_t word, int shift) { return static_cast<int>(word >> shift & 0xffffu); };
    EXPECT_LE(std::abs(half(got, 0) - half(expected, 0)), lowSteps);
    EXPECT_LE(std::abs(half(got, 16) - half(expected, 16)), highSteps);
}

TEST_F(VoxelRecordTest, PackingFunctionsAgreeInGlsl) {
    addShader("test/pack.comp.glsl", R"(#version 450
layout(local_size_x = 64) in;
#include "lib/voxel_record.glsl"
layout(std430) readonly buffer In { vec4 values[]; };
layout(std430) writeonly buffer Out { uvec4 packed_[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    vec4 v = values[i];
    uvec4 material = packFaceMaterial(v.rgb, v.rgb * 1000.0, v.a * 4.0, 0u);
    ivec3 voxel = ivec3(v.xyz * 1023.0);
    packed_[2u * i] = uvec4(packOffsetWeight(v.x * 2.0 - 1.0, v.w * 4.0), packBounds(min(v.xyz, v.yzx), max(v.xyz, v.yzx)),
                            material.x, packRgb9e5(v.xyz * exp2(floor(v.w * 40.0 - 20.0))));
    packed_[2u * i + 1u] = uvec4(material.yz, packVoxel(voxel), bitOfVoxel(voxel) | (brickIndex(voxel >> 2, ivec3(256, 256, 256)) << 6));
})");
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<glm::vec4> values;
    for (std::size_t i = 0; i < kCount; ++i)
        values.emplace_back(unit(random), unit(random), unit(random), unit(random));
    values[0] = {0, 0, 0, 0};
    values[1] = {1, 1, 1, 1};
    values[2] = {0.5f, 1, 0, 0.5f};
    const gl::Buffer in(values, "in");
    const gl::Buffer out(kCount * 32, "out");
    programs()
        .compute("test/pack.comp.glsl")
        .dispatch(gl::Inputs().storage("In", in).storage("Out", out), static_cast<int>(kCount));
    gl::barrier(gl::Access::ShaderStorage);
    const auto got = out.read<std::uint32_t>(8 * kCount);
    for (std::size_t i = 0; i < kCount; ++i) {
        const std::array<std::uint32_t, 8> expected = packed(values[i]);
        for (std::size_t k = 0; k < 8; ++k) {
            if (k == 4 || k == 5) {
                // GLSL leaves the rounding of halves to the driver: one step either way.
                expectHalvesNear(got[8 * i + k], expected[k], 1, k == 4 ? 1 : 0);
            } else {
                EXPECT_EQ(got[8 * i + k], expected[k]);
            }
            if (HasFailure()) FAIL() << "value " << i << " word " << k;
        }
    }
}

TEST_F(VoxelRecordTest, UnpackingFunctionsAndAddressesAgreeInGlsl) {
    addShader("test/unpack.comp.glsl", R"(#version 450
layout(local_size_x = 64) in;
#include "lib/voxel_record.glsl"
layout(std430) readonly buffer In { uvec4 bits[]; };
layout(std430) writeonly buffer Out { vec4 values[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    uvec4 b = bits[i];
    values[5u * i] = vec4(unpackOffset(b.x), unpackWeight(b.x), unpackArea(uvec4(0u, b.xy, 0u)), float(brickRank(b.xy, b.z & 63u)));
    values[5u * i + 1u] = vec4(unpackAlbedo(b.x), float(faceIndex(b.x, int(b.z % 6u))));
    values[5u * i + 2u] = vec4(unpackRgb9e5(b.y), brickHas(b.xy, b.z & 63u) ? 1.0 : 0.0);
    values[5u * i + 3u] = vec4(unpackBoundsMin(b.x), 0.0);
    ivec3 brick = brickOfIndex(b.w & 0xffffu, ivec3(20, 24, 28));
    values[5u * i + 4u] = vec4(unpackBoundsMax(b.x), float(brickIndex(brick, ivec3(20, 24, 28))));
})");
    std::mt19937 random(8);
    std::vector<std::uint32_t> bits(4 * kCount);
    for (std::uint32_t& b : bits) b = static_cast<std::uint32_t>(random());
    const gl::Buffer in(bits, "in");
    const gl::Buffer out(kCount * 80, "out");
    programs()
        .compute("test/unpack.comp.glsl")
        .dispatch(gl::Inputs().storage("In", in).storage("Out", out), static_cast<int>(kCount));
    gl::barrier(gl::Access::ShaderStorage);
    const auto got = out.read<glm::vec4>(5 * kCount);
    for (std::size_t i = 0; i < kCount; ++i) {
        const std::uint32_t x = bits[4 * i], y = bits[4 * i + 1], z = bits[4 * i + 2], w = bits[4 * i + 3];
        const std::uint64_t mask = x | (static_cast<std::uint64_t>(y) << 32);
        const std::uint32_t bit = z & 63u;
        const glm::vec4* g = &got[5 * i];
        EXPECT_NEAR(g[0].x, voxels::unpackOffset(x), 1e-6f);
        EXPECT_NEAR(g[0].y, voxels::unpackWeight(x), 1e-6f);
        EXPECT_NEAR(g[0].z, voxels::unpackArea({0, x, y, 0}), 1e-6f);
        EXPECT_EQ(static_cast<int>(g[0].w), std::popcount(mask & ((std::uint64_t{1} << bit) - 1)));
        const glm::vec3 albedo = voxels::unpackAlbedo(x);
        const glm::vec3 light = voxels::unpackRgb9e5(y);
        glm::vec3 low, high;
        voxels::unpackBounds(x, low, high);
        for (int k = 0; k < 3; ++k) {
            EXPECT_NEAR(g[1][k], albedo[k], 1e-6f);
            EXPECT_EQ(g[2][k], light[k]);
            EXPECT_NEAR(g[3][k], low[k], 1e-6f);
            EXPECT_NEAR(g[4][k], high[k], 1e-6f);
        }
        const std::uint32_t direction = z % 6;
        EXPECT_EQ(g[1].w, static_cast<float>((x & 0x3ffffffu) + static_cast<std::uint32_t>(std::popcount(
                                                                    (x >> 26) & ((1u << direction) - 1)))));
        EXPECT_EQ(g[2].w, ((mask >> bit) & 1u) != 0 ? 1.0f : 0.0f);
        const std::uint32_t index = w & 0xffffu;
        if (index < 20 * 24 * 28) {
            EXPECT_EQ(g[4].w, static_cast<float>(index));
        }
        if (HasFailure()) FAIL() << "value " << i;
    }
}

}  // namespace
}  // namespace conelight::test
