#version 450 core
// SPDX-License-Identifier: MIT
// Triangle -> the same triangle with the lines of its edges on the screen, so that each fragment knows how
// far it is from them (Baerentzen et al. 2006, "Single-pass Wireframe Rendering"). Lines are homogeneous:
// they hold as well where the triangle reaches behind the eye.
#include "lib/dot.glsl"
#include "lib/frame_block.glsl"

layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;
layout(location = 0) flat out vec3 edge0;  // dot with (x, y, 1): distance in pixels
layout(location = 1) flat out vec3 edge1;
layout(location = 2) flat out vec3 edge2;

// Pixel coordinates times w, and w.
vec3 onScreen(vec4 clip) { return vec3(0.5 * vec2(frame.width, frame.height) * (clip.xy + clip.w), clip.w); }

vec3 edgeLine(vec3 p, vec3 q) {
    vec3 line = cross(p, q);
    return line / max(length(line.xy), 1e-20);
}

void main() {
    vec3 p0 = onScreen(gl_in[0].gl_Position);
    vec3 p1 = onScreen(gl_in[1].gl_Position);
    vec3 p2 = onScreen(gl_in[2].gl_Position);
    for (int i = 0; i < 3; ++i) {
        edge0 = edgeLine(p0, p1);
        edge1 = edgeLine(p1, p2);
        edge2 = edgeLine(p2, p0);
        gl_Position = gl_in[i].gl_Position;
        EmitVertex();
    }
    EndPrimitive();
}
