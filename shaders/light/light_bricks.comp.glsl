#version 450 core
// SPDX-License-Identifier: MIT
// Flux of faces -> flux of runs of bricks, by the side to which faces look (lib/light_bricks.glsl). One invocation per run.
layout(local_size_x = 64) in;
#include "lib/linear_index.glsl"
#include "light/light_bricks.glsl"
layout(std430) writeonly buffer RunTable { float runs[]; };

void main() {
    uint run = linearIndex();
    if (run >= runCount()) return;
    ivec2 faces = facesOfRun(int(run));
    vec3 ahead = vec3(0.0), back = vec3(0.0);  // of sides 0, 2, 4 and 1, 3, 5
    while (faces.x < faces.y) {
        float sided = texelFetch(faceFluxes, faces.x++).x;
        uint side = sideOfFlux(sided);
        vec3 ofAxis = withoutSide(sided) * vec3(side >> 1 == 0u, side >> 1 == 1u, side >> 1 == 2u);
        ahead += (side & 1u) == 0u ? ofAxis : vec3(0.0);
        back += (side & 1u) == 0u ? vec3(0.0) : ofAxis;
    }
    runs[6u * run] = ahead.x;
    runs[6u * run + 1u] = back.x;
    runs[6u * run + 2u] = ahead.y;
    runs[6u * run + 3u] = back.y;
    runs[6u * run + 4u] = ahead.z;
    runs[6u * run + 5u] = back.z;
}
