// SPDX-License-Identifier: MIT
// Tiles of big triangles -> fragments. Eight invocations per tile of 8 x 8 columns, one row of columns each.
#version 450
#ifndef SURFACE_UPDATE
#error SURFACE_UPDATE must be 0 or 1
#endif
layout(local_size_x = 64) in;
#include "voxels/surface_common.glsl"
#include "voxels/surface_emit.glsl"
layout(std430) readonly buffer TileTable { uvec2 tiles[]; };
uniform samplerBuffer triangles;

void main() {
    uint index = linearInvocation();
    uint tile = index >> 3;
    int row = int(index & 7u);
    bool used = tile < min(counters[SURFACE_TILES], surface.tileCapacity);
    uvec2 entry = tiles[used ? tile : 0u];
    int triangle = int(entry.x);
    vec3 p0 = texelFetch(triangles, 3 * triangle).xyz;
    vec3 p1 = texelFetch(triangles, 3 * triangle + 1).xyz;
    vec3 p2 = texelFetch(triangles, 3 * triangle + 2).xyz;
#if NESTED_GRIDS
    emitLevel = int(used ? entry.y >> TILE_LEVEL_SHIFT : 0u);
    vec4 place = levelPlace(emitLevel);
#if SURFACE_UPDATE
    emitHeld = isStale(floatBitsToUint(texelFetch(triangles, 3 * triangle).w) & 0xffffffu);
#endif
    p0 = levelFromGrid(p0, place);
    p1 = levelFromGrid(p1, place);
    p2 = levelFromGrid(p2, place);
#endif
    vec3 n = cross(p1 - p0, p2 - p0);
    int axis = dominantAxis(n);
    vec3 a = toDominant(p0, axis);
    vec3 b = toDominant(p1, axis);
    vec3 c = toDominant(p2, axis);
    ivec3 low, high;
    columnBounds(a, b, c, axis, low, high);

    // The row's columns, up to the end of the triangle's bounds.
    ivec3 anchor = ivec3(TILE_COLUMN(entry.y) + ivec2(0, row), low.z);
    vec3 origin = vec3(anchor);
    ColumnTest t = columnTest(a - origin, b - origin, c - origin, toDominant(n, axis));
    ColumnBlock block = ColumnBlock(anchor, axis, 8, high.z - low.z);
    int count = used && anchor.y < high.y ? min(high.x - anchor.x, 8) : 0;
    uint met = 0u;
    int column = 0;
    do {
        uint mask = column < count ? columnMask(t, vec2(column, 0), block.depth) : 0u;
        met |= mask << (4 * column);
        ++column;
    } while (column < count);
    emitFragments(t, uint(triangle), uvec2(met, 0u), block);
}
