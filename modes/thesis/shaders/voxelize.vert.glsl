#version 450 core
// SPDX-License-Identifier: MIT
// Vertices of the scene -> world space, for the thesis's voxelization (voxelize.geom.glsl).
#include "lib/dot.glsl"
#include "lib/octahedral.glsl"
#include "lib/scene_tables.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in uint normalOct;
layout(location = 2) in vec2 uv;
layout(location = 4) in uint color;
layout(location = 5) in uint instanceIndex;

layout(location = 0) out vec3 outPosition;
layout(location = 1) out vec3 outNormal;
layout(location = 2) out vec2 outUv;
layout(location = 3) flat out uint outColor;
layout(location = 4) flat out uint outMaterial;

void main() {
    outPosition = (instances[instanceIndex].worldFromObject * vec4(position, 1.0)).xyz;
    vec3 n = octDecode(unpackSnorm2x16(normalOct));
    outNormal = normalize(instances[instanceIndex].normalColumn0.xyz * n.x +
                          instances[instanceIndex].normalColumn1.xyz * n.y +
                          instances[instanceIndex].normalColumn2.xyz * n.z);
    outUv = uv;
    uint flags = instances[instanceIndex].flags;
    outColor = (flags & INSTANCE_WIDE_COLORS) == 0u ? color : packUnorm4x8(vertexColor(color, flags));
    outMaterial = instances[instanceIndex].material;
}
