// SPDX-License-Identifier: MIT
// What carries the atrium: columns, piers, arches, vaults, balusters, cornices. Detail -> pieces in object
// space. Profiles follow the classical orders (torus, scotia, bell, abacus); sizes in metres, by eye.
#include "io/generated_atrium.h"

#include <array>
#include <glm/gtc/constants.hpp>

namespace conelight::io::generated::atrium {
namespace {

using shapes::arc;
using shapes::Curve;
using shapes::line;
using shapes::Patch;
constexpr float kShaftBottom = 0.36f;  // on top of the base
constexpr float kShaftTop = 2.52f;     // under the capital
constexpr float kShaftRadius = 0.20f;
constexpr float kTaper = 0.17f;  // of the radius, from bottom to top

Mesh boxMesh(glm::vec3 lo, glm::vec3 hi) { return box({lo, hi}); }

// A slab with a square plan around the y axis.
Mesh slab(float half, float y0, float y1) { return boxMesh({-half, y0, -half}, {half, y1, half}); }

// One acanthus leaf: rises along the bell from `foot`, bulges, and curls outward at its tip.
Patch capitalLeaf(const Detail& detail, float angle, float foot, float height, float bellRadius) {
    Patch patch;
    patch.nu = detail.pieces(6, 2);
    patch.nv = detail.pieces(8, 3);
    patch.uvScale = {0.15f, height};
    patch.position = [=](float u, float v) {
        const float side = 2 * u - 1;
        // Widest at a third of the height, pointed at the tip; the rim is toothed.
        const float tooth = 1 + 0.10f * std::cos(9 * glm::pi<float>() * v);
        const float halfWidth =
            0.062f * tooth * std::sqrt(std::max(0.02f, 1 - std::pow(std::abs(v - 0.3f) / 0.72f, 2.4f)));
        const float curl = std::max(0.0f, v - 0.62f) / 0.38f;
        const float out = bellRadius + 0.018f + 0.030f * v + 0.075f * curl * curl - 0.022f * side * side;
        const float up = foot + height * (v - 0.24f * curl * curl * v);
        const float a = angle + side * halfWidth / bellRadius;
        return glm::vec3(out * std::sin(a), up, out * std::cos(a));
    };
    return patch;
}

// How an arch is cut: at the directions of its panel's upper corners, and evenly between them, so that faces
// and mouldings share their vertices.
struct ArchCuts {
    std::array<float, 4> angles;  // left spring, left corner, right corner, right spring
    std::array<int, 3> pieces;
    int total() const { return pieces[0] + pieces[1] + pieces[2]; }
    // Angle after the fraction u of all pieces; goes on evenly outside of [0,1].
    float angleAt(float u) const {
        const float cut = u * float(total());
        float before = 0;
        std::size_t part = 0;
        while (part < 2 && cut > before + float(pieces[part])) before += float(pieces[part++]);
        return angles[part] + (angles[part + 1] - angles[part]) * (cut - before) / float(pieces[part]);
    }
};

ArchCuts archCuts(const Detail& detail, const ArchPanel& p) {
    const int side = detail.pieces(10, 1);
    return {
        {glm::pi<float>(), std::atan2(p.height, p.x0 - p.centre), std::atan2(p.height, p.x1 - p.centre), 0},
        {side, detail.pieces(16, 4), side}};
}

// Left, top and right part of the panel's face at z: from the arch's rim to the rectangle around it.
void addArchFace(std::vector<Piece>& pieces, const Detail& detail, const ArchPanel& p, float z) {
    const ArchCuts cuts = archCuts(detail, p);
    for (std::size_t part = 0; part < 3; ++part) {
        Patch patch;
        patch.nu = cuts.pieces[part];
        patch.nv = 1;
        patch.flip = z < 0;
        patch.uvOf = [](glm::vec3 q) { return glm::vec2(q.x, -q.y); };
        patch.position = [=](float u, float v) {
            const float a = cuts.angles[part] + (cuts.angles[part + 1] - cuts.angles[part]) * u;
            const glm::vec2 d(std::cos(a), std::sin(a));
            // Along the ray from the centre to the side of the rectangle that this part belongs to.
            const float outer = part == 0   ? (p.x0 - p.centre) / d.x
                                : part == 1 ? p.height / d.y
                                            : (p.x1 - p.centre) / d.x;
            return glm::vec3(glm::vec2(p.centre, 0) + d * (p.radius + (outer - p.radius) * v), z);
        };
        pieces.push_back(piece(std::move(patch)));
    }
}

// A strip along the half circle: radius and z are functions of v.
Patch archStrip(const ArchCuts& cuts, float centre, const Curve& radiusAndZ) {
    Patch patch;
    patch.nu = cuts.total();
    patch.nv = radiusAndZ.n;
    patch.uvScale = {glm::pi<float>() * radiusAndZ.at(0).x, radiusAndZ.length()};
    patch.position = [=, at = radiusAndZ.at](float u, float v) {
        const glm::vec2 p = at(v);
        const float a = cuts.angleAt(u);
        return glm::vec3(centre + p.x * std::cos(a), p.x * std::sin(a), p.y);
    };
    return patch;
}

}  // namespace

std::vector<Piece> columnShaft(const Detail& detail) {
    // Twenty flutes need at least six pieces each to look round; below that the shaft is plain.
    constexpr int kFlutes = 20;
    const int perFlute = int(std::lround(detail.scale() * 5));
    const bool fluted = perFlute >= 6;
    Patch patch;
    patch.nu = fluted ? kFlutes * perFlute : detail.pieces(40, 6);
    patch.nv = detail.pieces(fluted ? 10 : 6, 1);
    patch.uvScale = {2 * glm::pi<float>() * kShaftRadius, kShaftTop - kShaftBottom};
    patch.position = [fluted](float u, float v) {
        const float ends = std::min(1.0f, 14 * std::min(v, 1 - v));  // flutes run out before the ends
        const float wave = std::abs(std::sin(glm::pi<float>() * kFlutes * u));
        const float depth = fluted ? 0.012f * wave * ends : 0.0f;
        const float r = kShaftRadius * (1 - kTaper * std::pow(std::max(v, 0.0f), 1.7f)) - depth;  // entasis
        const float a = 2 * glm::pi<float>() * u;
        return glm::vec3(r * std::sin(a), kShaftBottom + (kShaftTop - kShaftBottom) * v, r * std::cos(a));
    };
    return {piece(std::move(patch))};
}

std::vector<Piece> columnTrim(const Detail& detail) {
    std::vector<Piece> pieces;
    const int around = detail.pieces(40, 8);
    const int round = detail.pieces(8, 2);
    if (!detail.rich()) {
        const int sides = detail.pieces(40, 6);
        pieces.push_back(piece(slab(0.30f, 0, 0.12f)));
        addPatches(pieces, shapes::lathe({line({0.27f, 0.12f}, {0.20f, kShaftBottom})}, sides, 0.24f));
        addPatches(pieces,
                   shapes::lathe({line({kShaftRadius * (1 - kTaper), kShaftTop}, {0.27f, kSpring - 0.10f})},
                                 sides, 0.2f));
        pieces.push_back(piece(slab(0.305f, kSpring - 0.10f, kSpring)));
        return pieces;
    }
    // Attic base: plinth, torus, scotia, torus, fillet.
    pieces.push_back(piece(slab(0.30f, 0, 0.12f)));
    const float h = 0.5f * glm::pi<float>();
    addPatches(pieces, shapes::lathe({arc({0.24f, 0.165f}, {0.045f, 0.045f}, -h, h, round),
                                      arc({0.262f, 0.25f}, {0.045f, 0.04f}, -h, -3 * h, round),
                                      arc({0.225f, 0.318f}, {0.028f, 0.028f}, -h, h, round),
                                      line({0.225f, 0.346f}, {0.212f, 0.346f}),
                                      line({0.212f, 0.346f}, {0.212f, kShaftBottom}),
                                      line({0.212f, kShaftBottom}, {0.19f, kShaftBottom})},
                                     around, 0.24f));
    // Capital: astragal, bell, two rings of leaves, abacus of two slabs.
    const float neck = kShaftRadius * (1 - kTaper);
    addPatches(pieces, shapes::lathe({arc({neck, kShaftTop + 0.02f}, {0.022f, 0.022f}, -h, h, round),
                                      Curve{round + 1,
                                            [=](float t) {
                                                return glm::vec2(neck + 0.015f + 0.085f * t * t * t,
                                                                 kShaftTop + 0.04f + 0.34f * t);
                                            }}},
                                     around, neck));
    if (detail.scale() > 0.3f)
        for (int i = 0; i < 16; ++i) {
            const bool upper = i % 2 != 0;
            pieces.push_back(piece(capitalLeaf(detail, 2 * glm::pi<float>() * float(i) / 16,
                                               kShaftTop + (upper ? 0.10f : 0.03f), upper ? 0.25f : 0.20f,
                                               neck + (upper ? 0.02f : 0.008f))));
        }
    pieces.push_back(piece(slab(0.275f, kSpring - 0.10f, kSpring - 0.05f)));
    pieces.push_back(piece(slab(0.305f, kSpring - 0.05f, kSpring)));
    return pieces;
}

std::vector<Piece> colonnette(const Detail& detail) {
    const int around = detail.pieces(24, 6);
    const int round = detail.pieces(5, 1);
    const float h = 0.5f * glm::pi<float>();
    const float top = kUpperSpring - kGallery;
    if (!detail.rich()) {
        std::vector<Piece> plain{piece(boxMesh({-0.13f, top - 0.09f, -0.19f}, {0.13f, top, 0.19f}))};
        addPatches(plain,
                   shapes::lathe({line({0.07f, 0}, {0.065f, top - 0.09f})}, detail.pieces(24, 5), 0.07f));
        return plain;
    }
    std::vector<Piece> pieces;
    pieces.push_back(piece(slab(0.12f, 0, 0.07f)));
    addPatches(
        pieces,
        shapes::lathe(
            {arc({0.085f, 0.095f}, {0.025f, 0.025f}, -h, h, round), line({0.085f, 0.12f}, {0.07f, 0.12f}),
             line({0.07f, 0.12f}, {0.062f, top - 0.28f}, detail.pieces(4, 1)),
             arc({0.062f, top - 0.265f}, {0.015f, 0.015f}, -h, h, round),
             Curve{round + 1,
                   [=](float t) { return glm::vec2(0.062f + 0.05f * t * t, top - 0.25f + 0.16f * t); }}},
            around, 0.07f));
    pieces.push_back(piece(boxMesh({-0.13f, top - 0.09f, -0.19f}, {0.13f, top, 0.19f})));
    return pieces;
}

std::vector<Piece> pier(const Detail& detail, float halfWidth, float height) {
    if (!detail.rich())
        return {piece(slab(halfWidth, 0, height - 0.14f)),
                piece(slab(halfWidth + 0.06f, height - 0.14f, height))};
    std::vector<Piece> pieces;
    pieces.push_back(piece(slab(halfWidth + 0.05f, 0, 0.18f)));
    pieces.push_back(piece(slab(halfWidth + 0.025f, 0.18f, 0.26f)));
    pieces.push_back(piece(slab(halfWidth, 0.26f, height - 0.20f)));
    pieces.push_back(piece(slab(halfWidth + 0.02f, height - 0.20f, height - 0.14f)));
    pieces.push_back(piece(slab(halfWidth + 0.04f, height - 0.14f, height - 0.06f)));
    pieces.push_back(piece(slab(halfWidth + 0.06f, height - 0.06f, height)));
    return pieces;
}

std::vector<Piece> archFaces(const Detail& detail, const ArchPanel& panel) {
    std::vector<Piece> pieces;
    const float z = 0.5f * panel.depth;
    addArchFace(pieces, detail, panel, z);
    addArchFace(pieces, detail, panel, -z);
    // What rests on the supports.
    for (const glm::vec2& span :
         {glm::vec2(panel.x0, panel.centre - panel.radius), glm::vec2(panel.centre + panel.radius, panel.x1)})
        if (span.y - span.x > 1e-3f)
            pieces.push_back(piece(quad({span.x, 0, -z}, {span.y - span.x, 0, 0}, {0, 0, panel.depth})));
    return pieces;
}

std::vector<Piece> archRim(const Detail& detail, const ArchPanel& panel, float rimWidth) {
    // Underside from the back to 3 cm before the front; then the archivolt: a fillet, a roll, a fillet.
    std::vector<Piece> pieces;
    const float r = panel.radius, back = -0.5f * panel.depth, front = 0.5f * panel.depth;
    const float proud = 0.2f * rimWidth;
    const int round = detail.pieces(6, 1);
    const float h = 0.5f * glm::pi<float>();
    const Curve curves[] = {
        line({r, back}, {r, detail.rich() ? front + proud : front}),
        line({r, front + proud}, {r + 0.55f * rimWidth, front + proud}),
        arc({r + 0.75f * rimWidth, front + proud}, {0.2f * rimWidth, 0.2f * rimWidth}, 2 * h, 0, round),
        line({r + 0.95f * rimWidth, front + proud}, {r + rimWidth, front}),
    };
    for (const Curve& curve : curves) {
        pieces.push_back(piece(archStrip(archCuts(detail, panel), panel.centre, curve)));
        if (!detail.rich()) break;  // the underside only
    }
    return pieces;
}

std::vector<Piece> vault(const Detail& detail) {
    // A groin vault is the union of two barrels; each of four sectors is a piece of one barrel, cut along the
    // groins: height = sqrt(h^2 - z^2) where |z| <= x. Seen from below.
    const float h = 0.5f * kBay;
    std::vector<Piece> pieces;
    for (int sector = 0; sector < 4; ++sector) {
        Patch patch;
        patch.nu = detail.pieces(20, 4);  // fewer would cut the corner below the arches
        patch.nv = detail.pieces(10, 2);
        const float c = sector == 0 ? 1.0f : sector == 2 ? -1.0f : 0.0f;
        const float s = sector == 1 ? 1.0f : sector == 3 ? -1.0f : 0.0f;
        patch.flip = true;
        patch.uvOf = [](glm::vec3 p) { return glm::vec2(p.x, p.z); };
        patch.position = [=](float u, float v) {
            const float psi = 0.5f * glm::pi<float>() * v;
            const float phi = (2 * u - 1) * psi;
            const float x = h * std::sin(psi), z = h * std::sin(phi);
            return glm::vec3(c * x - s * z, h * std::cos(phi), s * x + c * z);
        };
        pieces.push_back(piece(std::move(patch)));
    }
    return pieces;
}

std::vector<Piece> rib(const Detail& detail) {
    // A band under the vault; its sides vanish in the vault at the radius of a half bay.
    constexpr float kHalfDepth = 0.2f;
    const float outer = 0.5f * kBay + 0.04f;
    std::vector<Piece> pieces;
    const Curve curves[] = {line({outer, -kHalfDepth}, {kArchRadius, -kHalfDepth}),
                            line({kArchRadius, -kHalfDepth}, {kArchRadius, kHalfDepth}),
                            line({kArchRadius, kHalfDepth}, {outer, kHalfDepth})};
    const ArchCuts cuts{{glm::pi<float>(), 2 * glm::pi<float>() / 3, glm::pi<float>() / 3, 0},
                        {detail.pieces(12, 2), detail.pieces(12, 2), detail.pieces(12, 2)}};
    for (const Curve& curve : curves) pieces.push_back(piece(archStrip(cuts, 0, curve)));
    for (float side : {-1.0f, 1.0f}) {
        const float x = side > 0 ? kArchRadius : -outer;
        pieces.push_back(
            piece(quad({x, 0, -kHalfDepth}, {outer - kArchRadius, 0, 0}, {0, 0, 2 * kHalfDepth})));
    }
    return pieces;
}

std::vector<Piece> baluster(const Detail& detail) {
    // A vase between two square blocks, 0.66 m from rail to rail.
    std::vector<Piece> pieces;
    pieces.push_back(piece(slab(0.055f, 0, 0.07f)));
    Curve body{detail.pieces(18, 3), [](float t) {
                   const float belly = std::exp(-std::pow((t - 0.27f) / 0.17f, 2.0f));
                   const float lip = std::exp(-std::pow((t - 0.86f) / 0.045f, 2.0f)) +
                                     std::exp(-std::pow((t - 0.02f) / 0.04f, 2.0f));
                   return glm::vec2(0.022f + 0.036f * belly + 0.018f * lip, 0.07f + 0.52f * t);
               }};
    addPatches(pieces, shapes::lathe({body}, detail.pieces(16, 4), 0.04f));
    pieces.push_back(piece(slab(0.055f, 0.59f, 0.66f)));
    return pieces;
}

std::vector<Piece> cornice(const Detail& detail, float y, float height, float projection, float inset) {
    // Profile in (out, up) from the wall at out = 0: cavetto, fillet, ovolo, fascia, and the top back to the
    // wall.
    const float p = projection, h = height, q = 0.5f * glm::pi<float>();
    const int round = detail.pieces(8, 2);
    const std::vector<Curve> profile{line({0, 0}, {0.15f * p, 0}),
                                     line({0.15f * p, 0}, {0.15f * p, 0.15f * h}),
                                     arc({0.55f * p, 0.15f * h}, {0.40f * p, 0.30f * h}, 2 * q, q, round),
                                     line({0.55f * p, 0.45f * h}, {0.60f * p, 0.45f * h}),
                                     arc({0.60f * p, 0.70f * h}, {0.30f * p, 0.25f * h}, -q, 0, round),
                                     line({0.90f * p, 0.70f * h}, {p, 0.70f * h}),
                                     line({p, 0.70f * h}, {p, h}),
                                     line({p, h}, {-0.02f, h})};
    // The four inner sides of the courtyard; `inset` is the wall's face, measured from the column axes
    // inward.
    const float x = kHalfX - inset, z = kHalfZ - inset;
    const glm::vec3 corner[4] = {{-x, y, -z}, {-x, y, z}, {x, y, z}, {x, y, -z}};
    const glm::vec3 out[4] = {{1, 0, 0}, {0, 0, -1}, {-1, 0, 0}, {0, 0, 1}};
    std::vector<Piece> pieces;
    for (int side = 0; side < 4; ++side)
        addPatches(pieces, shapes::extrude(profile, corner[side], corner[(side + 1) % 4], out[side], -1, -1));
    return pieces;
}

}  // namespace conelight::io::generated::atrium
