// SPDX-License-Identifier: MIT
// What hangs, stands and grows in the atrium: curtains, banners, fountain, pots, shrubs, lanterns. Detail ->
// pieces in object space. Cloth is a sum of waves, not a simulation: folds get deeper where the cloth is
// gathered.
#include "io/generated_atrium.h"

#include <algorithm>
#include <glm/gtc/constants.hpp>

namespace conelight::io::generated::atrium {
namespace {

using shapes::arc;
using shapes::Curve;
using shapes::line;
using shapes::Patch;
constexpr float kHalfTurn = 0.5f * glm::pi<float>();

// Heights of a curtain: from the rod to 5 cm above the floor, tied at three fifths of the way down.
constexpr float kCurtainLength = kSpring - 0.10f - 0.05f;
constexpr float kTie = 0.58f;
constexpr float kCurtainLeft = -1.10f;

float smooth(float t) {
    t = std::clamp(t, 0.0f, 1.0f);
    return t * t * (3 - 2 * t);
}

// Free edge of a tied curtain at the fraction `down` of its length: sweeps to the tie, then falls and
// spreads.
float curtainEdge(float down) {
    if (down < kTie) return -0.03f - 0.80f * smooth(std::pow(std::max(down, 0.0f) / kTie, 1.25f));
    return -0.83f + 0.24f * smooth((down - kTie) / 0.30f);
}

float wobble(int seed, int k) {
    return shapes::unitFloat(shapes::hash(std::uint32_t(seed), std::uint32_t(k)));
}

// One leaf: a bent, pointed patch from `root` along `along`, its upper side toward `up`.
Patch leaf(glm::vec3 root, glm::vec3 along, glm::vec3 up, float length, int nu, int nv) {
    Patch patch;
    patch.nu = nu;
    patch.nv = nv;
    const glm::vec3 side = glm::normalize(glm::cross(along, up));
    const glm::vec3 top = glm::cross(side, along);
    patch.uvScale = {0.3f * length, length};
    patch.position = [=](float u, float v) {
        const float s = 2 * u - 1;
        const float width =
            0.24f * length * std::sin(glm::pi<float>() * std::pow(std::clamp(v, 0.0f, 1.0f), 0.75f)) +
            0.004f * length;
        const float bend = length * (-0.30f * v * v + 0.06f * s * s);
        return root + along * (length * v) + side * (s * width) + top * bend;
    };
    return patch;
}

}  // namespace

std::vector<Piece> curtainHalf(const Detail& detail, int seed) {
    Patch patch;
    patch.nu = detail.pieces(72, 8);
    patch.nv = detail.pieces(36, 4);
    patch.uvScale = {1.6f, kCurtainLength};
    const float phase = 2 * glm::pi<float>() * wobble(seed, 0), drift = 0.03f + 0.03f * wobble(seed, 1);
    // Seven folds at most, and never more than the grid can show.
    const float folds = float(std::clamp(patch.nu / 9, 2, 7));
    const bool fine = patch.nu >= 100;
    patch.position = [=](float u, float v) {
        const float down = 1 - v;
        const float edge = curtainEdge(down);
        const float width = edge - kCurtainLeft;
        const float gathered = 1 - width / 1.1f;
        // Folds whose spacing varies along the rod, a finer wave on top of them.
        const float warped = u + drift * std::sin(2 * glm::pi<float>() * u + phase);
        const float fold = std::sin(2 * glm::pi<float>() * folds * warped + phase) +
                           (fine ? 0.25f * std::sin(2 * glm::pi<float>() * 13 * warped + 3 * down) : 0.0f);
        const float pinch = 1 - 0.65f * std::exp(-std::pow((down - kTie) / 0.05f, 2.0f));
        const float depth = (0.030f + 0.055f * gathered) * pinch * (0.75f + 0.25f * smooth(down * 6));
        const float swing = 0.02f * std::sin(4.2f * down + phase) * down;
        // Folds lean over, but never so far that the cloth turns back.
        const float lean = std::min(0.12f * depth, 0.25f * width / (4 * glm::pi<float>() * folds));
        // Hems sag between the folds.
        const float hem =
            0.012f * std::cos(2 * glm::pi<float>() * folds * warped + phase) * smooth((down - 0.9f) * 10);
        return glm::vec3(kCurtainLeft + width * u + lean * std::cos(4 * glm::pi<float>() * folds * warped),
                         -kCurtainLength * down + hem, depth * fold + swing);
    };
    return {piece(std::move(patch))};
}

std::vector<Piece> curtainTie(const Detail& detail) {
    // A band around the gathered cloth, elliptical, a little lower at the front.
    Patch patch;
    patch.nu = detail.pieces(28, 8);
    patch.nv = detail.pieces(4, 1);
    patch.uvScale = {0.8f, 0.07f};
    patch.position = [](float u, float v) {
        const float a = 2 * glm::pi<float>() * u;
        const float bulge = 0.012f * std::sin(glm::pi<float>() * v);
        return glm::vec3(kCurtainLeft + 0.135f + (0.175f + bulge) * std::sin(a),
                         -kCurtainLength * kTie + 0.08f * (v - 0.5f) - 0.03f * std::sin(a),
                         (0.075f + bulge) * std::cos(a));
    };
    return {piece(std::move(patch))};
}

std::vector<Piece> rod(const Detail& detail, float halfLength) {
    Patch patch;
    patch.nu = detail.pieces(12, 5);
    patch.nv = 1;
    patch.uvScale = {0.1f, 2 * halfLength};
    patch.position = [=](float u, float v) {
        const float a = 2 * glm::pi<float>() * u;
        return glm::vec3(halfLength * (2 * v - 1), 0.018f * std::sin(a), -0.018f * std::cos(a));
    };
    return {piece(std::move(patch))};
}

std::vector<Piece> banner(const Detail& detail, float width, float length, int seed) {
    Patch patch;
    patch.nu = detail.pieces(24, 4);
    patch.nv = detail.pieces(32, 5);
    patch.uvScale = {width, length};
    const float phase = 2 * glm::pi<float>() * wobble(seed, 7);
    patch.position = [=](float u, float v) {
        const float down = 1 - v, side = 2 * u - 1;
        // A soft fold along the length, a breath of wind across it, and a pointed hem.
        const float wave =
            0.05f * down * std::sin(2 * glm::pi<float>() * (0.9f * u + 0.35f * down) + phase) +
            0.02f * std::sin(2 * glm::pi<float>() * (2.1f * u - 0.5f * down) + 2 * phase) * smooth(3 * down);
        const float point = 0.22f * width * (1 - std::abs(side)) * smooth((down - 0.6f) / 0.4f);
        return glm::vec3(0.5f * width * side * (1 - 0.04f * down), -length * down - point, wave);
    };
    return {piece(std::move(patch))};
}

std::vector<Piece> fountainStone(const Detail& detail) {
    const int around = detail.pieces(72, 8);
    const int round = detail.pieces(8, 2);
    const std::vector<Curve> basin{
        line({1.48f, 0}, {1.48f, 0.13f}),
        line({1.48f, 0.13f}, {1.33f, 0.13f}),
        arc({1.33f, 0.23f}, {0.10f, 0.10f}, -kHalfTurn, -2 * kHalfTurn, round),
        line({1.23f, 0.23f}, {1.23f, 0.44f}),
        line({1.23f, 0.44f}, {1.29f, 0.47f}),
        arc({1.29f, 0.53f}, {0.06f, 0.06f}, -kHalfTurn, kHalfTurn, round),
        line({1.29f, 0.59f}, {1.12f, 0.59f}),
        line({1.12f, 0.59f}, {1.12f, 0.20f}),
        line({1.12f, 0.20f}, {0.30f, 0.20f}),
    };
    const std::vector<Curve> stem{
        line({0.30f, 0.20f}, {0.30f, 0.34f}),
        line({0.30f, 0.34f}, {0.22f, 0.40f}),
        Curve{detail.pieces(14, 3),
              [](float t) {
                  return glm::vec2(
                      0.11f + 0.07f * std::exp(-std::pow((t - 0.25f) / 0.22f, 2.0f)) + 0.03f * t * t,
                      0.40f + 0.62f * t);
              }},
        arc({0.10f, 1.36f}, {0.553f, 0.34f}, -0.93f * kHalfTurn, -0.16f * kHalfTurn, round),
        arc({0.635f, 1.30f}, {0.03f, 0.025f}, -kHalfTurn, 2 * kHalfTurn, round),
        arc({0.10f, 1.36f}, {0.517f, 0.28f}, -0.14f * kHalfTurn, -0.93f * kHalfTurn, round),
        Curve{detail.pieces(10, 3),
              [](float t) {
                  return glm::vec2(0.05f + 0.035f * std::sin(glm::pi<float>() * t * 1.6f) * (1 - 0.5f * t),
                                   1.09f + 0.46f * t);
              }},
        arc({0, 1.60f}, {0.085f, 0.085f}, -0.7f * kHalfTurn, kHalfTurn, round),
    };
    std::vector<Piece> pieces;
    addPatches(pieces, shapes::lathe(basin, around, 1.3f));
    addPatches(pieces, shapes::lathe(stem, detail.pieces(40, 5), 0.3f));
    return pieces;
}

std::vector<Piece> fountainWater(const Detail& detail) {
    // Rings that die away from the falling drops: 3 mm high, one every 11 cm.
    const auto surface = [&](float radius, float y, float ripple, int rings) {
        return Curve{detail.pieces(float(rings), 1), [=](float t) {
                         const float r = radius * (1 - t);
                         return glm::vec2(r, y + ripple * std::cos(2 * glm::pi<float>() * r / 0.11f) *
                                                     std::exp(-1.6f * r));
                     }};
    };
    std::vector<Piece> pieces;
    addPatches(pieces, shapes::lathe({surface(1.125f, 0.50f, 0.003f, 60)}, detail.pieces(64, 8), 1));
    addPatches(pieces, shapes::lathe({surface(0.59f, 1.27f, 0.001f, 12)}, detail.pieces(40, 5), 0.5f));
    return pieces;
}

std::vector<Piece> pot(const Detail& detail) {
    const int round = detail.pieces(6, 2);
    const std::vector<Curve> profile{
        line({0.20f, 0}, {0.21f, 0.03f}),
        Curve{detail.pieces(10, 2),
              [](float t) { return glm::vec2(0.21f + 0.08f * std::sin(kHalfTurn * t), 0.03f + 0.40f * t); }},
        arc({0.29f, 0.475f}, {0.045f, 0.045f}, -kHalfTurn, kHalfTurn, round),
        line({0.29f, 0.52f}, {0.255f, 0.52f}),
        line({0.255f, 0.52f}, {0.25f, 0.45f}),
        line({0.25f, 0.45f}, {0, 0.47f}),
    };
    std::vector<Piece> pieces;
    addPatches(pieces, shapes::lathe(profile, detail.pieces(36, 5), 0.28f));
    return pieces;
}

std::vector<Piece> shrub(const Detail& detail, int seed) {
    // Leaves on the outer half of an ellipsoid. Fewer leaves are bigger leaves: the covered area stays.
    constexpr float kFullCount = 420;
    constexpr int kMostLeaves = 12000;
    const int count = detail.count(kFullCount, 16, kMostLeaves);
    const float size = 0.15f * std::pow(kFullCount / float(count), 0.4f);
    const int nu = detail.scale() > 0.5f ? 2 : 1;
    const int nv = count == kMostLeaves ? detail.pieces(0.6f, 3) : 2;
    const std::size_t each = 2 * std::size_t(nu) * std::size_t(nv);
    return {
        {each * std::size_t(count), [=](Mesh& mesh) {
             for (int i = 0; i < count; ++i) {
                 auto random = [&](int k) {
                     return shapes::unitFloat(
                         shapes::hash(std::uint32_t(i), std::uint32_t(k), std::uint32_t(seed)));
                 };
                 const float y = 2 * random(0) - 1, a = 2 * glm::pi<float>() * random(1);
                 const float ring = std::sqrt(std::max(0.0f, 1 - y * y));
                 const glm::vec3 out(ring * std::sin(a), y, ring * std::cos(a));
                 // Growth: outward and up, and sideways by chance.
                 glm::vec3 along = out + glm::vec3(0, 0.35f, 0) +
                                   1.1f * (glm::vec3(random(2), random(3), random(4)) - 0.5f);
                 along = glm::normalize(along + 0.01f);
                 glm::vec3 up = glm::normalize(out + glm::vec3(0.01f, 0.8f, 0.02f));
                 if (std::abs(glm::dot(along, up)) > 0.95f)
                     up = glm::normalize(glm::cross(along, glm::vec3(0.3f, 0.1f, 0.9f)));
                 const glm::vec3 root = glm::vec3(0, 0.92f, 0) + out * glm::vec3(0.36f, 0.44f, 0.36f) *
                                                                     (0.55f + 0.40f * std::sqrt(random(5)));
                 shapes::appendPatch(mesh, leaf(root, along, up, size * (0.75f + 0.5f * random(6)), nu, nv));
             }
         }}};
}

std::vector<Piece> lantern(const Detail& detail) {
    // A chain (as a thin rod), a hood and a foot; the glass hangs at the origin.
    std::vector<Piece> pieces;
    const int around = detail.pieces(24, 4);
    addPatches(pieces, shapes::lathe({line({0.008f, 0.22f}, {0.008f, 1.22f})}, detail.pieces(8, 3), 0.01f));
    addPatches(pieces, shapes::lathe({line({0, 0.11f}, {0.14f, 0.11f}), line({0.14f, 0.11f}, {0.14f, 0.125f}),
                                      Curve{detail.pieces(8, 2),
                                            [](float t) {
                                                return glm::vec2(
                                                    0.14f * (1 - t) * (1 - 0.4f * t) + 0.008f * t,
                                                    0.125f + 0.10f * t);
                                            }}},
                                     around, 0.14f));
    addPatches(pieces,
               shapes::lathe({line({0, -0.14f}, {0.05f, -0.12f}), line({0.05f, -0.12f}, {0.07f, -0.10f}),
                              line({0.07f, -0.10f}, {0, -0.09f})},
                             around, 0.07f));
    return pieces;
}

std::vector<Piece> lanternGlass(const Detail& detail) {
    return {piece(
        shapes::uvSphere(glm::vec3(0), glm::vec3(kGlassRadius), detail.pieces(24, 6), detail.pieces(12, 4)))};
}

}  // namespace conelight::io::generated::atrium
