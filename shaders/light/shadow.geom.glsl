#version 450 core
// SPDX-License-Identifier: MIT
// Edges of the triangle for light/shadow.frag.glsl. Fetched and worked out there, at each texel, they cost
// three times as much (six maps of 512 x 512: 90 against 31 cpu-ms on llvmpipe). MASKED: passes on what the
// cut-off needs.
layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;
#include "lib/dot.glsl"
#include "light/shadow_view.glsl"

layout(location = 3) flat out vec3 edge[3];
layout(location = 6) flat out vec4 viewConstants;  // slopeUnit, middle: lib/flat_constants.glsl says why
#if MASKED
layout(location = 0) in vec2 uv[];
layout(location = 1) in float alpha[];
layout(location = 2) flat in uint material[];
layout(location = 0) out vec2 outUv;
layout(location = 1) out float outAlpha;
layout(location = 2) flat out uint outMaterial;
#endif

void main() {
    // Edge functions in homogeneous coordinates, which corners behind the light do not upset (Olano and Greer
    // 1997, "Triangle Scan Conversion using 2D Homogeneous Coordinates"): at (x, y) texels from the map's
    // middle, positive inside.
    vec3 corner[3];
    for (int i = 0; i < 3; ++i)
        corner[i] = vec3(gl_in[i].gl_Position.xy * shadowMap.halfSize, gl_in[i].gl_Position.w);
    vec3 edges[3];
    for (int i = 0; i < 3; ++i) edges[i] = cross(corner[i], corner[(i + 1) % 3]);
    float turn = dot(edges[0], corner[2]) < 0.0 ? -1.0 : 1.0;
    for (int i = 0; i < 3; ++i) {
        gl_Position = gl_in[i].gl_Position;
        for (int k = 0; k < 3; ++k) edge[k] = edges[k] * turn;
        viewConstants = vec4(shadowMap.slopeUnit, shadowMap.middle);
#if MASKED
        outUv = uv[i];
        outAlpha = alpha[i];
        outMaterial = material[i];
#endif
        EmitVertex();
    }
}
