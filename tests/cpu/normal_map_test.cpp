// SPDX-License-Identifier: MIT
// Normal maps as files hold them: lengths, and which textures are normal maps.
#include "scene/normal_map.h"

#include <gtest/gtest.h>

#include <cmath>

namespace conelight::test {
namespace {

glm::vec3 normalOf(const std::vector<std::uint8_t>& rgba, std::size_t texel) {
    return glm::vec3(rgba[4 * texel], rgba[4 * texel + 1], rgba[4 * texel + 2]) / 127.5f - 1.0f;
}

TEST(NormalMap, TexelsGetUnitLengthAndKeepTheirDirection) {
    // 3 % too short, upright; half as long, at a slant; longer than 1.
    const std::vector<std::uint8_t> rgba{127, 127, 251, 7, 160, 128, 183, 8, 230, 128, 240, 9};
    const std::vector<std::uint8_t> unit = scene::unitNormals(rgba);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(glm::length(normalOf(unit, i)), 1, 0.006) << i;
        EXPECT_GT(glm::dot(normalOf(unit, i), glm::normalize(normalOf(rgba, i))), 0.993) << i;
        EXPECT_EQ(unit[4 * i + 3], rgba[4 * i + 3]);
    }
}

TEST(NormalMap, UnitNormalsAndTexelsWithoutDirectionKeepTheirBytes) {
    const std::vector<std::uint8_t> rgba{128, 128, 255, 255, 218, 128, 218, 255, 127, 128, 128, 255};
    EXPECT_EQ(scene::unitNormals(rgba), rgba);
}

TEST(NormalMap, IsWhatMaterialsUseAsNothingElse) {
    Material a, b;
    a.normalTexture.texture = 0;
    a.baseColorTexture.texture = 1;
    b.coatNormalTexture.texture = 2;
    b.normalTexture.texture = 3;
    b.transmissionTexture.texture = 3;
    EXPECT_EQ(scene::normalMaps({a, b}, 5), (std::vector<bool>{true, false, true, false, false}));
}

}  // namespace
}  // namespace conelight::test
