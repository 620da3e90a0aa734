// SPDX-License-Identifier: MIT
// Bodies made by code, each about one metre high on the plane y = 0: a robed figure with wings, a rabbit, a
// dragon. Smooth unions of round parts (a signed distance), turned into triangles by naive surface nets
// (Gibson 1998, "Constrained elastic surface nets"). Closed, the same bits every time. Private to this room.
#pragma once

#include "conelight/scene.h"

namespace conelight::thesis {

// `detail`: cells along a metre. 128 gives about 60,000 triangles for the figure.
Mesh statueMesh(int detail);
Mesh rabbitMesh(int detail);
Mesh dragonMesh(int detail);

}  // namespace conelight::thesis
