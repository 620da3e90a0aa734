// SPDX-License-Identifier: MIT
#include "voxels/voxel_record.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtc/packing.hpp>

namespace conelight::voxels {
namespace {

constexpr float kWeightScale = 65535.0f / 4.0f;  // W and area: [0,4] in 16 bits
constexpr float kBoundsScale = 31.0f;

// [0,1] -> `scale` steps, halves up, as the GLSL twin rounds.
std::uint32_t quantized(float value, float scale) {
    return static_cast<std::uint32_t>(std::floor(std::clamp(value, 0.0f, 1.0f) * scale + 0.5f));
}

// Half of a number in [0, 65504], to nearest, ties to even.
std::uint32_t packHalf(float value) {
    const float v = std::clamp(value, 0.0f, 65504.0f);
    if (v < 6.103515625e-5f)
        return static_cast<std::uint32_t>(std::nearbyint(v * 16777216.0f));  // denormal: steps of 2^-24
    const auto bits = std::bit_cast<std::uint32_t>(v);
    return ((bits + 0xfffu + ((bits >> 13) & 1u)) >> 13) - (112u << 10);  // exponent bias 127 -> 15
}

}  // namespace

glm::vec3 directionVector(int direction) {
    glm::vec3 v(0);
    v[direction / 2] = direction % 2 == 0 ? 1.0f : -1.0f;
    return v;
}

std::uint32_t packOffsetWeight(float offset, float weight) {
    const int signedOffset = static_cast<int>(std::floor(std::clamp(offset, -1.0f, 1.0f) * 32767.0f + 0.5f));
    const auto high =
        static_cast<std::uint32_t>(std::floor(std::clamp(weight, 0.0f, 4.0f) * kWeightScale + 0.5f));
    return (static_cast<std::uint32_t>(signedOffset) & 0xffffu) | (high << 16);
}

float unpackOffset(std::uint32_t bits) {
    return std::max(static_cast<float>(static_cast<std::int16_t>(bits & 0xffffu)) / 32767.0f, -1.0f);
}

float unpackWeight(std::uint32_t bits) { return static_cast<float>(bits >> 16) / kWeightScale; }

std::uint32_t packBounds(const glm::vec3& min, const glm::vec3& max) {
    std::uint32_t bits = 0;
    for (int i = 0; i < 3; ++i) {
        bits |= static_cast<std::uint32_t>(std::floor(std::clamp(min[i], 0.0f, 1.0f) * kBoundsScale))
                << (5 * i);
        bits |= static_cast<std::uint32_t>(std::ceil(std::clamp(max[i], 0.0f, 1.0f) * kBoundsScale))
                << (15 + 5 * i);
    }
    return bits;
}

void unpackBounds(std::uint32_t bits, glm::vec3& min, glm::vec3& max) {
    for (int i = 0; i < 3; ++i) {
        min[i] = static_cast<float>((bits >> (5 * i)) & 31u) / kBoundsScale;
        max[i] = static_cast<float>((bits >> (15 + 5 * i)) & 31u) / kBoundsScale;
    }
}

std::uint32_t packAlbedo(const glm::vec3& albedo) {
    return quantized(albedo.r, 2047.0f) | (quantized(albedo.g, 2047.0f) << 11) |
           (quantized(albedo.b, 1023.0f) << 22);
}

glm::vec3 unpackAlbedo(std::uint32_t bits) {
    return {static_cast<float>(bits & 2047u) / 2047.0f, static_cast<float>((bits >> 11) & 2047u) / 2047.0f,
            static_cast<float>(bits >> 22) / 1023.0f};
}

std::uint32_t packRgb9e5(const glm::vec3& color) {
    // 9-bit mantissas without hidden one; exponent e stands for 2^(e - 24). Largest value 511/512 * 2^16.
    const glm::vec3 c = glm::clamp(color, glm::vec3(0), glm::vec3(65408.0f));
    const float largest = std::max({c.r, c.g, c.b});
    // floor(log2) from the float's own exponent field, exact on both sides.
    int exponent = std::max(static_cast<int>(std::bit_cast<std::uint32_t>(largest) >> 23) - 127, -16) + 16;
    const auto scaleOf = [](int e) {
        return std::bit_cast<float>(static_cast<std::uint32_t>(127 + 24 - e) << 23);
    };
    if (std::floor(largest * scaleOf(exponent) + 0.5f) >= 512.0f) ++exponent;
    const float scale = scaleOf(exponent);
    const auto mantissa = [&](float x) { return static_cast<std::uint32_t>(std::floor(x * scale + 0.5f)); };
    return mantissa(c.r) | (mantissa(c.g) << 9) | (mantissa(c.b) << 18) |
           (static_cast<std::uint32_t>(exponent) << 27);
}

glm::vec3 unpackRgb9e5(std::uint32_t bits) {
    const float scale = std::bit_cast<float>(((bits >> 27) + 127u - 24u) << 23);
    return glm::vec3(static_cast<float>(bits & 511u), static_cast<float>((bits >> 9) & 511u),
                     static_cast<float>((bits >> 18) & 511u)) *
           scale;
}

gpu::FaceMaterial packFaceMaterial(const glm::vec3& albedo, const glm::vec3& emission, float area,
                                   std::uint32_t lobe) {
    const auto high =
        static_cast<std::uint32_t>(std::floor(std::clamp(area, 0.0f, 4.0f) * kWeightScale + 0.5f));
    return {packAlbedo(albedo), packHalf(emission.r) | (packHalf(emission.g) << 16),
            packHalf(emission.b) | (high << 16), lobe};
}

glm::vec3 unpackEmission(const gpu::FaceMaterial& material) {
    return {glm::unpackHalf1x16(static_cast<glm::uint16>(material.emission & 0xffffu)),
            glm::unpackHalf1x16(static_cast<glm::uint16>(material.emission >> 16)),
            glm::unpackHalf1x16(static_cast<glm::uint16>(material.emissionBArea & 0xffffu))};
}

float unpackArea(const gpu::FaceMaterial& material) {
    return static_cast<float>(material.emissionBArea >> 16) / kWeightScale;
}

}  // namespace conelight::voxels
