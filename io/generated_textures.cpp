// SPDX-License-Identifier: MIT
// Periodic noise and the textures built from it: (name, size) -> Texture. Colours are computed linear and
// encoded to sRGB (IEC 61966-2-1); normals come from central differences of a height field. Sizes, contrasts
// and colours were chosen by eye against photographs of the materials.
#include "generated_textures.h"

#include "io/generated_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/gtc/constants.hpp>
#include <utility>

namespace conelight::io::textures {
namespace {

std::uint8_t toByte(float x) { return std::uint8_t(std::clamp(x, 0.0f, 1.0f) * 255.0f + 0.5f); }

// sRGB encoding by a table: 4096 linear steps are below one 8-bit step everywhere but in the darkest 1 %.
std::uint8_t encodeSrgb(float linear) {
    static const auto kTable = [] {
        std::array<std::uint8_t, 4097> table{};
        for (std::size_t i = 0; i < table.size(); ++i) {
            const float x = float(i) / 4096.0f;
            table[i] = toByte(x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f);
        }
        return table;
    }();
    return kTable[std::size_t(std::clamp(linear, 0.0f, 1.0f) * 4096.0f + 0.5f)];
}

Texture emptyTexture(std::string name, int size, bool srgb) {
    Texture t;
    t.name = std::move(name);
    t.width = t.height = size;
    t.srgb = srgb;
    t.rgba.resize(4 * std::size_t(size) * std::size_t(size), 255);
    return t;
}

// Calls shade(uv) for every texel's centre.
template <class Shade>
Texture colorTexture(std::string name, int size, Shade shade) {
    Texture t = emptyTexture(std::move(name), size, true);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const glm::vec3 c = shade((glm::vec2(float(x), float(y)) + 0.5f) / float(size));
            for (int k = 0; k < 3; ++k)
                t.rgba[4 * std::size_t(y * size + x) + std::size_t(k)] = encodeSrgb(c[k]);
        }
    return t;
}

// A height field, periodic, in units of the texture's width.
struct HeightField {
    int size;
    std::vector<float> values;
    float at(int x, int y) const {
        return values[std::size_t(((y + size) % size) * size + (x + size) % size)];
    }
};

template <class Height>
HeightField heightField(int size, Height height) {
    HeightField field{size, std::vector<float>(std::size_t(size) * std::size_t(size))};
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            field.values[std::size_t(y * size + x)] =
                height((glm::vec2(float(x), float(y)) + 0.5f) / float(size));
    return field;
}

Texture normalTexture(std::string name, const HeightField& field) {
    Texture t = emptyTexture(std::move(name), field.size, false);
    const float perTexel = 0.5f * float(field.size);
    for (int y = 0; y < field.size; ++y)
        for (int x = 0; x < field.size; ++x) {
            // Rows run down, the bitangent up: its slope changes sign.
            const float slopeX = (field.at(x + 1, y) - field.at(x - 1, y)) * perTexel;
            const float slopeUp = (field.at(x, y - 1) - field.at(x, y + 1)) * perTexel;
            const glm::vec3 n = glm::normalize(glm::vec3(-slopeX, -slopeUp, 1));
            for (int k = 0; k < 3; ++k)
                t.rgba[4 * std::size_t(y * field.size + x) + std::size_t(k)] = toByte(0.5f + 0.5f * n[k]);
        }
    return t;
}

// Which cell of a running bond a point lies in, and how far it is from the cell's border.
struct Cell {
    int column, row;
    float border;  // in units of the texture's width
};

Cell bondCell(glm::vec2 uv, int columns, int rows, float shiftPerRow) {
    const float y = uv.y * float(rows);
    const int row = std::min(int(y), rows - 1);
    float x = uv.x * float(columns) + shiftPerRow * float(row % 2);
    x -= float(columns) * std::floor(x / float(columns));
    const int column = std::min(int(x), columns - 1);
    const float fx = x - float(column), fy = y - float(row);
    return {column, row, std::min(std::min(fx, 1 - fx) / float(columns), std::min(fy, 1 - fy) / float(rows))};
}

float smoothStep(float from, float to, float x) {
    const float t = std::clamp((x - from) / (to - from), 0.0f, 1.0f);
    return t * t * (3 - 2 * t);
}

float cellRandom(const Cell& cell, std::uint32_t seed) {
    return shapes::unitFloat(shapes::hash(std::uint32_t(cell.column), std::uint32_t(cell.row), seed));
}

// Veins of marble: 1 in a vein, 0 far from it. A ridge of noise, bent by coarser noise.
float veins(glm::vec2 uv, std::uint32_t seed) {
    const glm::vec2 bent =
        uv + 0.12f * glm::vec2(fractalNoise(uv, 3, 3, seed + 1), fractalNoise(uv, 3, 3, seed + 2));
    const float ridge = 1 - std::min(1.0f, 3.2f * std::abs(fractalNoise(bent, 2, 3, seed)));
    return ridge * ridge * ridge;
}

}  // namespace

float noise(glm::vec2 uv, int cells, std::uint32_t seed) {
    const glm::vec2 p = uv * float(cells);
    const glm::vec2 base = glm::floor(p);
    const glm::vec2 f = p - base;
    const auto wrapped = [cells](int i) {
        const int rest = i % cells;
        return rest < 0 ? rest + cells : rest;
    };
    const auto next = [cells](int i) { return i + 1 < cells ? i + 1 : 0; };
    const int x0 = wrapped(int(base.x)), y0 = wrapped(int(base.y));
    const std::uint32_t columns[2] = {std::uint32_t(x0), std::uint32_t(next(x0))};
    const std::uint32_t rows[2] = {std::uint32_t(y0), std::uint32_t(next(y0))};
    auto corner = [&](int dx, int dy) {
        const std::uint32_t h = shapes::hash(columns[dx], rows[dy], seed);
        // One of 16 directions: enough to hide the lattice, and no trigonometry per texel.
        constexpr float kC[16] = {1,  .92388f,  .70711f,  .38268f,  0, -.38268f, -.70711f, -.92388f,
                                  -1, -.92388f, -.70711f, -.38268f, 0, .38268f,  .70711f,  .92388f};
        const std::uint32_t k = h >> 28;
        return kC[k] * (f.x - float(dx)) + kC[(k + 12) & 15] * (f.y - float(dy));
    };
    const glm::vec2 w = f * f * f * (f * (f * 6.0f - 15.0f) + 10.0f);
    const float top = corner(0, 0) + (corner(1, 0) - corner(0, 0)) * w.x;
    const float bottom = corner(0, 1) + (corner(1, 1) - corner(0, 1)) * w.x;
    return top + (bottom - top) * w.y;
}

float fractalNoise(glm::vec2 uv, int cells, int octaves, std::uint32_t seed) {
    float sum = 0;
    float weight = 1;
    for (int i = 0; i < octaves; ++i) {
        sum += weight * noise(uv, cells << i, seed + 0x51u * std::uint32_t(i));
        weight *= 0.5f;
    }
    return sum;
}

Surface ashlar(int size) {
    constexpr std::uint32_t kSeed = 0xa51a;
    auto cellAt = [](glm::vec2 uv) {
        // Joints waver a little, by a thousandth of the tile.
        return bondCell(uv + 0.0015f * glm::vec2(noise(uv, 12, kSeed), noise(uv, 12, kSeed + 1)) + 1.0f -
                            glm::floor(uv + 1.0f),
                        2, 4, 0.5f);
    };
    Surface s;
    s.color = colorTexture("ashlar", size, [&](glm::vec2 uv) {
        const Cell cell = cellAt(glm::fract(uv));
        const float stain = fractalNoise(uv, 4, 4, kSeed + 2);
        const float grain = fractalNoise(uv, 32, 2, kSeed + 3);
        const float tone = 0.88f + 0.16f * (cellRandom(cell, kSeed) - 0.5f) + 0.10f * stain + 0.07f * grain;
        const float joint = 1 - smoothStep(0.0035f, 0.007f, cell.border);
        const glm::vec3 warm(1.0f, 0.96f - 0.05f * cellRandom(cell, kSeed + 9),
                             0.90f - 0.10f * cellRandom(cell, kSeed + 9));
        return tone * (1 - 0.35f * joint) * warm;
    });
    s.normal = normalTexture("ashlar normal", heightField(size, [&](glm::vec2 uv) {
                                 const Cell cell = cellAt(uv);
                                 return 0.008f * smoothStep(0.002f, 0.011f, cell.border) +
                                        0.0025f * fractalNoise(uv, 10, 4, kSeed + 4);
                             }));
    return s;
}

Surface tiles(int size) {
    constexpr std::uint32_t kSeed = 0x711e;
    constexpr float kJoint = 0.006f;
    auto cellAt = [](glm::vec2 uv) { return bondCell(uv, 2, 2, 0); };
    Surface s;
    s.color = colorTexture("tiles", size, [&](glm::vec2 uv) {
        const Cell cell = cellAt(uv);
        const bool dark = (cell.column + cell.row) % 2 != 0;
        const float vein = veins(uv, kSeed + (dark ? 40u : 0u));
        const float stain = 1 + 0.10f * fractalNoise(uv, 6, 4, kSeed + 3);
        const glm::vec3 stone =
            dark ? glm::mix(glm::vec3(0.30f, 0.15f, 0.11f), glm::vec3(0.50f, 0.40f, 0.33f), 0.5f * vein)
                 : glm::mix(glm::vec3(0.56f, 0.49f, 0.39f), glm::vec3(0.40f, 0.32f, 0.24f), 0.7f * vein);
        const glm::vec3 joint(0.24f, 0.21f, 0.18f);
        return glm::mix(joint, stone * stain, smoothStep(0.6f * kJoint, kJoint, cell.border));
    });
    s.normal = normalTexture("tiles normal", heightField(size, [&](glm::vec2 uv) {
                                 return 0.003f * smoothStep(0.3f * kJoint, 1.6f * kJoint, cellAt(uv).border) +
                                        0.0002f * fractalNoise(uv, 8, 2, kSeed + 7);
                             }));
    s.roughness = emptyTexture("tiles roughness", size, false);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const glm::vec2 uv = (glm::vec2(float(x), float(y)) + 0.5f) / float(size);
            const float wear =
                0.30f + 0.12f * fractalNoise(uv, 4, 3, kSeed + 5);  // polish, walked off in places
            const float polished = smoothStep(0.6f * kJoint, kJoint, cellAt(uv).border);
            s.roughness.rgba[4 * std::size_t(y * size + x) + 1] = toByte(0.9f + (wear - 0.9f) * polished);
        }
    return s;
}

Texture plaster(int size) {
    constexpr std::uint32_t kSeed = 0x91a5;
    return colorTexture("plaster", size, [](glm::vec2 uv) {
        const float cloud = fractalNoise(uv, 3, 4, kSeed);
        const float grain = noise(uv, 64, kSeed + 1);
        return glm::vec3(0.93f + 0.10f * cloud + 0.04f * grain) *
               glm::vec3(1, 0.99f + 0.02f * cloud, 0.97f + 0.04f * cloud);
    });
}

Texture marble(int size) {
    constexpr std::uint32_t kSeed = 0x3a2b;
    return colorTexture("marble", size, [](glm::vec2 uv) {
        const float vein = veins(uv, kSeed);
        const float cloud = fractalNoise(uv, 4, 3, kSeed + 5);
        return (0.95f + 0.06f * cloud) *
               glm::mix(glm::vec3(1.0f, 0.98f, 0.94f), glm::vec3(0.62f, 0.56f, 0.50f), 0.55f * vein);
    });
}

Texture fabric(int size) {
    constexpr std::uint32_t kSeed = 0xfab1;
    return colorTexture("fabric", size, [](glm::vec2 uv) {
        // 64 threads each way; rings and discs, four across, are woven a little brighter.
        const float pi = glm::pi<float>();
        const float weave = std::sin(2 * pi * 64 * uv.x) * std::sin(2 * pi * 64 * uv.y);
        const float lattice = std::abs(std::cos(4 * pi * uv.x)) + std::abs(std::cos(4 * pi * uv.y));
        const float band =
            smoothStep(0.14f, 0.06f, std::abs(lattice - 1.0f)) + smoothStep(0.30f, 0.22f, 2 - lattice);
        return glm::vec3(0.80f + 0.04f * weave + 0.16f * band + 0.05f * noise(uv, 16, kSeed));
    });
}

Texture wood(int size) {
    constexpr std::uint32_t kSeed = 0x300d;
    return colorTexture("wood", size, [](glm::vec2 uv) {
        // Four boards side by side; the grain is noise stretched along v.
        const Cell board = bondCell(uv, 4, 1, 0);
        const float shift = cellRandom(board, kSeed);
        const glm::vec2 along(uv.x, glm::fract(uv.y + shift));
        float grain = 0;
        for (int i = -1; i <= 1; ++i)
            grain += noise({along.x, along.y + 0.02f * float(i)}, 48, kSeed + 1) / 3;
        const float rings =
            std::sin(2 * glm::pi<float>() * (10 * uv.x + 0.6f * fractalNoise(along, 2, 3, kSeed + 2)));
        const float tone = 0.80f + 0.16f * (shift - 0.5f) + 0.08f * rings + 0.14f * grain;
        const float gap = smoothStep(0.001f, 0.005f, std::min(std::abs(board.border), 1.0f));
        return glm::vec3(tone) * glm::vec3(1, 0.97f, 0.93f) * (0.35f + 0.65f * gap);
    });
}

}  // namespace conelight::io::textures
