// SPDX-License-Identifier: MIT
// glTF that is compressed, written by the encoders of what conelight_io decodes: a wavy sheet through Draco or
// meshoptimizer, a textured triangle through WebP.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "cpu/io_test_support.h"

namespace conelight::test {

// What this build can read, and the encoders can write.
bool packsDraco();
bool packsMeshopt();
bool packsWebp();

// A grid of (n+1)^2 vertices over a wavy square.
struct Sheet {
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec2> uvs;
    std::vector<std::uint32_t> indices;
};
Sheet sheet(int n);

// Each has no bytes where its encoder is missing.
struct DracoBytes {
    std::vector<char> bytes;
    std::size_t points = 0;
};
DracoBytes dracoBytes(const Sheet& from);
GltfBuilder dracoFile(const Sheet& from, const DracoBytes& packed);

// Indices as triangles, or as a sequence.
GltfBuilder meshoptFile(const Sheet& from, bool sequence);

// Four 8-bit numbers a texel, kept bit by bit.
std::vector<std::uint8_t> webpBytes(int width, int height, const std::vector<std::uint8_t>& rgba);
// A triangle whose texture is WebP (image 1, view 2) and PNG (image 0, view 1).
GltfBuilder webpFile(const std::vector<std::uint8_t>& webp, const std::string& png);

}  // namespace conelight::test
