#version 450 core
// SPDX-License-Identifier: MIT
// Vertices of the scene -> clip space, and what the G-buffer's fragments need (view/gbuffer.frag.glsl).
// What is constant over an instance is packed here once per vertex instead of once per fragment.
#ifndef TEXTURES
#error TEXTURES must be 0 (none), 1 (base colour) or 2 (all)
#endif
#include "lib/dot.glsl"
#include "lib/frame_block.glsl"
#include "lib/gbuffer_pack.glsl"
#include "lib/octahedral.glsl"
#include "lib/scene_tables.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in uint normalOct;
layout(location = 2) in vec2 uv;
layout(location = 3) in uint tangentOct;
layout(location = 4) in uint color;
layout(location = 5) in uint instanceIndex;

layout(location = 0) out vec3 outFromEye;  // world space
layout(location = 1) out vec3 outNormal;
layout(location = 2) out vec4 outBase;  // base colour and opacity
layout(location = 3) flat out uvec4 outConstant;
#if TEXTURES >= 1
layout(location = 4) out vec2 outUv;
#endif
#if TEXTURES >= 2
layout(location = 5) out vec4 outTangent;
#endif

void main() {
    mat4 worldFromObject = instances[instanceIndex].worldFromObject;
    vec3 world = (worldFromObject * vec4(position, 1.0)).xyz;
    gl_Position = frame.clipFromWorld * vec4(world, 1.0);
    // Relative to the eye, so that differences between neighbouring pixels keep their digits far from the
    // origin.
    outFromEye = world - frame.eye;

    vec3 n = octDecode(unpackSnorm2x16(normalOct));
    outNormal = normalize(instances[instanceIndex].normalColumn0.xyz * n.x +
                          instances[instanceIndex].normalColumn1.xyz * n.y +
                          instances[instanceIndex].normalColumn2.xyz * n.z);

    uint material = instances[instanceIndex].material;
    uint flags = materials[material].flags;
    outBase = materials[material].baseColor * vertexColor(color, instances[instanceIndex].flags);
    outConstant.x = packInstanceWord(instanceIndex, (flags & MATERIAL_UNLIT) != 0u);
    outConstant.y = packReflectance(materials[material].specularF0, materials[material].metallic);
    outConstant.z = material;
    outConstant.w = floatBitsToUint(materials[material].roughness);
#if TEXTURES >= 1
    outUv = uv;
#endif
#if TEXTURES >= 2
    // Tangents follow the surface (not its normals); the lowest bit holds the sign of the bitangent.
    vec3 t = octDecode(unpackSnorm2x16(tangentOct & ~(VERTEX_SOLID_BITS | 1u)));
    float handedness = (tangentOct & 1u) != 0u ? -1.0 : 1.0;
    if ((instances[instanceIndex].flags & INSTANCE_FLIPPED) != 0u) handedness = -handedness;
    outTangent = vec4(mat3(worldFromObject) * t, handedness);
#endif
}
