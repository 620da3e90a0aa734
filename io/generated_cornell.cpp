// SPDX-License-Identifier: MIT
// The boxes that measurements are made in: two Cornell boxes (after Goral, Torrance, Greenberg, Battaile,
// "Modeling the Interaction of Light Between Diffuse Surfaces", 1984, and the measured box of the Cornell
// Program of Computer Graphics), the furnace, and a grid of spheres. Values -> Scene.
//
// Both Cornell rooms are the cube [-0.5,0.5] x [0,1] x [-0.5,0.5] metres: the measured box (0.55 m) scaled to
// 1 m.
#include "io/generated_scenes.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace conelight::io::generated {
namespace {

// Rounded from the measured spectra of the original box.
constexpr glm::vec3 kWhite{0.73f, 0.72f, 0.69f};
constexpr glm::vec3 kRed{0.60f, 0.06f, 0.05f};
constexpr glm::vec3 kGreen{0.13f, 0.42f, 0.10f};

struct CornellMaterials {
    int white, red, green;
};

CornellMaterials addCornellMaterials(Scene& scene) {
    return {add(scene, matte("white", kWhite)), add(scene, matte("red", kRed)),
            add(scene, matte("green", kGreen))};
}

// Floor, back and side walls, seen from inside.
void addCornellWalls(Scene& scene, const CornellMaterials& m) {
    addPart(scene, quad({-0.5f, 0, 0.5f}, {1, 0, 0}, {0, 0, -1}), "floor", m.white);
    addPart(scene, quad({-0.5f, 0, -0.5f}, {1, 0, 0}, {0, 1, 0}), "back wall", m.white);
    addPart(scene, quad({-0.5f, 0, 0.5f}, {0, 0, -1}, {0, 1, 0}), "left wall", m.red);
    addPart(scene, quad({0.5f, 0, -0.5f}, {0, 0, 1}, {0, 1, 0}), "right wall", m.green);
}

// The two turned blocks: footprints, angles and places of the original, scaled by 1 / 0.555.
void addCornellBlocks(Scene& scene, int material) {
    auto addBlock = [&](const char* name, glm::vec3 place, float height, float angleDeg) {
        const float half = 0.1485f;
        Instance& block = addPart(scene, box({{-half, 0, -half}, {half, height, half}}), name, material);
        block.worldFromObject = translation(place) * turnAboutY(glm::radians(angleDeg));
    };
    addBlock("tall block", {-0.166f, 0, -0.129f}, 0.6f, 17.2f);
    addBlock("short block", {0.164f, 0, 0.199f}, 0.3f, -17.0f);
}

// A third block, which is meant to be moved along the white wall behind it: 1.5 cm before it, it colours the wall, and
// hides light from it.
void addMovingBlock(Scene& scene, int material, float x) {
    constexpr float kHalf = 0.075f, kHeight = 0.55f;
    Instance& block =
        addPart(scene, box({{-kHalf, 0, -kHalf}, {kHalf, kHeight, kHalf}}), "moving block", material);
    block.worldFromObject = translation({x, 0, -0.5f + 0.015f + kHalf});
    block.dynamic = true;
}

}  // namespace

Scene buildCornell(const Values& values) {
    Scene scene;
    const CornellMaterials m = addCornellMaterials(scene);
    addCornellWalls(scene, m);

    // The lamp fills a hole of the ceiling: flush, so that it shares no voxel-thin layer with the ceiling.
    const glm::vec2 lo(0.383f, 0.405f), hi(0.617f, 0.595f);  // 0.234 m x 0.19 m, as in the original
    const glm::vec3 corner(-0.5f, 1, -0.5f);
    Mesh ceiling;
    shapes::appendFrame(ceiling, corner, {1, 0, 0}, {0, 0, 1}, lo, hi);
    addPart(scene, std::move(ceiling), "ceiling", m.white);
    const int lamp = add(scene, emitter("lamp", float(values["emission"]) * glm::vec3(1.0f, 0.78f, 0.48f)));
    addPart(scene, quad(corner + glm::vec3(lo.x, 0, lo.y), {hi.x - lo.x, 0, 0}, {0, 0, hi.y - lo.y}), "lamp",
            lamp);

    addCornellBlocks(scene, m.white);
    if (values["block"] > 0) addMovingBlock(scene, m.red, float(values["block_x"]));
    // Distance from which the open front fills a square picture at the original's field of view.
    // Less than a tenth of a pixel off the axis: on it, edges of the room run through the middles of all
    // pixels on the diagonals, and rounding decides which wall a renderer sees there.
    scene.cameras.push_back(camera("front", {6e-4f, 0.5002f, 1.94f}, {6e-4f, 0.5002f, 0}, 39.3f));
    return scene;
}

Scene buildCornellPoint(const Values& values) {
    Scene scene;
    const CornellMaterials m = addCornellMaterials(scene);
    addCornellWalls(scene, m);
    addPart(scene, quad({-0.5f, 1, -0.5f}, {1, 0, 0}, {0, 0, 1}), "ceiling", m.white);
    addPart(scene, quad({0.5f, 0, 0.5f}, {-1, 0, 0}, {0, 1, 0}), "front wall", m.white);
    addCornellBlocks(scene, m.white);
    scene.lights.push_back(
        pointLight("lamp", {0, 0.9f, 0}, float(values["intensity"]) * glm::vec3(1.0f, 0.85f, 0.65f)));
    // Inside, 1 cm before the front wall; wide enough to see both blocks and the lit ceiling.
    scene.cameras.push_back(camera("front", {0, 0.58f, 0.49f}, {0, 0.46f, -0.5f}, 82));
    return scene;
}

Scene buildFurnace(const Values& values) {
    Scene scene;
    Material wall = matte("wall", glm::vec3(float(values["albedo"])));
    wall.emission = glm::vec3(float(values["emission"]));
    addPart(scene, box({{-0.5f, 0, -0.5f}, {0.5f, 1, 0.5f}}, true), "walls", add(scene, std::move(wall)));
    scene.cameras.push_back(camera("inside", {0.2f, 0.45f, 0.4f}, {-0.1f, 0.5f, -0.5f}, 60));
    return scene;
}

Scene buildSpheres(const Values& values) {
    Scene scene;
    const int rows = int(values["rows"]);
    const int columns = int(values["columns"]);
    constexpr float kRadius = 0.22f;
    constexpr float kSpacing = 0.6f;
    constexpr float kHeight = 2.4f;
    const float halfWidth = 0.5f * kSpacing * float(columns) + 0.7f;
    const float depth = kSpacing * float(rows) + 3.6f;  // room for the camera in front of the grid
    const float back = -0.5f * kSpacing * float(rows) - 0.6f;

    // A closed room. Its side walls differ, so that the mirror images tell left from right.
    const int white = add(scene, matte("white", {0.73f, 0.72f, 0.70f}));
    const int left = add(scene, matte("left wall", {0.62f, 0.25f, 0.08f}));
    const int right = add(scene, matte("right wall", {0.10f, 0.30f, 0.55f}));
    const int floor = add(scene, glossy("floor", {0.35f, 0.34f, 0.33f}, 0.6f));
    const glm::vec3 x(2 * halfWidth, 0, 0), y(0, kHeight, 0), z(0, 0, depth);
    const glm::vec3 corner(-halfWidth, 0, back);
    addPart(scene, quad(corner + z, x, -z), "floor", floor);
    addPart(scene, quad(corner, x, y), "back wall", white);
    addPart(scene, quad(corner + x + z, -x, y), "front wall", white);
    addPart(scene, quad(corner + z, -z, y), "left wall", left);
    addPart(scene, quad(corner + x, z, y), "right wall", right);
    const glm::vec2 lo(0.3f, 0.25f), hi(0.7f, 0.5f);
    Mesh ceiling;
    shapes::appendFrame(ceiling, corner + y, x, z, lo, hi);
    addPart(scene, std::move(ceiling), "ceiling", white);
    const int lamp = add(scene, emitter("lamp", float(values["emission"]) * glm::vec3(1.0f, 0.93f, 0.82f)));
    addPart(scene, quad(corner + y + x * lo.x + z * lo.y, x * (hi.x - lo.x), z * (hi.y - lo.y)), "lamp",
            lamp);

    // Roughness grows to the right, metalness to the back: from painted to gold.
    Mesh ball;
    ball.name = "sphere";
    shapes::appendPatch(ball, shapes::uvSphere(glm::vec3(0), glm::vec3(kRadius), 48, 24));
    const int mesh = add(scene, std::move(ball));
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const float metallic = rows > 1 ? float(row) / float(rows - 1) : 0.0f;
            const float roughness = columns > 1 ? 0.05f + 0.95f * float(column) / float(columns - 1) : 0.3f;
            const std::string name = fmt::format("metallic {:.2f} roughness {:.2f}", metallic, roughness);
            Material m = glossy(
                name, glm::mix(glm::vec3(0.55f, 0.06f, 0.05f), glm::vec3(0.95f, 0.70f, 0.33f), metallic),
                roughness);
            m.metallic = metallic;
            place(scene, mesh, add(scene, std::move(m)), name,
                  translation({kSpacing * (float(column) - 0.5f * float(columns - 1)), kRadius,
                               kSpacing * (0.5f * float(rows - 1) - float(row))}));
        }
    // Far enough for the columns to fit, held inside of the room.
    const float wanted = 0.5f * kSpacing * float(rows) + 0.55f * kSpacing * float(columns) + 0.5f;
    const float front = std::min(wanted, back + depth - 0.1f);
    scene.cameras.push_back(camera("front", {0, 1.35f, front}, {0, 0.2f, 0}, 45));
    return scene;
}

}  // namespace conelight::io::generated
