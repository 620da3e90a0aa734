// SPDX-License-Identifier: MIT
// What the tests of glTF share: built files loaded, or refused with a message; small pictures; near vectors.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "cpu/io_test_support.h"
#include "io/image_file.h"

namespace conelight::test {

inline constexpr float kTight = 1e-5f;  // a few float roundings of numbers near 1

inline Scene loadGlb(const GltfBuilder& builder, const std::string& name) {
    return io::loadScene(write(folderOf("gltf") / (name + ".glb"), builder.glb()));
}

inline std::string glbError(const GltfBuilder& builder, const std::string& name) {
    return loadError(write(folderOf("gltf") / (name + ".glb"), builder.glb()));
}

// A PNG of w x h equal texels.
inline std::string png(int w, int h, std::array<std::uint8_t, 4> texel) {
    io::ByteImage image{w, h, 4, {}};
    for (int i = 0; i < w * h; ++i) image.pixels.insert(image.pixels.end(), texel.begin(), texel.end());
    const std::filesystem::path path = folderOf("gltf") / "made.png";
    io::writePng(path, image);
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

inline void expectNear(const glm::vec3& a, const glm::vec3& b, float tolerance = kTight) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance) << "component " << c;
}

}  // namespace conelight::test
