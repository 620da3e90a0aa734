// SPDX-License-Identifier: MIT
// A cellar: barrels, racks of bottles, sacks and crates, stairs to an open hatch, two caged bulbs. Values -> Scene.
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>

#include "io/generated_furnished.h"
#include "io/generated_textures.h"

namespace conelight::io::generated {
namespace {

struct CellarPaints {
    int stone, oak, hoop, bottle, label, sack, crate, wire, apple, wax;
};

// A barrel of 20 staves with gaps of a millimetre, five hoops, two heads; it stands.
Mesh barrelStaves(float radius, float height) {
    Mesh mesh;
    for (int i = 0; i < 20; ++i) {
        const float step = 0.31415927f;
        for (const float skin : {0.0f, 0.022f})
            merge(mesh,
                  sheet(
                      [=](float u, float v) {
                          const float bulge = 1 - 0.22f * (2 * v - 1) * (2 * v - 1);
                          const float a = step * (0.01f + 0.98f * (skin > 0 ? 1 - u : u));
                          const float r = radius * bulge - skin;
                          return glm::vec3(r * std::sin(a), height * v, r * std::cos(a));
                      },
                      4, 10, {0.1f, height}),
                  turnAboutY(step * float(i)));
    }
    return mesh;
}

Mesh barrelHoops(float radius, float height) {
    Mesh mesh;
    for (const float v : {0.04f, 0.2f, 0.5f, 0.8f, 0.96f}) {
        const float r = radius * (1 - 0.22f * (2 * v - 1) * (2 * v - 1)) + 0.003f;
        merge(mesh, turned({shapes::line({r, height * v - 0.02f}, {r, height * v + 0.02f})}, 64));
    }
    return mesh;
}

void addBarrel(const Placer& at, const CellarPaints& p) {
    constexpr float kRadius = 0.34f, kHeight = 0.9f;
    at.put(barrelStaves(kRadius, kHeight), "barrel", p.oak);
    at.put(barrelHoops(kRadius, kHeight), "hoops", p.hoop);
    for (const float y : {0.05f, kHeight - 0.05f})
        at.put(cylinder(0.255f, y - 0.01f, y + 0.01f, 48, 1), "barrel head", p.oak, glm::vec3(0));
}

Mesh bottle() {
    return turned(
        {shapes::line({0, 0}, {0.036f, 0}), shapes::line({0.036f, 0}, {0.038f, 0.19f}, 4),
         shapes::arc({0.014f, 0.19f}, {0.024f, 0.06f}, 0, 1.57f, 8),
         shapes::line({0.014f, 0.25f}, {0.014f, 0.31f}, 2), shapes::line({0.014f, 0.31f}, {0, 0.31f})},
        24);
}

// A rack of crossed boards, bottles lie in it.
void addRack(const Placer& at, const CellarPaints& p) {
    constexpr int kColumns = 9, kRows = 8;
    constexpr float kCell = 0.11f, kDeep = 0.28f;
    for (int i = 0; i <= kColumns; ++i)
        at.put(box({{kCell * float(i) - 0.004f, 0, 0}, {kCell * float(i) + 0.004f, kCell * kRows, kDeep}}),
               "rack", p.crate);
    for (int j = 0; j <= kRows; ++j)
        at.put(box({{-0.02f, kCell * float(j) - 0.004f, 0.006f},
                    {kCell * kColumns + 0.02f, kCell * float(j) + 0.004f, kDeep - 0.004f}}),
               "rack", p.crate);
    const int mesh = add(at.scene, bottle()),
              band = add(at.scene, turned({shapes::line({0.0385f, 0.06f}, {0.0388f, 0.15f})}, 24));
    at.scene.meshes[std::size_t(mesh)].name = "bottle";
    at.scene.meshes[std::size_t(band)].name = "label";
    for (int j = 0; j < kRows; ++j)
        for (int i = 0; i < kColumns; ++i) {
            if (randomAt(71, i, j) < 0.2f) continue;
            const glm::mat4 place = translation({kCell * (float(i) + 0.5f), kCell * float(j) + 0.043f,
                                                 0.01f + 0.02f * randomAt(72, i, j)}) *
                                    glm::rotate(glm::mat4(1), 0.5f * glm::pi<float>(), glm::vec3(1, 0, 0));
            at.again(mesh, "bottle", p.bottle, place);
            at.again(band, "label", p.label, place);
        }
}

// A crate of slats with apples.
void addAppleCrate(const Placer& at, int seed, const CellarPaints& p) {
    for (const float x : {-0.25f, 0.238f})
        for (int k = 0; k < 3; ++k)
            at.put(
                box({{x, 0.01f + 0.09f * float(k), -0.17f}, {x + 0.012f, 0.085f + 0.09f * float(k), 0.17f}}),
                "crate", p.crate);
    for (const float z : {-0.183f, 0.171f})
        for (int k = 0; k < 3; ++k)
            at.put(
                box({{-0.25f, 0.01f + 0.09f * float(k), z}, {0.25f, 0.085f + 0.09f * float(k), z + 0.012f}}),
                "crate", p.crate);
    for (int k = 0; k < 4; ++k)
        at.put(box({{-0.237f, 0, -0.16f + 0.085f * float(k)}, {0.237f, 0.009f, -0.09f + 0.085f * float(k)}}),
               "crate", p.crate);
    for (int i = 0; i < 40; ++i)
        at.put(sphere(0.036f + 0.005f * randomAt(81, i, seed), 20), "apple", p.apple,
               {-0.19f + 0.076f * float(i % 6), 0.05f + 0.065f * float(i / 20),
                -0.12f + 0.078f * float((i / 6) % 4)});
}

// A sack: a lathe's outline with folds.
Mesh sack(std::uint32_t seed) {
    return sheet(
        [=](float u, float v) {
            const float a = 2 * glm::pi<float>() * u, w = std::clamp(v, 0.0f, 1.0f);
            const float body = 0.27f * std::pow(std::sin(0.2f + 2.6f * w), 0.45f) * (1 - 0.35f * w);
            const float fold = 0.012f * std::sin(7 * a + float(seed)) * w + 0.01f * std::sin(3 * a + 9 * w);
            const float r = v < 0.06f ? std::max(0.0f, v) / 0.06f * body
                                      : body + fold * (v < 0.15f ? (v - 0.06f) / 0.09f : 1);
            return glm::vec3(r * std::sin(a), 0.002f + 0.62f * v, r * std::cos(a));
        },
        72, 60, {1.4f, 0.8f});
}

// A bulb in a cage of rods below a plate.
void addCagedBulb(const Placer& at, float glow, const CellarPaints& p) {
    at.put(cylinder(0.07f, 0.12f, 0.15f, 48, 1), "plate", p.hoop, glm::vec3(0));
    Mesh cage;
    for (int i = 0; i < 8; ++i) {
        const float turn = 0.7854f * float(i);
        merge(cage,
              tube(
                  [=](float t) {
                      const float a = 1.45f - 3.0f * t;
                      return glm::vec3(0.062f * std::cos(a), 0.04f + 0.085f * std::sin(a), 0);
                  },
                  0.0025f, 32, 8),
              turnAboutY(turn));
    }
    for (const float y : {-0.01f, 0.04f, 0.09f})
        merge(cage, turned({shapes::line({0.0615f - 8 * (y - 0.04f) * (y - 0.04f), y - 0.003f},
                                         {0.0615f - 8 * (y - 0.04f) * (y - 0.04f), y + 0.003f})},
                           48));
    at.put(std::move(cage), "cage", p.wire);
    if (glow > 0)
        at.put(sphere(0.028f, 32), "bulb",
               add(at.scene, emitter("bulb", glow * glm::vec3(1.0f, 0.80f, 0.55f))), {0, 0.05f, 0});
}

// Stairs of stone to the hatch, with a rail.
void addStairs(const Placer& at, const CellarPaints& p) {
    Mesh steps;
    for (int i = 0; i < 9; ++i)
        merge(steps, chamferedBox({{-0.45f, 0.001f, -0.26f * float(i) - 0.27f},
                                   {0.45f, 0.25f * float(i + 1), -0.26f * float(i)}},
                                  0.01f));
    at.put(std::move(steps), "stairs", p.stone);
    at.put(rod({-0.5f, 0.95f, -0.05f}, {-0.5f, 2.95f, -2.13f}, 0.018f, 20), "hand rail", p.wire);
    for (int i = 0; i < 9; ++i)
        at.put(rod({-0.5f, 0.001f, -0.26f * float(i) - 0.12f},
                   {-0.5f, 1.0f + 0.25f * float(i), -0.26f * float(i) - 0.12f}, 0.008f, 14),
               "baluster", p.wire);
}

}  // namespace

Scene buildCellar(const Values& values) {
    Scene scene;
    const Placer room{scene};
    const CellarPaints p = {
        textured(scene, "stone", textures::ashlar(512).color, 1.2f, {0.52f, 0.49f, 0.44f}),
        textured(scene, "oak", textures::wood(256), 0.4f, {0.44f, 0.29f, 0.16f}),
        add(scene, metal("hoop iron", {0.46f, 0.45f, 0.44f}, 0.4f)),
        add(scene, glossy("bottle", {0.05f, 0.10f, 0.05f}, 0.2f)),
        add(scene, matte("label", {0.70f, 0.64f, 0.50f})),
        textured(scene, "sacking", textures::fabric(256), 0.2f, {0.52f, 0.42f, 0.28f}),
        textured(scene, "crate", textures::wood(256), 0.5f, {0.56f, 0.42f, 0.26f}),
        add(scene, matte("wire", {0.08f, 0.08f, 0.085f})),
        add(scene, glossy("apple", {0.50f, 0.12f, 0.06f}, 0.35f)),
        add(scene, matte("wax", {0.70f, 0.64f, 0.50f}))};
    const int flags = textured(scene, "flags", textures::tiles(512).color, 1.0f, {0.62f, 0.62f, 0.60f});
    const int lime = textured(scene, "lime wash", textures::ashlar(512).color, 0.8f, {0.70f, 0.66f, 0.58f});
    // The hatch is above the upper steps.
    addRoom(scene, {{-2.4f, 0, -2.2f}, {2.4f, 2.45f, 2.0f}}, {flags, lime, lime, lime, lime, lime},
            {{{1.3f, 2.45f, -2.2f}, {2.3f, 4, -0.6f}}});
    addStairs(room.at(translation({1.82f, 0, 0.15f})), p);
    for (int i = 0; i < 4; ++i)
        addBarrel(room.at(translation({-2.0f + 0.02f * float(i % 2), 0.001f, -1.7f + 0.74f * float(i)}) *
                          turnAboutY(float(i))),
                  p);
    // One more lies on two beams.
    room.put(box({{-1.3f, 0.001f, -1.9f}, {-0.3f, 0.1f, -1.8f}}), "beam", p.oak);
    room.put(box({{-1.3f, 0.001f, -1.4f}, {-0.3f, 0.1f, -1.3f}}), "beam", p.oak);
    addBarrel(room.at(translation({-0.8f, 0.445f, -2.05f}) *
                      glm::rotate(glm::mat4(1), 0.5f * glm::pi<float>(), glm::vec3(1, 0, 0))),
              p);
    addRack(room.at(translation({0.05f, 0.15f, -2.19f})), p);
    for (int i = 0; i < 3; ++i)
        addAppleCrate(room.at(translation({-0.75f + 0.62f * float(i % 2) - 0.1f * float(i / 2),
                                           0.001f + 0.29f * float(i / 2), -0.2f + 0.05f * float(i)}) *
                              turnAboutY(0.2f * float(i))),
                      i, p);
    for (int i = 0; i < 3; ++i)
        room.put(
            sack(std::uint32_t(3 + i)), "sack", p.sack,
            translation({0.62f + 0.1f * float(i % 2), 0, -1.35f + 0.58f * float(i)}) * turnAboutY(float(i)));
    room.put(wire({-1.5f, 2.42f, -0.9f}, {0.5f, 2.42f, -0.1f}, 0.08f, 0.005f), "cable", p.wire);
    addCagedBulb(room.at(translation({-1.0f, 2.29f, -0.75f})), float(values["lamp"]), p);
    addCagedBulb(room.at(translation({0.5f, 2.29f, 0.4f})), float(values["lamp"]), p);
    makeTwoSided(scene);
    scene.sky = float(values["sky"]) * glm::vec3(0.60f, 0.78f, 1.0f);
    scene.cameras.push_back(camera("front", {0.95f, 1.6f, 1.85f}, {-0.45f, 0.7f, -1.1f}, 68));
    scene.cameras.push_back(camera("rack", {0.1f, 1.2f, -0.6f}, {0.5f, 0.65f, -2.1f}, 64));
    return scene;
}

}  // namespace conelight::io::generated
