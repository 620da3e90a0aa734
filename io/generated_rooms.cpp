// SPDX-License-Identifier: MIT
// Rooms that stress one effect each: light through a thin wall (leak), through a window (sunroom), around
// corners (corridor), off glossy surfaces (glossy). Values -> Scene.
//
// All rooms are shells of solid walls, built on a lattice: closed, without T-junctions, so that no light can
// pass where a renderer does not let it.
#include "io/generated_scenes.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace conelight::io::generated {
namespace {

// A part of a lattice solid: its name and material.
struct Part {
    const char* name;
    int material;
};

void addCells(Scene& scene, const shapes::CellSolid& cells, const std::vector<Part>& parts) {
    std::vector<Mesh> meshes = shapes::buildCells(cells, int(parts.size()));
    for (std::size_t i = 0; i < parts.size(); ++i)
        if (!meshes[i].indices.empty())
            addPart(scene, std::move(meshes[i]), parts[i].name, parts[i].material);
}

bool inside(const Aabb& box, glm::vec3 p) {
    return glm::all(glm::greaterThan(p, box.min)) && glm::all(glm::lessThan(p, box.max));
}

// A profile turned about y, as a mesh of its own.
Mesh turnedMesh(const std::vector<shapes::Curve>& profile, int around, float uvRadius) {
    Mesh mesh;
    for (const shapes::Patch& patch : shapes::lathe(profile, around, uvRadius))
        shapes::appendPatch(mesh, patch);
    return mesh;
}

// A closed vase of the given height, standing on y = 0.
Mesh vase(float height) {
    const float s = height;
    const auto outline = [s](float t) {
        // A belly and a neck: the sum of two cosine waves, by eye.
        const float r = 0.20f + 0.11f * std::cos(glm::two_pi<float>() * (t - 0.36f)) -
                        0.03f * std::cos(2 * glm::two_pi<float>() * (t - 0.1f));
        return s * glm::vec2(r, t);
    };
    const glm::vec2 foot = outline(0), lip = outline(1);
    const glm::vec2 inner(lip.x * 0.8f, lip.y);
    const glm::vec2 bottom(inner.x, 0.5f * s);
    return turnedMesh({shapes::line({0, 0}, foot, 2), shapes::Curve{32, outline}, shapes::line(lip, inner),
                       shapes::line(inner, bottom, 4), shapes::line(bottom, {0, bottom.y}, 2)},
                      48, foot.x);
}

// A table with a top of the given size, standing on y = 0, its parts in one mesh.
Mesh table(glm::vec3 size, float thickness) {
    Mesh mesh;
    const glm::vec2 half(0.5f * size.x, 0.5f * size.z);
    shapes::appendBox(mesh, {{-half.x, size.y - thickness, -half.y}, {half.x, size.y, half.y}});
    for (float sx : {-1.0f, 1.0f})
        for (float sz : {-1.0f, 1.0f}) {
            const glm::vec3 c(sx * (half.x - thickness), 0, sz * (half.y - thickness));
            const glm::vec3 leg(0.5f * thickness, 0, 0.5f * thickness);
            shapes::appendBox(mesh, {c - leg, c + leg + glm::vec3(0, size.y - thickness, 0)});
        }
    return mesh;
}

}  // namespace

Scene buildLeak(const Values& values) {
    Scene scene;
    // The room is the unit cube, its walls 0.06 m: bounds of 1.12 m, that is 128 voxels of 8.75 mm.
    constexpr float kWall = 0.06f;
    const int white = add(scene, matte("white", glm::vec3(0.7f)));
    const int partition = add(scene, matte("partition", glm::vec3(0.7f)));
    const Aabb room{{-0.5f, 0, -0.5f}, {0.5f, 1, 0.5f}};
    shapes::CellSolid shell;
    for (std::size_t a = 0; a < 3; ++a)
        shell.planes[a] = {room.min[int(a)] - kWall, room.min[int(a)], room.max[int(a)],
                           room.max[int(a)] + kWall};
    shell.solid = [=](glm::vec3 p) { return !inside(room, p); };
    shell.part = [=](glm::vec3 p, glm::vec3) {
        const bool outside = glm::any(glm::lessThan(p, room.min - 0.5f * kWall)) ||
                             glm::any(glm::greaterThan(p, room.max + 0.5f * kWall));
        return outside ? 1 : 0;
    };
    addCells(scene, shell, {{"room", white}, {"outside", white}});

    // The partition ends inside of the walls, at half their depth: no slit however it is turned.
    const float angle = glm::radians(float(values["angle"]));
    const float halfWidth = 0.5f * float(values["thickness"]) / std::cos(angle);  // measured along x
    const float end = 0.5f + 0.5f * kWall;
    std::array<glm::vec3, 8> corners;
    for (unsigned i = 0; i < 8; ++i) {
        const float z = (i & 4) ? end : -end;
        corners[i] = {z * std::tan(angle) + ((i & 1) ? halfWidth : -halfWidth),
                      (i & 2) ? 0.5f + end : 0.5f - end, z};
    }
    Mesh slab;
    shapes::appendHexahedron(slab, corners);
    addPart(scene, std::move(slab), "partition", partition);

    scene.lights.push_back(pointLight("lamp", {-0.3f, 0.8f, 0}, glm::vec3(float(values["intensity"]))));

    // Each half is seen from the end where it is wider. The cut-away's near plane removes the front wall.
    const float s = angle >= 0 ? 1.0f : -1.0f;
    scene.cameras.push_back(camera("lit", {-0.28f, 0.5f, 0.48f * s}, {-0.25f, 0.47f, -0.5f * s}, 75));
    scene.cameras.push_back(camera("dark", {0.28f, 0.5f, -0.48f * s}, {0.25f, 0.47f, 0.5f * s}, 75));
    Camera both = camera("both", {0, 0.5f, 2.2f}, {0, 0.5f, 0}, 32.6f);
    both.zNear = 2.2f - 0.495f;
    scene.cameras.push_back(both);
    return scene;
}

Scene buildSunroom(const Values& values) {
    Scene scene;
    const int plaster = add(scene, matte("plaster", {0.72f, 0.70f, 0.66f}));
    const int boards = add(scene, matte("floorboards", {0.50f, 0.37f, 0.24f}));
    const int accent = add(scene, matte("accent wall", {0.26f, 0.44f, 0.48f}));
    const int ground = add(scene, matte("ground", {0.42f, 0.38f, 0.30f}));

    // One solid: the room's walls, 0.2 m thick, a window in the left one, and a strip of ground before it.
    constexpr float kWall = 0.2f;
    const Aabb room{{-1.8f, 0, -2.2f}, {1.8f, 2.6f, 2.2f}};
    const Aabb outer{room.min - kWall, room.max + kWall};
    const Aabb window{{outer.min.x - 1, 0.8f, -1.3f}, {room.min.x + 1, 2.2f, 0.5f}};
    const float groundEnd = outer.min.x - 2.4f;
    shapes::CellSolid house;
    house.planes[0] = {groundEnd, outer.min.x, room.min.x, room.max.x, outer.max.x};
    house.planes[1] = {outer.min.y, room.min.y, window.min.y, window.max.y, room.max.y, outer.max.y};
    house.planes[2] = {outer.min.z, room.min.z, window.min.z, window.max.z, room.max.z, outer.max.z};
    house.solid = [=](glm::vec3 p) {
        if (p.x < outer.min.x) return p.y < 0;
        return !inside(room, p) && !(p.x < room.min.x && inside(window, p));
    };
    house.part = [=](glm::vec3 p, glm::vec3 n) {
        if (p.x < outer.min.x + 0.01f && p.y < 0.01f) return 3;          // the ground and its sides
        if (!inside({room.min - 0.01f, room.max + 0.01f}, p)) return 0;  // outside walls, reveals
        if (n.y > 0.5f) return 1;
        return n.z > 0.5f && p.z < room.min.z + 0.01f ? 2 : 0;
    };
    addCells(scene, house,
             {{"walls", plaster}, {"floor", boards}, {"back wall", accent}, {"ground", ground}});

    // Furniture where the sun falls, for colour and for contact shadows.
    const int red = add(scene, matte("rug", {0.55f, 0.07f, 0.06f}));
    const int wood = add(scene, matte("wood", {0.45f, 0.28f, 0.15f}));
    const int clay = add(scene, glossy("glazed clay", {0.16f, 0.36f, 0.50f}, 0.35f));
    const int linen = add(scene, matte("linen", {0.70f, 0.66f, 0.58f}));
    addPart(scene, box({{-0.65f, 0, -1.75f}, {0.85f, 0.02f, 0.0f}}), "rug", red);
    addPart(scene, table({1.1f, 0.45f, 0.6f}, 0.06f), "table", wood).worldFromObject =
        translation({0.1f, 0.02f, -0.8f}) * turnAboutY(0.2f);
    addPart(scene, vase(0.45f), "vase", clay).worldFromObject = translation({0.25f, 0.47f, -0.8f});
    addPart(scene, box({{1.0f, 0, -2.1f}, {1.75f, 0.42f, -0.4f}}), "bench", linen);

    // The sun enters from the left, over the ground. Its irradiance makes the lit floor about as bright as
    // white.
    scene.lights.push_back(
        sunLight("sun", {0.80f, -0.62f, -0.12f}, float(values["sun"]) * glm::vec3(1.0f, 0.93f, 0.80f)));
    scene.sky = float(values["sky"]) * glm::vec3(0.60f, 0.78f, 1.0f);
    scene.cameras.push_back(camera("inside", {0.9f, 1.35f, 2.1f}, {-0.35f, 0.85f, -1.2f}, 62));
    scene.cameras.push_back(camera("window", {1.6f, 1.5f, 0.8f}, {-1.8f, 1.2f, -0.5f}, 62));
    return scene;
}

Scene buildCorridor(const Values& values) {
    Scene scene;
    const int plaster = add(scene, matte("plaster", {0.74f, 0.72f, 0.68f}));
    const int floor = add(scene, matte("floor", {0.42f, 0.40f, 0.37f}));
    const int lamp = add(scene, emitter("lamp", float(values["emission"]) * glm::vec3(1.0f, 0.88f, 0.70f)));
    const int teal = add(scene, matte("teal wall", {0.10f, 0.42f, 0.44f}));
    const int ochre = add(scene, matte("ochre wall", {0.68f, 0.40f, 0.10f}));

    // Three legs of an S, 1.6 m wide and 2.4 m high: A toward -z, B toward +x, C toward -z with the lamp at
    // its end.
    constexpr float kWall = 0.2f;
    constexpr float kHalf = 0.8f;
    constexpr float kHeight = 2.4f;
    const Aabb legs[3] = {{{-kHalf, 0, -kHalf}, {kHalf, kHeight, 5}},
                          {{-kHalf, 0, -kHalf}, {5 + kHalf, kHeight, kHalf}},
                          {{5 - kHalf, 0, -5}, {5 + kHalf, kHeight, kHalf}}};
    const Aabb panel{{4.6f, 0, -4.4f}, {5.4f, 9, -3.2f}};
    auto inLegs = [legs](glm::vec3 p, float grow) {
        for (const Aabb& leg : legs)
            if (inside({leg.min - grow, leg.max + grow}, p)) return true;
        return false;
    };
    shapes::CellSolid walls;
    walls.planes[0] = {-kHalf - kWall, -kHalf,      kHalf,       kHalf + kWall, 5 - kHalf - kWall,
                       5 - kHalf,      panel.min.x, panel.max.x, 5 + kHalf,     5 + kHalf + kWall};
    walls.planes[1] = {-kWall, 0, kHeight, kHeight + kWall};
    walls.planes[2] = {-5 - kWall, -5,    panel.min.z,   panel.max.z, -kHalf - kWall,
                       -kHalf,     kHalf, kHalf + kWall, 5,           5 + kWall};
    walls.solid = [=](glm::vec3 p) { return inLegs(p, kWall) && !inLegs(p, 0); };
    walls.part = [=](glm::vec3 p, glm::vec3 n) {
        if (!inLegs(p, 0.01f)) return 0;  // outside
        if (n.y > 0.5f) return 1;
        if (n.y < -0.5f) return inside(panel, p) ? 2 : 0;
        if (n.x < -0.5f && p.x > 5 && p.z > -kHalf) return 3;          // faces who walks along B
        if (n.z > 0.5f && p.z < 0 && std::abs(p.x) < kHalf) return 4;  // faces who walks along A
        return 0;
    };
    addCells(
        scene, walls,
        {{"walls", plaster}, {"floor", floor}, {"lamp", lamp}, {"teal wall", teal}, {"ochre wall", ochre}});

    scene.cameras.push_back(camera("middle", {0.2f, 1.5f, 0.25f}, {5, 1.15f, -0.15f}, 58));
    scene.cameras.push_back(camera("dark", {0, 1.5f, 4.7f}, {0.1f, 1.2f, 0}, 58));
    scene.cameras.push_back(camera("lit", {5.2f, 1.5f, 0.5f}, {4.95f, 1.3f, -4}, 58));
    return scene;
}

namespace {

// The shell of the glossy room: lamps are flush fields of the ceiling and of the back wall.
void addGlossyRoom(Scene& scene, int floor, float emission) {
    const int plaster = add(scene, matte("plaster", {0.70f, 0.68f, 0.65f}));
    const int orange = add(scene, matte("orange wall", {0.66f, 0.26f, 0.06f}));
    const int blue = add(scene, matte("blue wall", {0.08f, 0.22f, 0.55f}));
    const int lamp = add(scene, emitter("lamp", emission * glm::vec3(1.0f, 0.90f, 0.76f)));
    const int tube = add(scene, emitter("tube", 0.5f * emission * glm::vec3(0.55f, 0.80f, 1.0f)));
    constexpr float kWall = 0.15f;
    const Aabb room{{-2, 0, -2}, {2, 2.5f, 2.4f}};
    const Aabb panel{{-0.7f, 2, -0.8f}, {0.7f, 3, 0.2f}};
    const Aabb slit{{0.9f, 0.35f, -3}, {1.1f, 2.1f, -1.9f}};
    shapes::CellSolid shell;
    shell.planes[0] = {room.min.x - kWall, room.min.x, panel.min.x, panel.max.x,
                       slit.min.x,         slit.max.x, room.max.x,  room.max.x + kWall};
    shell.planes[1] = {room.min.y - kWall, room.min.y, slit.min.y,
                       slit.max.y,         room.max.y, room.max.y + kWall};
    shell.planes[2] = {room.min.z - kWall, room.min.z, panel.min.z,
                       panel.max.z,        room.max.z, room.max.z + kWall};
    shell.solid = [=](glm::vec3 p) { return !inside(room, p); };
    shell.part = [=](glm::vec3 p, glm::vec3 n) {
        if (!inside({room.min - 0.01f, room.max + 0.01f}, p)) return 0;  // outside
        if (n.y > 0.5f) return 1;
        if (n.x > 0.5f) return 2;
        if (n.x < -0.5f) return 3;
        if (n.y < -0.5f && inside(panel, p)) return 4;
        return n.z > 0.5f && inside(slit, p) ? 5 : 0;
    };
    addCells(scene, shell,
             {{"walls", plaster},
              {"floor", floor},
              {"left wall", orange},
              {"right wall", blue},
              {"lamp", lamp},
              {"tube", tube}});
}

}  // namespace

Scene buildGlossy(const Values& values) {
    Scene scene;
    Material floor = glossy("floor", {0.52f, 0.51f, 0.49f}, float(values["roughness"]));
    floor.metallic = float(values["metallic"]);
    addGlossyRoom(scene, add(scene, std::move(floor)), float(values["emission"]));

    // Metals take their F0 from their optical constants, rounded; roughness 0.1 to 0.4.
    const int gold = add(scene, metal("gold, roughness 0.1", {0.95f, 0.72f, 0.34f}, 0.1f));
    const int copper = add(scene, metal("copper, roughness 0.2", {0.93f, 0.62f, 0.52f}, 0.2f));
    const int steel = add(scene, metal("steel, roughness 0.3", {0.56f, 0.57f, 0.58f}, 0.3f));
    const int lacquer = add(scene, glossy("lacquer, roughness 0.4", {0.50f, 0.04f, 0.04f}, 0.4f));
    Mesh ball;
    shapes::appendPatch(ball, shapes::uvSphere({0, 0.42f, 0}, glm::vec3(0.42f), 64, 32));
    addPart(scene, std::move(ball), "gold ball", gold).worldFromObject = translation({-0.75f, 0, -0.35f});
    addPart(scene, vase(1.1f), "copper vase", copper).worldFromObject = translation({0.45f, 0, -1.05f});
    addPart(scene, box({{-0.28f, 0, -0.28f}, {0.28f, 0.56f, 0.28f}}), "steel block", steel).worldFromObject =
        translation({0.75f, 0, 0.15f}) * turnAboutY(0.55f);
    Mesh disc = turnedMesh(
        {shapes::line({0, 0}, {0.26f, 0}, 2),
         shapes::arc({0.26f, 0.09f}, {0.09f, 0.09f}, -glm::half_pi<float>(), glm::half_pi<float>(), 12),
         shapes::line({0.26f, 0.18f}, {0, 0.18f}, 2)},
        48, 0.3f);
    addPart(scene, std::move(disc), "lacquer drum", lacquer).worldFromObject =
        translation({-0.15f, 0, 0.55f});
    scene.cameras.push_back(camera("front", {0.15f, 1.15f, 2.3f}, {0, 0.55f, -0.6f}, 62));
    return scene;
}

}  // namespace conelight::io::generated
