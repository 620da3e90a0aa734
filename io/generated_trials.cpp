// SPDX-License-Identifier: MIT
// Scenes to try methods on that were tuned elsewhere: written down after the modes' constants were fixed, one
// for each kind of light and surface that people bring. `tools/measure_modes held-out` measures on them.
// Values -> Scene.
#include <fmt/format.h>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "io/generated_textures.h"
#include "io/generated_trial_parts.h"

namespace conelight::io::generated {

// Three lamps of three colours, two of them spots, among a few slabs: shadows of every mixture.
Scene buildColours(const Values& values) {
    Scene scene;
    const float lamp = float(values["intensity"]);
    const int grey = add(scene, matte("grey", glm::vec3(0.55f)));
    const int pale = white(scene);
    addRoom(scene, {{-1.5f, 0, -1.5f}, {1.5f, 2.2f, 1.5f}}, {grey, pale, pale, pale, pale, pale});
    for (int i = 0; i < 4; ++i) {
        const float angle = 0.4f + 1.3f * float(i);
        addPart(scene, box({{-0.05f, 0, -0.35f}, {0.05f, 0.7f + 0.25f * float(i), 0.35f}}),
                fmt::format("slab {}", i), pale)
            .worldFromObject = translation({0.75f * std::cos(angle), 0, -0.2f + 0.75f * std::sin(angle)}) *
                               turnAboutY(angle + 0.7f);
    }
    scene.lights.push_back(pointLight("red lamp", {-1.1f, 1.7f, 0.6f}, lamp * glm::vec3(1.0f, 0.18f, 0.10f)));
    scene.lights.push_back(spotLight("green spot", {1.2f, 2.0f, 1.0f}, {0, 0.3f, -0.5f}, 38,
                                     2 * lamp * glm::vec3(0.15f, 1.0f, 0.25f)));
    scene.lights.push_back(spotLight("blue spot", {0.2f, 2.05f, -1.2f}, {-0.3f, 0, 0.6f}, 50,
                                     2 * lamp * glm::vec3(0.15f, 0.30f, 1.0f)));
    scene.cameras.push_back(camera("front", {0.3f, 1.25f, 1.42f}, {-0.05f, 0.75f, -0.9f}, 75));
    return scene;
}

// No light but what surfaces emit: a glowing ball, a ring, a strip low on the wall, in a room with a column.
Scene buildLanterns(const Values& values) {
    Scene scene;
    const float glow = float(values["emission"]);
    const int pale = white(scene);
    const int clay = add(scene, matte("clay wall", {0.60f, 0.28f, 0.16f}));
    const int floor = add(scene, matte("floor", {0.34f, 0.36f, 0.40f}));
    addRoom(scene, {{-1.6f, 0, -1.8f}, {1.6f, 2.4f, 1.8f}}, {floor, pale, clay, pale, pale, pale});
    addPart(scene, sphere(0.16f), "ball lamp",
            add(scene, emitter("ball", glow * glm::vec3(1.0f, 0.8f, 0.5f))))
        .worldFromObject = translation({-0.8f, 1.2f, -0.7f});
    addPart(scene, torus(0.35f, 0.05f), "ring lamp",
            add(scene, emitter("ring", glow * glm::vec3(1.0f, 0.93f, 0.85f))))
        .worldFromObject = translation({0.55f, 1.9f, 0.1f}) *
                           glm::rotate(glm::mat4(1), 0.35f, glm::normalize(glm::vec3(1, 0, 0.4f)));
    addPart(scene, box({{1.52f, 0.15f, -1.2f}, {1.56f, 0.25f, 0.9f}}), "strip lamp",
            add(scene, emitter("strip", glow * glm::vec3(0.45f, 0.65f, 1.0f))));
    addPart(scene,
            turned({shapes::line({0, 0}, {0.2f, 0}), shapes::line({0.2f, 0}, {0.2f, 2.4f}, 4),
                    shapes::line({0.2f, 2.4f}, {0, 2.4f})},
                   48),
            "column", pale)
        .worldFromObject = translation({0.1f, 0, -0.9f});
    addPart(scene, box({{-0.35f, 0, -0.35f}, {0.35f, 0.5f, 0.35f}}), "crate", clay).worldFromObject =
        translation({-0.7f, 0, 0.1f}) * turnAboutY(0.5f);
    scene.cameras.push_back(camera("front", {0.5f, 1.35f, 1.72f}, {-0.15f, 0.9f, -0.8f}, 70));
    return scene;
}

// Curved meshes alone, on a shelf and on the floor, under one lamp.
Scene buildVases(const Values& values) {
    Scene scene;
    const int pale = white(scene);
    const int sand = add(scene, matte("sand", {0.62f, 0.52f, 0.36f}));
    addRoom(scene, {{-1.2f, 0, -0.9f}, {1.2f, 1.8f, 1.1f}}, {sand, pale, pale, pale, pale, pale});
    const glm::vec3 colours[] = {{0.62f, 0.14f, 0.09f},
                                 {0.12f, 0.34f, 0.48f},
                                 {0.66f, 0.55f, 0.18f},
                                 {0.22f, 0.42f, 0.20f},
                                 {0.70f, 0.68f, 0.64f}};
    addPart(scene, box({{-0.95f, 0.62f, -0.9f}, {0.95f, 0.67f, -0.5f}}), "shelf", pale);
    for (int i = 0; i < 5; ++i) {
        const float belly = 0.10f + 0.02f * float(i % 3), waves = 1.0f + 0.5f * float(i);
        const float height = 0.34f + 0.05f * float((2 * i) % 5);
        const auto outline = [=](float t) {
            return glm::vec2(belly * (0.75f + 0.25f * std::cos(glm::two_pi<float>() * waves * (t - 0.4f))),
                             height * t);
        };
        const glm::vec2 foot = outline(0), lip = outline(1);
        Mesh mesh = turned(
            {shapes::line({0, 0}, foot, 2), shapes::Curve{40, outline}, shapes::line(lip, {0, lip.y}, 2)},
            48);
        addPart(scene, std::move(mesh), fmt::format("vase {}", i),
                add(scene, matte(fmt::format("glaze {}", i), colours[i])))
            .worldFromObject = translation({-0.76f + 0.38f * float(i), 0.67f, -0.70f});
    }
    addPart(scene, sphere(0.24f, 64), "ball", add(scene, matte("blue ball", {0.15f, 0.25f, 0.58f})))
        .worldFromObject = translation({-0.55f, 0.24f, 0.05f});
    addPart(scene, torus(0.26f, 0.09f), "ring", add(scene, matte("orange ring", {0.68f, 0.33f, 0.08f})))
        .worldFromObject = translation({0.15f, 0.09f, 0.2f});
    addPart(scene, torus(0.2f, 0.07f), "leaning ring", pale).worldFromObject =
        translation({0.7f, 0.25f, -0.05f}) *
        glm::rotate(glm::mat4(1), 1.2f, glm::normalize(glm::vec3(1, 0.3f, 0)));
    scene.lights.push_back(pointLight("lamp", {0.35f, 1.55f, 0.55f},
                                      float(values["intensity"]) * glm::vec3(1.0f, 0.87f, 0.70f)));
    scene.cameras.push_back(camera("front", {0, 1.05f, 1.05f}, {0, 0.55f, -0.6f}, 72));
    return scene;
}

// Every surface textured: stone, tiles, fabric, wood, plaster.
Scene buildStudy(const Values& values) {
    Scene scene;
    const auto surface = [&](const char* name, textures::Surface made, float metres, float roughness) {
        Material m = roughness < 1 ? glossy(name, glm::vec3(0.8f), roughness) : matte(name, glm::vec3(0.8f));
        m.baseColorTexture = repeat(add(scene, std::move(made.color)), metres);
        if (made.roughness.width > 0)
            m.metallicRoughnessTexture = repeat(add(scene, std::move(made.roughness)), metres);
        return add(scene, std::move(m));
    };
    const auto coloured = [&](const char* name, Texture texture, float metres, glm::vec3 colour) {
        Material m = matte(name, colour);
        m.baseColorTexture = repeat(add(scene, std::move(texture)), metres);
        return add(scene, std::move(m));
    };
    const int stone = surface("stone", textures::ashlar(256), 1.2f, 1);
    const int tiles = surface("tiles", textures::tiles(256), 0.8f, 0.5f);
    const int plaster = coloured("plaster", textures::plaster(256), 1, {0.74f, 0.70f, 0.62f});
    const int fabric = coloured("fabric", textures::fabric(256), 0.5f, {0.50f, 0.10f, 0.12f});
    const int wood = coloured("wood", textures::wood(256), 0.7f, {0.52f, 0.34f, 0.19f});
    addRoom(scene, {{-1.7f, 0, -1.6f}, {1.7f, 2.3f, 1.8f}}, {tiles, plaster, stone, plaster, stone, plaster});
    addPart(scene, box({{-0.7f, 0.72f, -0.4f}, {0.7f, 0.78f, 0.4f}}), "desk top", wood).worldFromObject =
        translation({0.2f, 0, -0.5f});
    for (int i = 0; i < 4; ++i)
        addPart(scene, box({{-0.04f, 0, -0.04f}, {0.04f, 0.72f, 0.04f}}), "leg", wood).worldFromObject =
            translation({0.2f + (i & 1 ? 0.62f : -0.62f), 0, -0.5f + (i & 2 ? 0.32f : -0.32f)});
    addPart(scene, box({{-0.3f, 0, -0.25f}, {0.3f, 0.45f, 0.25f}}), "stool", fabric).worldFromObject =
        translation({-0.9f, 0, 0.2f}) * turnAboutY(0.35f);
    addPart(scene, box({{1.62f, 0.9f, -1.0f}, {1.66f, 2.0f, 0.6f}}), "hanging", fabric);
    scene.lights.push_back(
        pointLight("lamp", {0.1f, 1.9f, 0.3f}, float(values["intensity"]) * glm::vec3(1.0f, 0.84f, 0.64f)));
    scene.cameras.push_back(camera("front", {-0.5f, 1.45f, 1.72f}, {0.2f, 0.8f, -0.8f}, 70));
    return scene;
}

// Many small boxes, turned at random: much detail at the size of a voxel.
Scene buildClutter(const Values& values) {
    Scene scene;
    const int pale = white(scene);
    const int floor = add(scene, matte("floor", {0.45f, 0.42f, 0.38f}));
    const int red = add(scene, matte("red wall", {0.58f, 0.10f, 0.08f}));
    addRoom(scene, {{-1, 0, -1}, {1, 1.6f, 1.2f}}, {floor, pale, red, pale, pale, pale});
    const int materials[] = {pale, add(scene, matte("teal", {0.10f, 0.40f, 0.42f})),
                             add(scene, matte("ochre", {0.66f, 0.44f, 0.12f})),
                             add(scene, matte("slate", {0.20f, 0.22f, 0.26f}))};
    Mesh cube = box({glm::vec3(-0.5f), glm::vec3(0.5f)});
    cube.name = "cube";
    const int mesh = add(scene, std::move(cube));
    const auto number = [](int i, int which) {
        return shapes::unitFloat(shapes::hash(std::uint32_t(i), std::uint32_t(which), 7));
    };
    for (int i = 0; i < int(values["boxes"]); ++i) {
        const glm::vec3 size = 0.02f + 0.12f * glm::vec3(number(i, 0), number(i, 1), number(i, 2));
        const glm::vec3 centre(-0.9f + 1.8f * number(i, 3), 0.07f + 0.75f * number(i, 4) * number(i, 5),
                               -0.9f + 1.5f * number(i, 6));
        const glm::vec3 axis = glm::normalize(glm::vec3(number(i, 7), number(i, 8), number(i, 9)) - 0.45f);
        place(scene, mesh, materials[i % 4], fmt::format("box {}", i),
              glm::scale(glm::rotate(translation(centre), 6.28f * number(i, 10), axis), size));
    }
    scene.lights.push_back(
        pointLight("lamp", {-0.2f, 1.4f, 0.4f}, float(values["intensity"]) * glm::vec3(1.0f, 0.9f, 0.75f)));
    scene.cameras.push_back(camera("front", {0.1f, 0.95f, 1.12f}, {0, 0.4f, -0.5f}, 75));
    return scene;
}

// A straight passage, lit by a lamp behind its far end only; ribs along the walls.
Scene buildTunnel(const Values& values) {
    Scene scene;
    const int pale = white(scene);
    const int floor = add(scene, matte("floor", {0.38f, 0.35f, 0.32f}));
    const int green = add(scene, matte("green wall", {0.22f, 0.44f, 0.24f}));
    addRoom(scene, {{-0.7f, 0, -6}, {0.7f, 1.6f, 2}}, {floor, pale, green, pale, pale, pale});
    for (int i = 0; i < 6; ++i) {
        const float z = 0.9f - 1.15f * float(i);
        for (const float side : {-1.0f, 1.0f})
            addPart(scene, box({{-0.08f, 0, -0.1f}, {0.08f, 1.6f, 0.1f}}), "rib", pale).worldFromObject =
                translation({side * 0.63f, 0, z});
    }
    addPart(scene, box({{-0.5f, 1.5f, -5.8f}, {0.5f, 1.55f, -5.2f}}), "lamp",
            add(scene, emitter("lamp", float(values["emission"]) * glm::vec3(1.0f, 0.86f, 0.66f))));
    scene.cameras.push_back(camera("dark", {0.15f, 1.0f, 1.9f}, {-0.05f, 0.75f, -4}, 62));
    scene.cameras.push_back(camera("lit", {0.15f, 1.0f, -2}, {-0.05f, 0.75f, -6}, 62));
    return scene;
}

// Outdoors: houses, a wall and round trees on a ground, under sun and sky.
Scene buildYard(const Values& values) {
    Scene scene;
    const int grass = add(scene, matte("grass", {0.20f, 0.30f, 0.10f}));
    const int plaster = add(scene, matte("plaster", {0.74f, 0.70f, 0.60f}));
    const int brick = add(scene, matte("brick", {0.48f, 0.20f, 0.13f}));
    const int roof = add(scene, matte("roof", {0.36f, 0.16f, 0.11f}));
    const int leaves = add(scene, matte("leaves", {0.14f, 0.28f, 0.07f}));
    const int bark = add(scene, matte("bark", {0.24f, 0.17f, 0.11f}));
    addPart(scene, box({{-9, -0.4f, -9}, {9, 0, 9}}), "ground", grass);
    struct House {
        glm::vec3 place, half;
        float turn;
        int wall;
    };
    for (const House& h : {House{{-3.2f, 0, -2.5f}, {1.8f, 2.4f, 1.4f}, 0.15f, plaster},
                           House{{2.6f, 0, -3.4f}, {2.0f, 3.1f, 1.2f}, -0.3f, brick}}) {
        const glm::mat4 m = translation(h.place) * turnAboutY(h.turn);
        addPart(scene, box({{-h.half.x, 0, -h.half.z}, {h.half.x, h.half.y, h.half.z}}), "house", h.wall)
            .worldFromObject = m;
        // A gable roof: a prism with eaves.
        const float x = h.half.x + 0.15f, z = h.half.z + 0.2f, y = h.half.y, top = h.half.y + 0.9f;
        Mesh prism;
        shapes::appendHexahedron(prism, {glm::vec3(-x, y, -z),
                                         {x, y, -z},
                                         {-x, top, -0.02f},
                                         {x, top, -0.02f},
                                         {-x, y, z},
                                         {x, y, z},
                                         {-x, top, 0.02f},
                                         {x, top, 0.02f}});
        addPart(scene, std::move(prism), "roof", roof).worldFromObject = m;
    }
    addPart(scene, box({{-0.9f, 0, -4.5f}, {-0.7f, 1.3f, 1.2f}}), "wall", plaster);
    const glm::vec3 trees[] = {{1.2f, 0, 0.6f}, {3.4f, 0, 0.2f}, {-4.6f, 0, 0.9f}};
    for (const glm::vec3& t : trees) {
        addPart(scene,
                turned({shapes::line({0, 0}, {0.12f, 0}), shapes::line({0.12f, 0}, {0.09f, 1.3f}, 3),
                        shapes::line({0.09f, 1.3f}, {0, 1.3f})},
                       16),
                "trunk", bark)
            .worldFromObject = translation(t);
        addPart(scene, sphere(0.85f, 40), "crown", leaves).worldFromObject =
            translation(t + glm::vec3(0, 1.9f, 0));
    }
    scene.lights.push_back(
        sunLight("sun", {-0.45f, -0.75f, -0.48f}, float(values["sun"]) * glm::vec3(1.0f, 0.95f, 0.86f)));
    scene.sky = float(values["sky"]) * glm::vec3(0.55f, 0.75f, 1.0f);
    scene.cameras.push_back(camera("front", {1.2f, 2.2f, 6.4f}, {-0.3f, 1.0f, -1.5f}, 60));
    return scene;
}

// A polished floor under columns, one lit wall: what a glossy dielectric reflects.
Scene buildLobby(const Values& values) {
    Scene scene;
    const int pale = white(scene);
    const int floor = add(scene, glossy("floor", {0.20f, 0.19f, 0.18f}, float(values["roughness"])));
    const int blue = add(scene, matte("blue wall", {0.12f, 0.24f, 0.52f}));
    const int rust = add(scene, matte("rust wall", {0.58f, 0.24f, 0.10f}));
    addRoom(scene, {{-2, 0, -2.6f}, {2, 2.6f, 2.2f}}, {floor, pale, blue, rust, pale, pale});
    for (int i = 0; i < 4; ++i)
        addPart(scene,
                turned({shapes::line({0, 0}, {0.16f, 0}), shapes::line({0.16f, 0}, {0.13f, 2.6f}, 6),
                        shapes::line({0.13f, 2.6f}, {0, 2.6f})},
                       40),
                "column", pale)
            .worldFromObject = translation({i & 1 ? 0.9f : -0.9f, 0, i & 2 ? -1.6f : -0.1f});
    addPart(scene, box({{-0.6f, 2.52f, -1.3f}, {0.6f, 2.56f, 0.7f}}), "lamp",
            add(scene, emitter("lamp", float(values["emission"]) * glm::vec3(1.0f, 0.92f, 0.80f))));
    scene.cameras.push_back(camera("front", {0.25f, 1.2f, 2.1f}, {-0.1f, 0.65f, -1.6f}, 66));
    return scene;
}

// A mirror ball and a mirror on the wall in a coloured room.
Scene buildMirrors(const Values& values) {
    Scene scene;
    const int pale = white(scene);
    const int green = add(scene, matte("green wall", {0.20f, 0.46f, 0.18f}));
    const int red = add(scene, matte("red wall", {0.58f, 0.12f, 0.10f}));
    const int chequer = [&] {
        Material m = matte("tiles", glm::vec3(0.75f));
        m.baseColorTexture = repeat(add(scene, textures::tiles(256).color), 0.9f);
        return add(scene, std::move(m));
    }();
    addRoom(scene, {{-1.3f, 0, -1.3f}, {1.3f, 2, 1.5f}}, {chequer, pale, red, green, pale, pale});
    const int silver = add(scene, metal("silver", {0.95f, 0.93f, 0.88f}, float(values["roughness"])));
    addPart(scene, sphere(0.4f, 96), "mirror ball", silver).worldFromObject =
        translation({-0.35f, 0.4f, -0.35f});
    addPart(scene, box({{0.1f, 0.7f, -1.29f}, {1.0f, 1.6f, -1.25f}}), "mirror", silver);
    addPart(scene, box({{-0.18f, 0, -0.18f}, {0.18f, 0.55f, 0.18f}}), "block",
            add(scene, matte("yellow block", {0.70f, 0.55f, 0.12f})))
        .worldFromObject = translation({0.55f, 0, 0.1f}) * turnAboutY(0.4f);
    const glm::vec3 intensity = float(values["intensity"]) * glm::vec3(1.0f, 0.9f, 0.76f),
                    at(0.3f, 1.75f, 0.5f);
    const float edge = float(values["lamp"]);
    if (edge > 0)
        addPart(scene, quad(at - glm::vec3(0.5f * edge, 0, 0.5f * edge), {edge, 0, 0}, {0, 0, edge}), "lamp",
                add(scene, emitter("lamp", intensity / (edge * edge))));
    else
        scene.lights.push_back(pointLight("lamp", at, intensity));
    scene.cameras.push_back(camera("front", {0.15f, 1.05f, 1.42f}, {0, 0.6f, -0.8f}, 70));
    return scene;
}

// Paper-thin screens, straight and turned, between a lit bay and two dark ones.
Scene buildScreens(const Values& values) {
    Scene scene;
    const int pale = white(scene);
    Material paper = matte("paper", {0.70f, 0.66f, 0.56f});
    paper.doubleSided = true;
    const int sheet = add(scene, std::move(paper));
    addRoom(scene, {{-1.5f, 0, -1}, {1.5f, 1.6f, 1.4f}}, {pale, pale, pale, pale, pale, pale});
    // Sheets without thickness, into the walls on all sides but for gaps in front.
    addPart(scene, quad({-0.55f, -0.1f, -1.1f}, {0, 0, 1.5f}, {0, 1.8f, 0}), "straight screen", sheet);
    addPart(scene, quad({0.45f, -0.1f, -1.1f}, {0.42f, 0, 1.45f}, {0, 1.8f, 0}), "turned screen", sheet);
    addPart(scene, quad({-1.6f, 0.9f, -0.3f}, {0.9f, 0, 0.35f}, {0.1f, 0.45f, -0.6f}), "leaning sheet",
            sheet);
    scene.lights.push_back(
        pointLight("lamp", {0.0f, 1.2f, -0.6f}, float(values["intensity"]) * glm::vec3(1.0f, 0.85f, 0.62f)));
    scene.cameras.push_back(camera("front", {0.1f, 0.95f, 1.36f}, {0, 0.65f, -0.6f}, 105));
    return scene;
}

// A room under two skylights: sun patches on floor and wall, all else by bounces and sky.
Scene buildLoft(const Values& values) {
    Scene scene;
    const int pale = white(scene);
    const int boards = add(scene, matte("boards", {0.46f, 0.33f, 0.20f}));
    const int slate = add(scene, matte("slate wall", {0.28f, 0.32f, 0.38f}));
    addRoom(scene, {{-2, 0, -1.8f}, {2, 2.3f, 2}}, {boards, pale, pale, slate, pale, pale},
            {{{-1.3f, 2, -1.0f}, {-0.5f, 3, 0.4f}}, {{0.4f, 2, -1.0f}, {1.2f, 3, 0.4f}}});
    addPart(scene, box({{-0.9f, 0, -0.45f}, {0.9f, 0.42f, 0.45f}}), "bed",
            add(scene, matte("blanket", {0.55f, 0.20f, 0.24f})))
        .worldFromObject = translation({-0.5f, 0, -0.8f});
    addPart(scene, box({{1.3f, 0, -1.7f}, {1.95f, 1.5f, -0.6f}}), "wardrobe", boards);
    scene.lights.push_back(
        sunLight("sun", {0.42f, -0.85f, -0.30f}, float(values["sun"]) * glm::vec3(1.0f, 0.93f, 0.82f)));
    scene.sky = float(values["sky"]) * glm::vec3(0.58f, 0.77f, 1.0f);
    scene.cameras.push_back(camera("front", {0.9f, 1.35f, 1.92f}, {-0.3f, 0.8f, -1.0f}, 68));
    return scene;
}

}  // namespace conelight::io::generated
