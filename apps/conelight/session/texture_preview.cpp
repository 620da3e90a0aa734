// SPDX-License-Identifier: MIT
#include "session/texture_preview.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

namespace conelight::program {
namespace {

// Texels from a first to a last one that a pixel of the preview stands for.
std::array<int, 2> texelsOf(int pixel, int pixels, int texels) {
    const auto at = [&](int p) { return static_cast<int>(static_cast<long long>(p) * texels / pixels); };
    return {at(pixel), std::max(at(pixel + 1), at(pixel) + 1)};
}

const char* wrapName(TextureWrap wrap) {
    return wrap == TextureWrap::Repeat ? "repeated" : wrap == TextureWrap::Clamp ? "clamped" : "mirrored";
}

}  // namespace

glm::ivec2 previewSize(const Texture& texture, int most) {
    const glm::ivec2 size(texture.width, texture.height);
    const int longer = std::max(size.x, size.y);
    return longer <= most ? size : glm::max(size * most / longer, glm::ivec2(1));
}

std::vector<std::uint8_t> previewOf(const Texture& texture, const glm::ivec2& size, TextureChannel channel) {
    std::vector<std::uint8_t> rgb;
    rgb.reserve(3 * static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const auto [x0, x1] = texelsOf(x, size.x, texture.width);
            const auto [y0, y1] = texelsOf(y, size.y, texture.height);
            std::array<unsigned, 4> sum{};
            for (int v = y0; v < y1; ++v)
                for (int u = x0; u < x1; ++u)
                    for (std::size_t c = 0; c < 4; ++c)
                        sum[c] += texture.rgba[4 * (static_cast<std::size_t>(v) *
                                                        static_cast<std::size_t>(texture.width) +
                                                    static_cast<std::size_t>(u)) +
                                               c];
            const auto count = static_cast<unsigned>((x1 - x0) * (y1 - y0));
            for (std::size_t c = 0; c < 3; ++c) {
                const std::size_t from =
                    channel == TextureChannel::Color ? c : static_cast<std::size_t>(channel) - 1;
                rgb.push_back(static_cast<std::uint8_t>((sum[from] + count / 2) / count));
            }
        }
    return rgb;
}

std::vector<TextureUse> texturesOf(const Material& m) {
    return {{"base colour", m.baseColorTexture.texture},
            {"metallic and roughness", m.metallicRoughnessTexture.texture},
            {"normal", m.normalTexture.texture},
            {"emission", m.emissiveTexture.texture},
            {"specular", m.specularTexture.texture},
            {"specular colour", m.specularColorTexture.texture},
            {"transmission", m.transmissionTexture.texture},
            {"coat", m.coatTexture.texture},
            {"coat roughness", m.coatRoughnessTexture.texture},
            {"coat normal", m.coatNormalTexture.texture},
            {"sheen colour", m.sheenColorTexture.texture},
            {"sheen roughness", m.sheenRoughnessTexture.texture}};
}

std::string describe(const Texture& texture) {
    const std::string wrap = texture.wrapU == texture.wrapV
                                 ? wrapName(texture.wrapU)
                                 : fmt::format("{} and {}", wrapName(texture.wrapU), wrapName(texture.wrapV));
    return fmt::format("{}{}{} x {}, {}, {}{}", texture.name, texture.name.empty() ? "" : ", ", texture.width,
                       texture.height, texture.srgb ? "sRGB" : "linear", wrap,
                       texture.filter == TextureFilter::Nearest ? ", not filtered" : "");
}

}  // namespace conelight::program
