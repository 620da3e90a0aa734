#version 450 core
// SPDX-License-Identifier: MIT
// Triangles -> their direct light, put into the volume (voxel_sums.glsl): for every column of voxels that a triangle
// touches, exactly the area that it covers (coverage.glsl), lit at the point nearest to the column's middle.
// Columns lie along the dominant axis of the triangle's normal, or as ThesisGrid asks (scene_triangle.glsl).
//
//   TILES  0: one invocation per triangle, which walks through its columns; wide ones are cut into tiles of 8 x 8
//             columns, each a column of bricks
//          1: eight invocations per tile, which walk through one row across of it each
#include "lib/dot.glsl"
#include "thesis/shaders/constants.h"
#include "thesis/shaders/coverage.glsl"
layout(local_size_x = 64) in;
#include "lib/linear_index.glsl"
layout(std140) uniform ThesisGridBlock { ThesisGrid grid; };
#include "thesis/shaders/scene_triangle.glsl"
#include "thesis/shaders/voxel_sums.glsl"
#ifndef TILES
#error TILES must be 0 or 1
#endif
// Per instance: 1 where it shines as a light of the table.
layout(std430) readonly buffer LampTable { uint lamps[]; };
// Triangle, tile (x, y: 16 bits each).
layout(std430) buffer TileTable { uvec2 tiles[]; };
// [2] tiles listed so far
layout(std430) buffer BrickList { uint brickList[]; };

// What pieces of a triangle take from its corners.
struct Corners {
    vec3 normalA, normalB, normalC;  // unit
    vec2 uvA, uvB, uvC;
};

vec3 cornerNormal(GridTriangle t, uint vertex) {
    vec3 n = octDecode(unpackSnorm2x16(vertices[vertex].normalOct));
    return normalize(instances[t.instance].normalColumn0.xyz * n.x +
                     instances[t.instance].normalColumn1.xyz * n.y +
                     instances[t.instance].normalColumn2.xyz * n.z);
}

Corners cornersOf(GridTriangle t) {
    Corners c;
    c.normalA = cornerNormal(t, t.vertex.x);
    c.normalB = cornerNormal(t, t.vertex.y);
    c.normalC = cornerNormal(t, t.vertex.z);
    c.uvA = vec2(vertices[t.vertex.x].u, vertices[t.vertex.x].v);
    c.uvB = vec2(vertices[t.vertex.y].u, vertices[t.vertex.y].v);
    c.uvC = vec2(vertices[t.vertex.z].u, vertices[t.vertex.z].v);
    return c;
}

SurfaceOfPiece surfaceOf(GridTriangle t, Corners c) {
    uint flags = instances[t.instance].flags;
    uint color = vertices[t.vertex.x].color;
    if ((flags & INSTANCE_WIDE_COLORS) != 0u) color = packUnorm4x8(vertexColor(color, flags));
    float front = dot(t.across, c.normalA + c.normalB + c.normalC) < 0.0 ? -1.0 : 1.0;
    return surfaceOfPiece(t.axis, instances[t.instance].material, color, areasSeen(front * t.across, t.axis),
                          lamps[t.instance] != 0u);
}

float coverageOf(GridTriangle t, vec2 column) {
    // Relative to the column, so that the digits are spent on it.
    return triangleCoverage(t.a.xy - column, t.b.xy - column, t.c.xy - column);
}

Piece pieceOf(GridTriangle t, Corners c, vec2 column, float coverage) {
    vec3 w = nearestBarycentrics(t.a.xy - column, t.b.xy - column, t.c.xy - column, vec2(0.5));
    Piece piece;
    piece.coverage = coverage * t.share;
    piece.gridPosition = permuted(w.x * t.a + w.y * t.b + w.z * t.c, t.axis);
    vec3 n = w.x * c.normalA + w.y * c.normalB + w.z * c.normalC;
    piece.normal = n * inversesqrt(max(dot(n, n), 1e-12));
    piece.uv = w.x * c.uvA + w.y * c.uvB + w.z * c.uvC;
    return piece;
}

// Adds the pieces in `count` columns from `first` on, rows of `width`. Each turn of the outer loop has a piece for
// every invocation that has one left.
void addPieces(GridTriangle t, ivec2 first, int width, int count) {
    Corners corners = cornersOf(t);
    SurfaceOfPiece surface = surfaceOf(t, corners);
    int next = 0;
    ivec2 at = first;
    bool found;
    do {
        float coverage = 0.0;
        vec2 column = vec2(0.0);
        found = false;
        while (!found && next < count) {
            column = vec2(at);
            coverage = coverageOf(t, column);
            found = coverage > 0.0;
            ++next;
            bool rowEnds = at.x + 1 == first.x + width;
            at = rowEnds ? ivec2(first.x, at.y + 1) : ivec2(at.x + 1, at.y);
        }
        Piece piece = pieceOf(t, corners, column, coverage);
        if (found) addPiece(piece, surface, column);
    } while (found);
}

void main() {
#if TILES
    uint tile = linearIndex() >> 3;
    bool isTile = tile < min(brickList[2], uint(tiles.length()));
    uvec2 entry = tiles[isTile ? tile : 0u];
    GridTriangle t = gridTriangle(entry.x);
    ivec2 low = ivec2(entry.y & 0xffffu, entry.y >> 16) * THESIS_BRICK;
    ivec2 high = min(low + THESIS_BRICK, t.high);
    // Invocations side by side take columns side by side.
    low.x += int(linearIndex() & 7u);
    bool has = isTile && t.used && low.x >= t.low.x && low.x < high.x;
    low.y = max(low.y, t.low.y);
    addPieces(t, low, 1, has ? max(high.y - low.y, 0) : 0);
#else
    uint index = linearIndex();
    GridTriangle t = gridTriangle(index);
    ivec2 size = t.high - t.low;
    addPieces(t, t.low, size.x, t.used && !t.isWide ? size.x * size.y : 0);
    // Wide ones, tile by tile.
    ColumnWalk walk = startColumns(t);
    walk.total = t.isWide ? walk.total : 0;
    ivec2 column;
    bool found = nextColumn(t, walk, column);
    while (found) {
        uint slot = atomicAdd(brickList[2], 1u);
        if (slot < uint(tiles.length())) tiles[slot] = uvec2(index, uint(column.x) | uint(column.y) << 16);
        found = nextColumn(t, walk, column);
    }
#endif
}
