// SPDX-License-Identifier: MIT
// builtin:lamps: huts and crates on an open ground, with any number of lamps. What lamps cost, and whether their
// light keeps to its side of a wall, where there are more than can be asked one by one.
//
// One plot of 8 m takes four lamps, one of them in its hut. Plots come in rings about the middle: with more lamps the
// camera sees the same ones near by, and more behind.
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "io/generated_furnished.h"
#include "io/generated_scenes.h"

namespace conelight::io::generated {
namespace {

constexpr int kLampsOfPlot = 4;
constexpr float kPlot = 8;        // m, edge
constexpr float kLeastEdge = 72;  // m, of the ground: the camera of the lane looks down a little

// Number `i` of the plots about the middle, ring by ring.
glm::ivec2 plotAt(int i) {
    int ring = 0;
    while ((2 * ring + 1) * (2 * ring + 1) <= i) ++ring;
    if (ring == 0) return {0, 0};
    const int along = i - (2 * ring - 1) * (2 * ring - 1), side = along / (2 * ring), at = along % (2 * ring);
    const glm::ivec2 corner[] = {{-ring, -ring}, {ring, -ring}, {ring, ring}, {-ring, ring}};
    const glm::ivec2 step[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    return corner[side] + at * step[side];
}

// A hut of boards with a door to +x and a window to +z, 4 m by 3.4 m.
Mesh hutMesh() {
    Mesh mesh;
    mesh.name = "hut";
    const auto board = [&](glm::vec3 low, glm::vec3 high) { shapes::appendBox(mesh, {low, high}); };
    board({-2, 0, -1.7f}, {-1.85f, 2.6f, 1.7f});
    board({-1.85f, 0, -1.7f}, {1.85f, 2.6f, -1.55f});
    board({1.85f, 0, -1.7f}, {2, 2.6f, -0.5f});
    board({1.85f, 0, 0.6f}, {2, 2.6f, 1.7f});
    board({1.85f, 2.1f, -0.5f}, {2, 2.6f, 0.6f});
    board({-1.85f, 0, 1.55f}, {1.85f, 0.9f, 1.7f});
    board({-1.85f, 0.9f, 1.55f}, {-0.7f, 2, 1.7f});
    board({0.7f, 0.9f, 1.55f}, {1.85f, 2, 1.7f});
    board({-1.85f, 2, 1.55f}, {1.85f, 2.6f, 1.7f});
    board({-2.2f, 2.6f, -1.9f}, {2.2f, 2.8f, 1.9f});
    return mesh;
}

struct LampParts {
    int hut, crate;
    int hutPaint[4], wood[3];
};

glm::vec3 colourOf(int number) {
    constexpr glm::vec3 kColours[] = {
        {1, 0.72f, 0.42f}, {1, 0.82f, 0.6f}, {1, 0.6f, 0.3f}, {0.75f, 0.88f, 1}, {1, 0.45f, 0.35f}};
    return kColours[std::min(static_cast<int>(5 * randomAt(3, number)), 4)];
}

void addPlot(Scene& scene, const LampParts& parts, int plot, int lamps) {
    const glm::ivec2 cell = plotAt(plot);
    const glm::mat4 at =
        translation({kPlot * static_cast<float>(cell.x), 0, kPlot * static_cast<float>(cell.y)}) *
        turnAboutY(0.5f * glm::pi<float>() * std::floor(4 * randomAt(1, plot)));
    const int paint = std::min(static_cast<int>(4 * randomAt(1, plot, 1)), 3);
    place(scene, parts.hut, parts.hutPaint[paint], "hut", at * translation({-1.2f, 0, -1.6f}));
    for (int i = 0; i < 3; ++i) {
        const float edge = 0.4f + 0.6f * randomAt(2, plot, 8 * i);
        const glm::vec3 where(-3 + 6 * randomAt(2, plot, 8 * i + 1), 0.5f * edge,
                              1.2f + 2.2f * randomAt(2, plot, 8 * i + 2));
        place(scene, parts.crate, parts.wood[i], "crate",
              at * translation(where) * turnAboutY(3 * randomAt(2, plot, 8 * i + 3)) *
                  glm::mat4(glm::mat3(edge)));
    }
    constexpr glm::vec3 kPlaces[kLampsOfPlot] = {
        {2.6f, 2.4f, 1.5f}, {-2.8f, 2.8f, 2.6f}, {-1.2f, 2.1f, -1.6f}, {2.4f, 3.2f, -2.4f}};
    for (int i = 0; i < lamps; ++i) {
        const int number = kLampsOfPlot * plot + i;
        const bool inside = i == 2;
        const glm::vec3 aside(randomAt(4, number) - 0.5f, 0.6f * randomAt(4, number, 1) - 0.3f,
                              randomAt(4, number, 2) - 0.5f);
        const glm::vec3 where = kPlaces[i] + (inside ? 0.5f : 1.0f) * aside;
        const float strength = (inside ? 1.5f : 2.5f) * (0.4f + 1.2f * randomAt(5, number));
        scene.lights.push_back(pointLight("lamp " + std::to_string(number + 1),
                                          glm::vec3(at * glm::vec4(where, 1)), strength * colourOf(number)));
    }
}

}  // namespace

Scene buildLamps(const Values& values) {
    const int count = static_cast<int>(values["count"]);
    Scene scene;
    LampParts parts{};
    parts.hut = add(scene, hutMesh());
    parts.crate = add(scene, box({glm::vec3(-0.5f), glm::vec3(0.5f)}));
    scene.meshes.back().name = "crate";
    constexpr glm::vec3 kPaints[] = {
        {0.7f, 0.68f, 0.62f}, {0.55f, 0.25f, 0.2f}, {0.3f, 0.42f, 0.5f}, {0.62f, 0.55f, 0.3f}};
    for (int i = 0; i < 4; ++i)
        parts.hutPaint[i] = add(scene, matte("paint " + std::to_string(i + 1), kPaints[i]));
    constexpr glm::vec3 kWoods[] = {{0.5f, 0.36f, 0.2f}, {0.6f, 0.5f, 0.36f}, {0.35f, 0.3f, 0.28f}};
    for (int i = 0; i < 3; ++i)
        parts.wood[i] = add(scene, glossy("wood " + std::to_string(i + 1), kWoods[i], 0.45f));

    const int plots = std::max((count + kLampsOfPlot - 1) / kLampsOfPlot, 1);
    int rings = 0;
    while ((2 * rings + 1) * (2 * rings + 1) < plots) ++rings;
    const float edge = std::max(kPlot * static_cast<float>(2 * rings + 1) + 4, kLeastEdge);
    addPart(scene, quad({-0.5f * edge, 0, 0.5f * edge}, {edge, 0, 0}, {0, 0, -edge}), "ground",
            add(scene, matte("ground", glm::vec3(0.4f, 0.38f, 0.34f))));
    for (int plot = 0; plot < plots; ++plot)
        addPlot(scene, parts, plot, std::clamp(count - kLampsOfPlot * plot, 0, kLampsOfPlot));

    scene.cameras.push_back(camera("lane", {3.9f, 1.7f, 4.1f}, {-6, 1.2f, -6.5f}, 60));
    scene.cameras.push_back(camera("above", {0, 14, 0.3f * edge + 6}, {0, 0, -0.05f * edge}, 50));
    const glm::mat4 turned = turnAboutY(0.5f * glm::pi<float>() * std::floor(4 * randomAt(1, 0)));
    scene.cameras.push_back(camera("hut", glm::vec3(turned * glm::vec4(-2.8f, 1.5f, -0.4f, 1)),
                                   glm::vec3(turned * glm::vec4(1.2f, 1, -1.9f, 1)), 70));
    scene.settings.emplace_back("voxels.levels", "0");
    return scene;
}

}  // namespace conelight::io::generated
