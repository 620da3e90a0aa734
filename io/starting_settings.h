// SPDX-License-Identifier: MIT
// Settings that files of other programs start with, where they name none.
#pragma once

#include "conelight/scene.h"

namespace conelight::io {

// Longest edge in m from which a file's voxels lie in nested grids: the default of 128 are larger than 0.15 m there.
inline constexpr float kLargeScene = 20;

// image.exposure auto, for lights and emission of others are as bright as they like. voxels.levels 0 in a scene larger than
// kLargeScene: voxels of a street or a landscape are as small as those of a room, around the eye.
// `scene` is complete but for what completeScene adds.
void addStartingSettings(Scene& scene);

}  // namespace conelight::io
