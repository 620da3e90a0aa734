// SPDX-License-Identifier: MIT
// Which voxels of a column a triangle meets: exact test of triangle against box (Schwarz and Seidel, "Fast
// Parallel Surface and Solid Voxelization on GPUs", 2010). Along the normal's dominant axis a plane rises by
// at most two voxels within a column, so there are at most three candidates, four with rounding.
//
// Coordinates are dominant-axis ones (lib/clip.glsl), in voxels, relative to an anchor near the columns, so
// that numbers stay small where precision matters.

// How far outside a voxel a triangle may pass and still count, in voxels. Rounding of coordinates up to 512
// and of the edge functions stays below; the clipping that follows is exact.
const float kTouch = 4e-5;

// Edge functions of one projection, a component per edge: value = a first + b second + c, >= 0 where the edge
// leaves room for the cell. Scaled so that one unit is one voxel.
struct EdgeFunctions {
    vec3 a, b, c;
};

struct ColumnTest {
    EdgeFunctions uv, vw, wu;  // projections along w, u and v
    // Lowest height of the plane over cell (0,0), its slopes, and how much it rises within a cell.
    float height, slopeU, slopeV, rise;
    float lowest, highest;  // of the triangle along w
};

// The three vertices of one projection in order; side: sign of the normal along the third axis.
EdgeFunctions projectedEdges(vec2 p0, vec2 p1, vec2 p2, float side) {
    EdgeFunctions e;
    e.a = vec3(p0.y - p1.y, p1.y - p2.y, p2.y - p0.y) * side;
    e.b = vec3(p1.x - p0.x, p2.x - p1.x, p0.x - p2.x) * side;
    vec3 scale = 1.0 / max(abs(e.a) + abs(e.b), 1e-20);
    e.a *= scale;
    e.b *= scale;
    // The corner of the unit cell that lies farthest inside decides.
    e.c = max(e.a, 0.0) + max(e.b, 0.0) - e.a * vec3(p0.x, p1.x, p2.x) - e.b * vec3(p0.y, p1.y, p2.y);
    // An edge seen end-on has no direction and excludes nothing.
    e.c += kTouch;
    return e;
}

// Vertices relative to the anchor; n: any normal of the triangle.
ColumnTest columnTest(vec3 a, vec3 b, vec3 c, vec3 n) {
    ColumnTest t;
    t.uv = projectedEdges(a.xy, b.xy, c.xy, n.z >= 0.0 ? 1.0 : -1.0);
    t.vw = projectedEdges(a.yz, b.yz, c.yz, n.x >= 0.0 ? 1.0 : -1.0);
    t.wu = projectedEdges(a.zx, b.zx, c.zx, n.y >= 0.0 ? 1.0 : -1.0);
    t.slopeU = -n.x / n.z;
    t.slopeV = -n.y / n.z;
    t.height = a.z - t.slopeU * a.x - t.slopeV * a.y + min(t.slopeU, 0.0) + min(t.slopeV, 0.0);
    t.rise = abs(t.slopeU) + abs(t.slopeV);
    t.lowest = min(min(a.z, b.z), c.z);
    t.highest = max(max(a.z, b.z), c.z);
    return t;
}

// Cells of the column that may be met: first and number (0..4), within [0, depth).
int columnCandidates(ColumnTest t, vec2 cell, int depth, out int first) {
    precise float low = t.height + t.slopeU * cell.x + t.slopeV * cell.y;
    precise float high = min(low + t.rise, t.highest) + kTouch;
    low = max(low, t.lowest) - kTouch;
    vec3 e = t.uv.a * cell.x + t.uv.b * cell.y + t.uv.c;
    first = max(int(floor(low)), 0);
    int last = min(int(floor(high)), depth - 1);
    bool inside = min(min(e.x, e.y), e.z) >= 0.0 && low <= high;
    return inside ? clamp(last - first + 1, 0, 4) : 0;
}

// Bit i: cell first + i of the column is met.
uint columnMask(ColumnTest t, vec2 cell, int depth) {
    int first;
    int count = columnCandidates(t, cell, depth, first);
    vec3 vw = t.vw.a * cell.y + t.vw.c;
    vec3 wu = t.wu.b * cell.x + t.wu.c;
    uint mask = 0u;
    int i = 0;
    do {
        float w = float(first + i);
        vec3 e = min(vw + t.vw.b * w, wu + t.wu.a * w);
        mask |= i < count && min(min(e.x, e.y), e.z) >= 0.0 ? 1u << i : 0u;
        ++i;
    } while (i < count);
    return mask;
}

// Voxels that a triangle (dominant-axis coordinates, in voxels) may meet within the grid: low <= voxel <
// high.
void columnBounds(vec3 a, vec3 b, vec3 c, int axis, out ivec3 low, out ivec3 high) {
    ivec3 size = axis == 2 ? gridSize() : (axis == 1 ? gridSize().zxy : gridSize().yzx);
    vec3 limit = vec3(size);
    low = ivec3(floor(clamp(min(min(a, b), c) - kTouch, vec3(0.0), limit)));
    high = ivec3(floor(clamp(max(max(a, b), c) + kTouch, vec3(-1.0), limit - 0.5))) + 1;
}
