// SPDX-License-Identifier: MIT
// What a view cannot see.
#pragma once

#include "scene/gpu_scene.h"

namespace conelight::scene {

// True when the box is outside one of the planes of clip space (no far plane: depth is reversed, far is 0), by more
// than rounding. `clipFromBox`: from the box's space.
bool isOutside(const glm::mat4& clipFromBox, const Aabb& box);

// For GpuScene::draw: the parts of meshes that such a view may see.
GpuScene::PartFilter partsWithin(const glm::mat4& clipFromWorld);

}  // namespace conelight::scene
