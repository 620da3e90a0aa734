// SPDX-License-Identifier: MIT
// The second round of trial scenes (generated_trials.cpp), written before what the first one had shown was
// mended. Values -> Scene.
#include <fmt/format.h>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "io/generated_textures.h"
#include "io/generated_trial_parts.h"

namespace conelight::io::generated {

// Emission alone again: a rod and a bar, both turned, a small ball, a standing ring and a lit sill.
Scene buildLounge(const Values& values) {
    Scene scene;
    const float glow = float(values["emission"]);
    const int pale = white(scene);
    const int moss = add(scene, matte("moss wall", {0.26f, 0.36f, 0.20f}));
    const int boards = add(scene, matte("boards", {0.42f, 0.30f, 0.20f}));
    addRoom(scene, {{-2, 0, -1.7f}, {2, 2.5f, 1.9f}}, {boards, pale, pale, moss, pale, pale});
    const auto lamp = [&](Mesh mesh, const char* name, glm::vec3 colour, const glm::mat4& place) {
        addPart(scene, std::move(mesh), name, add(scene, emitter(name, glow * colour))).worldFromObject =
            place;
    };
    lamp(turned({shapes::line({0, 0}, {0.035f, 0}), shapes::line({0.035f, 0}, {0.035f, 1.5f}, 2),
                 shapes::line({0.035f, 1.5f}, {0, 1.5f})},
                24),
         "leaning rod", {1.0f, 0.75f, 0.45f},
         translation({-1.6f, 0.1f, -1.0f}) * glm::rotate(glm::mat4(1), -0.25f, glm::vec3(0.3f, 0, 1)));
    lamp(box({{-0.6f, -0.04f, -0.04f}, {0.6f, 0.04f, 0.04f}}), "turned bar", {0.9f, 0.95f, 1.0f},
         translation({0.3f, 2.1f, -0.4f}) * turnAboutY(0.6f) *
             glm::rotate(glm::mat4(1), 0.3f, glm::vec3(1, 0, 0.4f)));
    lamp(sphere(0.09f, 32), "small ball", {1.0f, 0.55f, 0.35f}, translation({0.9f, 0.64f, -0.9f}));
    lamp(torus(0.28f, 0.03f), "standing ring", {0.6f, 0.8f, 1.0f},
         translation({1.45f, 1.35f, -1.2f}) * glm::rotate(glm::mat4(1), 1.2f, glm::vec3(1, 0, 0.3f)));
    addPart(scene, box({{-0.9f, 0, -0.4f}, {0.9f, 0.42f, 0.4f}}), "seat", moss).worldFromObject =
        translation({-0.5f, 0, -0.6f}) * turnAboutY(-0.2f);
    addPart(scene,
            turned({shapes::line({0, 0}, {0.25f, 0}), shapes::line({0.25f, 0}, {0.06f, 0.1f}),
                    shapes::line({0.06f, 0.1f}, {0.06f, 0.5f}), shapes::line({0.06f, 0.5f}, {0.3f, 0.55f}),
                    shapes::line({0.3f, 0.55f}, {0, 0.55f})},
                   32),
            "table", pale)
        .worldFromObject = translation({0.9f, 0, -0.9f});
    scene.cameras.push_back(camera("front", {-0.2f, 1.3f, 1.82f}, {0.1f, 0.95f, -0.8f}, 72));
    return scene;
}

// Emission again, written after the rules for small lamps and measured once they stood: a tube that winds
// through the room, a glowing cone, a lens, a small leaning cube.
Scene buildNeon(const Values& values) {
    Scene scene;
    const float glow = float(values["emission"]);
    const int pale = white(scene);
    const int plum = add(scene, matte("plum wall", {0.34f, 0.20f, 0.30f}));
    const int slate = add(scene, matte("slate", {0.22f, 0.24f, 0.26f}));
    addRoom(scene, {{-1.5f, 0, -1.6f}, {1.5f, 2.4f, 1.6f}}, {slate, pale, plum, pale, pale, pale});
    const auto lamp = [&](Mesh mesh, const char* name, glm::vec3 colour, const glm::mat4& place) {
        addPart(scene, std::move(mesh), name, add(scene, emitter(name, glow * colour))).worldFromObject =
            place;
    };
    // A closed tube about a curve on the far wall that crosses itself in depth.
    constexpr float kTurn = 6.28318531f, kRadius = 0.025f;
    const auto middle = [](float u) {
        return glm::vec3(0.8f * std::sin(kTurn * u), 1.35f + 0.4f * std::sin(2 * kTurn * u),
                         -1.2f + 0.18f * std::cos(3 * kTurn * u));
    };
    shapes::Patch tube;
    tube.nu = 160;
    tube.nv = 16;
    tube.position = [&](float u, float v) {
        const glm::vec3 along = glm::normalize(middle(u + 0.001f) - middle(u - 0.001f));
        const glm::vec3 side = glm::normalize(glm::cross(along, glm::vec3(0, 0, 1)));
        const glm::vec3 up = glm::cross(side, along);
        return middle(u) + kRadius * (std::cos(kTurn * v) * side + std::sin(kTurn * v) * up);
    };
    Mesh winding;
    shapes::appendPatch(winding, tube);
    lamp(std::move(winding), "winding tube", {1.0f, 0.35f, 0.55f}, glm::mat4(1));
    lamp(turned({shapes::line({0, 0}, {0.16f, 0}), shapes::line({0.16f, 0}, {0, 0.4f}, 4)}, 24), "cone",
         {0.45f, 0.8f, 1.0f},
         translation({0.85f, 0.1f, -0.5f}) * glm::rotate(glm::mat4(1), 0.4f, glm::vec3(1, 0, 1)));
    lamp(turned({shapes::line({0, 0}, {0.12f, 0}),
                 shapes::arc({0, -0.16f}, {0.2f, 0.2f}, 0.92729522f, 1.57079633f, 6)},
                32),
         "lens", {1.0f, 0.9f, 0.6f},
         translation({-0.7f, 2.25f, 0.2f}) * glm::rotate(glm::mat4(1), 2.7f, glm::vec3(1, 0, 0.2f)));
    lamp(box({glm::vec3(-0.06f), glm::vec3(0.06f)}), "small cube", {0.7f, 1.0f, 0.6f},
         translation({-0.95f, 0.62f, -0.4f}) * turnAboutY(0.5f) *
             glm::rotate(glm::mat4(1), 0.6f, glm::vec3(1, 0, 0)));
    addPart(scene, box({{-0.3f, 0, -0.3f}, {0.3f, 0.4f, 0.3f}}), "block", pale).worldFromObject =
        translation({-0.85f, 0, -0.45f}) * turnAboutY(0.4f);
    addPart(scene, sphere(0.28f, 32), "ball", plum).worldFromObject = translation({0.15f, 0.28f, 0.1f});
    scene.cameras.push_back(camera("front", {0.1f, 1.25f, 1.52f}, {0, 1.05f, -0.8f}, 74));
    return scene;
}

// Textures again: shelves of wood along plastered and tiled walls, a rug, under two lamps.
Scene buildLibrary(const Values& values) {
    Scene scene;
    const auto coloured = [&](const char* name, Texture texture, float metres, glm::vec3 colour) {
        Material m = matte(name, colour);
        m.baseColorTexture = repeat(add(scene, std::move(texture)), metres);
        return add(scene, std::move(m));
    };
    const int boards = coloured("boards", textures::wood(256), 0.9f, {0.60f, 0.46f, 0.30f});
    const int oak = coloured("oak", textures::wood(256), 0.4f, {0.44f, 0.27f, 0.15f});
    const int plaster = coloured("plaster", textures::plaster(256), 0.8f, {0.70f, 0.72f, 0.74f});
    const int brick = coloured("stone", textures::ashlar(256).color, 0.9f, {0.66f, 0.50f, 0.42f});
    const int rug = coloured("rug", textures::fabric(256), 0.3f, {0.20f, 0.16f, 0.42f});
    addRoom(scene, {{-1.6f, 0, -2}, {1.6f, 2.6f, 1.6f}}, {boards, plaster, brick, plaster, plaster, plaster});
    for (int i = 0; i < 5; ++i) {
        const float y = 0.3f + 0.45f * float(i);
        addPart(scene, box({{-1.3f, y, -2}, {0.5f, y + 0.03f, -1.7f}}), fmt::format("shelf {}", i), oak);
        for (int j = 0; j < 6; ++j) {
            const float x = -1.2f + 0.28f * float(j), tall = 0.2f + 0.03f * float((3 * i + 5 * j) % 7);
            addPart(
                scene,
                box({{x, y + 0.03f, -1.98f}, {x + 0.05f + 0.02f * float(j % 3), y + 0.03f + tall, -1.76f}}),
                fmt::format("book {}", 6 * i + j), (i + j) % 2 == 0 ? rug : brick);
        }
    }
    addPart(scene, box({{-0.8f, 0, -0.6f}, {0.8f, 0.015f, 0.6f}}), "rug", rug).worldFromObject =
        translation({0.1f, 0, -0.4f}) * turnAboutY(0.25f);
    addPart(scene, box({{-0.35f, 0, -0.3f}, {0.35f, 0.5f, 0.3f}}), "chest", oak).worldFromObject =
        translation({1.0f, 0, -1.2f}) * turnAboutY(-0.4f);
    const float lamp = float(values["intensity"]);
    scene.lights.push_back(
        pointLight("ceiling lamp", {-0.2f, 2.2f, -0.3f}, lamp * glm::vec3(1.0f, 0.88f, 0.7f)));
    scene.lights.push_back(spotLight("reading lamp", {1.3f, 1.6f, 0.6f}, {0.6f, 0, -0.9f}, 40,
                                     2 * lamp * glm::vec3(1.0f, 0.8f, 0.55f)));
    scene.cameras.push_back(camera("front", {0.4f, 1.4f, 1.5f}, {-0.2f, 0.9f, -1.2f}, 70));
    return scene;
}

// Small things again, of other shapes: rods, cones, tiles and balls, turned at random.
Scene buildHeap(const Values& values) {
    Scene scene;
    const int pale = white(scene);
    const int floor = add(scene, matte("floor", {0.50f, 0.46f, 0.40f}));
    const int blue = add(scene, matte("blue wall", {0.14f, 0.22f, 0.50f}));
    addRoom(scene, {{-1.2f, 0, -1.1f}, {1.2f, 1.7f, 1.2f}}, {floor, pale, pale, blue, pale, pale});
    const int materials[] = {pale, add(scene, matte("brass", {0.60f, 0.48f, 0.20f})),
                             add(scene, matte("brick", {0.50f, 0.20f, 0.14f})),
                             add(scene, matte("leaf", {0.18f, 0.40f, 0.16f}))};
    Mesh shapesOf[] = {
        turned({shapes::line({0, -0.5f}, {0.12f, -0.5f}), shapes::line({0.12f, -0.5f}, {0.12f, 0.5f}),
                shapes::line({0.12f, 0.5f}, {0, 0.5f})},
               12),
        turned({shapes::line({0, -0.4f}, {0.35f, -0.4f}), shapes::line({0.35f, -0.4f}, {0, 0.4f}, 2)}, 12),
        box({{-0.45f, -0.06f, -0.3f}, {0.45f, 0.06f, 0.3f}}), sphere(0.3f, 16)};
    int meshes[4];
    for (int i = 0; i < 4; ++i) {
        shapesOf[i].name = fmt::format("shape {}", i);
        meshes[i] = add(scene, std::move(shapesOf[i]));
    }
    const auto number = [](int i, int which) {
        return shapes::unitFloat(shapes::hash(std::uint32_t(i), std::uint32_t(which), 19));
    };
    for (int i = 0; i < int(values["things"]); ++i) {
        const glm::vec3 centre(-1.05f + 2.1f * number(i, 0), 0.06f + 0.6f * number(i, 1) * number(i, 2),
                               -1.0f + 1.6f * number(i, 3));
        const glm::vec3 axis = glm::normalize(glm::vec3(number(i, 4), number(i, 5), number(i, 6)) - 0.55f);
        place(scene, meshes[i % 4], materials[(i / 4) % 4], fmt::format("thing {}", i),
              glm::scale(glm::rotate(translation(centre), 6.28f * number(i, 7), axis),
                         glm::vec3(0.06f + 0.14f * number(i, 8))));
    }
    scene.lights.push_back(
        pointLight("lamp", {0.3f, 1.5f, 0.3f}, float(values["intensity"]) * glm::vec3(1.0f, 0.92f, 0.8f)));
    scene.cameras.push_back(camera("front", {-0.15f, 1.0f, 1.12f}, {0.05f, 0.4f, -0.5f}, 75));
    return scene;
}

// A passage that turns back on itself twice between screens of masonry, lit at its far end.
Scene buildBends(const Values& values) {
    Scene scene;
    const int pale = white(scene);
    const int floor = add(scene, matte("floor", {0.44f, 0.42f, 0.40f}));
    const int ochre = add(scene, matte("ochre wall", {0.62f, 0.46f, 0.20f}));
    addRoom(scene, {{-1.4f, 0, -3}, {1.4f, 1.8f, 1.8f}}, {floor, pale, ochre, pale, pale, pale});
    for (const float side : {-1.0f, 1.0f})
        addPart(scene, box({{-0.9f, 0, -0.09f}, {0.9f, 1.8f, 0.09f}}), "screen", pale).worldFromObject =
            translation({0.55f * side, 0, -0.6f - 0.8f * side});
    addPart(scene, box({{-0.4f, 0.6f, -2.98f}, {0.5f, 1.3f, -2.94f}}), "lamp",
            add(scene, emitter("lamp", float(values["emission"]) * glm::vec3(1.0f, 0.9f, 0.72f))));
    scene.cameras.push_back(camera("dark", {-0.9f, 1.0f, 1.7f}, {0.7f, 0.75f, -0.4f}, 75));
    scene.cameras.push_back(camera("lit", {1.2f, 1.1f, -0.1f}, {-0.6f, 0.8f, -2.9f}, 75));
    return scene;
}

}  // namespace conelight::io::generated
