// SPDX-License-Identifier: MIT
// A workshop: shelves and bench of sheet steel, tools, wires, springs, thin rods, under one shaded lamp with a
// small bulb. Values -> Scene.
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>

#include "io/generated_furnished.h"
#include "io/generated_textures.h"

namespace conelight::io::generated {
namespace {

constexpr float kHalfTurn = 3.14159265f;

struct WorkshopPaints {
    int steel, bright, iron, wood, card, red, blue, cable, shade;
};

glm::mat4 tilted(float angle, glm::vec3 axis) { return glm::rotate(glm::mat4(1), angle, axis); }

// Uprights of angled sheet 2 mm thick, shelves of one sheet with folded edges.
void addShelves(const Placer& at, const WorkshopPaints& p) {
    Mesh uprights;
    for (const float x : {0.0f, 1.4f})
        for (const float z : {0.0f, 0.4f}) {
            const float inX = x > 0 ? -0.035f : 0.035f, inZ = z > 0 ? -0.035f : 0.035f;
            merge(uprights,
                  box({{std::min(x, x + inX), 0, z - 0.001f}, {std::max(x, x + inX), 2.0f, z + 0.001f}}));
            merge(uprights,
                  box({{x - 0.001f, 0, std::min(z, z + inZ)}, {x + 0.001f, 2.0f, std::max(z, z + inZ)}}));
        }
    at.put(std::move(uprights), "upright", p.steel);
    for (int i = 0; i < 5; ++i) {
        const float y = 0.12f + 0.45f * float(i);
        Mesh shelf = quad({0, y, 0.4f}, {1.4f, 0, 0}, {0, 0, -0.4f});
        shapes::appendQuad(shelf, {0, y - 0.03f, 0.4f}, {1.4f, 0, 0}, {0, 0.03f, 0});
        shapes::appendQuad(shelf, {0, y - 0.03f, 0}, {1.4f, 0, 0}, {0, 0.03f, 0});
        at.put(std::move(shelf), "shelf", p.steel);
    }
}

// An open box of card with flaps, each a sheet.
void addCarton(const Placer& at, glm::vec3 size, int card) {
    Mesh mesh;
    shapes::appendQuad(mesh, {0, 0.002f, size.z}, {size.x, 0, 0}, {0, 0, -size.z});
    shapes::appendQuad(mesh, {0, 0.002f, size.z}, {size.x, 0, 0}, {0, size.y, 0});
    shapes::appendQuad(mesh, {size.x, 0.002f, 0}, {-size.x, 0, 0}, {0, size.y, 0});
    shapes::appendQuad(mesh, {0, 0.002f, 0}, {0, 0, size.z}, {0, size.y, 0});
    shapes::appendQuad(mesh, {size.x, 0.002f, size.z}, {0, 0, -size.z}, {0, size.y, 0});
    shapes::appendQuad(mesh, {0, size.y, size.z}, {size.x, 0, 0}, {0, -0.04f, 0.09f});
    shapes::appendQuad(mesh, {size.x, size.y, 0}, {-size.x, 0, 0}, {0, 0.05f, -0.08f});
    at.put(std::move(mesh), "carton", card);
}

Mesh can(float radius, float height) {
    return turned(
        {shapes::line({0, 0.001f}, {radius, 0.001f}), shapes::line({radius, 0.001f}, {radius, height}, 6),
         shapes::line({radius, height}, {radius - 0.003f, height + 0.004f}),
         shapes::line({radius - 0.003f, height + 0.004f}, {radius - 0.006f, height - 0.003f}),
         shapes::line({radius - 0.006f, height - 0.003f}, {0, height - 0.003f})},
        56);
}

// A hexagonal bolt: head and shank.
Mesh bolt(float size) {
    Mesh mesh = cylinder(0.9f * size, 0, 0.7f * size, 6, 1);
    merge(mesh, cylinder(0.45f * size, 0.7f * size, 4 * size, 12, 1));
    return mesh;
}

// A dish full of bolts, turned at random.
void addBolts(const Placer& at, int count, std::uint32_t seed, const WorkshopPaints& p) {
    at.put(turned({shapes::line({0, 0}, {0.09f, 0}), shapes::line({0.09f, 0}, {0.12f, 0.05f}, 4),
                   shapes::line({0.12f, 0.05f}, {0.117f, 0.05f}),
                   shapes::line({0.117f, 0.05f}, {0.088f, 0.003f}, 4),
                   shapes::line({0.088f, 0.003f}, {0, 0.003f})},
                  56),
           "dish", p.iron);
    const int mesh = add(at.scene, bolt(0.007f));
    at.scene.meshes[std::size_t(mesh)].name = "bolt";
    for (int i = 0; i < count; ++i) {
        const float a = 6.2832f * randomAt(seed, i), r = 0.075f * std::sqrt(randomAt(seed, i, 1));
        at.again(mesh, "bolt", i % 3 ? p.bright : p.iron,
                 translation({r * std::cos(a), 0.012f + 0.035f * randomAt(seed, i, 2), r * std::sin(a)}) *
                     tilted(6.28f * randomAt(seed, i, 3), {0.3f, 0.2f, 1}) *
                     tilted(6.28f * randomAt(seed, i, 4), {1, 0.1f, 0}));
    }
}

// Top of sheet steel with a folded rim over a frame of timber, drawers, a vice.
void addBench(const Placer& at, const WorkshopPaints& p) {
    at.put(chamferedBox({{-1.1f, 0.84f, -0.36f}, {1.1f, 0.876f, 0.36f}}, 0.004f), "bench board", p.wood);
    Mesh top = quad({-1.105f, 0.879f, 0.365f}, {2.21f, 0, 0}, {0, 0, -0.73f});
    shapes::appendQuad(top, {-1.105f, 0.83f, 0.365f}, {2.21f, 0, 0}, {0, 0.049f, 0});
    at.put(std::move(top), "bench sheet", p.steel);
    for (const float x : {-1.05f, 0.97f})
        for (const float z : {-0.33f, 0.25f})
            at.put(box({{x, 0, z}, {x + 0.08f, 0.839f, z + 0.08f}}), "bench leg", p.wood);
    at.put(box({{-1.0f, 0.25f, -0.3f}, {1.0f, 0.27f, 0.3f}}), "lower board", p.wood);
    for (int i = 0; i < 3; ++i) {
        at.put(
            chamferedBox({{0.4f, 0.62f - 0.16f * float(i), -0.3f}, {0.94f, 0.774f - 0.16f * float(i), 0.34f}},
                         0.004f),
            "drawer", p.blue);
        at.put(
            rod({0.58f, 0.70f - 0.16f * float(i), 0.365f}, {0.76f, 0.70f - 0.16f * float(i), 0.365f}, 0.006f),
            "drawer handle", p.bright);
    }
    const Placer vice = at.at(translation({-0.75f, 0.88f, 0.22f}));
    vice.put(chamferedBox({{-0.07f, 0, -0.14f}, {0.07f, 0.05f, 0.06f}}, 0.01f), "vice foot", p.iron);
    vice.put(chamferedBox({{-0.06f, 0.05f, -0.06f}, {0.06f, 0.16f, -0.02f}}, 0.008f), "jaw", p.iron);
    vice.put(chamferedBox({{-0.06f, 0.05f, 0.03f}, {0.06f, 0.16f, 0.07f}}, 0.008f), "jaw", p.iron);
    vice.put(rod({0, 0.09f, -0.02f}, {0, 0.09f, 0.22f}, 0.014f, 40), "screw", p.bright);
    vice.put(rod({-0.11f, 0.05f, 0.21f}, {0.11f, 0.13f, 0.21f}, 0.006f, 24), "lever", p.bright);
}

// A coil about the y axis.
Mesh spring(float radius, float height, int turns, float thickness) {
    return tube(
        [=](float t) {
            const float a = 2 * kHalfTurn * float(turns) * t;
            return glm::vec3(radius * std::cos(a), height * t, radius * std::sin(a));
        },
        thickness, 28 * turns, 10, {0, 1, 0});
}

void addOnBench(const Placer& top, const WorkshopPaints& p) {
    addBolts(top.at(translation({-0.25f, 0.001f, -0.12f})), 90, 51, p);
    addBolts(top.at(translation({0.05f, 0.001f, -0.2f})), 70, 52, p);
    for (int i = 0; i < 5; ++i)
        top.put(spring(0.018f + 0.003f * float(i), 0.10f, 9, 0.0022f), "spring", p.bright,
                {0.3f + 0.07f * float(i), 0.003f, -0.22f + 0.03f * float(i % 2)});
    top.put(spring(0.11f, 0.05f, 7, 0.005f), "coil of cable", p.cable, {0.82f, 0.006f, -0.1f});
    // A ball and a block of steel, a rod across them, a rule of thin sheet.
    top.put(sphere(0.05f, 64), "ball", p.bright, {0.2f, 0.051f, 0.1f});
    top.put(chamferedBox({{0, 0.001f, 0}, {0.12f, 0.08f, 0.08f}}, 0.004f), "block", p.steel,
            translation({0.4f, 0, 0.1f}) * turnAboutY(0.4f));
    top.put(box({{0, 0.001f, 0}, {0.5f, 0.002f, 0.03f}}), "rule", p.bright,
            translation({-0.4f, 0, 0.2f}) * turnAboutY(0.15f));
    for (int i = 0; i < 3; ++i) {
        const Placer driver =
            top.at(translation({-0.4f + 0.05f * float(i), 0.014f, 0.06f + 0.05f * float(i)}) *
                   turnAboutY(0.1f * float(i)));
        driver.put(rod({0, 0, 0}, {0.14f, 0, 0}, 0.003f, 20), "driver", p.bright);
        driver.put(turned({shapes::line({0, 0}, {0.009f, 0}),
                           shapes::arc({0.009f, 0.05f}, {0.005f, 0.05f}, -1.5f, 1.5f, 12),
                           shapes::line({0.009f, 0.1f}, {0, 0.1f})},
                          28),
                   "driver handle", i % 2 ? p.red : p.blue,
                   translation({0.14f, 0, 0}) * tilted(-0.5f * kHalfTurn, {0, 0, 1}));
    }
    top.put(can(0.06f, 0.16f), "can", p.red, {-0.98f, 0, -0.18f});
    top.put(can(0.045f, 0.11f), "can", p.blue, {-0.84f, 0, -0.24f});
}

// A board on the wall with tools on pegs.
void addPegboard(const Placer& at, const WorkshopPaints& p) {
    at.put(chamferedBox({{-1.0f, 0, 0.004f}, {1.0f, 0.9f, 0.016f}}, 0.002f), "pegboard", p.wood);
    for (int i = 0; i < 9; ++i) {  // spanners
        const float x = -0.9f + 0.085f * float(i), size = 0.32f - 0.02f * float(i);
        at.put(chamferedBox({{x - 0.008f, 0.48f, 0.03f}, {x + 0.008f, 0.48f + size, 0.036f}}, 0.002f),
               "spanner", p.bright);
        at.put(torus(0.018f, 0.005f), "ring", p.bright,
               translation({x, 0.465f, 0.033f}) * tilted(0.5f * kHalfTurn, {1, 0, 0}));
        at.put(rod({x, 0.48f + size, 0.016f}, {x, 0.48f + size, 0.05f}, 0.003f), "peg", p.iron);
    }
    for (int i = 0; i < 3; ++i) {  // hammers
        const float x = 0.1f + 0.16f * float(i);
        at.put(rod({x, 0.44f, 0.04f}, {x, 0.78f, 0.04f}, 0.012f, 24), "hammer handle", p.wood);
        at.put(chamferedBox({{x - 0.06f, 0.77f, 0.024f}, {x + 0.05f, 0.81f, 0.056f}}, 0.006f), "hammer head",
               p.steel);
    }
    // Saws: blades 1.5 mm thick.
    for (int i = 0; i < 2; ++i) {
        const float y = 0.1f + 0.17f * float(i);
        Mesh blade;
        for (const float z : {0.03f, 0.0315f})
            appendPolygon(
                blade, {{-0.85f, y, z}, {-0.3f, y - 0.02f, z}, {-0.3f, y + 0.11f, z}, {-0.85f, y + 0.05f, z}},
                {0, 0, z > 0.0305f ? 1.0f : -1.0f});
        at.put(std::move(blade), "saw", p.bright);
        at.put(chamferedBox({{-0.3f, y - 0.02f, 0.022f}, {-0.2f, y + 0.11f, 0.042f}}, 0.006f), "saw handle",
               p.wood);
    }
    // A chain of rings between two pegs.
    for (int i = 0; i < 24; ++i) {
        const float t = float(i) / 23.0f, x = 0.05f + 0.85f * t, y = 0.36f - 0.9f * t * (1 - t);
        at.put(torus(0.017f, 0.0035f), "chain", p.steel,
               translation({x, y, 0.04f}) * tilted(i % 2 ? 0.5f * kHalfTurn : 0, {1, 0, 0}) *
                   tilted(0.4f, {0, 0, 1}));
    }
}

// A shade of one sheet that hangs from a wire, a bulb of 3 cm in it.
void addHangingLamp(const Placer& at, float glow, const WorkshopPaints& p) {
    at.put(
        turned({shapes::line({0.22f, 0}, {0.05f, 0.14f}, 6), shapes::line({0.05f, 0.14f}, {0.03f, 0.2f}, 2)},
               64),
        "lamp shade", p.shade);
    at.put(cylinder(0.016f, 0.09f, 0.19f, 32, 2), "socket", p.iron, glm::vec3(0));
    at.put(rod({0, 0.19f, 0}, {0, 0.95f, 0}, 0.004f), "lamp wire", p.cable);
    if (glow > 0)
        at.put(sphere(0.03f, 32), "bulb",
               add(at.scene, emitter("bulb", glow * glm::vec3(1.0f, 0.82f, 0.58f))), {0, 0.055f, 0});
}

// Pipes along the wall, cables that hang from clips, rods in a tub, a ladder.
void addAlongWalls(const Placer& room, const WorkshopPaints& p) {
    for (int i = 0; i < 3; ++i) {
        const float y = 2.3f + 0.09f * float(i);
        room.put(rod({-2.2f, y, -1.75f}, {2.2f, y, -1.75f}, 0.022f - 0.005f * float(i), 28), "pipe",
                 i == 1 ? p.red : p.steel);
        for (int k = 0; k < 5; ++k)
            room.put(torus(0.027f, 0.006f), "clip", p.iron,
                     translation({-1.9f + 0.9f * float(k), y, -1.75f}) * tilted(0.5f * kHalfTurn, {0, 0, 1}));
    }
    for (int i = 0; i < 7; ++i)
        room.put(wire({-2.18f + 0.6f * float(i), 2.25f, -1.78f}, {-1.58f + 0.6f * float(i), 2.22f, -1.78f},
                      0.1f + 0.06f * randomAt(4, i), 0.004f),
                 "cable", p.cable);
    room.put(wire({-2.1f, 2.5f, -0.6f}, {2.1f, 2.52f, 0.2f}, 0.22f, 0.005f), "cable", p.cable);
    const Placer tub = room.at(translation({1.75f, 0, -1.4f}));
    tub.put(cup(0.19f, 0.45f, 0.004f, 56), "tub", p.blue);
    for (int i = 0; i < 26; ++i) {
        const float a = 6.28f * randomAt(8, i), r = 0.1f * randomAt(8, i, 1), b = 6.28f * randomAt(8, i, 2);
        tub.put(rod({r * std::cos(a), 0.01f, r * std::sin(a)},
                    {0.16f * std::cos(b), 0.9f + 0.8f * randomAt(8, i, 3), 0.16f * std::sin(b)},
                    0.003f + 0.005f * randomAt(8, i, 4), 14),
                "rod", i % 3 ? p.bright : p.wood);
    }
    const Placer ladder = room.at(translation({2.05f, 0, 0.2f}) * tilted(-0.12f, {0, 0, 1}));
    for (const float z : {0.0f, 0.42f})
        ladder.put(box({{0, 0, z}, {0.03f, 2.2f, z + 0.06f}}), "rail", p.wood);
    for (int i = 0; i < 8; ++i)
        ladder.put(rod({0.015f, 0.22f + 0.26f * float(i), 0.05f}, {0.015f, 0.22f + 0.26f * float(i), 0.43f},
                       0.014f, 20),
                   "rung", p.wood);
}

void fillShelves(const Placer& at, const WorkshopPaints& p) {
    for (int row = 0; row < 5; ++row) {
        const Placer shelf = at.at(translation({0, 0.121f + 0.45f * float(row), 0}));
        if (row % 2 == 0)
            for (int i = 0; i < 3; ++i)
                addCarton(shelf.at(translation({0.06f + 0.44f * float(i), 0.001f, 0.05f})),
                          {0.36f, 0.18f + 0.05f * randomAt(13, i, row), 0.3f}, p.card);
        else
            for (int i = 0; i < 9; ++i)
                shelf.put(can(0.05f + 0.012f * randomAt(14, i, row), 0.13f + 0.1f * randomAt(15, i, row)),
                          "can",
                          i % 4 == 0   ? p.red
                          : i % 4 == 1 ? p.blue
                          : i % 4 == 2 ? p.steel
                                       : p.card,
                          {0.1f + 0.15f * float(i), 0.001f, 0.12f + 0.14f * float(i % 2)});
    }
}

}  // namespace

Scene buildWorkshop(const Values& values) {
    Scene scene;
    const Placer room{scene};
    const float roughness = float(values["roughness"]);
    const WorkshopPaints p = {add(scene, metal("sheet steel", {0.56f, 0.56f, 0.55f}, roughness)),
                              add(scene, metal("bright steel", {0.66f, 0.65f, 0.63f}, 0.8f * roughness)),
                              add(scene, matte("cast iron", {0.10f, 0.11f, 0.12f})),
                              textured(scene, "timber", textures::wood(256), 0.6f, {0.50f, 0.36f, 0.22f}),
                              add(scene, matte("card", {0.48f, 0.36f, 0.24f})),
                              add(scene, glossy("red lacquer", {0.50f, 0.08f, 0.06f}, 0.3f)),
                              add(scene, glossy("blue lacquer", {0.09f, 0.18f, 0.34f}, 0.35f)),
                              add(scene, matte("cable", {0.05f, 0.05f, 0.055f})),
                              add(scene, matte("enamel", {0.60f, 0.62f, 0.58f}))};
    const int concrete = textured(scene, "concrete", textures::plaster(512), 1.6f, {0.42f, 0.41f, 0.39f});
    const int wall =
        textured(scene, "painted brick", textures::ashlar(512).color, 0.5f, {0.66f, 0.64f, 0.58f});
    addRoom(scene, {{-2.2f, 0, -1.8f}, {2.2f, 2.6f, 1.8f}}, {concrete, wall, wall, wall, wall, wall},
            {{{-3, 1.5f, 0.2f}, {-2.2f, 2.2f, 1.2f}}});
    addBench(room.at(translation({0.2f, 0, -1.42f})), p);
    addOnBench(room.at(translation({0.2f, 0.88f, -1.42f})), p);
    addPegboard(room.at(translation({0.2f, 1.2f, -1.8f})), p);
    const Placer shelves = room.at(translation({-2.18f, 0, 0.1f}) * turnAboutY(0.5f * kHalfTurn));
    addShelves(shelves, p);
    fillShelves(shelves, p);
    addHangingLamp(room.at(translation({0.25f, 1.65f, -0.95f})), float(values["lamp"]), p);
    addAlongWalls(room, p);
    makeTwoSided(scene);
    scene.sky = float(values["sky"]) * glm::vec3(0.60f, 0.78f, 1.0f);
    scene.cameras.push_back(camera("front", {1.0f, 1.6f, 1.5f}, {-0.35f, 1.05f, -1.4f}, 68));
    scene.cameras.push_back(camera("bench", {0.35f, 1.32f, -0.62f}, {0.2f, 0.92f, -1.55f}, 62));
    scene.cameras.push_back(camera("shelves", {0.1f, 1.4f, 0.9f}, {-2.0f, 1.0f, -0.7f}, 66));
    return scene;
}

}  // namespace conelight::io::generated
