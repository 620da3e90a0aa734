#version 450 core
// SPDX-License-Identifier: MIT
// Draws the slots of each listed row from the clusters that send light, by what they bring to its cell were nothing in
// between, and those of the row of all by flux (lib/light_cells.glsl). Counts the slots of each cluster. One
// invocation per row: lists of clusters are short.
layout(local_size_x = 64) in;
#include "lib/light_cells.glsl"
#include "lib/linear_index.glsl"
layout(std140) uniform CacheBlock { CacheConstants cache; };
uniform usamplerBuffer clusterList;
uniform samplerBuffer clusterPlaces;
uniform usamplerBuffer rowList;
layout(std430) buffer LightTable { uint lightTable[]; };

// The gain of a listed cluster, and its flux.
vec2 gainAndFlux(LightBounds cell, int place) {
    vec4 middle = texelFetch(clusterPlaces, 2 * place);
    vec3 extent = texelFetch(clusterPlaces, 2 * place + 1).xyz;
    int row = int(texelFetch(clusterList, 1 + place).x);
    LightBounds cluster = LightBounds(middle.xyz, extent, axisOfSide(sideOfRow(row)), voxelAreaOfRow(row));
    return vec2(lightGain(cell, cluster), middle.w);
}

void main() {
    uint index = linearIndex();
    int count = int(texelFetch(clusterList, 0).x);
    if (count == 0 || index >= texelFetch(rowList, 0).x) return;
    int row = int(texelFetch(rowList, int(1u + index)).x);
    int known = min(row, LIGHT_CLUSTERS - 1);
    LightBounds cell = lightBounds(cellOfRow(known, cellShift(cache.update, cache.seed)),
                                   lightTable[LIGHT_CELL_EXTENTS_AT + known]);

    // Add up gains
    float total = 0.0, flux = 0.0;
    int i = 0;
    do {
        vec2 one = gainAndFlux(cell, i);
        total += one.x * one.y;
        flux += one.y;
    } while (++i < count);
    bool ofAll = row == LIGHT_ROW_OF_ALL || total == 0.0;
    float scale = ofAll ? 0.0 : (1.0 - kByFluxAlone) * flux / total;
    lightTable[LIGHT_SCALES_AT + row] = floatBitsToUint(scale);
    lightTable[LIGHT_PLACES_AT + row] = index;

    // Draw evenly spaced slots
    uint state = drawSeed(uint(row), cache.update, cache.draw, cache.seed);
    uint slots = lightTable[LIGHT_SLOT_COUNT_AT];
    float step = flux / float(slots);
    float wanted = randomNext(state) * step;
    uint slot = 0u;
    float sum = 0.0;
    uint word = 0u;
    i = 0;
    do {
        vec2 one = gainAndFlux(cell, i);
        sum += shareOfCluster(one.x, scale) * one.y;
        uint begin = slot;
        // Rounding leaves no slot empty.
        while (slot < slots && (sum > wanted || i + 1 == count)) {
            word = (slot & 1u) != 0u ? word | uint(i) << 16 : uint(i);
            if ((slot & 1u) != 0u) lightTable[uint(LIGHT_SLOTS_AT) + (index * slots + slot) / 2u] = word;
            wanted += step;
            ++slot;
        }
        if (slot > begin) atomicAdd(lightTable[LIGHT_CLUSTER_POOLS_AT + i], slot - begin);
    } while (++i < count);
}
