// SPDX-License-Identifier: MIT
// The pixel of an invocation of a pass that may come in bands of rows (gl/picture_pass.h). Variants that record one pixel
// (lib/record_steps.glsl) have their own.
#include "lib/record_steps.glsl"
#ifdef RECORD_STEPS
ivec2 passPixel() { return INVOCATION_PIXEL; }
#else
layout(std140) uniform FirstRowBlock { uint firstRow; };
ivec2 passPixel() { return ivec2(gl_GlobalInvocationID.x, gl_GlobalInvocationID.y + firstRow); }
#endif
