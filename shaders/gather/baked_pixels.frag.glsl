#version 450 core
// SPDX-License-Identifier: MIT
// Baked irradiance / pi of the pixels whose G-buffer holds this very surface: the instance, at this depth, where it
// stands as it was baked.
#include "lib/gbuffer_pack.glsl"
#include "lib/scene_tables.glsl"
uniform usampler2D gbufferGeometry;

layout(location = 0) flat in uint instance;
layout(location = 1) in vec3 irradiance;
layout(location = 0) out vec4 result;

// Of the depth. Far above rounding, far below the distance of a surface from what is behind it.
const float kSameDepth = 1e-3;

void main() {
    uvec4 geometry = texelFetch(gbufferGeometry, ivec2(gl_FragCoord.xy), 0);
    float depth = 1.0 / gl_FragCoord.w;
    bool same = instanceOfWord(geometry.w) == instance &&
                abs(uintBitsToFloat(geometry.x) - depth) <= kSameDepth * depth;
    if (!same || (instances[instance].flags & INSTANCE_BAKED) == 0u) discard;
    // Below the largest half.
    result = vec4(min(irradiance, 65000.0), 1.0);
}
