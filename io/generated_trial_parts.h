// SPDX-License-Identifier: MIT
// Parts that several trial scenes share: closed rooms, round meshes, spot lights. Internal to conelight_io.
#pragma once

#include "io/generated_scenes.h"

#include <string>
#include <vector>

namespace conelight::io::generated {

// Materials of the inner faces of a room.
struct RoomMaterials {
    int floor, ceiling, left, right, back, front;  // left is -x, back is -z
};

// A closed shell about `room`, its walls 0.2 m thick, with openings cut through them.
void addRoom(Scene& scene, const Aabb& room, const RoomMaterials& m, const std::vector<Aabb>& openings = {});
// Adds the walls' paint.
int white(Scene& scene);

Mesh sphere(float radius, int around = 48);
// A profile turned about y.
Mesh turned(const std::vector<shapes::Curve>& profile, int around);
// A ring of radius `major` and thickness `minor`, lying in the xz plane.
Mesh torus(float major, float minor);

Light spotLight(std::string name, glm::vec3 from, glm::vec3 to, float outerDeg, glm::vec3 intensity);

}  // namespace conelight::io::generated
