// SPDX-License-Identifier: MIT
// What the passes of the irradiance cache share that go over all faces.
#include "lib/dot.glsl"
#include "lib/linear_index.glsl"
#include "lib/voxel_grid.glsl"
#include "lib/voxel_record.glsl"
#include "light/cache_state.glsl"
#include "shared/prefix_sum.h"
layout(std140) uniform CacheBlock { CacheConstants cache; };
layout(std430) buffer StateTable { FaceCache states[]; };
