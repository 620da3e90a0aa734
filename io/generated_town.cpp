// SPDX-License-Identifier: MIT
// builtin:town: a square in the middle of a grid of streets, each block with 18 houses about a yard, by instances of a
// few meshes, at any hour of a summer's day. Values -> Scene.
//
// Light is that of the sky model at the hour, and of lamps of about 25 lux on the ground, all times one factor: so a
// camera that adapts would see it. Lamps near the square give light; those farther away, and lit windows, only glow.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <vector>

#include "io/generated_surroundings.h"
#include "io/generated_textures.h"
#include "io/generated_town_parts.h"

namespace conelight::io::generated {
namespace {

constexpr float kPitch = 60, kHalfBlock = 24, kHalfSlab = 26.5f, kKerb = 0.12f, kTownFloor = 0.15f;
constexpr int kHouseKinds = 6;
constexpr glm::vec3 kLampColour(1.0f, 0.72f, 0.42f);

// How much of everything there is at an hour.
struct TownLight {
    LoadedEnvironment sky;
    float scale = 1;  // of the sky's and the sun's light
    float lamps = 0;  // W/sr of a street lamp
};

float smoothRise(float from, float to, float x) {
    const float t = std::clamp((x - from) / (to - from), 0.0f, 1.0f);
    return t * t * (3 - 2 * t);
}

// On the ground, of a picture's upper half: luminance.
float groundIrradiance(const EnvironmentImage& image) {
    const float pi = glm::pi<float>();
    double sum = 0;
    for (int y = 4; y < image.height / 2; y += 8) {
        const float up = pi * (0.5f - (float(y) + 0.5f) / float(image.height));
        for (int x = 4; x < image.width; x += 8) {
            const glm::vec3& c = image.radiance[std::size_t(y) * std::size_t(image.width) + std::size_t(x)];
            sum += double(std::sin(up) * std::cos(up) * glm::dot(c, glm::vec3(0.2126f, 0.7152f, 0.0722f)));
        }
    }
    return float(sum * 64 * 2 * double(pi * pi) / (double(image.width) * double(image.height)));
}

TownLight lightAt(double hour) {
    TownLight light;
    light.sky = generateSurroundings(fmt::format("sky?hour={}", hour));
    float sky = groundIrradiance(*light.sky.environment.image);
    if (light.sky.sun)
        sky += glm::dot(light.sky.sun->intensity, glm::vec3(0.2126f, 0.7152f, 0.0722f)) *
               -light.sky.sun->direction.y;
    // Lamps go on below 1000 lux. A camera makes night brighter, but not as bright as day.
    constexpr float kLampIrradiance = 25.0f / 683;
    const float on = smoothRise(0.5f, -0.5f, std::log10(sky));
    const float arriving = sky + on * kLampIrradiance;
    const float seen = glm::mix(1.6f, 4.6f, smoothRise(-1.5f, 2.0f, std::log10(arriving)));
    light.scale = seen / arriving;
    light.lamps = on * light.scale * kLampIrradiance * 70;
    return light;
}

// Indices of meshes and materials.
struct HouseParts {
    int walls, roof, painted, litPanes, panes;
};
struct TownParts {
    std::array<HouseParts, kHouseKinds + 1> houses{};  // the last: the open one at the square
    std::array<int, 6> plasters{};
    std::array<int, 2> tiles{};
    std::array<int, 2> nearTrees{}, farTrees{};
    int paint = 0, leaf = 0, glass = 0, glow = 0, globeGlow = 0, globeDark = 0;
    int post = 0, globe = 0, furniture = 0;
};

int named(Scene& scene, Mesh mesh, const char* name) {
    mesh.name = name;
    return add(scene, std::move(mesh));
}

HouseParts addHouseKind(Scene& scene, const TownHouse& house) {
    TownHouseMeshes meshes = townHouse(house);
    return {named(scene, std::move(meshes.walls), "house walls"),
            named(scene, std::move(meshes.roof), "house roof"),
            named(scene, std::move(meshes.painted), "rooms and trim"),
            named(scene, std::move(meshes.litPanes), "panes lit at night"),
            named(scene, std::move(meshes.panes), "panes")};
}

void addMaterials(Scene& scene, TownParts& parts, const TownLight& light) {
    const int plaster = add(scene, textures::plaster(256));
    const glm::vec3 colours[] = {{0.66f, 0.52f, 0.30f}, {0.62f, 0.40f, 0.32f}, {0.68f, 0.65f, 0.56f},
                                 {0.50f, 0.55f, 0.54f}, {0.70f, 0.58f, 0.42f}, {0.56f, 0.30f, 0.22f}};
    for (std::size_t i = 0; i < parts.plasters.size(); ++i) {
        Material m = matte(fmt::format("plaster {}", i + 1), colours[i]);
        m.baseColorTexture = repeat(plaster, 2.4f);
        parts.plasters[i] = add(scene, std::move(m));
    }
    const int courses = add(scene, textures::ashlar(256).color);
    const glm::vec3 clays[] = {{0.46f, 0.20f, 0.12f}, {0.30f, 0.27f, 0.26f}};
    for (std::size_t i = 0; i < parts.tiles.size(); ++i) {
        Material m = matte(fmt::format("roof tiles {}", i + 1), clays[i]);
        m.baseColorTexture = repeat(courses, 0.9f);
        m.doubleSided = true;  // gables leave the ends of courses open
        parts.tiles[i] = add(scene, std::move(m));
    }
    parts.paint = add(scene, matte("paint", glm::vec3(0.99f)));
    Material leaf = matte("wood and leaves", glm::vec3(0.99f));
    leaf.doubleSided = true;
    parts.leaf = add(scene, std::move(leaf));
    parts.glass = add(scene, glossy("window glass", {0.03f, 0.04f, 0.05f}, 0.1f));
    parts.glow = add(scene, emitter("lit window", 0.016f * light.lamps * kLampColour));
    parts.globeGlow = add(scene, emitter("lit globe", 0.25f * light.lamps * kLampColour));
    parts.globeDark = add(scene, glossy("milk glass", {0.7f, 0.69f, 0.65f}, 0.2f));
}

TownParts addParts(Scene& scene, const TownLight& light) {
    TownParts parts;
    addMaterials(scene, parts, light);
    const glm::vec3 green(0.10f, 0.22f, 0.16f), blue(0.14f, 0.24f, 0.36f), brown(0.26f, 0.15f, 0.09f);
    const TownHouse kinds[] = {{2, 3, false, false, green, {}},
                               {3, 3, true, false, blue, {0.50f, 0.10f, 0.08f}},
                               {3, 4, false, false, brown, {}},
                               {2, 3, true, false, brown, {0.10f, 0.28f, 0.22f}},
                               {4, 3, false, false, blue, {}},
                               {3, 3, true, false, green, {0.60f, 0.42f, 0.12f}},
                               {3, 3, true, true, green, {0.50f, 0.10f, 0.08f}}};
    for (std::size_t i = 0; i < parts.houses.size(); ++i) parts.houses[i] = addHouseKind(scene, kinds[i]);
    for (std::uint32_t i = 0; i < 2; ++i) {
        parts.nearTrees[i] = named(scene, townTree(330, 0.19f, 41 + 7 * i), "tree on the square");
        parts.farTrees[i] = named(scene, townTree(18, 0.8f, 60 + 7 * i), "tree");
    }
    parts.post = named(scene, townLampPost(), "lamp post");
    parts.globe = named(scene, sphere(0.15f, 16), "globe");
    parts.furniture = named(scene, townFurniture(), "furniture");
    return parts;
}

// What is put into the town, at one hour.
struct TownBuilder {
    Scene& scene;
    const TownParts& parts;
    const TownLight& light;
    float lit;  // m from the middle: lamps as near as that give light

    // A globe that is seen, and the light that it gives if it is near.
    void addGlobe(glm::vec3 at, float size, float share) const {
        const bool on = light.lamps > 0;
        Instance& globe = place(scene, parts.globe, on ? parts.globeGlow : parts.globeDark, "globe",
                                translation(at) * glm::mat4(glm::mat3(size)));
        if (!on) return;
        globe.voxelized = globe.castsShadow = false;
        if (glm::length(glm::vec2(at.x, at.z)) <= lit)
            scene.lights.push_back(pointLight(fmt::format("lamp {}", scene.lights.size() + 1), at,
                                              share * light.lamps * kLampColour));
    }
    void addLamp(glm::vec3 foot) const {
        place(scene, parts.post, parts.paint, "lamp post", translation(foot));
        addGlobe(foot + glm::vec3(0, kTownLampHeight, 0), 1, 1);
    }
    void addTree(glm::vec3 foot, bool near, std::uint32_t seed) const {
        const float size = 0.85f + 0.4f * randomAt(seed, 1);
        const auto& kinds = near ? parts.nearTrees : parts.farTrees;
        place(scene, kinds[seed % 2], parts.leaf, "tree",
              translation(foot) * turnAboutY(6.28f * randomAt(seed, 2)) * glm::mat4(glm::mat3(size)));
    }
    void addHouse(const glm::mat4& at, int kind, std::uint32_t seed) const {
        const HouseParts& house = parts.houses[std::size_t(kind)];
        place(scene, house.walls, parts.plasters[std::size_t(6 * randomAt(seed, 3))], "house", at);
        place(scene, house.roof, parts.tiles[randomAt(seed, 4) < 0.7f ? 0 : 1], "roof", at);
        place(scene, house.painted, parts.paint, "rooms and trim", at);
        place(scene, house.panes, parts.glass, "panes", at);
        const bool glows = light.lamps > 0 && randomAt(seed, 5) < 0.7f;
        Instance& panes =
            place(scene, house.litPanes, glows ? parts.glow : parts.glass, "panes lit at night", at);
        panes.voxelized = !glows;
        const glm::vec3 room(at * glm::vec4(4, 2.5f, -2.4f, 1));
        if (glm::length(glm::vec2(room.x, room.z)) > 62) return;
        place(scene, parts.furniture, parts.paint, "furniture", at);
        if (kind == kHouseKinds || randomAt(seed, 6) < 0.3f) addGlobe(room, 0.8f, 0.12f);
    }
    void addBlock(int column, int row) const;
    void addSquare() const;
};

void TownBuilder::addBlock(int column, int row) const {
    const glm::vec3 middle(kPitch * float(column), 0, kPitch * float(row));
    const std::uint32_t seed = shapes::hash(std::uint32_t(column + 500), std::uint32_t(row + 500));
    for (int side = 0; side < 4; ++side) {
        const int houses = side % 2 == 0 ? 6 : 3;
        const glm::mat4 turn = translation(middle) * turnAboutY(0.5f * glm::pi<float>() * float(side));
        for (int i = 0; i < houses; ++i) {
            const std::uint32_t own = seed + std::uint32_t(100 * side + i);
            const bool open = column == 0 && row == -1 && side == 0 && i == 2;
            addHouse(turn * translation({kTownHouseWidth * (float(i) - 0.5f * float(houses)), kTownFloor,
                                         kHalfBlock}),
                     open ? kHouseKinds : int(float(kHouseKinds) * randomAt(own, 0)), own);
        }
        for (const float x : {-16.0f, 0.0f, 16.0f})
            if (randomAt(seed, 20 + side, int(x)) < 0.6f)
                addTree(glm::vec3(turn * glm::vec4(x, kKerb, kHalfSlab - 0.7f, 1)), false,
                        seed + std::uint32_t(side));
        addLamp(glm::vec3(turn * glm::vec4(8, kKerb, kHalfSlab - 0.6f, 1)));
    }
    for (int i = 0; i < 4; ++i)
        addTree(
            middle + glm::vec3(18 * (randomAt(seed, i, 8) - 0.5f), kKerb, 18 * (randomAt(seed, i, 9) - 0.5f)),
            false, seed + std::uint32_t(40 + i));
}

// A fountain, rows of trees with benches, stalls, lamps.
void TownBuilder::addSquare() const {
    place(scene, named(scene, townFountain(), "fountain"), parts.paint, "fountain",
          translation({0, kKerb, 0}));
    place(scene, named(scene, townWater(), "water"),
          add(scene, glossy("water", {0.02f, 0.05f, 0.05f}, 0.05f)), "water", translation({0, kKerb, 0}));
    const int bench = named(scene, townBench(), "bench");
    for (const float z : {-17.0f, 17.0f})
        for (int i = 0; i < 5; ++i) {
            const float x = -20 + 10 * float(i);
            addTree({x, kKerb, z}, true, std::uint32_t(300 + i + (z > 0 ? 20 : 0)));
            if (i < 4)
                place(scene, bench, parts.paint, "bench",
                      translation({x + 5, kKerb, z * 0.94f}) * turnAboutY(z > 0 ? glm::pi<float>() : 0.0f));
        }
    for (const float x : {-1.0f, 1.0f})
        for (const float z : {-1.0f, 1.0f}) {
            addLamp({17.5f * x, kKerb, 13.5f * z});
            addLamp({5.5f * x, kKerb, 6.5f * z});
        }
    for (const float z : {-22.5f, 22.5f}) addLamp({0, kKerb, z});
    const glm::vec3 cloths[] = {{0.52f, 0.10f, 0.08f}, {0.10f, 0.24f, 0.42f}, {0.12f, 0.34f, 0.18f}};
    for (int i = 0; i < 3; ++i)
        place(scene, named(scene, townStall(cloths[i]), "stall"), parts.leaf, "stall",
              translation({-10 - 3.9f * float(i), kKerb, 5.5f - 4.5f * float(i)}) *
                  turnAboutY(0.6f + 0.3f * float(i)));
}

// Setts for the streets, a slab of paving with a kerb for each block, a yard of grass.
void addTownGround(Scene& scene, int blocks) {
    textures::Surface stones = textures::ashlar(512);
    const int colour = add(scene, std::move(stones.color)), normals = add(scene, std::move(stones.normal));
    const auto stone = [&](const char* name, glm::vec3 paint, float metres) {
        Material m = matte(name, paint);
        m.baseColorTexture = repeat(colour, metres);
        m.normalTexture = repeat(normals, metres);
        return add(scene, std::move(m));
    };
    const float edge = kPitch * float(blocks);
    Mesh street = quad({-0.5f * edge, 0, 0.5f * edge}, {edge, 0, 0}, {0, 0, -edge});
    shapes::computeTangents(street);
    addPart(scene, std::move(street), "streets", stone("setts", {0.27f, 0.26f, 0.25f}, 0.8f));
    Mesh slab = box({{-kHalfSlab, 0, -kHalfSlab}, {kHalfSlab, kKerb, kHalfSlab}});
    shapes::computeTangents(slab);
    const int slabMesh = named(scene, std::move(slab), "paving");
    const int yard = named(scene, box({{-14.5f, kKerb, -14.5f}, {14.5f, kKerb + 0.03f, 14.5f}}), "yard");
    const int paving = stone("paving", {0.46f, 0.43f, 0.38f}, 1.8f),
              square = stone("paving of the square", {0.52f, 0.47f, 0.39f}, 1.4f),
              grass = add(scene, matte("grass", {0.13f, 0.22f, 0.06f}));
    for (int row = -blocks / 2; row <= blocks / 2; ++row)
        for (int column = -blocks / 2; column <= blocks / 2; ++column) {
            const bool middle = row == 0 && column == 0;
            const glm::mat4 at = translation({kPitch * float(column), 0, kPitch * float(row)});
            place(scene, slabMesh, middle ? square : paving, middle ? "square" : "paving", at);
            if (!middle) place(scene, yard, grass, "yard", at);
        }
}

void addCameras(Scene& scene) {
    scene.cameras.push_back(camera("square", {9.5f, 1.75f, 5.5f}, {-6, 2.9f, -9}, 60));
    scene.cameras.push_back(camera("room", {-7.1f, 1.8f, -40.0f}, {-2.6f, 1.25f, -36}, 70));
    scene.cameras.push_back(camera("street", {30.5f, 1.75f, 34}, {28.5f, 4.2f, -30}, 60));
    scene.cameras.push_back(camera("roofs", {52, 30, 66}, {-12, 2, -22}, 50));
    for (Camera& c : scene.cameras) c.zNear = 0.05f, c.zFar = 4000;
}

}  // namespace

Scene buildTown(const Values& values) {
    Scene scene;
    // So many blocks along each side, an odd number, that all are within the size.
    const int blocks = (int(values["size"] / double(kPitch)) - 1) / 2 * 2 + 1;
    TownLight light = lightAt(values["hour"]);
    light.lamps *= float(values["lamps"]);
    addTownGround(scene, blocks);
    const TownParts parts = addParts(scene, light);
    const TownBuilder builder{scene, parts, light, float(values["lit"])};
    builder.addSquare();
    for (int row = -blocks / 2; row <= blocks / 2; ++row)
        for (int column = -blocks / 2; column <= blocks / 2; ++column)
            if (row != 0 || column != 0) builder.addBlock(column, row);
    addCameras(scene);
    useEnvironment(scene, std::move(light.sky), 0, light.scale);
    scene.settings.emplace_back("voxels.levels", "0");
    return scene;
}

}  // namespace conelight::io::generated
