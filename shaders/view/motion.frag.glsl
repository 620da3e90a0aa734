#version 450 core
// SPDX-License-Identifier: MIT
// Fragments of what has moved -> where their surface was in the picture before, less where it is (world, m), where the
// G-buffer shows them. a: 1, or -1 where nobody knows.
#include "lib/dot.glsl"
#include "lib/frame_block.glsl"
#include "lib/gbuffer_pack.glsl"

layout(location = 0) in vec3 fromEye;
layout(location = 1) in vec3 moved;
layout(location = 2) flat in uvec2 instance;
uniform usampler2D gbufferGeometry;

layout(location = 0) out vec4 outMoved;

// Two rasterizations of a triangle snap its corners alike, but for rounding: then it lies less than this beside itself.
const float kSameDepth = 1e-3;

void main() {
    uvec4 geometry = texelFetch(gbufferGeometry, ivec2(gl_FragCoord.xy), 0);
    float depth = frame.parallel != 0.0 ? dot(fromEye, frame.viewForward) : 1.0 / gl_FragCoord.w;
    float shown = uintBitsToFloat(geometry.x);
    bool same = geometry.x != 0u && instanceOfWord(geometry.w) == instance.x &&
                abs(depth - shown) <= kSameDepth * abs(shown);
    if (!same) discard;
    outMoved = vec4(moved, instance.y != 0u ? -1.0 : 1.0);
}
