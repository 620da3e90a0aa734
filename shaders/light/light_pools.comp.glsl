#version 450 core
// SPDX-License-Identifier: MIT
// Draws the pools of the clusters that send light. Each entry is the face at a random place in one of equal parts of the
// cluster's flux (stratified), in the order of runs and their faces.
layout(local_size_x = 64) in;
#include "lib/linear_index.glsl"
#include "light/light_bricks.glsl"
layout(std140) uniform CacheBlock { CacheConstants cache; };
uniform samplerBuffer runFluxes;
uniform usamplerBuffer clusterList;
uniform samplerBuffer clusterPlaces;
uniform usamplerBuffer lightSamples;  // the table, of which pools are written
layout(std430) buffer LightTable { uint lightTable[]; };

// The run of a cluster up to which there is more flux than `wanted`, and what is before it.
int runAt(int cluster, float wanted, out float before) {
    ivec3 block = cubeOfRow(cluster);
    int level = levelOfRow(cluster);
    int side = sideOfRow(cluster);
    int edge = 1 << blockShift();
    int found = -1;
    float sum = 0.0;
    ivec2 within = ivec2(0);
    do {
        int run = runOfBlock(block, level, within);
        float flux = run >= 0 ? texelFetch(runFluxes, 6 * max(run, 0) + side).x : 0.0;
        // The last one with any flux stands in where rounding overshoots.
        found = flux > 0.0 ? run : found;
        before = flux > 0.0 ? sum : before;
        sum += flux;
        within = within.x + 1 < edge ? within + ivec2(1, 0) : ivec2(0, within.y + 1);
    } while (within.y < edge && sum <= wanted);
    return found;
}

int faceAt(int run, uint side, float sum, float wanted) {
    ivec2 faces = facesOfRun(run);
    int found = faces.x;
    while (faces.x < faces.y && sum <= wanted) {
        float sided = texelFetch(faceFluxes, faces.x).x;
        float flux = sideOfFlux(sided) == side ? withoutSide(sided) : 0.0;
        found = flux > 0.0 ? faces.x : found;
        sum += flux;
        ++faces.x;
    }
    return found;
}

// The last listed cluster whose pool begins at an entry or before.
uint clusterOfEntry(uint entry) {
    uint low = 0u, end = max(texelFetch(clusterList, 0).x, 1u);
    do {
        uint middle = (low + end) / 2u;
        bool begins = texelFetch(lightSamples, int(uint(LIGHT_CLUSTER_POOLS_AT) + middle)).x >> 4 <= entry;
        low = begins ? middle : low;
        end = begins ? end : middle;
    } while (end - low > 1u);
    return low;
}

void main() {
    uint index = linearIndex();
    uint place = clusterOfEntry(index);
    uint pool = texelFetch(lightSamples, int(uint(LIGHT_CLUSTER_POOLS_AT) + place)).x;
    uint faces = 1u << (pool & 15u), entry = index - (pool >> 4);
    if (texelFetch(clusterList, 0).x == 0u || entry >= faces) return;
    int cluster = int(texelFetch(clusterList, int(1u + place)).x);
    uint state =
        drawSeed(uint(cluster) << LIGHT_MOST_POOL_SHIFT | entry, cache.update, cache.draw, cache.seed);
    float part = texelFetch(clusterPlaces, int(2u * place)).w / float(faces);
    float wanted = (float(entry) + randomNext(state)) * part;
    float before = 0.0;
    int run = runAt(cluster, wanted, before);
    uint face = uint(faceAt(max(run, 0), uint(sideOfRow(cluster)), before, wanted));
    // Those with bounds that are moved the other way are others in each update.
    bool moved = (entry + randomHash(uint(cluster) ^ cache.update ^ cache.draw * 0x9e3779b9u)) %
                     uint(kMovedBoundsPeriod) ==
                 0u;
    lightTable[uint(LIGHT_POOLS_AT) + index] = moved ? face | LIGHT_MOVED : face;
}
