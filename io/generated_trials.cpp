// SPDX-License-Identifier: MIT
// Scenes to try methods on that were tuned elsewhere: written down after the modes' constants were fixed, one
// for each kind of light and surface that people bring. `tools/measure_modes held-out` measures on them.
// Values -> Scene.
#include "io/generated_scenes.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "io/generated_textures.h"

namespace conelight::io::generated {
namespace {

// Materials of the inner faces of a room.
struct RoomMaterials {
    int floor, ceiling, left, right, back, front;  // left is -x, back is -z
};

constexpr float kWall = 0.2f;

bool inside(const Aabb& box, glm::vec3 p, float grow = 0) {
    return glm::all(glm::greaterThan(p, box.min - grow)) && glm::all(glm::lessThan(p, box.max + grow));
}

// A closed shell about `room`, its walls kWall thick, with openings cut through them.
void addRoom(Scene& scene, const Aabb& room, const RoomMaterials& m, const std::vector<Aabb>& openings = {}) {
    shapes::CellSolid shell;
    for (int a = 0; a < 3; ++a) {
        std::vector<float> planes = {room.min[a] - kWall, room.min[a], room.max[a], room.max[a] + kWall};
        for (const Aabb& hole : openings)
            for (const float edge : {hole.min[a], hole.max[a]})
                if (edge > room.min[a] && edge < room.max[a]) planes.push_back(edge);
        std::sort(planes.begin(), planes.end());
        planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
        shell.planes[std::size_t(a)] = planes;
    }
    shell.solid = [=](glm::vec3 p) {
        if (inside(room, p)) return false;
        for (const Aabb& hole : openings)
            if (inside(hole, p)) return false;
        return true;
    };
    shell.part = [=](glm::vec3 p, glm::vec3 n) {
        if (!inside(room, p, 0.01f)) return 6;
        if (n.y > 0.5f) return 0;
        if (n.y < -0.5f) return 1;
        if (std::abs(n.x) > 0.5f) return n.x > 0 ? 2 : 3;
        return n.z > 0 ? 4 : 5;
    };
    const char* names[] = {"floor",     "ceiling",    "left wall", "right wall",
                           "back wall", "front wall", "outside"};
    const int materials[] = {m.floor, m.ceiling, m.left, m.right, m.back, m.front, m.left};
    std::vector<Mesh> meshes = shapes::buildCells(shell, 7);
    for (std::size_t i = 0; i < meshes.size(); ++i)
        if (!meshes[i].indices.empty()) addPart(scene, std::move(meshes[i]), names[i], materials[i]);
}

int white(Scene& scene) { return add(scene, matte("white", {0.72f, 0.71f, 0.69f})); }

Mesh sphere(float radius, int around = 48) {
    Mesh mesh;
    shapes::appendPatch(mesh, shapes::uvSphere(glm::vec3(0), glm::vec3(radius), around, around / 2));
    return mesh;
}

Mesh turned(const std::vector<shapes::Curve>& profile, int around) {
    Mesh mesh;
    for (const shapes::Patch& patch : shapes::lathe(profile, around, 0.3f)) shapes::appendPatch(mesh, patch);
    return mesh;
}

// A ring of radius `major` and thickness `minor`, lying in the xz plane.
Mesh torus(float major, float minor) {
    const float pi = glm::pi<float>();
    return turned({shapes::arc({major, 0}, {minor, minor}, -0.5f * pi, 0.5f * pi, 16),
                   shapes::arc({major, 0}, {minor, minor}, 0.5f * pi, 1.5f * pi, 16)},
                  64);
}

Light spotLight(std::string name, glm::vec3 from, glm::vec3 to, float outerDeg, glm::vec3 intensity) {
    Light light = pointLight(std::move(name), from, intensity);
    light.type = LightType::Spot;
    light.direction = glm::normalize(to - from);
    light.outerAngle = glm::radians(outerDeg);
    light.innerAngle = 0.7f * light.outerAngle;
    return light;
}

}  // namespace

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
    scene.lights.push_back(
        pointLight("lamp", {0.3f, 1.75f, 0.5f}, float(values["intensity"]) * glm::vec3(1.0f, 0.9f, 0.76f)));
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

// --- A second round, written before what the first one had shown was mended

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
