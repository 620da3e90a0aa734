// SPDX-License-Identifier: MIT
// A paved street between two rows of houses: window reveals, louvred shutters, awnings, parked cars, trees of
// leaves, wires. Values -> Scene.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "io/generated_furnished.h"
#include "io/generated_textures.h"

namespace conelight::io::generated {
namespace {

constexpr float kStorey = 2.9f, kHouseDepth = 4.5f, kReveal = 0.22f, kPavement = 0.12f, kFront = 4.4f;

struct StreetPaints {
    int timber, glass, stone, iron, tiles, leaf, bark, rubber;
};

struct House {
    float x, width;
    int storeys, columns;
    int wall, shutters, awning;  // awning: a material, or -1
    float height() const { return kStorey * float(storeys); }
};

// Window or door in the front of a house; the door is in the first column.
struct Opening {
    glm::vec2 min, max;
    bool door;
};

std::vector<Opening> openingsOf(const House& house) {
    std::vector<Opening> openings;
    for (int s = 0; s < house.storeys; ++s)
        for (int c = 0; c < house.columns; ++c) {
            const float x = (float(c) + 0.5f) * house.width / float(house.columns), y = kStorey * float(s);
            const bool door = s == 0 && c == 0;
            openings.push_back({{x - 0.5f, door ? 0.0f : y + 0.85f}, {x + 0.5f, y + 2.25f}, door});
        }
    return openings;
}

// The walls, with a recess at each opening; the front is at z = 0.
Mesh houseWalls(const House& house, const std::vector<Opening>& openings) {
    shapes::CellSolid walls;
    walls.planes = {std::vector<float>{0, house.width}, std::vector<float>{0, house.height()},
                    std::vector<float>{-kHouseDepth, -kReveal, 0}};
    for (const Opening& o : openings)
        for (int a = 0; a < 2; ++a)
            walls.planes[std::size_t(a)].insert(walls.planes[std::size_t(a)].end(), {o.min[a], o.max[a]});
    for (int a = 0; a < 2; ++a) {
        std::vector<float>& planes = walls.planes[std::size_t(a)];
        std::sort(planes.begin(), planes.end());
        planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
    }
    walls.solid = [&](glm::vec3 p) {
        return p.z < -kReveal || std::none_of(openings.begin(), openings.end(), [&](const Opening& o) {
                   return p.x > o.min.x && p.x < o.max.x && p.y > o.min.y && p.y < o.max.y;
               });
    };
    walls.part = [](glm::vec3, glm::vec3) { return 0; };
    return shapes::buildCells(walls, 1)[0];
}

// Bars about a pane of `size`, in the plane z = 0.
Mesh windowFrame(glm::vec2 size) {
    Mesh frame;
    const auto bar = [&](glm::vec2 min, glm::vec2 max) {
        merge(frame, chamferedBox({glm::vec3(min, -0.03f), glm::vec3(max, 0.03f)}, 0.006f));
    };
    bar({0, 0}, {0.06f, size.y});
    bar({size.x - 0.06f, 0}, size);
    bar({0.06f, 0}, {size.x - 0.06f, 0.06f});
    bar({0.06f, size.y - 0.06f}, {size.x - 0.06f, size.y});
    bar({0.5f * size.x - 0.03f, 0.06f}, {0.5f * size.x + 0.03f, size.y - 0.06f});
    bar({0.06f, 0.65f * size.y}, {size.x - 0.06f, 0.65f * size.y + 0.03f});
    return frame;
}

// A shutter of leaning slats in a frame, its hinges at x = 0.
Mesh shutter(glm::vec2 size) {
    Mesh mesh;
    const auto bar = [&](glm::vec3 min, glm::vec3 max) { merge(mesh, chamferedBox({min, max}, 0.004f)); };
    bar({0, 0, 0}, {0.05f, size.y, 0.03f});
    bar({size.x - 0.05f, 0, 0}, {size.x, size.y, 0.03f});
    bar({0.05f, 0, 0}, {size.x - 0.05f, 0.05f, 0.03f});
    bar({0.05f, size.y - 0.05f, 0}, {size.x - 0.05f, size.y, 0.03f});
    const int slats = int((size.y - 0.12f) / 0.045f);
    for (int i = 0; i < slats; ++i)
        merge(mesh, box({{0.05f, -0.025f, -0.003f}, {size.x - 0.05f, 0.025f, 0.003f}}),
              translation({0, 0.08f + 0.045f * float(i), 0.015f}) *
                  glm::rotate(glm::mat4(1), -0.6f, glm::vec3(1, 0, 0)));
    return mesh;
}

// A gable roof: walls up to the ridge, two slopes of curved tiles, each a sheet.
void addRoof(const Placer& at, const House& house, const StreetPaints& paints) {
    const float rise = 1.5f, middle = -0.5f * kHouseDepth, y = house.height(), eaves = 0.35f;
    Mesh gables;
    for (const float x : {0.0f, house.width})
        appendPolygon(gables, {{x, y, 0}, {x, y, -kHouseDepth}, {x, y + rise, middle}},
                      {x > 0 ? 1.0f : -1.0f, 0, 0});
    at.put(std::move(gables), "gable", house.wall);
    const float run = -middle, drop = eaves * rise / run;
    const glm::vec3 up = glm::normalize(glm::vec3(0, rise, -run)), normal(0, -up.z, up.y);
    const float length = std::sqrt((run + eaves) * (run + eaves) + (rise + drop) * (rise + drop));
    Mesh under = quad({-0.02f, 0, 0}, {house.width + 0.04f, 0, 0}, {0, length, 0}), tiles;
    const int columns = int(house.width / 0.24f), rows = int(length / 0.34f);
    const float wide = house.width / float(columns), step = length / float(rows);
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c) {
            const float lift = 0.012f * randomAt(71, r * 100 + c);
            merge(tiles, sheet(
                             [&](float u, float v) {
                                 return glm::vec3(
                                     wide * (float(c) + 0.04f + 0.92f * u), step * (float(r) + 1.15f * v),
                                     0.03f + lift + 0.05f * std::sin(glm::pi<float>() * u) - 0.02f * v);
                             },
                             6, 1, {wide, step}));
        }
    for (const bool back : {false, true}) {
        const glm::mat4 slope(glm::vec4(1, 0, 0, 0), glm::vec4(up, 0), glm::vec4(normal, 0),
                              glm::vec4(0, y - drop, eaves, 1));
        const glm::mat4 turn =
            translation({house.width, 0, -kHouseDepth}) * turnAboutY(glm::pi<float>()) * slope;
        at.put(under, "roof boards", paints.timber, back ? turn : slope);
        at.put(tiles, "roof tiles", paints.tiles, back ? turn : slope);
    }
    at.put(chamferedBox({{0.6f, y + 0.3f, middle - 0.9f}, {1.2f, y + rise + 0.7f, middle - 0.4f}}, 0.02f),
           "chimney", house.wall);
}

// A sheet of cloth on two arms, with a scalloped rim.
void addAwning(const Placer& at, float width, int cloth, int iron) {
    at.put(sheet(
               [=](float u, float v) {
                   return glm::vec3(width * u, 0.55f * (1 - v) - 0.03f * std::sin(glm::pi<float>() * (1 - v)),
                                    1.2f * v);
               },
               24, 6, {width, 1.3f}),
           "awning", cloth, translation({0, 2.1f, 0.02f}));
    at.put(sheet(
               [=](float u, float v) {
                   return glm::vec3(width * u, -0.12f * v - 0.06f * v * std::abs(std::sin(9.42f * u * width)),
                                    1.2f + 0.01f * v);
               },
               96, 3, {width, 0.2f}),
           "valance", cloth, translation({0, 2.1f, 0.02f}));
    for (const float x : {0.05f, width - 0.05f})
        at.put(rod({x, 2.0f, 0.02f}, {x, 2.08f, 1.2f}, 0.012f), "awning arm", iron);
}

void addBalcony(const Placer& at, glm::vec3 where, float width, const StreetPaints& paints) {
    const Placer stand = at.at(translation(where));
    stand.put(chamferedBox({{0, -0.1f, 0}, {width, 0, 0.7f}}, 0.015f), "balcony", paints.stone);
    Mesh rails;
    const int bars = int(width / 0.11f);
    for (int i = 0; i <= bars; ++i) {
        const float x = 0.03f + (width - 0.06f) * float(i) / float(bars);
        merge(rails, rod({x, 0, 0.66f}, {x, 0.95f, 0.66f}, 0.008f, 10));
    }
    for (const float x : {0.03f, width - 0.03f})
        for (int i = 0; i < 6; ++i)
            merge(rails, rod({x, 0, 0.11f * float(i)}, {x, 0.95f, 0.11f * float(i)}, 0.008f, 10));
    merge(rails, rod({0.02f, 0.96f, 0.66f}, {width - 0.02f, 0.96f, 0.66f}, 0.02f));
    stand.put(std::move(rails), "railing", paints.iron);
}

void addHouse(const Placer& at, const House& house, const StreetPaints& paints) {
    const std::vector<Opening> openings = openingsOf(house);
    at.put(houseWalls(house, openings), "house", house.wall);
    const int frame = add(at.scene, windowFrame({1.0f, 1.4f})), leaf = add(at.scene, shutter({0.5f, 1.4f}));
    at.scene.meshes[std::size_t(frame)].name = "window frame";
    at.scene.meshes[std::size_t(leaf)].name = "shutter";
    for (const Opening& o : openings) {
        const glm::vec3 corner(o.min, -0.12f), size(o.max - o.min, 0);
        if (o.door) {
            at.put(chamferedBox({corner + glm::vec3(0.02f, 0.02f, 0),
                                 corner + size + glm::vec3(-0.02f, -0.02f, 0.05f)},
                                0.005f),
                   "door", house.shutters);
            for (int i = 0; i < 4; ++i) {
                const glm::vec3 panel =
                    corner + glm::vec3(0.14f + 0.4f * float(i % 2), 0.2f + float(i / 2), 0.05f);
                at.put(chamferedBox({panel, panel + glm::vec3(0.32f, 0.85f, 0.008f)}, 0.003f), "door panel",
                       house.shutters);
            }
            continue;
        }
        at.put(quad(corner + glm::vec3(0.04f, 0.04f, 0), {size.x - 0.08f, 0, 0}, {0, size.y - 0.08f, 0}),
               "pane", paints.glass);
        at.again(frame, "window frame", paints.timber, translation(corner));
        at.put(chamferedBox({{o.min.x - 0.08f, o.min.y - 0.05f, -kReveal}, {o.max.x + 0.08f, o.min.y, 0.07f}},
                            0.008f),
               "sill", paints.stone);
        if (o.min.y < kStorey) continue;
        const float ajar = 0.15f + 0.5f * randomAt(31, int(8 * o.min.x), int(house.x + o.min.y));
        at.again(leaf, "shutter", house.shutters,
                 translation({o.max.x + 0.01f, o.min.y, 0.02f}) * turnAboutY(-ajar));
        at.again(leaf, "shutter", house.shutters,
                 translation({o.min.x - 0.01f, o.min.y, 0.05f}) * turnAboutY(glm::pi<float>() + ajar));
    }
    addRoof(at, house, paints);
    if (house.awning >= 0)
        addAwning(at.at(translation({house.width / float(house.columns) + 0.1f, 0.2f, 0})),
                  house.width - house.width / float(house.columns) - 0.3f, house.awning, paints.iron);
    else
        addBalcony(at, {0.5f, kStorey + 0.02f, 0}, 1.8f, paints);
}

void addCar(const Placer& at, const StreetPaints& paints, int paint, float cabin) {
    at.put(chamferedBox({{-2, 0.28f, -0.85f}, {2, 0.88f, 0.85f}}, 0.07f), "car body", paint);
    const float front = -0.9f, back = cabin, low = 0.86f, high = 1.42f;
    const std::array<glm::vec3, 8> corners = {{{front, low, -0.8f},
                                               {back, low, -0.8f},
                                               {front + 0.55f, high, -0.66f},
                                               {back - 0.3f, high, -0.66f},
                                               {front, low, 0.8f},
                                               {back, low, 0.8f},
                                               {front + 0.55f, high, 0.66f},
                                               {back - 0.3f, high, 0.66f}}};
    Mesh top, panes;
    shapes::appendHexahedron(top, corners);
    at.put(std::move(top), "car cabin", paint);
    // Windows 4 mm before the cabin, less a rim.
    const int sides[4][4] = {{4, 5, 7, 6}, {1, 0, 2, 3}, {0, 4, 6, 2}, {5, 1, 3, 7}};
    for (const auto& side : sides) {
        glm::vec3 c[4], centre(0);
        for (int i = 0; i < 4; ++i) centre += 0.25f * (c[i] = corners[std::size_t(side[i])]);
        const glm::vec3 normal = glm::normalize(glm::cross(c[1] - c[0], c[3] - c[0]));
        std::vector<glm::vec3> pane;
        for (const glm::vec3& p : c) pane.push_back(glm::mix(p, centre, 0.12f) + 0.004f * normal);
        appendPolygon(panes, pane, normal);
    }
    at.put(std::move(panes), "car windows", paints.glass);
    for (const float x : {-1.25f, 1.3f})
        for (const float z : {-0.74f, 0.74f}) {
            const glm::mat4 place = translation({x, 0.31f, z}) *
                                    glm::rotate(glm::mat4(1), 0.5f * glm::pi<float>(), glm::vec3(1, 0, 0));
            at.put(torus(0.23f, 0.085f), "tyre", paints.rubber, place);
            at.put(cylinder(0.19f, -0.07f, 0.07f, 32, 1), "rim", paints.iron, place);
        }
    for (const float x : {-2.04f, 2.04f})
        at.put(chamferedBox({{x - 0.05f, 0.36f, -0.82f}, {x + 0.05f, 0.48f, 0.82f}}, 0.02f), "bumper",
               paints.rubber);
}

void addTree(const Placer& at, const StreetPaints& paints, float size, int count, std::uint32_t seed) {
    Mesh wood = cylinder(0.09f * size, 0, 2.2f * size, 20, 6);
    for (int i = 0; i < 9; ++i) {
        const float a = 6.2832f * randomAt(seed, i), tall = 1.6f + 0.7f * randomAt(seed, i, 1);
        const glm::vec3 foot(0, tall * size, 0),
            tip = size * glm::vec3(0.8f * std::cos(a), tall + 0.7f, 0.8f * std::sin(a));
        merge(wood, rod(foot, tip, 0.025f * size));
    }
    at.put(std::move(wood), "tree", paints.bark);
    at.put(leaves(size * glm::vec3(1.1f, 1.0f, 1.1f), count, 0.11f, seed), "crown", paints.leaf,
           {0, 2.7f * size, 0});
    Mesh grid;
    for (int i = 0; i < 9; ++i)
        merge(grid,
              box({{-0.5f, 0.002f, -0.5f + 0.12f * float(i)}, {0.5f, 0.014f, -0.46f + 0.12f * float(i)}}));
    at.put(std::move(grid), "tree grid", paints.iron);
}

void addStreetLamp(const Placer& at, const StreetPaints& paints) {
    at.put(turned({shapes::line({0, 0}, {0.14f, 0}), shapes::line({0.14f, 0}, {0.12f, 0.5f}, 3),
                   shapes::arc({0.05f, 0.5f}, {0.07f, 0.15f}, 0, 1.5708f, 6),
                   shapes::line({0.05f, 0.65f}, {0.035f, 3.3f}, 6),
                   shapes::line({0.035f, 3.3f}, {0.1f, 3.4f}), shapes::line({0.1f, 3.4f}, {0, 3.4f})},
                  28),
           "lamp post", paints.iron);
    for (int i = 0; i < 4; ++i) {
        const float a = 1.5708f * float(i);
        at.put(rod({0.09f * std::cos(a), 3.4f, 0.09f * std::sin(a)},
                   {0.17f * std::cos(a), 3.8f, 0.17f * std::sin(a)}, 0.01f),
               "lantern bar", paints.iron);
    }
    at.put(turned({shapes::line({0.24f, 3.8f}, {0.05f, 3.98f}, 3), shapes::line({0.05f, 3.98f}, {0, 4.05f})},
                  28),
           "lantern cap", paints.iron);
}

// Road and pavements: slabs along the kerb with joints, paving with grooves.
void addGround(const Placer& at, int road, int paving, int stone) {
    const auto slab = [&](Mesh mesh, const char* name, int material) {
        shapes::computeTangents(mesh);
        at.put(std::move(mesh), name, material);
    };
    slab(box({{-14, -0.4f, -9}, {14, 0, 9}}), "road", road);
    Mesh kerb;
    for (const float side : {-1.0f, 1.0f}) {
        const float inner = side * 2.45f, outer = side * (kFront + 0.4f);
        slab(box({{-14, 0.001f, std::min(inner, outer)}, {14, kPavement, std::max(inner, outer)}}),
             "pavement", paving);
        for (int i = 0; i < 29; ++i)
            merge(kerb,
                  chamferedBox({{-14 + 0.96f * float(i), 0.001f, side * 2.37f - 0.075f},
                                {-14 + 0.96f * float(i) + 0.952f, kPavement + 0.01f, side * 2.37f + 0.075f}},
                               0.012f));
    }
    at.put(std::move(kerb), "kerb", stone);
}

// Wires across the street; pennants, single sheets, hang from two of them.
void addWires(const Placer& at, int rubber, const int (&cloths)[2]) {
    for (int i = 0; i < 6; ++i) {
        const float x = -9 + 3.4f * float(i), y = 4.6f + 0.5f * randomAt(5, i);
        const glm::vec3 from(x, y, -kFront), to(x + 1.5f, y + 0.3f, kFront);
        const float sag = 0.5f + 0.2f * randomAt(6, i);
        at.put(wire(from, to, sag, 0.008f), "wire", rubber);
        if (i % 2 != 0) continue;
        for (int k = 1; k < 20; ++k) {
            const float t = float(k) / 20.0f;
            const glm::vec3 top = glm::mix(from, to, t) - glm::vec3(0, 4 * sag * t * (1 - t), 0);
            Mesh pennant;
            const float swing = 0.2f * (randomAt(9, i, k) - 0.5f);
            appendPolygon(pennant, {{0, 0, -0.11f}, {0, 0, 0.11f}, {swing, -0.32f, 0}}, {1, 0, 0});
            at.put(std::move(pennant), "pennant", cloths[k % 2], top);
        }
    }
}

// Two rows, and a house across the far end.
void addHouses(const Placer& ground, const StreetPaints& paints, const std::array<int, 4>& walls,
               const std::array<int, 2>& shutters, const std::array<int, 2>& awnings) {
    const auto [brick, ochre, rose, pale] = walls;
    const auto [green, blue] = shutters;
    const auto [red, cream] = awnings;
    const House north[] = {{-11, 5.2f, 2, 3, ochre, green, red},
                           {-5.8f, 4.4f, 3, 2, brick, blue, -1},
                           {-1.4f, 5.6f, 2, 3, rose, green, cream},
                           {4.2f, 4.6f, 3, 2, pale, blue, -1}};
    const House south[] = {{-11, 4.6f, 2, 2, pale, green, -1},
                           {-6.4f, 5.4f, 2, 3, brick, green, cream},
                           {-1.0f, 4.6f, 2, 2, ochre, blue, -1},
                           {3.6f, 5.2f, 2, 3, rose, blue, red}};
    for (const House& house : north)
        addHouse(ground.at(translation({house.x, kPavement, -kFront})), house, paints);
    for (const House& house : south)
        addHouse(
            ground.at(translation({house.x + house.width, kPavement, kFront}) * turnAboutY(glm::pi<float>())),
            house, paints);
    addHouse(ground.at(translation({-11.5f, 0, 2.6f}) * turnAboutY(0.5f * glm::pi<float>())),
             {30, 5.2f, 2, 3, pale, green, -1}, paints);
}

int grooved(Scene& scene, const char* name, textures::Surface surface, float metres, glm::vec3 colour) {
    const int material = textured(scene, name, std::move(surface.color), metres, colour);
    const int normals = add(scene, std::move(surface.normal));
    scene.materials[std::size_t(material)].normalTexture = repeat(normals, metres);
    return material;
}

}  // namespace

Scene buildStreet(const Values& values) {
    Scene scene;
    const Placer ground{scene};
    const int road = grooved(scene, "setts", textures::ashlar(512), 0.7f, {0.34f, 0.33f, 0.32f});
    const int paving = grooved(scene, "paving", textures::ashlar(512), 1.6f, {0.52f, 0.49f, 0.44f});
    const int brick = textured(scene, "brick", textures::ashlar(512).color, 0.5f, {0.52f, 0.27f, 0.20f});
    const int ochre = textured(scene, "ochre plaster", textures::plaster(256), 2.0f, {0.66f, 0.50f, 0.28f});
    const int rose = textured(scene, "rose plaster", textures::plaster(256), 2.0f, {0.62f, 0.42f, 0.36f});
    const int pale = textured(scene, "pale plaster", textures::plaster(256), 2.0f, {0.70f, 0.68f, 0.60f});
    const int green = add(scene, matte("green paint", {0.12f, 0.26f, 0.20f}));
    const int blue = add(scene, matte("blue paint", {0.16f, 0.26f, 0.40f}));
    const int red = add(scene, matte("red cloth", {0.56f, 0.12f, 0.09f}));
    const int cream = add(scene, matte("cream cloth", {0.72f, 0.66f, 0.52f}));
    const StreetPaints paints = {add(scene, matte("timber", {0.62f, 0.59f, 0.54f})),
                                 add(scene, glossy("window glass", {0.03f, 0.04f, 0.05f}, 0.12f)),
                                 add(scene, matte("stone", {0.56f, 0.54f, 0.50f})),
                                 add(scene, matte("iron", {0.06f, 0.06f, 0.065f})),
                                 add(scene, matte("roof tiles", {0.48f, 0.22f, 0.14f})),
                                 add(scene, matte("leaf", {0.18f, 0.33f, 0.09f})),
                                 add(scene, matte("bark", {0.24f, 0.18f, 0.13f})),
                                 add(scene, matte("rubber", {0.04f, 0.04f, 0.04f}))};
    addGround(ground, road, paving, paints.stone);
    addHouses(ground, paints, {brick, ochre, rose, pale}, {green, blue}, {red, cream});
    addCar(ground.at(translation({2.6f, 0, -1.45f})), paints,
           add(scene, glossy("blue lacquer", {0.08f, 0.16f, 0.34f}, 0.25f)), 1.5f);
    addCar(ground.at(translation({-4.2f, 0, 1.4f}) * turnAboutY(glm::pi<float>())), paints,
           add(scene, glossy("white lacquer", {0.66f, 0.66f, 0.64f}, 0.25f)), 1.9f);
    const int count = int(values["leaves"]);
    const glm::vec3 trees[] = {
        {-7.4f, 0.95f, -3.1f}, {0.2f, 1.05f, -3.15f}, {-2.2f, 0.9f, 3.2f}, {5.6f, 1.0f, 3.15f}};
    for (int i = 0; i < 4; ++i) {
        const float size = trees[i].y;
        addTree(ground.at(translation({trees[i].x, kPavement, trees[i].z}) * turnAboutY(float(i + 1))),
                paints, size, int(float(count) * size * size), std::uint32_t(41 + i));
    }
    for (const float x : {-5.0f, 3.9f}) addStreetLamp(ground.at(translation({x, kPavement, -2.75f})), paints);
    addStreetLamp(ground.at(translation({1.4f, kPavement, 2.75f})), paints);
    addWires(ground, paints.rubber, {red, cream});
    makeTwoSided(scene);
    scene.lights.push_back(
        sunLight("sun", {-0.42f, -0.80f, -0.42f}, float(values["sun"]) * glm::vec3(1.0f, 0.93f, 0.82f)));
    scene.sky = float(values["sky"]) * glm::vec3(0.56f, 0.76f, 1.0f);
    scene.cameras.push_back(camera("front", {8.2f, 1.75f, 1.3f}, {-3.0f, 1.95f, -1.3f}, 62));
    scene.cameras.push_back(camera("paving", {0.4f, 0.75f, 0.9f}, {-6.0f, 0.2f, -2.2f}, 58));
    scene.cameras.push_back(camera("windows", {-2.0f, 3.4f, 1.6f}, {-3.9f, 4.0f, -4.3f}, 60));
    return scene;
}

}  // namespace conelight::io::generated
