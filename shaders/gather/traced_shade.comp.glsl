#version 450 core
// SPDX-License-Identifier: MIT
// The picture of mode `traced` (gather/traced_shade.glsl) by a compute shader, for GPUs; or, with RECORD_STEPS, what it
// shows at one pixel, for the inspector.
#include "gather/traced_shade.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
#ifdef RECORD_STEPS
void main() { tracedShade(min(INVOCATION_PIXEL, textureSize(gbufferGeometry, 0) - 1)); }
#else
layout(rgba32f) writeonly uniform image2D result;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(pixel, imageSize(result)))) imageStore(result, pixel, tracedShade(pixel));
}
#endif
