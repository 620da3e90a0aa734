// SPDX-License-Identifier: MIT
// Scenes of the kinds that people model: everything two-sided, single sheets, closed thin solids, loose
// leaves, layers some millimetres apart. Values -> Scene.
#include <fmt/format.h>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "io/generated_furnished.h"
#include "io/generated_textures.h"

namespace conelight::io::generated {
namespace {

// A standing lamp: foot, stem of `wall` millimetres with a bulb buried in it, an open shade with a bulb.
void addStandingLamp(Scene& scene, glm::vec3 foot, float glow, float buried) {
    const int brass = add(scene, matte("lamp stem", {0.45f, 0.36f, 0.20f}));
    const int paper = add(scene, matte("lamp shade", {0.68f, 0.62f, 0.50f}));
    const auto stand = [&](Mesh mesh, const char* name, int material, float y) {
        addPart(scene, std::move(mesh), name, material).worldFromObject =
            translation(foot + glm::vec3(0, y, 0));
    };
    stand(cylinder(0.14f, 0, 0.02f), "lamp foot", brass, 0);
    // Walls of 3 mm, closed at both ends.
    stand(cylinder(0.016f, 0.02f, 1.3f, 24, 16), "lamp stem", brass, 0);
    Mesh inner = cylinder(0.013f, 0.03f, 1.29f, 24, 16);
    stand(std::move(inner), "inside of the stem", brass, 0);
    if (buried > 0)
        stand(sphere(0.01f, 24), "buried bulb",
              add(scene, emitter("buried bulb", buried * glm::vec3(1.0f, 0.85f, 0.6f))), 0.9f);
    Mesh shade = turned({shapes::line({0.20f, 1.15f}, {0.13f, 1.45f}, 4)}, 40);
    stand(std::move(shade), "lamp shade", paper, 0);
    if (glow > 0)
        stand(sphere(0.03f, 24), "bulb", add(scene, emitter("bulb", glow * glm::vec3(1.0f, 0.82f, 0.58f))),
              1.34f);
}

}  // namespace

// A furnished room behind a window with curtains: rug, table with cups and boards, plant, pictures, lamp.
Scene buildParlour(const Values& values) {
    Scene scene;
    const int boards = textured(scene, "boards", textures::wood(256), 0.9f, {0.58f, 0.43f, 0.28f});
    const int plaster = textured(scene, "plaster", textures::plaster(256), 1.1f, {0.72f, 0.69f, 0.63f});
    const int oak = textured(scene, "oak", textures::wood(256), 0.5f, {0.46f, 0.30f, 0.17f});
    const int rug = textured(scene, "rug", textures::fabric(256), 0.25f, {0.42f, 0.14f, 0.12f});
    const int cloth = add(scene, matte("curtain", {0.62f, 0.58f, 0.50f}));
    const int china = add(scene, matte("china", {0.72f, 0.72f, 0.70f}));
    const int green = add(scene, matte("leaf", {0.16f, 0.30f, 0.09f}));
    const int ink = add(scene, matte("picture", {0.20f, 0.26f, 0.34f}));
    addRoom(scene, {{-2.2f, 0, -2.0f}, {2.2f, 2.6f, 2.0f}},
            {boards, plaster, plaster, plaster, plaster, plaster}, {{{-3, 0.8f, -0.9f}, {-2, 2.2f, 0.7f}}});
    if (values["curtains"] > 0)
        for (const float z : {-1.12f, 0.92f})
            addPart(scene, curtain(0.55f, 2.0f, 0.03f, 6), "curtain", cloth).worldFromObject =
                translation({-2.12f, 0.35f, z}) * turnAboutY(0.5f * glm::pi<float>());
    // Rug and a smaller one on it; skirting 12 mm before the walls.
    addPart(scene, box({{-1.1f, 0.001f, -0.8f}, {1.1f, 0.008f, 0.8f}}), "rug", rug).worldFromObject =
        translation({0.1f, 0, -0.1f}) * turnAboutY(0.12f);
    addPart(scene, box({{-2.2f, 0, -2.0f}, {2.2f, 0.09f, -1.988f}}), "skirting", china);
    addPart(scene, box({{2.188f, 0, -1.98f}, {2.2f, 0.09f, 1.98f}}), "skirting", china);
    for (int i = 0; i < 3; ++i) {
        const float x = -1.2f + 1.0f * float(i);
        addPart(scene, box({{x, 1.3f, -2.0f}, {x + 0.6f, 1.8f, -1.98f}}), "frame", oak);
        addPart(scene, quad({x + 0.05f, 1.35f, -1.976f}, {0.5f, 0, 0}, {0, 0.4f, 0}), "picture", ink);
    }
    // Table: top of 25 mm, four legs, things on it.
    const glm::mat4 table = translation({0.2f, 0, -0.3f}) * turnAboutY(0.2f);
    const auto set = [&](Mesh mesh, const char* name, int material, glm::vec3 at = glm::vec3(0)) {
        addPart(scene, std::move(mesh), name, material).worldFromObject = table * translation(at);
    };
    set(box({{-0.7f, 0.70f, -0.4f}, {0.7f, 0.725f, 0.4f}}), "table top", oak);
    for (const float x : {-0.66f, 0.62f})
        for (const float z : {-0.36f, 0.32f})
            set(box({{x, 0, z}, {x + 0.04f, 0.70f, z + 0.04f}}), "table leg", oak);
    for (int i = 0; i < 4; ++i)
        set(cup(0.045f, 0.09f, 0.004f), "cup", china,
            {-0.45f + 0.24f * float(i), 0.726f, 0.12f * float(i % 2)});
    set(box({{-0.2f, 0.726f, -0.3f}, {0.15f, 0.742f, -0.08f}}), "board", boards);
    set(box({{0.3f, 0.7255f, -0.25f}, {0.5f, 0.7265f, 0.03f}}), "paper", china);
    // Plant in a pot.
    addPart(scene, cup(0.16f, 0.3f, 0.01f), "pot", rug).worldFromObject = translation({1.6f, 0, -1.4f});
    if (values["plants"] > 0)
        addPart(scene, leaves({0.4f, 0.5f, 0.4f}, 500, 0.12f, 7), "plant", green).worldFromObject =
            translation({1.6f, 0.9f, -1.4f});
    addStandingLamp(scene, {-1.5f, 0, -1.5f}, float(values["lamp"]), float(values["buried"]));
    makeTwoSided(scene);
    scene.lights.push_back(
        sunLight("sun", {0.70f, -0.62f, -0.25f}, float(values["sun"]) * glm::vec3(1.0f, 0.93f, 0.82f)));
    scene.sky = float(values["sky"]) * glm::vec3(0.58f, 0.77f, 1.0f);
    scene.cameras.push_back(camera("front", {1.7f, 1.5f, 1.85f}, {-0.4f, 0.8f, -0.9f}, 66));
    scene.cameras.push_back(camera("table", {0.5f, 1.25f, 0.75f}, {0.1f, 0.72f, -0.35f}, 50));
    scene.cameras.push_back(camera("window", {0.4f, 1.4f, 0.1f}, {-2.2f, 1.3f, -0.3f}, 80));
    return scene;
}

// Trees and hedges of loose leaves on a paved place before a house, under sun and sky.
Scene buildGarden(const Values& values) {
    Scene scene;
    const int paving = textured(scene, "paving", textures::ashlar(256).color, 1.2f, {0.52f, 0.49f, 0.45f});
    const int brick = textured(scene, "brick", textures::ashlar(256).color, 0.8f, {0.55f, 0.33f, 0.26f});
    const int bark = add(scene, matte("bark", {0.22f, 0.16f, 0.11f}));
    const int green = add(scene, matte("leaf", {0.20f, 0.36f, 0.10f}));
    const int timber = add(scene, matte("timber", {0.44f, 0.30f, 0.18f}));
    addPart(scene, box({{-6, -0.3f, -5}, {6, 0, 5}}), "ground", paving);
    addPart(scene, box({{-5.5f, 0, -4.8f}, {1.5f, 3.2f, -2.8f}}), "house", brick);
    const float trees[][3] = {{2.6f, -1.2f, 1.0f}, {-2.2f, -0.6f, 0.8f}, {0.4f, 1.6f, 0.7f}};
    int seed = 3;
    for (const auto& t : trees) {
        const glm::mat4 at = translation({t[0], 0, t[1]});
        addPart(scene, cylinder(0.09f * t[2], 0, 1.7f * t[2], 14), "trunk", bark).worldFromObject = at;
        const int count = int(float(values["leaves"]) * t[2] * t[2]);
        addPart(scene, leaves({1.0f * t[2], 0.9f * t[2], 1.0f * t[2]}, count, 0.16f, std::uint32_t(++seed)),
                "crown", green)
            .worldFromObject = at * translation({0, 2.1f * t[2], 0});
    }
    addPart(scene, leaves({1.6f, 0.45f, 0.3f}, int(0.6 * values["leaves"]), 0.1f, 11), "hedge", green)
        .worldFromObject = translation({-2.6f, 0.45f, 2.6f});
    // A bench of slats and a fence of rods.
    for (int i = 0; i < 4; ++i)
        addPart(scene, box({{-1.0f, 0.45f, 0.1f * float(i)}, {0.6f, 0.47f, 0.1f * float(i) + 0.08f}}), "slat",
                timber)
            .worldFromObject = translation({2.4f, 0, 0.9f}) * turnAboutY(-0.3f);
    for (const float x : {-0.9f, 0.45f})
        addPart(scene, box({{x, 0, 0.05f}, {x + 0.05f, 0.45f, 0.33f}}), "leg", timber).worldFromObject =
            translation({2.4f, 0, 0.9f}) * turnAboutY(-0.3f);
    for (int i = 0; i < 24; ++i)
        addPart(scene, cylinder(0.015f, 0, 1.0f, 10, 1), "rod", timber).worldFromObject =
            translation({-5.2f + 0.2f * float(i), 0, 3.6f});
    makeTwoSided(scene);
    scene.lights.push_back(
        sunLight("sun", {-0.5f, -0.72f, -0.48f}, float(values["sun"]) * glm::vec3(1.0f, 0.94f, 0.84f)));
    scene.sky = float(values["sky"]) * glm::vec3(0.55f, 0.75f, 1.0f);
    scene.cameras.push_back(camera("front", {3.6f, 1.8f, 5.2f}, {-0.6f, 0.8f, -1.0f}, 62));
    return scene;
}

}  // namespace conelight::io::generated
