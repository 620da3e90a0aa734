// SPDX-License-Identifier: MIT
// Triangles of the scene as the voxelizer sees them: along the dominant axis of their normal (thesis, "Dominant
// Axis Selection"), where columns of voxels stand for pixels. Before it: ThesisGrid `grid`.
#include "lib/dot.glsl"
#include "lib/scene_tables.glsl"
#include "thesis/shaders/dominant_axis.glsl"
layout(std430) readonly buffer VertexTable { Vertex vertices[]; };
layout(std430) readonly buffer IndexTable { uint indices[]; };

struct GridTriangle {
    vec3 a, b, c;  // permuted positions, in voxels
    vec3 across;   // normal in world axes, twice the area long, by the order of corners
    uint axis;
    uint instance;
    uvec3 vertex;     // places in VertexTable
    float share;      // of its surface that this pass takes
    bool used;        // voxelized, and covers something
    bool isWide;      // over more columns than one invocation should walk through
    ivec2 low, high;  // columns that it may touch, from low to below high, within the box
};

// One invocation walks through at most so many columns; on llvmpipe seven others wait for it.
const int kMostColumns = 36;

float twiceArea(vec2 a, vec2 b, vec2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

uint triangleCount() {
    uint last = uint(grid.boxSize.w) - 1u;
    return instances[last].firstTriangle + instances[last].indexCount / 3u;
}

// The instance a triangle belongs to: last one that starts at or before it.
uint instanceOfTriangle(uint triangle) {
    uint low = 0u;
    uint high = uint(grid.boxSize.w);
    do {
        uint middle = (low + high) >> 1;
        bool below = instances[middle].firstTriangle <= triangle;
        low = below ? middle : low;
        high = below ? high : middle;
    } while (high - low > 1u);
    return low;
}

GridTriangle gridTriangle(uint index) {
    GridTriangle t;
    bool inside = index < triangleCount();
    uint triangle = inside ? index : 0u;
    t.instance = instanceOfTriangle(triangle);
    uint first = instances[t.instance].firstIndex + 3u * (triangle - instances[t.instance].firstTriangle);
    t.vertex =
        instances[t.instance].firstVertex + uvec3(indices[first], indices[first + 1u], indices[first + 2u]);
    mat4 place = instances[t.instance].worldFromObject;
    vec3 p = (place * vec4(vertices[t.vertex.x].position, 1.0)).xyz;
    vec3 q = (place * vec4(vertices[t.vertex.y].position, 1.0)).xyz;
    vec3 r = (place * vec4(vertices[t.vertex.z].position, 1.0)).xyz;
    t.across = cross(q - p, r - p);
    vec3 weight = abs(t.across);
    t.axis = voxelizationAxis(weight, grid.along);
    t.share = passShare(weight, t.axis, grid.along);
    t.a = permuted((p - grid.origin) / grid.voxelSize, t.axis);
    t.b = permuted((q - grid.origin) / grid.voxelSize, t.axis);
    t.c = permuted((r - grid.origin) / grid.voxelSize, t.axis);
    // Degenerate triangles cover nothing; NaN fails the comparison, too.
    t.used = inside && (instances[t.instance].flags & INSTANCE_VOXELIZED) != 0u &&
             abs(twiceArea(t.a.xy, t.b.xy, t.c.xy)) > 0.0;
    ivec2 boxLow = ivec2(permuted(vec3(grid.boxMin.xyz), t.axis).xy);
    ivec2 boxHigh = boxLow + ivec2(permuted(vec3(grid.boxSize.xyz), t.axis).xy);
    // Clamped as floats: far outside of the grid they may be no int.
    t.low = ivec2(clamp(floor(min(min(t.a.xy, t.b.xy), t.c.xy)), vec2(boxLow), vec2(boxHigh)));
    t.high = ivec2(clamp(ceil(max(max(t.a.xy, t.b.xy), t.c.xy)), vec2(boxLow), vec2(boxHigh)));
    ivec2 columns = t.high - t.low;
    t.used = t.used && columns.x > 0 && columns.y > 0;
    t.isWide = columns.x * columns.y > kMostColumns;
    return t;
}

// ---- Columns of bricks, the tiles in which wide triangles are taken.

// Room about a triangle for rounding, in voxels.
const float kRoom = 0.125;

// Whether the triangle may touch a column of bricks.
bool touchesColumn(GridTriangle t, ivec2 column) {
    vec2 middle = (vec2(column) + 0.5) * float(THESIS_BRICK);
    bool turned = twiceArea(t.a.xy, t.b.xy, t.c.xy) < 0.0;
    vec2 corners[3] = vec2[3](t.a.xy, turned ? t.c.xy : t.b.xy, turned ? t.b.xy : t.c.xy);
    bool touches = true;
    for (int i = 0; i < 3; ++i) {
        vec2 from = corners[i], along = corners[(i + 1) % 3] - from;
        vec2 inward = vec2(-along.y, along.x);
        float reach = (0.5 * float(THESIS_BRICK) + kRoom) * (abs(inward.x) + abs(inward.y));
        touches = touches && dot(inward, middle - from) + reach >= 0.0;
    }
    return touches;
}

// Walks through the columns of bricks that it may touch.
struct ColumnWalk {
    ivec2 first, count;
    int total;
    int next;  // number of the next one to look at
};
ColumnWalk startColumns(GridTriangle t) {
    // One voxel more to each side: rounding may put light into the next column.
    ivec2 first = max((t.low - 1), ivec2(0)) / THESIS_BRICK;
    ivec2 count = t.high / THESIS_BRICK + 1 - first;
    return ColumnWalk(first, count, t.used ? count.x * count.y : 0, 0);
}
bool nextColumn(GridTriangle t, inout ColumnWalk w, out ivec2 column) {
    bool found = false;
    column = ivec2(0);
    while (!found && w.next < w.total) {
        column = w.first + ivec2(w.next % w.count.x, w.next / w.count.x);
        found = touchesColumn(t, column);
        ++w.next;
    }
    return found;
}
