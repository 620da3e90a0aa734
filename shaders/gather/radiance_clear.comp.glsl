#version 450 core
// SPDX-License-Identifier: MIT
// Zero in every texel of a level of the radiance volume. For GPUs: those with few raster units clear 3D textures slowly
// (docs/notes/2026-11-26-a-first-gpu.md).
layout(local_size_x = 8, local_size_y = 4, local_size_z = 4) in;
layout(rgba16f) writeonly uniform image3D level;

void main() {
    ivec3 texel = ivec3(gl_GlobalInvocationID);
    if (all(lessThan(texel, imageSize(level)))) imageStore(level, texel, vec4(0.0));
}
