// SPDX-License-Identifier: MIT
// A cafe's terrace: parasols, chairs of rods and slats, laid tables, planters, a wall with a vine. Values -> Scene.
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>

#include "io/generated_furnished.h"
#include "io/generated_textures.h"

namespace conelight::io::generated {
namespace {

struct CafePaints {
    int steel, timber, marble, canvas, stripe, china, wicker, clay, leaf, petal, paper;
};

// A parasol of eight gores, each one sheet that hangs through, with ribs and a mast.
void addParasol(const Placer& at, const CafePaints& p, float turn) {
    const Placer top = at.at(turnAboutY(turn));
    constexpr float kRadius = 1.45f, kGore = 0.78539816f;
    for (int i = 0; i < 8; ++i) {
        top.put(sheet(
                    [](float u, float v) {
                        const float a = kGore * u, r = kRadius * (0.02f + 0.98f * v);
                        const float sag = 0.05f * v * std::sin(glm::pi<float>() * std::clamp(u, 0.0f, 1.0f));
                        const float flat = std::cos(0.5f * kGore) / std::cos(a - 0.5f * kGore);
                        return glm::vec3(r * flat * std::sin(a), 2.55f - 0.42f * v * (0.7f + 0.3f * v) - sag,
                                         r * flat * std::cos(a));
                    },
                    10, 10, {1, 1.5f}),
                "parasol", i % 2 ? p.stripe : p.canvas, turnAboutY(kGore * float(i)));
        top.put(rod({0, 2.5f, 0.03f}, {0, 2.115f, kRadius - 0.02f}, 0.006f, 10), "rib", p.timber,
                turnAboutY(kGore * float(i)));
        top.put(rod({0, 1.95f, 0.03f}, {0, 2.31f, 0.72f}, 0.005f, 10), "stretcher", p.timber,
                turnAboutY(kGore * float(i)));
    }
    top.put(rod({0, 0.06f, 0}, {0, 2.6f, 0}, 0.024f, 32), "mast", p.timber);
    top.put(cylinder(0.26f, 0, 0.06f, 56, 1), "parasol foot", p.steel, glm::vec3(0));
}

// A chair: bent frame of tubes, slats for seat and back.
Mesh chairFrame() {
    Mesh mesh;
    for (const float x : {-0.2f, 0.2f}) {
        merge(mesh, rod({x, 0, 0.2f}, {x, 0.45f, 0.18f}, 0.009f, 16));
        merge(mesh, tube(
                        [=](float t) {
                            return glm::vec3(x, 0.86f * t,
                                             -0.26f + 0.1f * std::sin(glm::pi<float>() * t) - 0.04f * t);
                        },
                        0.009f, 24, 14, {1, 0, 0}));
        merge(mesh, rod({x, 0.45f, -0.18f}, {x, 0.45f, 0.19f}, 0.008f, 14));
    }
    merge(mesh, rod({-0.2f, 0.45f, 0.18f}, {0.2f, 0.45f, 0.18f}, 0.008f, 14));
    merge(mesh, rod({-0.2f, 0.86f, -0.3f}, {0.2f, 0.86f, -0.3f}, 0.009f, 14));
    merge(mesh, rod({-0.2f, 0.22f, -0.19f}, {0.2f, 0.22f, 0.19f}, 0.005f, 12));
    merge(mesh, rod({0.2f, 0.22f, -0.19f}, {-0.2f, 0.22f, 0.19f}, 0.005f, 12));
    return mesh;
}

Mesh chairSlats() {
    Mesh mesh;
    for (int i = 0; i < 8; ++i)
        merge(mesh, chamferedBox({{-0.2f, 0.459f, -0.18f + 0.048f * float(i)},
                                  {0.2f, 0.471f, -0.142f + 0.048f * float(i)}},
                                 0.002f));
    for (int i = 0; i < 5; ++i) {
        const float y = 0.55f + 0.06f * float(i);
        merge(mesh, chamferedBox({{-0.2f, y, -0.205f - 0.02f * float(i)},
                                  {0.2f, y + 0.045f, -0.193f - 0.02f * float(i)}},
                                 0.002f));
    }
    return mesh;
}

void addCupAndSaucer(const Placer& at, const CafePaints& p) {
    at.put(
        turned(
            {shapes::line({0, 0.001f}, {0.04f, 0.001f}), shapes::line({0.04f, 0.001f}, {0.07f, 0.012f}, 3),
             shapes::line({0.07f, 0.012f}, {0.069f, 0.015f}),
             shapes::line({0.069f, 0.015f}, {0.04f, 0.004f}, 3), shapes::line({0.04f, 0.004f}, {0, 0.004f})},
            48),
        "saucer", p.china);
    at.put(cup(0.038f, 0.06f, 0.003f, 48), "cup", p.china, {0, 0.005f, 0});
    at.put(box({{0.045f, 0.015f, -0.005f}, {0.1f, 0.0165f, 0.005f}}), "spoon", p.steel);
}

// A round table laid with cloth, cups, a vase and a folded menu; chairs about it.
void addTable(const Placer& at, int chairs, std::uint32_t seed, const CafePaints& p, int frame, int slats) {
    at.put(turned({shapes::line({0, 0.72f}, {0.38f, 0.72f}),
                   shapes::arc({0.38f, 0.732f}, {0.012f, 0.012f}, -1.57f, 1.57f, 8),
                   shapes::line({0.38f, 0.744f}, {0, 0.744f}, 4)},
                  72),
           "table top", p.marble);
    at.put(rod({0, 0.02f, 0}, {0, 0.72f, 0}, 0.025f, 32), "table stem", p.steel);
    at.put(turned({shapes::line({0, 0}, {0.24f, 0}), shapes::line({0.24f, 0}, {0.03f, 0.05f}, 4),
                   shapes::line({0.03f, 0.05f}, {0, 0.05f})},
                  48),
           "table foot", p.steel);
    const Placer top = at.at(translation({0, 0.745f, 0}) * turnAboutY(float(seed)));
    for (int i = 0; i < chairs; ++i) {
        const float a = 6.2832f * float(i) / float(chairs);
        addCupAndSaucer(
            top.at(translation({0.22f * std::cos(a), 0, 0.22f * std::sin(a)}) * turnAboutY(2 * a)), p);
        const glm::mat4 place = translation({0.72f * std::cos(a), 0, 0.72f * std::sin(a)}) *
                                turnAboutY(-a - 0.5f * glm::pi<float>() + 0.5f * (randomAt(seed, i) - 0.5f));
        const Placer seat = at.at(turnAboutY(float(seed)));
        seat.again(frame, "chair", p.steel, place);
        seat.again(slats, "chair slats", p.timber, place);
    }
    top.put(turned({shapes::line({0, 0}, {0.03f, 0}),
                    shapes::arc({0.03f, 0.05f}, {0.018f, 0.05f}, -1.57f, 1.2f, 14)},
                   40),
            "vase", p.clay, {0.03f, 0.001f, -0.04f});
    top.put(leaves({0.06f, 0.08f, 0.06f}, 60, 0.03f, seed), "sprig", p.leaf, {0.03f, 0.17f, -0.04f});
    top.put(leaves({0.06f, 0.06f, 0.06f}, 24, 0.025f, seed + 7), "petals", p.petal, {0.03f, 0.2f, -0.04f});
    Mesh menu = quad({-0.06f, 0.002f, 0}, {0.12f, 0, 0}, {0, 0.17f, -0.05f});
    shapes::appendQuad(menu, {0.06f, 0.002f, -0.1f}, {-0.12f, 0, 0}, {0, 0.17f, 0.05f});
    top.put(std::move(menu), "menu", p.paper, {-0.1f, 0, 0.06f});
}

// House wall with a door and two wide windows, a vine before it.
void addCafeWall(const Placer& at, int brick, int glass, const CafePaints& p) {
    shapes::CellSolid wall;
    wall.planes = {std::vector<float>{-5.5f, -3.6f, -1.4f, -0.6f, 0.6f, 1.4f, 3.6f, 5.5f},
                   std::vector<float>{0, 0.8f, 2.2f, 2.4f, 4.2f}, std::vector<float>{-1.2f, -0.25f, 0}};
    wall.solid = [](glm::vec3 c) {
        const float x = std::abs(c.x);
        const bool window = x > 1.4f && x < 3.6f && c.y > 0.8f && c.y < 2.2f, door = x < 0.6f && c.y < 2.4f;
        return c.z < -0.25f || !(window || door);
    };
    wall.part = [](glm::vec3, glm::vec3) { return 0; };
    at.put(shapes::buildCells(wall, 1)[0], "wall", brick);
    for (const float x : {-3.6f, 1.4f}) {
        at.put(quad({x + 0.03f, 0.83f, -0.16f}, {2.14f, 0, 0}, {0, 1.34f, 0}), "pane", glass);
        for (int i = 0; i < 5; ++i)
            at.put(chamferedBox({{x + 0.54f * float(i) - 0.03f * (i > 0), 0.8f, -0.18f},
                                 {x + 0.54f * float(i) + 0.04f, 2.2f, -0.13f}},
                                0.005f),
                   "bar", p.timber);
        at.put(chamferedBox({{x - 0.1f, 0.74f, -0.25f}, {x + 2.3f, 0.8f, 0.09f}}, 0.01f), "sill", p.marble);
    }
    at.put(chamferedBox({{-0.56f, 0, -0.2f}, {0.56f, 2.36f, -0.15f}}, 0.005f), "door", p.timber);
    for (int i = 0; i < 5; ++i)
        at.put(leaves({1.1f, 0.28f, 0.09f}, 700, 0.09f, std::uint32_t(200 + i)), "vine", p.leaf,
               {-4.4f + 2.2f * float(i), 2.75f + 0.25f * float(i % 2), 0.1f});
    at.put(leaves({0.16f, 1.3f, 0.09f}, 520, 0.09f, 211), "vine", p.leaf, {-4.9f, 1.4f, 0.1f});
    // A line of unlit bulbs.
    at.put(wire({-5.3f, 3.3f, 0.05f}, {5.3f, 3.3f, 0.05f}, 0.3f, 0.006f), "wire", p.steel);
}

}  // namespace

Scene buildCafe(const Values& values) {
    Scene scene;
    const Placer ground{scene};
    const int paving = textured(scene, "flags", textures::ashlar(512).color, 1.3f, {0.55f, 0.51f, 0.45f});
    const int stucco = textured(scene, "stucco", textures::plaster(512), 1.8f, {0.68f, 0.52f, 0.36f});
    const int glass = add(scene, glossy("window glass", {0.04f, 0.045f, 0.05f}, 0.1f));
    const CafePaints p = {add(scene, matte("painted steel", {0.10f, 0.14f, 0.13f})),
                          textured(scene, "slats", textures::wood(256), 0.5f, {0.50f, 0.36f, 0.22f}),
                          textured(scene, "marble", textures::marble(256), 0.8f, {0.70f, 0.69f, 0.66f}),
                          add(scene, matte("canvas", {0.74f, 0.70f, 0.60f})),
                          add(scene, matte("green canvas", {0.16f, 0.34f, 0.24f})),
                          add(scene, glossy("china", {0.75f, 0.75f, 0.73f}, 0.3f)),
                          add(scene, matte("wicker", {0.46f, 0.34f, 0.20f})),
                          add(scene, matte("clay", {0.52f, 0.26f, 0.17f})),
                          add(scene, matte("leaf", {0.17f, 0.33f, 0.10f})),
                          add(scene, matte("petal", {0.66f, 0.18f, 0.22f})),
                          add(scene, matte("paper", {0.72f, 0.70f, 0.64f}))};
    ground.put(box({{-6, -0.3f, -4}, {6, 0, 5}}), "paving", paving);
    addCafeWall(ground.at(translation({0, 0.001f, -2.6f})), stucco, glass, p);
    const int frame = add(scene, chairFrame()), slats = add(scene, chairSlats());
    scene.meshes[std::size_t(frame)].name = "chair";
    scene.meshes[std::size_t(slats)].name = "chair slats";
    const glm::vec3 tables[] = {
        {-2.9f, 3, -0.9f}, {-0.2f, 4, -0.2f}, {2.5f, 3, -1.0f}, {-1.9f, 3, 1.9f}, {1.8f, 4, 1.7f}};
    std::uint32_t seed = 3;
    for (const glm::vec3& t : tables)
        addTable(ground.at(translation({t.x, 0.001f, t.z})), int(t.y), seed++, p, frame, slats);
    addParasol(ground.at(translation({-2.3f, 0.001f, -0.1f})), p, 0.2f);
    addParasol(ground.at(translation({1.25f, 0.001f, 0.15f})), p, 0.5f);
    for (int i = 0; i < 4; ++i) {  // planters of slats
        const Placer planter = ground.at(translation({-4.6f + 2.9f * float(i), 0.001f, 3.4f}));
        for (int k = 0; k < 5; ++k)
            planter.put(chamferedBox({{-0.7f, 0.03f + 0.085f * float(k), 0.16f},
                                      {0.7f, 0.105f + 0.085f * float(k), 0.18f}},
                                     0.003f),
                        "planter", p.timber);
        planter.put(box({{-0.69f, 0.02f, -0.18f}, {0.69f, 0.4f, 0.15f}}), "planter box", p.wicker);
        planter.put(leaves({0.72f, 0.32f, 0.22f}, 650, 0.08f, std::uint32_t(300 + i)), "shrub", p.leaf,
                    {0, 0.62f, 0});
        planter.put(leaves({0.72f, 0.34f, 0.24f}, 60, 0.05f, std::uint32_t(310 + i)), "petals", p.petal,
                    {0, 0.64f, 0});
    }
    makeTwoSided(scene);
    scene.lights.push_back(
        sunLight("sun", {-0.48f, -0.78f, -0.40f}, float(values["sun"]) * glm::vec3(1.0f, 0.94f, 0.84f)));
    scene.sky = float(values["sky"]) * glm::vec3(0.56f, 0.76f, 1.0f);
    scene.cameras.push_back(camera("front", {3.9f, 1.7f, 3.0f}, {-0.7f, 1.0f, -0.9f}, 62));
    scene.cameras.push_back(camera("table", {0.6f, 1.3f, 1.0f}, {-0.3f, 0.7f, -0.5f}, 58));
    return scene;
}

}  // namespace conelight::io::generated
