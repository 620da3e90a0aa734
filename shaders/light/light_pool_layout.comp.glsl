#version 450 core
// SPDX-License-Identifier: MIT
// Slots of each listed cluster -> the place and the size of its pool: what many rows draw from has many faces. One group.
#include "shared/prefix_sum.h"
layout(local_size_x = PREFIX_GROUP) in;
#include "shared/irradiance.h"
#define PREFIX_TYPE uint
#define PREFIX_CHUNKS 0
#include "lib/prefix_sum.glsl"
uniform usamplerBuffer clusterList;
uniform usamplerBuffer rowList;
layout(std430) buffer LightTable { uint lightTable[]; };

const int kOfInvocation = LIGHT_CLUSTERS / PREFIX_GROUP;

void main() {
    // Of all entries each cluster gets the fewest, and its part of the rest rounded down.
    uint clusters = texelFetch(clusterList, 0).x;
    uint rest = LIGHT_POOL_ENTRIES - (clusters << LIGHT_LEAST_POOL_SHIFT);
    float perSlot = float(rest) / float(texelFetch(rowList, 0).x * lightTable[LIGHT_SLOT_COUNT_AT]);
    int first = int(gl_LocalInvocationIndex) * kOfInvocation;
    uint shifts[kOfInvocation];
    uint own = 0u;
    for (int i = 0; i < kOfInvocation; ++i) {
        uint slots = lightTable[LIGHT_CLUSTER_POOLS_AT + first + i];
        uint part = max(uint(float(slots) * perSlot), 1u);
        shifts[i] = clamp(uint(findMSB(part)), LIGHT_LEAST_POOL_SHIFT, LIGHT_MOST_POOL_SHIFT);
        own += uint(first + i) < clusters ? 1u << shifts[i] : 0u;
    }
    uint total;
    uint before = prefixBefore(own, total);
    for (int i = 0; i < kOfInvocation; ++i) {
        lightTable[LIGHT_CLUSTER_POOLS_AT + first + i] = before << 4 | shifts[i];
        before += uint(first + i) < clusters ? 1u << shifts[i] : 0u;
    }
}
