// SPDX-License-Identifier: MIT
#include "scene/mip_levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "math/srgb.h"

namespace conelight::scene {
namespace {

constexpr float kFull = 65535;  // 16 bits: what 8 bits of sRGB tell apart near black is 20 steps of it

// Linear values of a level; the next is a mean of these, so that no rounding to 8 bits adds up.
struct LinearTexels {
    int width = 0, height = 0;
    std::vector<std::uint16_t> rgba;
};

// The texels of a row or column that one of the next level covers, and how much of it each is.
struct Covered {
    std::size_t first = 0;
    std::size_t count = 0;
    std::array<float, 3> shares{};
};

std::vector<Covered> coveredBy(int from, int to) {
    std::vector<Covered> all(static_cast<std::size_t>(to));
    const double size = static_cast<double>(from) / to;
    for (int i = 0; i < to; ++i) {
        Covered& c = all[static_cast<std::size_t>(i)];
        const double begin = i * size, end = (i + 1) * size;
        c.first = static_cast<std::size_t>(begin + 1e-9);
        const auto last = std::min<std::size_t>(static_cast<std::size_t>(std::ceil(end - 1e-9)),
                                                static_cast<std::size_t>(from));
        c.count = std::min<std::size_t>(last - c.first, c.shares.size());
        for (std::size_t k = 0; k < c.count; ++k) {
            const auto texel = static_cast<double>(c.first + k);
            c.shares[k] = static_cast<float>((std::min(end, texel + 1) - std::max(begin, texel)) / size);
        }
    }
    return all;
}

// `addRow(y, share, sums)` adds a share of row y of the larger level to `sums`, four numbers per texel.
template <class AddRow>
LinearTexels halved(int width, int height, const AddRow& addRow) {
    LinearTexels half{std::max(width / 2, 1), std::max(height / 2, 1), {}};
    half.rgba.reserve(4 * static_cast<std::size_t>(half.width) * static_cast<std::size_t>(half.height));
    const std::vector<Covered> columns = coveredBy(width, half.width);
    std::vector<float> sums(4 * static_cast<std::size_t>(width));
    for (const Covered& rows : coveredBy(height, half.height)) {
        std::fill(sums.begin(), sums.end(), 0.0f);
        for (std::size_t k = 0; k < rows.count; ++k) addRow(rows.first + k, rows.shares[k], sums);
        for (const Covered& column : columns)
            for (std::size_t c = 0; c < 4; ++c) {
                float sum = 0;
                for (std::size_t k = 0; k < column.count; ++k)
                    sum += column.shares[k] * sums[4 * (column.first + k) + c];
                half.rgba.push_back(static_cast<std::uint16_t>(std::min(sum + 0.5f, kFull)));
            }
    }
    return half;
}

LinearTexels halvedBytes(const std::vector<std::uint8_t>& rgba, int width, int height, bool srgb) {
    std::array<float, 256> color{}, alpha{};
    for (std::size_t i = 0; i < 256; ++i) {
        const float value = static_cast<float>(i) / 255.0f;
        alpha[i] = kFull * value;
        color[i] = srgb ? kFull * math::srgbToLinear(value) : alpha[i];
    }
    return halved(width, height, [&](std::size_t y, float share, std::vector<float>& sums) {
        const std::uint8_t* row = rgba.data() + y * sums.size();
        for (std::size_t i = 0; i < sums.size(); i += 4) {
            for (std::size_t c = 0; c < 3; ++c) sums[i + c] += share * color[row[i + c]];
            sums[i + 3] += share * alpha[row[i + 3]];
        }
    });
}

LinearTexels halvedLevel(const LinearTexels& level) {
    return halved(level.width, level.height, [&](std::size_t y, float share, std::vector<float>& sums) {
        const std::uint16_t* row = level.rgba.data() + y * sums.size();
        for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += share * static_cast<float>(row[i]);
    });
}

// 16 bits linear -> 8 bits as textures hold them.
std::vector<std::uint8_t> encodings(bool srgb) {
    std::vector<std::uint8_t> table(65536);
    for (std::size_t i = 0; i < table.size(); ++i) {
        const float value = static_cast<float>(i) / kFull;
        table[i] =
            static_cast<std::uint8_t>(std::lround(255.0f * (srgb ? math::linearToSrgb(value) : value)));
    }
    return table;
}

MipLevel encoded(const LinearTexels& level, bool srgb) {
    static const std::vector<std::uint8_t> kSrgb = encodings(true), kLinear = encodings(false);
    const std::vector<std::uint8_t>& color = srgb ? kSrgb : kLinear;
    MipLevel bytes{level.width, level.height, std::vector<std::uint8_t>(level.rgba.size())};
    for (std::size_t i = 0; i < level.rgba.size(); ++i)
        bytes.rgba[i] = (i % 4 == 3 ? kLinear : color)[level.rgba[i]];
    return bytes;
}

}  // namespace

std::vector<MipLevel> smallerLevels(const std::vector<std::uint8_t>& rgba, int width, int height, bool srgb) {
    std::vector<MipLevel> levels;
    if (width <= 1 && height <= 1) return levels;
    LinearTexels level = halvedBytes(rgba, width, height, srgb);
    for (; level.width > 1 || level.height > 1; level = halvedLevel(level))
        levels.push_back(encoded(level, srgb));
    levels.push_back(encoded(level, srgb));
    return levels;
}

}  // namespace conelight::scene
