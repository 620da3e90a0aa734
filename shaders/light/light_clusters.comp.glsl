#version 450 core
// SPDX-License-Identifier: MIT
// Flux of runs -> the clusters that send light: their number, then each, with places and flux; the flux of all; and the
// list of the rows that light samples will be drawn from. One group.
#include "shared/prefix_sum.h"
layout(local_size_x = PREFIX_GROUP) in;
#include "lib/light_cells.glsl"
#include "light/light_bricks.glsl"
#define PREFIX_TYPE vec3
#define PREFIX_CHUNKS 0
layout(std140) uniform CacheBlock { CacheConstants cache; };
#include "lib/prefix_sum.glsl"
uniform samplerBuffer runFluxes;
uniform usamplerBuffer cellMarks;
layout(std430) writeonly buffer ClusterList { uint clusterList[]; };
layout(std430) writeonly buffer ClusterPlaces { vec4 clusterPlaces[]; };
layout(std430) writeonly buffer RowList { uint rowList[]; };
layout(std430) writeonly buffer LightTable { uint lightTable[]; };

const int kOfInvocation = LIGHT_CLUSTERS / PREFIX_GROUP;

uvec3 marksAt(int place) {
    return uvec3(texelFetch(cellMarks, place).x, texelFetch(cellMarks, place + 1).x,
                 texelFetch(cellMarks, place + 2).x);
}
bool isMarked(int row) { return texelFetch(cellMarks, 3 * row).x != 0u; }

float fluxOfCluster(int cluster) {
    ivec3 block = cubeOfRow(cluster);
    int level = levelOfRow(cluster);
#if NESTED_GRIDS
    if (level > coarsestLevel()) return 0.0;
#endif
    int edge = 1 << blockShift();
    int side = sideOfRow(cluster);
    float sum = 0.0;
    for (int z = 0; z < edge; ++z)
        for (int y = 0; y < edge; ++y) {
            int run = runOfBlock(block, level, ivec2(y, z));
            float flux = texelFetch(runFluxes, 6 * max(run, 0) + side).x;
            sum += run >= 0 ? flux : 0.0;
        }
    return sum;
}

// Slots of each of so many rows, a power of two.
uint slotsFor(uint rows) {
    uint slots = LIGHT_MOST_SLOTS;
    while (rows * slots > LIGHT_ROOM * LIGHT_MOST_SLOTS) slots /= 2u;
    return slots;
}

void main() {
    int first = int(gl_LocalInvocationIndex) * kOfInvocation;
    float fluxes[kOfInvocation];
    vec3 own = vec3(0.0);  // clusters, rows, flux
    for (int i = 0; i < kOfInvocation; ++i) {
        fluxes[i] = fluxOfCluster(first + i);
        own += vec3(fluxes[i] > 0.0, isMarked(first + i), fluxes[i]);
    }
    vec3 total;
    vec3 before = prefixBefore(own, total);
    uint cluster = uint(before.x), row = uint(before.y);
    for (int i = 0; i < kOfInvocation; ++i) {
        if (fluxes[i] > 0.0) {
            uvec3 bits = marksAt(LIGHT_CLUSTER_MARKS_AT + 3 * (first + i));
            uint extents = packExtents(bits.x != 0u ? bits : uvec3(0xffffffffu));
            lightTable[LIGHT_CLUSTER_EXTENTS_AT + first + i] = extents;
            LightBounds box = lightBounds(clusterOfRow(first + i), extents);
            clusterPlaces[2u * cluster] = vec4(box.middle, fluxes[i]);
            clusterPlaces[2u * cluster + 1u] = vec4(box.extent, 0.0);
            clusterList[1u + cluster++] = uint(first + i);
        }
        if (isMarked(first + i)) {
            rowList[2u + row++] = uint(first + i);
            lightTable[LIGHT_CELL_EXTENTS_AT + first + i] = packExtents(marksAt(3 * (first + i)));
        }
        lightTable[LIGHT_SCALES_AT + first + i] = 0u;
        lightTable[LIGHT_CLUSTER_POOLS_AT + first + i] = 0u;  // slots so far
        lightTable[LIGHT_PLACES_AT + first + i] = LIGHT_PLACE_OF_ALL;
    }
    if (gl_LocalInvocationIndex != 0u) return;
    clusterList[0] = uint(total.x);
    // The row of all is the first.
    rowList[0] = 1u + uint(total.y);
    rowList[1] = uint(LIGHT_ROW_OF_ALL);
    lightTable[LIGHT_INVERSE_FLUX_AT] = floatBitsToUint(total.z > 0.0 ? 1.0 / total.z : 0.0);
    lightTable[LIGHT_SHIFT_AT] = cellShift(cache.update, cache.seed);
    lightTable[LIGHT_SLOT_COUNT_AT] = slotsFor(1u + uint(total.y));
    lightTable[LIGHT_SCALES_AT + LIGHT_ROW_OF_ALL] = 0u;
    lightTable[LIGHT_PLACES_AT + LIGHT_ROW_OF_ALL] = LIGHT_PLACE_OF_ALL;
}
