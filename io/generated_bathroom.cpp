// SPDX-License-Identifier: MIT
// A bathroom: tiled walls, tub, shower curtain, towels, taps, a lit globe. Values -> Scene.
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>

#include "io/generated_furnished.h"
#include "io/generated_textures.h"

namespace conelight::io::generated {
namespace {

struct BathroomPaints {
    int tile, porcelain, chrome, towel, cloth, timber, brass, leaf, bottle;
};

// Tiles with rounded edges over a wall, in its plane: x along it, y up, the front towards +z.
Mesh tiledWall(float width, float height, glm::vec2 tile) {
    Mesh mesh;
    const Mesh one = chamferedBox({{0.001f, 0.001f, 0}, {tile.x - 0.001f, tile.y - 0.001f, 0.008f}}, 0.0015f);
    const int rows = int(height / tile.y), columns = int(width / tile.x);
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i)
            merge(mesh, one, translation({tile.x * float(i), tile.y * float(j), 0.001f}));
    return mesh;
}

// A round-cornered tub of one sheet with a rolled rim, on four feet.
void addTub(const Placer& at, const BathroomPaints& p) {
    // Half lengths of its ring at v: down the inside to the middle of its floor.
    const auto ring = [](float u, float v, float grow) {
        const float a = 2 * glm::pi<float>() * u, c = std::cos(a), s = std::sin(a);
        const float k = std::pow(std::pow(std::abs(c), 4.0f) + std::pow(std::abs(s), 4.0f), -0.25f);
        const float in = v < 0.4f ? 2.25f * v : 0.9f + 0.167f * (v - 0.4f);
        return glm::vec3((0.78f + grow) * in * k * c, 0, (0.33f + grow) * in * k * s);
    };
    const auto skin = [&](float grow, float floor) {
        return sheet(
            [=](float u, float v) {
                return ring(u, v, grow) +
                       glm::vec3(0, floor + (0.58f - floor) * std::pow(std::max(0.0f, v - 0.3f) / 0.7f, 1.5f),
                                 0);
            },
            96, 40, {4, 1});
    };
    at.put(skin(0, 0.16f), "tub inside", p.porcelain);
    at.put(skin(0.035f, 0.13f), "tub", p.porcelain);
    at.put(tube([&](float u) { return ring(u, 1, 0.018f) + glm::vec3(0, 0.585f, 0); }, 0.024f, 128, 20,
                {0, 1, 0}),
           "rim", p.porcelain);
    for (const float x : {-0.4f, 0.4f})
        for (const float z : {-0.14f, 0.14f}) at.put(sphere(0.07f, 32), "foot", p.brass, {x, 0.07f, z});
    at.put(rod({-0.86f, 0.45f, 0}, {-0.86f, 0.75f, 0}, 0.015f, 28), "tap", p.chrome);
    at.put(
        tube([](float t) { return glm::vec3(-0.86f + 0.17f * t, 0.75f - 0.12f * t * t, 0); }, 0.014f, 24, 24),
        "spout", p.chrome);
}

void addWashstand(const Placer& at, const BathroomPaints& p) {
    at.put(chamferedBox({{-0.45f, 0.80f, -0.25f}, {0.45f, 0.83f, 0.25f}}, 0.004f), "washstand", p.timber);
    at.put(box({{-0.44f, 0.35f, -0.24f}, {0.44f, 0.37f, 0.24f}}), "lower shelf", p.timber);
    for (const float x : {-0.42f, 0.38f})
        for (const float z : {-0.22f, 0.18f})
            at.put(box({{x, 0, z}, {x + 0.04f, 0.799f, z + 0.04f}}), "leg", p.timber);
    at.put(turned({shapes::line({0, 0.001f}, {0.08f, 0.001f}),
                   shapes::arc({0.08f, 0.12f}, {0.13f, 0.119f}, -1.57f, 0, 20),
                   shapes::line({0.21f, 0.12f}, {0.20f, 0.12f}),
                   shapes::arc({0.08f, 0.12f}, {0.12f, 0.109f}, 0, -1.57f, 20),
                   shapes::line({0.08f, 0.011f}, {0, 0.011f})},
                  96),
           "basin", p.porcelain, {0.1f, 0.83f, 0});
    at.put(tube(
               [](float t) {
                   const float a = glm::pi<float>() * t;
                   return glm::vec3(0.1f, 0.95f + 0.09f * std::sin(a), -0.12f - 0.08f * std::cos(a));
               },
               0.011f, 48, 24, {1, 0, 0}),
           "tap", p.chrome);
    at.put(rod({0.1f, 0.83f, -0.2f}, {0.1f, 0.95f, -0.2f}, 0.013f, 28), "tap foot", p.chrome);
    for (int i = 0; i < 4; ++i)
        at.put(turned({shapes::line({0, 0}, {0.028f, 0}),
                       shapes::line({0.028f, 0}, {0.028f, 0.11f + 0.02f * float(i)}, 4),
                       shapes::arc({0.01f, 0.11f + 0.02f * float(i)}, {0.018f, 0.02f}, 0, 1.57f, 6),
                       shapes::line({0.01f, 0.13f + 0.02f * float(i)}, {0.01f, 0.16f + 0.02f * float(i)}),
                       shapes::line({0.01f, 0.16f + 0.02f * float(i)}, {0, 0.16f + 0.02f * float(i)})},
                      48),
               "bottle", i % 2 ? p.bottle : p.brass,
               {-0.36f + 0.075f * float(i), 0.831f, -0.14f + 0.04f * float(i % 2)});
    // Folded towels: sheets 6 mm apart.
    for (int i = 0; i < 10; ++i)
        at.put(sheet(
                   [i](float u, float v) {
                       return glm::vec3(0.36f * u, 0.006f * float(i) + 0.002f * std::sin(7 * u + 4 * v),
                                        -0.28f * v);
                   },
                   28, 16, {0.36f, 0.28f}),
               "folded towel", i < 5 ? p.towel : p.cloth, {-0.3f, 0.374f, 0.14f});
}

// A towel over a rod: both halves of one sheet, 2 cm apart.
void addTowel(const Placer& at, float width, int cloth, int chrome) {
    at.put(rod({-0.08f, 0, 0}, {width + 0.08f, 0, 0}, 0.009f, 24), "towel rod", chrome);
    at.put(sheet(
               [=](float u, float v) {
                   const float along = 1.3f * (v - 0.5f), side = along > 0 ? 1.0f : -1.0f;
                   const float down = std::max(0.0f, std::abs(along) - 0.016f),
                               bend = std::min(1.0f, std::abs(along) / 0.016f);
                   return glm::vec3(
                       width * u, 0.011f - 0.011f * bend - down,
                       side * 0.011f * bend + 0.008f * std::sin(11 * u + 2) * std::min(1.0f, 4 * down));
               },
               40, 130, {width, 1.3f}),
           "towel", cloth);
}

}  // namespace

Scene buildBathroom(const Values& values) {
    Scene scene;
    const Placer room{scene};
    const BathroomPaints p = {
        add(scene, glossy("wall tile", {0.60f, 0.68f, 0.68f}, 0.2f)),
        add(scene, glossy("porcelain", {0.75f, 0.75f, 0.73f}, 0.2f)),
        add(scene, metal("chrome", {0.62f, 0.63f, 0.64f}, 0.2f)),
        textured(scene, "towel", textures::fabric(256), 0.15f, {0.66f, 0.48f, 0.30f}),
        textured(scene, "shower curtain", textures::fabric(256), 0.4f, {0.70f, 0.72f, 0.70f}),
        textured(scene, "timber", textures::wood(256), 0.5f, {0.50f, 0.34f, 0.20f}),
        add(scene, metal("brass", {0.72f, 0.56f, 0.28f}, 0.35f)),
        add(scene, matte("leaf", {0.15f, 0.31f, 0.10f})),
        add(scene, glossy("bottle", {0.14f, 0.34f, 0.30f}, 0.3f))};
    const int floor = textured(scene, "floor tiles", textures::tiles(512).color, 0.5f, {0.78f, 0.76f, 0.72f});
    const int paint = textured(scene, "paint", textures::plaster(256), 1.0f, {0.72f, 0.72f, 0.68f});
    addRoom(scene, {{-1.6f, 0, -1.5f}, {1.6f, 2.5f, 1.5f}}, {floor, paint, paint, paint, paint, paint},
            {{{1.6f, 1.0f, -0.9f}, {3, 2.1f, 0.3f}}});
    room.put(tiledWall(3.19f, 1.5f, {0.15f, 0.075f}), "tiles", p.tile, {-1.6f, 0, -1.5f});
    room.put(tiledWall(2.99f, 1.5f, {0.15f, 0.075f}), "tiles", p.tile,
             translation({-1.6f, 0, 1.5f}) * turnAboutY(0.5f * glm::pi<float>()));
    addTub(room.at(translation({-0.62f, 0, -0.98f})), p);
    room.put(rod({-1.59f, 2.1f, -0.52f}, {0.4f, 2.1f, -0.52f}, 0.011f, 24), "curtain rod", p.chrome);
    room.put(curtain(0.75f, 1.75f, 0.035f, 8), "shower curtain", p.cloth, {0.0f, 0.33f, -0.52f});
    for (int i = 0; i < 9; ++i)
        room.put(torus(0.018f, 0.003f), "ring", p.chrome,
                 translation({-0.36f + 0.09f * float(i), 2.09f, -0.52f}) *
                     glm::rotate(glm::mat4(1), 0.5f * glm::pi<float>(), glm::vec3(0, 0, 1)));
    addWashstand(room.at(translation({0.95f, 0, -1.2f})), p);
    room.put(chamferedBox({{0.62f, 1.2f, -1.478f}, {1.28f, 1.95f, -1.462f}}, 0.004f), "cabinet", p.timber);
    addTowel(room.at(translation({-1.52f, 1.25f, 0.9f}) * turnAboutY(0.5f * glm::pi<float>())), 0.5f, p.towel,
             p.chrome);
    room.put(chamferedBox({{-0.4f, 0.001f, -0.3f}, {0.4f, 0.012f, 0.3f}}, 0.004f), "mat", p.towel,
             {0, 0, 0.0f});
    const Placer stool = room.at(translation({-1.1f, 0, 0.35f}));
    stool.put(cylinder(0.17f, 0.42f, 0.45f, 64, 2), "stool", p.timber, glm::vec3(0));
    for (int i = 0; i < 3; ++i) {
        const float a = 2.1f * float(i);
        stool.put(rod({0.16f * std::cos(a), 0, 0.16f * std::sin(a)},
                      {0.1f * std::cos(a), 0.42f, 0.1f * std::sin(a)}, 0.016f, 20),
                  "stool leg", p.timber);
    }
    stool.put(cup(0.08f, 0.12f, 0.005f, 56), "pot", p.brass, {0, 0.451f, 0});
    stool.put(leaves({0.2f, 0.22f, 0.2f}, 320, 0.07f, 23), "plant", p.leaf, {0, 0.75f, 0});
    if (values["globe"] > 0)
        room.put(sphere(0.12f, 48), "globe",
                 add(scene, emitter("globe", float(values["globe"]) * glm::vec3(1.0f, 0.87f, 0.68f))),
                 {0.3f, 2.2f, 0.1f});
    room.put(rod({0.3f, 2.33f, 0.1f}, {0.3f, 2.5f, 0.1f}, 0.012f), "globe stem", p.brass);
    makeTwoSided(scene);
    scene.sky = float(values["sky"]) * glm::vec3(0.62f, 0.79f, 1.0f);
    scene.cameras.push_back(camera("front", {1.15f, 1.55f, 1.4f}, {-0.45f, 0.75f, -0.9f}, 66));
    scene.cameras.push_back(camera("washstand", {0.35f, 1.3f, -0.1f}, {1.0f, 0.8f, -1.3f}, 62));
    return scene;
}

}  // namespace conelight::io::generated
