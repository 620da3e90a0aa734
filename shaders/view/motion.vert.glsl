#version 450 core
// SPDX-License-Identifier: MIT
// Vertices of what has moved -> clip space of the picture, and by how much they were elsewhere in the one before
// (view/motion.frag.glsl).
#include "lib/frame_block.glsl"
#include "lib/scene_tables.glsl"
#include "shared/gbuffer.h"
layout(std430) readonly buffer MotionTable { InstanceMotion motions[]; };
layout(std430) readonly buffer VerticesBefore { Vertex verticesBefore[]; };

layout(location = 0) in vec3 position;
layout(location = 5) in uint instanceIndex;

layout(location = 0) out vec3 outFromEye;         // world space
layout(location = 1) out vec3 outMoved;           // then less now
layout(location = 2) flat out uvec2 outInstance;  // its index, 1: where it was is not known

void main() {
    uint first = motions[instanceIndex].firstVertex;
    vec3 before = position;
    if (first < MOTION_UNKNOWN) {
        uint vertex = first + uint(gl_VertexID) - instances[instanceIndex].firstVertex;
        before = verticesBefore[vertex].position;
    }
    vec3 now = (instances[instanceIndex].worldFromObject * vec4(position, 1.0)).xyz;
    vec3 then = (motions[instanceIndex].worldFromObject * vec4(before, 1.0)).xyz;
    outFromEye = now - frame.eye;
    outMoved = then - now;
    outInstance = uvec2(instanceIndex, first == MOTION_UNKNOWN ? 1u : 0u);
    // Depths of a host's matrices are of many kinds; fragments compare the view depth.
    vec4 clip = frame.clipFromWorld * vec4(now, 1.0);
    gl_Position = vec4(clip.xy, 0.0, clip.w);
}
