#version 450 core
// SPDX-License-Identifier: MIT
// Triangle -> the same triangle, smaller about its middle, with all that its corners carry. Between the
// G-buffer's vertex and fragment shaders (view/gbuffer.vert.glsl, .frag.glsl).
#ifndef TEXTURES
#error TEXTURES must be 0 (none), 1 (base colour) or 2 (all)
#endif
#include "lib/frame_block.glsl"
#include "shared/gbuffer.h"
layout(std140) uniform ShrinkBlock { ShrinkConstants shrink; };

layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;

layout(location = 0) in vec3 cornerFromEye[];
layout(location = 1) in vec3 cornerNormal[];
layout(location = 2) in vec4 cornerBase[];
layout(location = 3) flat in uvec4 cornerConstant[];
layout(location = 0) out vec3 outFromEye;
layout(location = 1) out vec3 outNormal;
layout(location = 2) out vec4 outBase;
layout(location = 3) flat out uvec4 outConstant;
#if TEXTURES >= 1
layout(location = 4) in vec2 cornerUv[];
layout(location = 4) out vec2 outUv;
#endif
#if TEXTURES >= 2
layout(location = 5) in vec4 cornerTangent[];
layout(location = 5) out vec4 outTangent;
#endif

void main() {
    vec3 middle = (cornerFromEye[0] + cornerFromEye[1] + cornerFromEye[2]) / 3.0;
    for (int i = 0; i < 3; ++i) {
        outFromEye = mix(middle, cornerFromEye[i], shrink.kept);
        outNormal = cornerNormal[i];
        outBase = cornerBase[i];
        outConstant = cornerConstant[i];
#if TEXTURES >= 1
        outUv = cornerUv[i];
#endif
#if TEXTURES >= 2
        outTangent = cornerTangent[i];
#endif
        gl_Position = frame.clipFromWorld * vec4(frame.eye + outFromEye, 1.0);
        EmitVertex();
    }
    EndPrimitive();
}
