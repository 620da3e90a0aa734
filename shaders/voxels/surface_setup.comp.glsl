// SPDX-License-Identifier: MIT
// First pass of the voxelizer, one invocation per triangle: vertices to grid coordinates (kept for the later
// passes), small triangles to fragments, big ones to tiles of 8 x 8 columns. A triangle is small when it
// spans at most 16 columns; then one invocation has little to do. At most 64 x 64 tiles are visited per
// triangle.
#version 450
#ifndef SURFACE_UPDATE
#error SURFACE_UPDATE must be 0 or 1
#endif
layout(local_size_x = 64) in;
#include "lib/brdf.glsl"
#include "lib/dot.glsl"
#include "lib/voxel_record.glsl"
#include "voxels/surface_common.glsl"
#include "voxels/surface_emit.glsl"
#include "voxels/surface_vertices.glsl"
layout(std430) writeonly buffer TriangleTable { vec4 triangles[]; };
layout(std430) writeonly buffer TileTable { uvec2 tiles[]; };

const int kSmallColumns = 16;

#if SURFACE_UPDATE
layout(std430) readonly buffer RunTable { uvec2 runs[]; };

// The changed instance that the n-th triangle of the work belongs to: last run that starts at or before it.
uvec2 runOf(uint n) {
    uint low = 0u;
    uint high = surface.instanceCount;
    do {
        uint middle = (low + high) >> 1;
        bool below = runs[middle].y <= n;
        low = below ? middle : low;
        high = below ? high : middle;
    } while (high - low > 1u);
    return runs[low];
}
#endif

// The instance a triangle belongs to: last one that starts at or before it.
uint instanceOfTriangle(uint triangle) {
    uint low = 0u;
    uint high = surface.instanceCount;
    do {
        uint middle = (low + high) >> 1;
        bool below = instances[middle].firstTriangle <= triangle;
        low = below ? middle : low;
        high = below ? high : middle;
    } while (high - low > 1u);
    return low;
}

// The triangle of an invocation, in grid coordinates.
struct GridTriangle {
    uint triangle;
    uint instance;
    vec3 p0, p1, p2;
    vec3 normal;  // unit; z when the triangle is not used
    bool used;    // voxelized
};

GridTriangle gridTriangle(uint triangle, uint instance, bool wanted) {
    uint instanceFlags = instances[instance].flags;
    mat4 worldFromObject = instances[instance].worldFromObject;
    uvec3 v = cornersOfTriangle(triangle, instance);
    vec3 p0 = gridFromWorld((worldFromObject * vec4(vertices[v.x].position, 1.0)).xyz);
    vec3 p1 = gridFromWorld((worldFromObject * vec4(vertices[v.y].position, 1.0)).xyz);
    vec3 p2 = gridFromWorld((worldFromObject * vec4(vertices[v.z].position, 1.0)).xyz);

    // Leave out triangles whose height is below a millionth of their longest edge: they have no reliable
    // normal and next to no area. NaN fails the comparison too.
    vec3 e0 = p1 - p0;
    vec3 e1 = p2 - p0;
    vec3 e2 = p2 - p1;
    vec3 n = cross(e0, e1);
    float twiceArea = length(n);
    float longest = max(max(dot(e0, e0), dot(e1, e1)), dot(e2, e2));
    bool used =
        wanted && (instanceFlags & INSTANCE_VOXELIZED) != 0u && twiceArea > 1e-6 * longest && longest < 1e18;
    n = used ? n / twiceArea : vec3(0.0, 0.0, 1.0);
    return GridTriangle(triangle, instance, p0, p1, p2, n, used);
}

#if NESTED_GRIDS
// From grid coordinates to those of a level; what edges it has stays as it is.
GridTriangle inLevel(GridTriangle t, int level) {
    vec4 place = levelPlace(level);
    t.p0 = levelFromGrid(t.p0, place);
    t.p1 = levelFromGrid(t.p1, place);
    t.p2 = levelFromGrid(t.p2, place);
    return t;
}
#endif

// For VOXEL_TRIANGLE_SOLID_SHIFT, of the solid that the vertex belongs to. Scaled, it has another volume and another area,
// by the mean of what sides along the axes have.
uint solidBits(uint vertex, uint instance) {
    uint code = VERTEX_SOLID_CODE(vertices[vertex].tangentOct);
    float volumes = abs(determinant(mat3(instances[instance].worldFromObject)));
    float areas = length(instances[instance].normalColumn0.xyz) +
                  length(instances[instance].normalColumn1.xyz) +
                  length(instances[instance].normalColumn2.xyz);
    float scale = 3.0 * volumes / max(areas, 1e-30) * grid.inverseVoxelSize;
    float steps = 2.0 * (float(code) - float(VERTEX_SOLID_BIAS) + log2(max(scale, 1e-30))) + 16.5;
    return code != 0u && steps < 32.0 ? uint(max(steps, 1.0)) << VOXEL_TRIANGLE_SOLID_SHIFT : 0u;
}

// Keeps corners, flags and the material without its textures for the later passes.
void writeTriangle(GridTriangle t) {
    uint material = instances[t.instance].material;
    uint materialFlags = materials[material].flags;
    // Through holes one sees the inside.
    bool whole = (materialFlags & (MATERIAL_ALPHA_MASK | MATERIAL_ALPHA_BLEND)) == 0u;
    const uint asked = INSTANCE_CASTS_SHADOW | INSTANCE_VEIL;
    bool hides = whole && (instances[t.instance].flags & asked) == INSTANCE_CASTS_SHADOW;
    uint solid = whole ? solidBits(cornersOfTriangle(t.triangle, t.instance).x, t.instance) : 0u;
    uint bits = t.instance | solid |
                ((materialFlags & MATERIAL_DOUBLE_SIDED) != 0u ? TRIANGLE_TWO_SIDED : 0u) |
                (t.used ? 0u : TRIANGLE_UNUSED) | (hides ? 0u : VOXEL_TRIANGLE_PASSABLE);
    bool unlit = (materialFlags & MATERIAL_UNLIT) != 0u;
    vec3 albedo = evenAlbedo(materials[material].baseColor.rgb, materials[material].metallic,
                             materials[material].roughness, materials[material].specularF0);
    albedo = layeredAlbedo(albedo, materials[material].evenLayers);
    albedo = unlit ? vec3(0.0) : albedo;
    vec3 emission = unlit ? vec3(0.0) : materials[material].emission;
    triangles[3u * t.triangle] = vec4(t.p0, uintBitsToFloat(bits));
    triangles[3u * t.triangle + 1u] = vec4(t.p1, uintBitsToFloat(packAlbedo(albedo)));
    triangles[3u * t.triangle + 2u] = vec4(t.p2, uintBitsToFloat(packRgb9e5(emission)));
}

// Cells that a triangle meets in the first `count` columns of a block, as emitFragments takes them.
uvec2 metCells(ColumnTest t, ColumnBlock block, int count) {
    uvec2 met = uvec2(0u);
    int column = 0;
    int u = 0;
    int v = 0;
    do {
        uint mask = column < count ? columnMask(t, vec2(u, v), block.depth) : 0u;
        met.x |= column < 8 ? mask << (4 * column) : 0u;
        met.y |= column < 8 ? 0u : mask << (4 * (column & 7));
        ++column;
        bool rowEnds = u + 1 == block.width;
        u = rowEnds ? 0 : u + 1;
        v += rowEnds ? 1 : 0;
    } while (column < count);
    return met;
}

// Lists every tile that the triangle's projection reaches, of `columns` columns from `low` on.
void emitTiles(ColumnTest t, uint triangle, ivec2 low, ivec2 columns) {
    ivec2 tileCount = (columns + 7) >> 3;
    int tileTotal = tileCount.x * tileCount.y;
    int tile = 0;
    ivec2 at = ivec2(0);
    // A cell of 8 columns moves the deciding corner seven cells further than a single one.
    vec3 reach = t.uv.c + 7.0 * (max(t.uv.a, 0.0) + max(t.uv.b, 0.0));
    do {
        vec2 cell = vec2(at * 8);
        vec3 e = t.uv.a * cell.x + t.uv.b * cell.y + reach;
        if (tile < tileTotal && min(min(e.x, e.y), e.z) >= 0.0) {
            uint slot = atomicAdd(counters[SURFACE_TILES], 1u);
            if (slot < surface.tileCapacity)
                tiles[slot] = uvec2(triangle, TILE_WORD(low.x + at.x * 8, low.y + at.y * 8));
        }
        ++tile;
        bool rowEnds = at.x + 1 >= tileCount.x;
        at = rowEnds ? ivec2(0, at.y + 1) : ivec2(at.x + 1, at.y);
    } while (tile < tileTotal);
}

void main() {
    // Find the triangle, and keep it for the later passes.
    uint index = linearInvocation();
#if NESTED_GRIDS
    // Once for each level.
    emitLevel = min(int(index / surface.triangleCount), coarsestLevel());
    bool inside = index < surface.triangleCount * voxelLevels.count;
    index -= uint(emitLevel) * surface.triangleCount;
#else
    bool inside = index < surface.triangleCount;
#endif
#if SURFACE_UPDATE
    // surface.triangleCount and .instanceCount are those of the work.
    uint work = min(index, surface.triangleCount - 1u);
    uvec2 run = runOf(work);
    uint instance = run.x;
    uint triangle = instances[instance].firstTriangle + work - run.y;
#else
    uint triangle = min(index, surface.triangleCount - 1u);
    uint instance = instanceOfTriangle(triangle);
#endif
    GridTriangle t = gridTriangle(triangle, instance, inside);
#if NESTED_GRIDS
    if (inside && emitLevel == 0) writeTriangle(t);
    t = inLevel(t, emitLevel);
#else
    if (inside) writeTriangle(t);
#endif

    // Bound the columns it may meet, within the grid, in dominant-axis coordinates.
    int axis = dominantAxis(t.normal);
    vec3 a = toDominant(t.p0, axis);
    vec3 b = toDominant(t.p1, axis);
    vec3 c = toDominant(t.p2, axis);
    ivec3 low, high;
    columnBounds(a, b, c, axis, low, high);
    bool met = t.used && all(greaterThan(high, low));
#if SURFACE_UPDATE && NESTED_GRIDS
    emitHeld = isStale(instance);
    met = met && (emitHeld || mayEnter(fromDominant(low, axis), fromDominant(high, axis), emitLevel));
#endif
    ivec2 columns = met ? high.xy - low.xy : ivec2(0);
    vec3 origin = vec3(low);
    ColumnTest test = columnTest(a - origin, b - origin, c - origin, toDominant(t.normal, axis));

    // Turn a small triangle into fragments, a big one into tiles.
    int total = columns.x * columns.y;
    bool small = total > 0 && total <= kSmallColumns;
    ColumnBlock block = ColumnBlock(low, axis, max(columns.x, 1), high.z - low.z);
    emitFragments(test, triangle, metCells(test, block, small ? total : 0), block);
    emitTiles(test, triangle, low.xy, small ? ivec2(0) : columns);
}
