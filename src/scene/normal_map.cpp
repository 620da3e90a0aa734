// SPDX-License-Identifier: MIT
#include "scene/normal_map.h"

#include <cmath>

#include "shared/scene.h"

namespace conelight::scene {
namespace {

constexpr float kLeast = 0.1f;  // shorter ones have no direction

std::uint8_t byteOf(float component) {
    return static_cast<std::uint8_t>(std::lround((component + 1) * 127.5f));
}

}  // namespace

std::vector<std::uint8_t> unitNormals(const std::vector<std::uint8_t>& rgba) {
    std::vector<std::uint8_t> unit = rgba;
    for (std::size_t i = 0; i + 3 < unit.size(); i += 4) {
        const glm::vec3 n = glm::vec3(unit[i], unit[i + 1], unit[i + 2]) / 127.5f - 1.0f;
        const float length = glm::length(n);
        if (std::abs(length - 1) <= UNIT_NORMAL_ROUNDING || length < kLeast) continue;
        for (int c = 0; c < 3; ++c) unit[i + static_cast<std::size_t>(c)] = byteOf(n[c] / length);
    }
    return unit;
}

std::vector<bool> normalMaps(const std::vector<Material>& materials, std::size_t textures) {
    std::vector<bool> asNormals(textures, false), asOther(textures, false);
    const auto mark = [](std::vector<bool>& as, const TextureRef& use) {
        if (use.used()) as[static_cast<std::size_t>(use.texture)] = true;
    };
    for (const Material& m : materials) {
        for (const TextureRef* use : {&m.normalTexture, &m.coatNormalTexture}) mark(asNormals, *use);
        for (const TextureRef* use :
             {&m.baseColorTexture, &m.metallicRoughnessTexture, &m.emissiveTexture, &m.specularTexture,
              &m.specularColorTexture, &m.transmissionTexture, &m.coatTexture, &m.coatRoughnessTexture,
              &m.sheenColorTexture, &m.sheenRoughnessTexture})
            mark(asOther, *use);
    }
    for (std::size_t i = 0; i < textures; ++i) asNormals[i] = asNormals[i] && !asOther[i];
    return asNormals;
}

}  // namespace conelight::scene
