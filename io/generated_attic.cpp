// SPDX-License-Identifier: MIT
// An attic: rafters and battens below a roof with two skylights, boards with gaps, boxes, a chest, a draped
// chair, ropes. Values -> Scene.
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>

#include "io/generated_furnished.h"
#include "io/generated_textures.h"

namespace conelight::io::generated {
namespace {

struct AtticPaints {
    int beam, board, roof, card, linen, leather, brass, rope, paper, paint;
};

constexpr float kEaves = 0.55f, kRidge = 2.75f, kHalfWide = 2.3f, kLong = 2.6f;  // half width and half length

// A frame on a slope of the roof: x along the ridge, y up the slope, z out of it. Side 1 looks to -x.
glm::mat4 slopeFrame(int side) {
    const glm::vec3 up = glm::normalize(glm::vec3(-kHalfWide, kRidge - kEaves, 0)), along(0, 0, -1);
    const glm::mat4 right(glm::vec4(along, 0), glm::vec4(up, 0), glm::vec4(glm::cross(along, up), 0),
                          glm::vec4(kHalfWide, kEaves, 0, 1));
    return side == 0 ? right : turnAboutY(glm::pi<float>()) * right;
}

// One slope: boards outside with a hole for the skylight, battens, rafters inside.
void addSlope(const Placer& at, int side, const AtticPaints& p) {
    const Placer slope = at.at(slopeFrame(side));
    const float length = std::hypot(kHalfWide, kRidge - kEaves);
    const float hole[2][2] = {{-0.65f, 0.55f}, {0.9f, 2.0f}};
    const int rows = 22;
    Mesh boards;
    for (int i = 0; i < rows; ++i) {
        const float y0 = length * float(i) / float(rows), y1 = length * float(i + 1) / float(rows) - 0.002f;
        const auto board = [&](float from, float to) {
            merge(boards, chamferedBox({{from, y0, 0}, {to, y1, 0.022f}}, 0.002f));
        };
        if (y1 > hole[1][0] && y0 < hole[1][1]) {
            board(-kLong - 0.1f, hole[0][0]);
            board(hole[0][1], kLong + 0.1f);
        } else {
            board(-kLong - 0.1f, kLong + 0.1f);
        }
    }
    slope.put(std::move(boards), "roof board", p.board);
    // Felt over all, 1 cm above; a frame, so that the skylight stays open.
    Mesh felt;
    const glm::vec2 size(2 * kLong + 0.3f, length + 0.1f), corner(-kLong - 0.15f, -0.05f);
    const auto part = [&](int axis, int i) { return (hole[axis][i] - corner[axis]) / size[axis]; };
    shapes::appendFrame(felt, {corner, 0.032f}, {size.x, 0, 0}, {0, size.y, 0}, {part(0, 0), part(1, 0)},
                        {part(0, 1), part(1, 1)});
    slope.put(std::move(felt), "felt", p.roof);
    for (int i = 0; i < 7; ++i) {
        const float x = -2.4f + 0.8f * float(i);
        if (x > hole[0][0] - 0.05f && x < hole[0][1] + 0.05f) {
            slope.put(
                chamferedBox({{x - 0.04f, 0, -0.141f}, {x + 0.04f, hole[1][0] - 0.04f, -0.001f}}, 0.004f),
                "rafter", p.beam);
            slope.put(chamferedBox({{x - 0.04f, hole[1][1] + 0.04f, -0.141f}, {x + 0.04f, length, -0.001f}},
                                   0.004f),
                      "rafter", p.beam);
        } else {
            slope.put(chamferedBox({{x - 0.04f, 0, -0.141f}, {x + 0.04f, length, -0.001f}}, 0.004f), "rafter",
                      p.beam);
        }
    }
    const auto rim = [&](float x0, float y0, float x1, float y1) {
        slope.put(chamferedBox({{x0, y0, -0.12f}, {x1, y1, 0.06f}}, 0.004f), "skylight frame", p.paint);
    };
    const float inside = 0.002f;  // the boards' edges are not in its planes
    const float x0 = hole[0][0] + inside, x1 = hole[0][1] - inside, y0 = hole[1][0] + inside,
                y1 = hole[1][1] - inside;
    rim(x0 - 0.03f, y0 - 0.03f, x1 + 0.03f, y0);
    rim(x0 - 0.03f, y1, x1 + 0.03f, y1 + 0.03f);
    rim(x0 - 0.03f, y0, x0, y1);
    rim(x1, y0, x1 + 0.03f, y1);
    rim(-0.065f, hole[1][0], -0.035f, hole[1][1]);
}

void addShell(const Placer& at, const AtticPaints& p) {
    for (int i = 0; i < 24; ++i) {  // floor boards, 3 mm apart
        const float x = -kHalfWide + 2 * kHalfWide * float(i) / 24.0f;
        at.put(chamferedBox({{x, -0.025f, -kLong}, {x + 2 * kHalfWide / 24 - 0.003f, 0, kLong}}, 0.002f),
               "floor board", p.board);
    }
    at.put(box({{-kHalfWide - 0.1f, -0.3f, -kLong - 0.1f}, {kHalfWide + 0.1f, -0.03f, kLong + 0.1f}}),
           "ceiling below", p.paint);
    for (const float x : {-kHalfWide - 0.1f, kHalfWide})
        at.put(box({{x, -0.03f, -kLong}, {x + 0.1f, kEaves + 0.02f, kLong}}), "knee wall", p.paint);
    for (const float z : {-kLong, kLong}) {
        Mesh gable;
        for (const float out : {0.0f, z > 0 ? 0.12f : -0.12f})
            appendPolygon(gable,
                          {{-kHalfWide - 0.1f, -0.03f, z + out},
                           {kHalfWide + 0.1f, -0.03f, z + out},
                           {kHalfWide + 0.1f, kEaves - 0.09f, z + out},
                           {0, kRidge + 0.02f, z + out},
                           {-kHalfWide - 0.1f, kEaves - 0.09f, z + out}},
                          {0, 0, (out != 0) == (z > 0) ? 1.0f : -1.0f});
        at.put(std::move(gable), "gable", p.paint);
    }
    for (int side = 0; side < 2; ++side) addSlope(at, side, p);
    for (int i = 0; i < 3; ++i) {  // ties and posts
        const float z = -1.7f + 1.6f * float(i);
        at.put(chamferedBox({{-1.35f, 1.98f, z - 0.05f}, {1.35f, 2.1f, z + 0.05f}}, 0.006f), "tie", p.beam);
        if (i == 0)
            at.put(chamferedBox({{-0.06f, 0, z - 0.06f}, {0.06f, 1.98f, z + 0.06f}}, 0.006f), "post", p.beam);
    }
    at.put(chamferedBox({{-0.06f, 2.46f, -kLong}, {0.06f, 2.66f, kLong}}, 0.006f), "ridge beam", p.beam);
}

void addCardboardBox(const Placer& at, glm::vec3 size, bool open, int card) {
    const float t = 0.004f;
    at.put(box({{0, 0, 0}, {size.x, t, size.z}}), "box", card);
    at.put(box({{0, t, 0}, {t, size.y, size.z}}), "box", card);
    at.put(box({{size.x - t, t, 0}, {size.x, size.y, size.z}}), "box", card);
    at.put(box({{t, t, 0}, {size.x - t, size.y, t}}), "box", card);
    at.put(box({{t, t, size.z - t}, {size.x - t, size.y, size.z}}), "box", card);
    const float lean = open ? 0.7f : -0.04f;
    Mesh flaps;
    shapes::appendQuad(
        flaps, {0, size.y + 0.001f, 0}, {0, 0, size.z},
        glm::vec3(open ? -std::cos(lean) : std::cos(lean), std::sin(std::abs(lean)), 0) * 0.49f * size.x);
    shapes::appendQuad(
        flaps, {size.x, size.y + 0.001f, size.z}, {0, 0, -size.z},
        glm::vec3(open ? std::cos(lean) : -std::cos(lean), std::sin(std::abs(lean)), 0) * 0.49f * size.x);
    at.put(std::move(flaps), "flaps", card);
}

// A chest with a vaulted lid that stands 5 mm open, bands and rivets.
void addChest(const Placer& at, const AtticPaints& p) {
    at.put(chamferedBox({{-0.5f, 0.005f, -0.28f}, {0.5f, 0.42f, 0.28f}}, 0.008f), "chest", p.leather);
    at.put(sheet(
               [](float u, float v) {
                   const float a = glm::pi<float>() * v;
                   return glm::vec3(0.5f - 1.0f * u, 0.425f + 0.16f * std::sin(a), -0.28f * std::cos(a));
               },
               4, 40, {1, 0.8f}),
           "lid", p.leather);
    for (const float x : {-0.4f, 0.0f, 0.4f}) {
        at.put(chamferedBox({{x - 0.03f, 0.01f, 0.28f}, {x + 0.03f, 0.41f, 0.286f}}, 0.001f), "band", p.beam);
        for (int i = 0; i < 6; ++i)
            at.put(sphere(0.008f, 20), "rivet", p.brass, {x, 0.05f + 0.066f * float(i), 0.287f});
    }
    at.put(chamferedBox({{-0.05f, 0.34f, 0.286f}, {0.05f, 0.44f, 0.298f}}, 0.004f), "lock", p.brass);
}

// A chair under a sheet of linen that hangs in folds.
void addDrapedChair(const Placer& at, const AtticPaints& p) {
    for (const float x : {-0.22f, 0.2f})
        for (const float z : {-0.22f, 0.2f})
            at.put(box({{x, 0, z}, {x + 0.035f, 0.44f, z + 0.035f}}), "chair leg", p.beam);
    at.put(chamferedBox({{-0.23f, 0.44f, -0.23f}, {0.24f, 0.47f, 0.24f}}, 0.004f), "seat", p.beam);
    at.put(chamferedBox({{-0.22f, 0.47f, -0.23f}, {0.23f, 1.0f, -0.2f}}, 0.004f), "back", p.beam);
    at.put(sheet(
               [](float u, float v) {
                   const float a = 2 * glm::pi<float>() * u, down = v * v;
                   const float fold = 0.05f * down * std::sin(9 * a) + 0.03f * down * std::sin(5 * a + 1);
                   const float r = 0.03f + 0.30f * std::min(1.0f, 1.6f * v) + 0.1f * down + fold;
                   const float back = 0.5f - 0.5f * std::sin(a);
                   const float high = 1.02f * (1 - down) -
                                      0.5f * (1 - back) *
                                          std::sin(glm::pi<float>() * std::min(1.0f, std::max(0.0f, v))) *
                                          0.9f;
                   return glm::vec3(r * std::cos(a), std::max(0.006f, high) + 0.01f * (1 - v),
                                    -0.02f + r * std::sin(a));
               },
               180, 48, {2.2f, 1.1f}),
           "linen", p.linen);
}

void addStores(const Placer& at, const AtticPaints& p) {
    for (int i = 0; i < 7; ++i)
        addCardboardBox(at.at(translation({1.0f + 0.34f * float(i % 3), 0.001f + 0.302f * float(i / 3),
                                           -2.4f + 0.05f * randomAt(21, i)}) *
                              turnAboutY(-0.15f * randomAt(22, i))),
                        {0.32f, 0.28f, 0.36f}, i == 6 || i == 4, p.card);
    addCardboardBox(at.at(translation({-0.9f, 0.001f, -0.5f}) * turnAboutY(0.4f)), {0.5f, 0.32f, 0.4f}, true,
                    p.card);
    addChest(at.at(translation({0.85f, 0, -0.9f}) * turnAboutY(-0.35f)), p);
    addDrapedChair(at.at(translation({-1.15f, 0, -1.55f}) * turnAboutY(0.5f)), p);
    for (int pile = 0; pile < 4; ++pile)  // books
        for (int i = 0; i < 9; ++i) {
            const float w = 0.16f + 0.05f * randomAt(31, i, pile), d = 0.11f + 0.04f * randomAt(32, i, pile);
            at.put(chamferedBox({{-w / 2, 0.002f, -d / 2}, {w / 2, 0.033f, d / 2}}, 0.003f), "book",
                   i % 3 == 0   ? p.leather
                   : i % 3 == 1 ? p.linen
                                : p.paint,
                   translation(
                       {-0.3f + 0.27f * float(pile), 0.034f * float(i), -2.2f + 0.1f * float(pile % 2)}) *
                       turnAboutY(randomAt(33, i, pile)));
        }
    for (int i = 0; i < 60; ++i) {  // loose sheets of paper
        const float lift = 0.001f + 0.0012f * float(i);
        at.put(sheet(
                   [=](float u, float v) {
                       return glm::vec3(0.21f * u, lift + 0.004f * (u - 0.5f) * (v - 0.3f), -0.297f * v);
                   },
                   4, 4, {0.21f, 0.3f}),
               "sheet of paper", p.paper,
               translation({0.1f + 0.3f * randomAt(41, i), 0, 0.2f + 0.35f * randomAt(42, i)}) *
                   turnAboutY(6.28f * randomAt(43, i)));
    }
    at.put(wire({-1.2f, 1.93f, -1.7f}, {1.2f, 1.93f, -0.1f}, 0.5f, 0.009f), "rope", p.rope);
    at.put(tube(
               [](float t) {
                   const float a = 2 * glm::pi<float>() * 9 * t;
                   return glm::vec3((0.14f + 0.02f * std::sin(5 * a)) * std::cos(a), 0.012f + 0.1f * t,
                                    (0.14f + 0.02f * std::cos(3 * a)) * std::sin(a));
               },
               0.009f, 700, 12, {0, 1, 0}),
           "coil of rope", p.rope, {0.25f, 0, -0.75f});
    for (int i = 0; i < 4; ++i)  // frames that lean on the knee wall
        at.put(chamferedBox({{0, 0, 0}, {0.9f - 0.12f * float(i), 0.75f - 0.1f * float(i), 0.02f}}, 0.004f),
               "picture", i % 2 ? p.paint : p.leather,
               translation({-2.0f + 0.03f * float(i), 0.002f, 0.6f}) * turnAboutY(0.5f * glm::pi<float>()) *
                   glm::rotate(glm::mat4(1), -0.3f - 0.05f * float(i), glm::vec3(1, 0, 0)));
}

}  // namespace

Scene buildAttic(const Values& values) {
    Scene scene;
    const Placer room{scene};
    const AtticPaints p = {textured(scene, "beams", textures::wood(512), 0.4f, {0.34f, 0.23f, 0.14f}),
                           textured(scene, "boards", textures::wood(512), 0.8f, {0.52f, 0.40f, 0.27f}),
                           add(scene, matte("felt", {0.12f, 0.12f, 0.12f})),
                           add(scene, matte("card", {0.50f, 0.38f, 0.25f})),
                           textured(scene, "linen", textures::fabric(256), 0.3f, {0.68f, 0.66f, 0.60f}),
                           textured(scene, "leather", textures::plaster(256), 0.3f, {0.32f, 0.17f, 0.10f}),
                           add(scene, metal("brass", {0.72f, 0.56f, 0.28f}, 0.3f)),
                           add(scene, matte("rope", {0.50f, 0.42f, 0.28f})),
                           add(scene, matte("paper", {0.72f, 0.69f, 0.60f})),
                           textured(scene, "lime", textures::plaster(256), 1.0f, {0.66f, 0.63f, 0.57f})};
    addShell(room, p);
    addStores(room, p);
    makeTwoSided(scene);
    scene.lights.push_back(
        sunLight("sun", {-0.50f, -0.78f, -0.30f}, float(values["sun"]) * glm::vec3(1.0f, 0.93f, 0.82f)));
    scene.sky = float(values["sky"]) * glm::vec3(0.60f, 0.78f, 1.0f);
    scene.cameras.push_back(camera("front", {0.45f, 1.5f, 2.35f}, {-0.1f, 0.75f, -1.2f}, 68));
    scene.cameras.push_back(camera("chest", {0.1f, 1.25f, 0.6f}, {0.85f, 0.4f, -1.1f}, 60));
    return scene;
}

}  // namespace conelight::io::generated
