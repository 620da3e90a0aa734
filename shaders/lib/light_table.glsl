// SPDX-License-Identifier: MIT
// The light table (shared/scene.h), sorted by kind: number -> lightOfTable, lightOfTexels.
#include "lib/execution.glsl"
#include "lib/lighting.glsl"
#include "shared/scene.h"
uniform usamplerBuffer lightTexels;  // seven texels a light

Light lightOfTexels(uint number) {
    int at = 7 * int(number);
    uvec4 a = texelFetch(lightTexels, at), b = texelFetch(lightTexels, at + 1);
    uvec4 c = texelFetch(lightTexels, at + 2), d = texelFetch(lightTexels, at + 3);
    uvec4 e = texelFetch(lightTexels, at + 4), f = texelFetch(lightTexels, at + 5);
    uvec4 g = texelFetch(lightTexels, at + 6);
    return Light(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), int(b.w), uintBitsToFloat(c.xyz),
                 uintBitsToFloat(c.w), uintBitsToFloat(d.xyz), uintBitsToFloat(d.w), uintBitsToFloat(e.xyz),
                 uintBitsToFloat(e.w), uintBitsToFloat(f.xyz), f.w, uintBitsToFloat(g.x),
                 uintBitsToFloat(g.y), g.z, g.w);
}

// Of a number that lanes share: a software driver reads storage word by word and lane by lane.
#if EXECUTION_GPU
layout(std430) readonly buffer LightTable { Light lights[]; };
Light lightOfTable(uint number) { return lights[number]; }
#else
Light lightOfTable(uint number) { return lightOfTexels(number); }
#endif
vec3 lightPosition(uint number) { return lightOfTable(number).position; }
