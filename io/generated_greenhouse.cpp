// SPDX-License-Identifier: MIT
// A greenhouse without its panes: ribs, benches of slats, pots and plants of loose leaves. Values -> Scene.
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>

#include "io/generated_furnished.h"
#include "io/generated_textures.h"

namespace conelight::io::generated {
namespace {

struct GreenhousePaints {
    int white, clay, soil, slat, zinc, rubber, leaf[3], petal;
};

// Posts, rafters and bars of the house; a brick sill carries them.
void addRibs(const Placer& at, const GreenhousePaints& p, int brick) {
    Mesh ribs;
    for (int i = 0; i < 9; ++i) {
        const float z = -3 + 0.75f * float(i);
        for (const float x : {-2.0f, 2.0f}) {
            merge(ribs, chamferedBox({{x - 0.03f, 0.6f, z - 0.025f}, {x + 0.03f, 2.0f, z + 0.025f}}, 0.004f));
            merge(ribs, rod({x, 2.0f, z}, {0, 3.1f, z}, 0.022f, 8));
        }
    }
    for (const float x : {-2.0f, 2.0f}) {
        for (const float y : {1.3f, 2.0f}) merge(ribs, rod({x, y, -3}, {x, y, 3}, 0.02f, 8));
        merge(ribs, rod({0.5f * x, 2.55f, -3}, {0.5f * x, 2.55f, 3}, 0.014f, 8));
        at.put(chamferedBox({{x - 0.11f, 0, -3.05f}, {x + 0.11f, 0.6f, 3.05f}}, 0.01f), "sill", brick);
    }
    merge(ribs, rod({0, 3.1f, -3}, {0, 3.1f, 3}, 0.03f, 10));
    at.put(std::move(ribs), "ribs", p.white);
    at.put(chamferedBox({{-1.88f, 0, -3.11f}, {1.88f, 0.6f, -2.89f}}, 0.01f), "sill", brick);
    for (int i = 0; i < 5; ++i)
        at.put(rod({-1.5f + 0.75f * float(i), 0.6f, -3}, {-1.5f + 0.75f * float(i), 2.2f, -3}, 0.02f, 8),
               "bar", p.white);
}

void addPottingBench(const Placer& at, float length, const GreenhousePaints& p) {
    for (int i = 0; i < 7; ++i)
        at.put(
            chamferedBox({{-0.4f + 0.115f * float(i), 0.78f, 0}, {-0.3f + 0.115f * float(i), 0.8f, length}},
                         0.002f),
            "slat", p.slat);
    for (int i = 0; i < 4; ++i) {
        const float z = 0.1f + (length - 0.25f) * float(i) / 3.0f;
        at.put(box({{-0.4f, 0.73f, z}, {0.39f, 0.779f, z + 0.05f}}), "cross bar", p.slat);
        for (const float x : {-0.39f, 0.33f})
            at.put(box({{x, 0, z}, {x + 0.05f, 0.729f, z + 0.05f}}), "bench leg", p.slat);
    }
}

Mesh flowerPot(float radius, float height) {
    return turned({shapes::line({0, 0.001f}, {0.7f * radius, 0.001f}),
                   shapes::line({0.7f * radius, 0.001f}, {0.95f * radius, 0.75f * height}, 5),
                   shapes::line({0.95f * radius, 0.75f * height}, {1.05f * radius, 0.75f * height}),
                   shapes::line({1.05f * radius, 0.75f * height}, {1.08f * radius, height}, 2),
                   shapes::line({1.08f * radius, height}, {0.97f * radius, height}),
                   shapes::line({0.97f * radius, height}, {0.9f * radius, 0.85f * height}, 2),
                   shapes::line({0.9f * radius, 0.85f * height}, {0, 0.85f * height})},
                  40);
}

// Bent leaves that grow out of a pot, each one sheet.
Mesh fan(int count, float length, float width, std::uint32_t seed) {
    Mesh mesh;
    for (int i = 0; i < count; ++i) {
        const float a = 6.2832f * randomAt(seed, i), lean = 0.3f + 0.9f * randomAt(seed, i, 1);
        const float size = length * (0.6f + 0.4f * randomAt(seed, i, 2));
        merge(mesh,
              sheet(
                  [=](float u, float v) {
                      const float across =
                          width * std::sin(glm::pi<float>() * (0.08f + 0.9f * v)) * (u - 0.5f);
                      const float out = size * v * std::sin(lean * (0.3f + 0.9f * v)),
                                  up = size * v * std::cos(lean * (0.3f + 0.9f * v));
                      return glm::vec3(out, up, across);
                  },
                  2, 8, {width, length}),
              turnAboutY(a));
    }
    return mesh;
}

void addPlant(const Placer& at, int kind, float size, std::uint32_t seed, const GreenhousePaints& p) {
    at.put(flowerPot(0.11f * size, 0.2f * size), "pot", kind == 1 ? p.zinc : p.clay);
    if (kind == 0) {
        at.put(fan(26, 0.5f * size, 0.07f * size, seed), "plant", p.leaf[0], {0, 0.17f * size, 0});
    } else if (kind == 1) {
        at.put(leaves(size * glm::vec3(0.2f, 0.26f, 0.2f), 380, 0.06f * size, seed), "plant", p.leaf[1],
               {0, 0.46f * size, 0});
        at.put(rod({0, 0.15f * size, 0}, {0, 0.5f * size, 0}, 0.008f * size), "stem", p.slat);
        at.put(leaves(size * glm::vec3(0.21f, 0.27f, 0.21f), 50, 0.045f * size, seed + 1), "petals", p.petal,
               {0, 0.48f * size, 0});
    } else {
        Mesh climb;
        for (int i = 0; i < 3; ++i)
            merge(climb, rod({0.03f * float(i - 1), 0.15f * size, 0},
                             {0.01f * float(i - 1), 1.1f * size, 0.02f}, 0.005f, 10));
        at.put(std::move(climb), "cane", p.slat);
        at.put(leaves(size * glm::vec3(0.15f, 0.5f, 0.15f), 420, 0.08f * size, seed), "plant", p.leaf[2],
               {0, 0.7f * size, 0});
    }
}

}  // namespace

Scene buildGreenhouse(const Values& values) {
    Scene scene;
    const Placer ground{scene};
    const int gravel = textured(scene, "flags", textures::ashlar(512).color, 1.1f, {0.48f, 0.46f, 0.42f});
    const int lawn = textured(scene, "lawn", textures::plaster(256), 0.7f, {0.16f, 0.26f, 0.08f});
    const int brick = textured(scene, "brick", textures::ashlar(256).color, 0.4f, {0.54f, 0.30f, 0.22f});
    const GreenhousePaints p = {add(scene, matte("white paint", {0.74f, 0.74f, 0.71f})),
                                add(scene, matte("clay", {0.54f, 0.27f, 0.17f})),
                                add(scene, matte("soil", {0.12f, 0.08f, 0.05f})),
                                textured(scene, "slats", textures::wood(256), 0.5f, {0.50f, 0.40f, 0.29f}),
                                add(scene, metal("zinc", {0.55f, 0.57f, 0.58f}, 0.4f)),
                                add(scene, matte("hose", {0.10f, 0.24f, 0.12f})),
                                {add(scene, matte("dark leaf", {0.10f, 0.25f, 0.08f})),
                                 add(scene, matte("leaf", {0.20f, 0.36f, 0.10f})),
                                 add(scene, matte("pale leaf", {0.30f, 0.40f, 0.14f}))},
                                add(scene, matte("petal", {0.62f, 0.16f, 0.26f}))};
    ground.put(box({{-5, -0.3f, -6}, {5, -0.001f, 6}}), "lawn", lawn);
    ground.put(quad({-2, 0.002f, 3.2f}, {4, 0, 0}, {0, 0, -6.3f}), "flags", gravel);
    addRibs(ground, p, brick);
    addPottingBench(ground.at(translation({-1.42f, 0, -2.7f})), 5.2f, p);
    addPottingBench(ground.at(translation({1.42f, 0, -2.7f})), 5.2f, p);
    for (int side = 0; side < 2; ++side)
        for (int i = 0; i < 22; ++i) {
            const float x = (side ? 1.24f : -1.6f) + 0.36f * float(i % 2),
                        z = -2.5f + 0.22f * float(i) + 0.06f * randomAt(61, i, side);
            addPlant(ground.at(translation({x, 0.801f, z}) * turnAboutY(6 * randomAt(62, i, side))),
                     int(2.99f * randomAt(63, i, side)), 0.75f + 0.5f * randomAt(64, i, side),
                     std::uint32_t(100 + 22 * side + i), p);
        }
    for (int i = 0; i < 12; ++i)  // empty pots, one in the other
        ground.put(flowerPot(0.13f, 0.22f), "empty pot", p.clay,
                   {-1.5f + 0.3f * float(i / 4), 0.03f * float(i % 4), 2.65f});
    ground.put(tube(
                   [](float t) {
                       const float a = 40 * t;
                       return glm::vec3((0.28f - 0.05f * t) * std::cos(a), 0.02f + 0.05f * t,
                                        (0.28f - 0.05f * t) * std::sin(a));
                   },
                   0.014f, 400, 12, {0, 1, 0}),
               "hose", p.rubber, {0.25f, 0, -1.9f});
    const Placer can = ground.at(translation({-0.45f, 0, 0.7f}) * turnAboutY(0.6f));
    can.put(cup(0.12f, 0.26f, 0.002f, 56), "watering can", p.zinc);
    can.put(rod({0.08f, 0.06f, 0}, {0.36f, 0.3f, 0}, 0.014f, 24), "spout", p.zinc);
    can.put(tube(
                [](float t) {
                    const float a = 0.4f + 2.4f * t;
                    return glm::vec3(-0.02f + 0.12f * std::cos(a), 0.24f + 0.14f * std::sin(a), 0);
                },
                0.008f, 32, 16),
            "can handle", p.zinc);
    makeTwoSided(scene);
    scene.lights.push_back(
        sunLight("sun", {0.55f, -0.72f, -0.42f}, float(values["sun"]) * glm::vec3(1.0f, 0.94f, 0.84f)));
    scene.sky = float(values["sky"]) * glm::vec3(0.56f, 0.76f, 1.0f);
    scene.cameras.push_back(camera("front", {0.35f, 1.65f, 3.4f}, {-0.15f, 1.0f, -1.0f}, 62));
    scene.cameras.push_back(camera("pots", {-0.4f, 1.35f, 0.6f}, {-1.5f, 0.9f, -0.6f}, 60));
    return scene;
}

}  // namespace conelight::io::generated
