// SPDX-License-Identifier: MIT
// builtin:plain: a room of 8 m with a lamp, a table and an open door on a square plain with houses. What becomes of a
// room where the scene about it grows.
#include "io/generated_scenes.h"

namespace conelight::io::generated {
namespace {

constexpr float kLeastWithHouses = 60;  // m: nearer ones would stand in the room

void addRoomOfBoards(Scene& scene) {
    const int white = add(scene, matte("white", glm::vec3(0.7f))),
              red = add(scene, matte("red", {0.6f, 0.1f, 0.1f}));
    const auto board = [&](const char* name, glm::vec3 low, glm::vec3 high, int material) {
        addPart(scene, box({low, high}), name, material);
    };
    board("floor", {-4.2f, -0.3f, -4.2f}, {4.2f, 0, 4.2f}, white);
    board("ceiling", {-4.2f, 3, -4.2f}, {4.2f, 3.3f, 4.2f}, white);
    board("left wall", {-4.2f, 0, -4.2f}, {-4, 3, 4.2f}, red);
    board("wall before the door", {4, 0, -4.2f}, {4.2f, 3, 2}, white);
    board("wall behind the door", {4, 0, 3}, {4.2f, 3, 4.2f}, white);
    board("lintel", {4, 2.1f, 2}, {4.2f, 3, 3}, white);
    board("back wall", {-4, 0, -4.2f}, {4, 3, -4}, white);
    board("front wall", {-4, 0, 4}, {4, 3, 4.2f}, white);
    board("chest", {-1, 0, -2}, {0.5f, 1.2f, -1}, white);
    Material lamp = matte("lamp", glm::vec3(0.7f));
    lamp.emission = glm::vec3(12);
    addPart(scene, quad({-0.6f, 2.95f, -1}, {1.2f, 0, 0}, {0, 0, 1.2f}), "lamp", add(scene, std::move(lamp)));
}

// Five rows of five with the room in the middle of the third.
void addPlain(Scene& scene, float edge) {
    const int earth = add(scene, matte("earth", {0.3f, 0.3f, 0.2f}));
    addPart(scene, quad({-0.5f * edge, -0.1f, 0.5f * edge}, {edge, 0, 0}, {0, 0, -edge}), "plain", earth);
    if (edge < kLeastWithHouses) return;
    const int brick = add(scene, matte("brick", {0.5f, 0.25f, 0.18f}));
    const int house = add(scene, box({{-4, -0.1f, -4.5f}, {4, 6, 4.5f}}));
    scene.meshes[static_cast<std::size_t>(house)].name = "house";
    for (int row = -2; row <= 2; ++row)
        for (int column = -2; column <= 2; ++column)
            if (row != 0 || column != 0)
                place(scene, house, brick, "house",
                      translation({0.2f * edge * float(column), 0, 0.2f * edge * float(row)}));
}

}  // namespace

Scene buildPlain(const Values& values) {
    Scene scene;
    addRoomOfBoards(scene);
    const auto edge = static_cast<float>(values["size"]);
    if (edge > 0) addPlain(scene, edge);
    scene.cameras.push_back(camera("room", {-2.2f, 1.7f, 3.4f}, {1.2f, 1.1f, -2.5f}, 63));
    scene.cameras.push_back(camera("door", {0.5f, 1.6f, -1.5f}, {4, 1.4f, 2.5f}, 63));
    scene.settings.emplace_back("voxels.levels", "0");
    return scene;
}

}  // namespace conelight::io::generated
