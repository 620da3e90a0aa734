// SPDX-License-Identifier: MIT
// From where a scene is first seen, and the floor that it brings along.
#pragma once

#include "conelight/scene.h"

namespace conelight::scene {

// What a scene stands on when it has that itself: the largest level area near its lower end.
struct Floor {
    float height = 0;
    bool carries = false;  // half of the footprint and more lies on it
};
Floor floorOf(const Scene& scene, const Aabb& bounds);

// From the front, a little from the right and above; a single sheet from the side that it faces. All that rises above
// the floor just fills a square picture, or all there is where nothing does.
Camera frameShape(const Scene& scene, const Aabb& bounds, const Floor& floor);
// The same from another side.
Camera frameShape(const Scene& scene, const Aabb& bounds, const Floor& floor, const glm::vec3& side);

}  // namespace conelight::scene
