// SPDX-License-Identifier: MIT
// The eye: camera and picture size, as `frame`.
#include "lib/flat_constants.glsl"
#include "shared/frame.h"
#if !FLAT_CONSTANTS
layout(std140) uniform FrameBlock { FrameConstants frame; };
#endif
