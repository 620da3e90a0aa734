// SPDX-License-Identifier: MIT
// A kitchen counter by a window: tiles, steel sink and kettle, cups, jars, boards and cloths some millimetres
// apart, a plant. Values -> Scene.
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>

#include "io/generated_furnished.h"
#include "io/generated_textures.h"

namespace conelight::io::generated {
namespace {

constexpr float kTop = 0.90f, kEdge = -0.98f, kBack = -1.6f;  // of the counter's slab
constexpr int kAround = 72;

struct KitchenPaints {
    int slab, cupboard, tile, steel, dull, china, blue, clay, board, cloth, leaf, glaze, fruit;
};

// Slab with a hole for the sink, cupboards with doors 4 mm apart below it, handles.
void addCupboards(const Placer& room, const KitchenPaints& p) {
    shapes::CellSolid slab;
    slab.planes = {std::vector<float>{-1.8f, -0.15f, 0.47f, 1.8f}, std::vector<float>{0.86f, kTop},
                   std::vector<float>{kBack, -1.48f, -1.10f, kEdge}};
    slab.solid = [](glm::vec3 c) { return !(c.x > -0.15f && c.x < 0.47f && c.z > -1.48f && c.z < -1.10f); };
    slab.part = [](glm::vec3, glm::vec3) { return 0; };
    room.put(shapes::buildCells(slab, 1)[0], "slab", p.slab);
    room.put(box({{-1.79f, 0.1f, -1.55f}, {1.79f, 0.715f, -1.03f}}), "carcass", p.cupboard);
    room.put(box({{-1.79f, 0, -1.55f}, {1.79f, 0.099f, -1.09f}}), "plinth", p.dull);
    for (int i = 0; i < 6; ++i) {
        const float x = -1.79f + 0.597f * float(i);
        const auto front = [&](float low, float high) {
            room.put(chamferedBox({{x + 0.002f, low, -1.028f}, {x + 0.595f, high, -1.010f}}, 0.002f), "door",
                     p.cupboard);
            const float y = high - 0.05f;
            room.put(rod({x + 0.18f, y, -0.985f}, {x + 0.42f, y, -0.985f}, 0.006f, 20), "handle", p.steel);
            for (const float a : {0.2f, 0.4f})
                room.put(rod({x + a, y, -1.011f}, {x + a, y, -0.985f}, 0.004f), "handle foot", p.steel);
        };
        front(0.104f, i % 3 == 0 ? 0.62f : 0.852f);
        if (i % 3 == 0) front(0.624f, 0.852f);
    }
}

// Glazed tiles with joints of 2 mm, but for the window.
void addTiles(const Placer& room, const KitchenPaints& p) {
    Mesh tiles;
    const Mesh tile = chamferedBox({{0.001f, 0.001f, 0}, {0.099f, 0.099f, 0.007f}}, 0.0015f);
    for (int j = 0; j < 6; ++j)
        for (int i = 0; i < 36; ++i) {
            const float x = -1.8f + 0.1f * float(i), y = kTop + 0.1f * float(j);
            if (x > -0.62f && x < 0.78f && y > 1.02f) continue;
            const float lean = 0.0008f * randomAt(3, i, j);
            merge(tiles, tile, translation({x, y, kBack + 0.001f + lean}));
        }
    room.put(std::move(tiles), "tiles", p.tile);
}

// A basin of one sheet, its rim 2 mm above the slab; a bent tap.
void addSink(const Placer& room, const KitchenPaints& p) {
    Mesh basin;
    const glm::vec3 o(-0.148f, 0.72f, -1.478f);
    const float w = 0.616f, d = 0.376f, h = 0.182f;
    shapes::appendQuad(basin, o, {0, 0, d}, {w, 0, 0});
    shapes::appendQuad(basin, o, {w, 0, 0}, {0, h, 0});
    shapes::appendQuad(basin, o + glm::vec3(w, 0, d), {-w, 0, 0}, {0, h, 0});
    shapes::appendQuad(basin, o + glm::vec3(0, 0, d), {0, 0, -d}, {0, h, 0});
    shapes::appendQuad(basin, o + glm::vec3(w, 0, 0), {0, 0, d}, {0, h, 0});
    shapes::appendFrame(basin, o + glm::vec3(-0.02f, h, d + 0.02f), {w + 0.04f, 0, 0}, {0, 0, -d - 0.04f},
                        {0.032f, 0.05f}, {0.968f, 0.95f});
    room.put(std::move(basin), "sink", p.steel);
    room.put(torus(0.035f, 0.006f), "drain", p.steel, {0.16f, 0.724f, -1.29f});
    room.put(cylinder(0.025f, kTop, 0.96f, kAround, 2), "tap foot", p.steel, {0.16f, 0, -1.53f});
    room.put(tube(
                 [](float t) {
                     const float a = glm::pi<float>() * std::min(std::max(1.6f * t - 0.6f, 0.0f), 1.1f);
                     return glm::vec3(0.16f, t < 0.375f ? 0.95f + 0.55f * t : 1.156f + 0.1f * std::sin(a),
                                      -1.43f - 0.1f * std::cos(a));
                 },
                 0.013f, 64, 28, {1, 0, 0}),
             "tap", p.steel);
}

void addKettle(const Placer& at, const KitchenPaints& p) {
    at.put(turned({shapes::line({0, 0.002f}, {0.10f, 0.002f}),
                   shapes::arc({0.10f, 0.012f}, {0.01f, 0.01f}, -1.57f, 0, 6),
                   shapes::arc({0.02f, 0.012f}, {0.09f, 0.16f}, 0, 1.45f, 40)},
                  96),
           "kettle", p.steel);
    at.put(cylinder(0.035f, 0.17f, 0.178f, kAround, 2), "lid", p.steel, glm::vec3(0));
    at.put(sphere(0.014f, 40), "knob", p.dull, {0, 0.192f, 0});
    at.put(
        tube([](float t) { return glm::vec3(0.08f + 0.10f * t, 0.09f + 0.08f * t * t, 0); }, 0.014f, 24, 28),
        "spout", p.steel);
    at.put(tube(
               [](float t) {
                   const float a = 0.25f + 2.64f * t;
                   return glm::vec3(0.11f * std::cos(a), 0.13f + 0.13f * std::sin(a), 0);
               },
               0.007f, 48, 20),
           "kettle handle", p.dull);
}

// A jar with a lid that stands a millimetre above its rim.
void addJar(const Placer& at, float radius, float height, int body, int lid) {
    at.put(
        turned({shapes::line({0, 0.001f}, {0.9f * radius, 0.001f}),
                shapes::arc({0.9f * radius, 0.1f * radius}, {0.1f * radius, 0.1f * radius}, -1.57f, 0, 6),
                shapes::line({radius, 0.1f * radius}, {radius, 0.85f * height}, 12),
                shapes::arc({0.8f * radius, 0.85f * height}, {0.2f * radius, 0.15f * height}, 0, 1.57f, 8)},
               kAround),
        "jar", body);
    at.put(turned({shapes::line({0, height + 0.001f}, {0.82f * radius, height + 0.001f}),
                   shapes::line({0.82f * radius, height + 0.001f}, {0.82f * radius, height + 0.02f}, 3),
                   shapes::line({0.82f * radius, height + 0.02f}, {0.02f, height + 0.03f}, 6),
                   shapes::arc({0, height + 0.042f}, {0.018f, 0.014f}, -0.9f, 1.57f, 12)},
                  kAround),
           "jar lid", lid);
}

void addCup(const Placer& at, int material, float radius = 0.042f) {
    at.put(cup(radius, 0.088f, 0.003f, kAround), "cup", material);
    at.put(tube(
               [=](float t) {
                   const float a = -1.35f + 2.7f * t;
                   return glm::vec3(radius - 0.006f + 0.026f * std::cos(a), 0.046f + 0.028f * std::sin(a), 0);
               },
               0.0045f, 24, 14),
           "cup handle", material);
}

// What stands and lies on the slab, left to right.
void addThings(const Placer& top, const KitchenPaints& p) {
    for (int i = 0; i < 4; ++i)
        addJar(top.at(translation({-1.66f + 0.17f * float(i), 0, -1.50f})), 0.072f - 0.007f * float(i),
               0.24f - 0.035f * float(i), i % 2 ? p.china : p.blue, i % 2 ? p.board : p.china);
    addKettle(top.at(translation({-0.62f, 0, -1.34f}) * turnAboutY(-2.5f)), p);
    // Seven plates, 3 mm apart.
    const Mesh plate = turned(
        {shapes::line({0, 0}, {0.07f, 0}), shapes::line({0.07f, 0}, {0.12f, 0.014f}, 4),
         shapes::line({0.12f, 0.014f}, {0.119f, 0.018f}), shapes::line({0.119f, 0.018f}, {0.069f, 0.004f}, 4),
         shapes::line({0.069f, 0.004f}, {0, 0.004f})},
        96);
    for (int i = 0; i < 7; ++i)
        top.put(plate, "plate", i == 3 ? p.blue : p.china, {-1.42f, 0.001f + 0.007f * float(i), -1.20f});
    addCup(top.at(translation({-1.42f, 0.055f, -1.20f}) * turnAboutY(0.8f)), p.china);
    addCup(top.at(translation({-1.14f, 0.001f, -1.17f}) * turnAboutY(-0.5f)), p.blue);
    addCup(top.at(translation({-1.02f, 0.001f, -1.26f}) * turnAboutY(2.2f)), p.china);
    addCup(top.at(translation({-0.9f, 0.001f, -1.10f}) * turnAboutY(1.2f)), p.clay);
    // Boards: two lie, a cloth between them; two lean.
    const Placer lie = top.at(translation({1.0f, 0, -1.24f}) * turnAboutY(0.12f));
    lie.put(chamferedBox({{-0.24f, 0.003f, -0.15f}, {0.24f, 0.021f, 0.15f}}, 0.003f), "board", p.board);
    lie.put(chamferedBox({{-0.16f, 0.025f, -0.09f}, {0.15f, 0.039f, 0.09f}}, 0.003f), "small board", p.board,
            turnAboutY(-0.3f));
    lie.put(box({{-0.1f, 0.0405f, -0.012f}, {0.09f, 0.0425f, 0.014f}}), "blade", p.steel);
    lie.put(chamferedBox({{0.09f, 0.040f, -0.013f}, {0.2f, 0.058f, 0.012f}}, 0.004f), "knife handle", p.dull);
    for (int i = 0; i < 2; ++i)
        top.put(chamferedBox({{-0.14f, 0, 0}, {0.14f, 0.4f - 0.08f * float(i), 0.016f}}, 0.003f),
                "leaning board", i ? p.clay : p.board,
                translation({1.42f + 0.1f * float(i), 0.001f, -1.47f + 0.024f * float(i)}) *
                    glm::rotate(glm::mat4(1), -0.22f, glm::vec3(1, 0, 0)));
    // A bowl of fruit.
    const Placer bowl = top.at(translation({0.66f, 0.001f, -1.38f}));
    bowl.put(
        turned({shapes::line({0, 0}, {0.05f, 0}), shapes::arc({0.05f, 0.09f}, {0.09f, 0.09f}, -1.57f, 0, 16),
                shapes::line({0.14f, 0.09f}, {0.136f, 0.09f}),
                shapes::arc({0.05f, 0.09f}, {0.086f, 0.086f}, 0, -1.57f, 16),
                shapes::line({0.05f, 0.004f}, {0, 0.004f})},
               96),
        "bowl", p.glaze);
    for (int i = 0; i < 7; ++i) {
        const float a = 1.05f * float(i);
        bowl.put(
            sphere(0.038f, 40), "fruit", p.fruit,
            i == 6 ? glm::vec3(0, 0.098f, 0) : glm::vec3(0.066f * std::cos(a), 0.056f, 0.066f * std::sin(a)));
    }
}

// A cloth over the slab's edge, and one folded in four layers 3 mm apart.
void addCloths(const Placer& top, const KitchenPaints& p) {
    top.put(sheet(
                [](float u, float v) {
                    const float along = 0.62f * v, bend = 0.24f;  // from the slab down over its edge
                    const float wave = 0.010f * std::sin(16.0f * u + 1.5f) * std::min(1.0f, 2.0f * v);
                    if (along < bend) return glm::vec3(0.34f * u, 0.003f + 0.3f * wave * wave, along);
                    return glm::vec3(0.34f * u + 0.02f * std::sin(3.0f * along), 0.003f + bend - along,
                                     bend + 0.012f + wave);
                },
                48, 62, {0.34f, 0.62f}),
            "cloth", p.cloth, {-0.58f, 0, kEdge - 0.242f});
    for (int i = 0; i < 4; ++i)
        top.put(sheet(
                    [i](float u, float v) {
                        return glm::vec3(0.22f * u, 0.003f * float(i + 1) + 0.001f * std::sin(9 * u + 5 * v),
                                         -0.16f * v);
                    },
                    24, 16, {0.22f, 0.16f}),
                "folded cloth", p.cloth, translation({-0.92f, 0, -1.4f}) * turnAboutY(0.15f));
}

// Shelf with cups, cups on hooks below it, a rail with ladles, cupboard with a strip of light.
void addWall(const Placer& room, const KitchenPaints& p, float glow) {
    for (int row = 0; row < 2; ++row) {
        const float y = 1.55f + 0.36f * float(row);
        room.put(chamferedBox({{-1.78f, y, kBack + 0.01f}, {-0.72f, y + 0.024f, -1.36f}}, 0.003f), "shelf",
                 p.board);
        for (const float x : {-1.6f, -0.9f})
            room.put(rod({x, y - 0.14f, kBack + 0.01f}, {x, y - 0.004f, -1.4f}, 0.006f), "bracket", p.dull);
        for (int i = 0; i < 6; ++i) {
            const Placer at =
                room.at(translation({-1.68f + 0.165f * float(i), y + 0.025f, -1.47f}) * turnAboutY(float(i)));
            if ((i + row) % 3 == 0)
                addJar(at, 0.05f, 0.15f, p.clay, p.board);
            else
                addCup(at, i % 2 ? p.china : p.blue);
        }
    }
    room.put(rod({0.82f, 1.45f, kBack + 0.05f}, {1.76f, 1.45f, kBack + 0.05f}, 0.007f, 24), "rail", p.steel);
    for (int i = 0; i < 7; ++i) {
        const float x = 0.88f + 0.13f * float(i), z = kBack + 0.06f;
        room.put(rod({x, 1.45f, z}, {x, 1.20f, z}, 0.0035f, 16), "ladle stem", p.steel);
        room.put(turned({shapes::arc({0, 0.03f}, {0.03f, 0.03f}, -1.57f, 0, 12)}, 40), "ladle",
                 i % 2 ? p.dull : p.steel, {x, 1.145f, z});
    }
    for (int i = 0; i < 2; ++i) {
        const float x = 0.84f + 0.48f * float(i);
        room.put(box({{x, 1.62f, kBack + 0.002f}, {x + 0.478f, 2.3f, -1.29f}}), "wall cupboard", p.cupboard);
        room.put(chamferedBox({{x + 0.001f, 1.615f, -1.287f}, {x + 0.477f, 2.305f, -1.269f}}, 0.002f), "door",
                 p.cupboard);
    }
    if (glow > 0)
        room.put(quad({1.0f, 1.612f, -1.5f}, {0.6f, 0, 0}, {0, 0, 0.02f}), "strip",
                 add(room.scene, emitter("strip light", glow * glm::vec3(1.0f, 0.86f, 0.66f))));
}

void addWindow(const Placer& room, const KitchenPaints& p) {
    const auto bar = [&](glm::vec3 min, glm::vec3 max) {
        room.put(chamferedBox({min, max}, 0.004f), "window bar", p.china);
    };
    for (const float x : {-0.52f, 0.06f, 0.70f}) bar({x, 1.1f, -1.72f}, {x + 0.06f, 2.1f, -1.67f});
    for (const float y : {1.1f, 1.72f, 2.05f}) bar({-0.46f, y, -1.715f}, {0.70f, y + 0.05f, -1.675f});
    bar({-0.6f, 1.075f, -1.66f}, {0.84f, 1.105f, -1.5f});
    for (const float x : {-0.62f, 0.88f})
        room.put(curtain(0.26f, 1.15f, 0.018f, 5), "curtain", p.cloth, {x, 1.02f, -1.53f});
    room.put(rod({-0.85f, 2.19f, -1.53f}, {1.1f, 2.19f, -1.53f}, 0.008f, 20), "curtain rod", p.dull);
    const Placer plant = room.at(translation({0.52f, 1.106f, -1.58f}));
    plant.put(cup(0.07f, 0.11f, 0.005f, kAround), "pot", p.clay);
    plant.put(leaves({0.14f, 0.16f, 0.11f}, 420, 0.04f, 17), "plant", p.leaf, {0, 0.24f, 0.02f});
    Mesh stems;
    for (int i = 0; i < 24; ++i) {
        const float a = 0.5f * float(i);
        merge(stems, rod({0, 0.06f, 0}, {0.09f * std::cos(a), 0.3f, 0.08f * std::sin(a)}, 0.0015f, 8));
    }
    plant.put(std::move(stems), "stems", p.leaf);
}

}  // namespace

Scene buildCounter(const Values& values) {
    Scene scene;
    const Placer room{scene};
    const KitchenPaints p = {textured(scene, "slab", textures::marble(512), 1.4f, {0.62f, 0.60f, 0.57f}),
                             textured(scene, "cupboard", textures::wood(256), 0.8f, {0.56f, 0.44f, 0.30f}),
                             add(scene, glossy("tile", {0.68f, 0.70f, 0.66f}, 0.22f)),
                             add(scene, metal("steel", {0.62f, 0.61f, 0.59f}, float(values["roughness"]))),
                             add(scene, matte("dark", {0.05f, 0.05f, 0.05f})),
                             add(scene, glossy("china", {0.74f, 0.73f, 0.70f}, 0.3f)),
                             add(scene, glossy("blue glaze", {0.10f, 0.20f, 0.38f}, 0.25f)),
                             add(scene, matte("clay", {0.50f, 0.25f, 0.16f})),
                             textured(scene, "board", textures::wood(256), 0.3f, {0.58f, 0.40f, 0.24f}),
                             textured(scene, "cloth", textures::fabric(256), 0.12f, {0.64f, 0.60f, 0.54f}),
                             add(scene, matte("leaf", {0.14f, 0.32f, 0.08f})),
                             add(scene, glossy("green glaze", {0.22f, 0.34f, 0.26f}, 0.3f)),
                             add(scene, matte("fruit", {0.70f, 0.34f, 0.06f}))};
    const int plaster = textured(scene, "plaster", textures::plaster(256), 1.2f, {0.72f, 0.70f, 0.64f});
    const int floor = textured(scene, "floor tiles", textures::tiles(256).color, 0.6f, {0.75f, 0.72f, 0.68f});
    addRoom(scene, {{-1.8f, 0, kBack}, {1.8f, 2.5f, 1.7f}},
            {floor, plaster, plaster, plaster, plaster, plaster},
            {{{-0.5f, 1.1f, -3}, {0.75f, 2.1f, kBack}}, {{-1.5f, 0, 1.7f}, {1.1f, 2.2f, 3}}});
    addCupboards(room, p);
    addTiles(room, p);
    addSink(room, p);
    addThings(room.at(translation({0, kTop, 0})), p);
    addCloths(room.at(translation({0, kTop, 0})), p);
    addWall(room, p, float(values["strip"]));
    addWindow(room, p);
    makeTwoSided(scene);
    scene.lights.push_back(
        sunLight("sun", {0.42f, -0.60f, 0.68f}, float(values["sun"]) * glm::vec3(1.0f, 0.93f, 0.82f)));
    scene.sky = float(values["sky"]) * glm::vec3(0.60f, 0.78f, 1.0f);
    scene.cameras.push_back(camera("front", {0.55f, 1.62f, 0.55f}, {-0.05f, 1.12f, -1.5f}, 64));
    scene.cameras.push_back(camera("cups", {-0.75f, 1.28f, -0.52f}, {-1.18f, 0.95f, -1.4f}, 58));
    scene.cameras.push_back(camera("boards", {0.72f, 1.36f, -0.5f}, {1.05f, 0.95f, -1.4f}, 58));
    return scene;
}

}  // namespace conelight::io::generated
