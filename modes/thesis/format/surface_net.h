// SPDX-License-Identifier: MIT
// A signed distance (negative inside) -> the triangles of its zero surface. Private to this room.
#pragma once

#include <functional>

#include "conelight/scene.h"

namespace conelight::thesis {

// `bounds` must hold the whole surface. Normals are means over the triangles of a vertex; uvs are 0.
Mesh surfaceNet(const std::function<float(const glm::vec3&)>& distance, const Aabb& bounds, float cell);

}  // namespace conelight::thesis
