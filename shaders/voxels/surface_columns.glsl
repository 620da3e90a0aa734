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

struct ColumnTest {
    // Edge functions of the three projections (uv, vw, wu), three edges each: value = A first + B second + C,
    // >= 0 where the edge leaves room for the cell. Scaled so that one unit is one voxel.
    vec3 uvA, uvB, uvC;
    vec3 vwA, vwB, vwC;
    vec3 wuA, wuB, wuC;
    // Lowest height of the plane over cell (0,0), its slopes, and how much it rises within a cell.
    float height, slopeU, slopeV, rise;
    float lowest, highest;  // of the triangle along w
};

// Edges of one projection: x, y of the three vertices in order; side: sign of the normal along the third
// axis.
void projectedEdges(vec2 a, vec2 b, vec2 c, float side, out vec3 A, out vec3 B, out vec3 C) {
    A = vec3(a.y - b.y, b.y - c.y, c.y - a.y) * side;
    B = vec3(b.x - a.x, c.x - b.x, a.x - c.x) * side;
    vec3 scale = 1.0 / max(abs(A) + abs(B), 1e-20);
    A *= scale;
    B *= scale;
    // The corner of the unit cell that lies farthest inside decides.
    C = max(A, 0.0) + max(B, 0.0) - A * vec3(a.x, b.x, c.x) - B * vec3(a.y, b.y, c.y);
    // An edge seen end-on has no direction and excludes nothing.
    C += kTouch;
}

// Vertices relative to the anchor; n: any normal of the triangle.
ColumnTest columnTest(vec3 a, vec3 b, vec3 c, vec3 n) {
    ColumnTest t;
    projectedEdges(a.xy, b.xy, c.xy, n.z >= 0.0 ? 1.0 : -1.0, t.uvA, t.uvB, t.uvC);
    projectedEdges(a.yz, b.yz, c.yz, n.x >= 0.0 ? 1.0 : -1.0, t.vwA, t.vwB, t.vwC);
    projectedEdges(a.zx, b.zx, c.zx, n.y >= 0.0 ? 1.0 : -1.0, t.wuA, t.wuB, t.wuC);
    t.slopeU = -n.x / n.z;
    t.slopeV = -n.y / n.z;
    t.height = a.z - t.slopeU * a.x - t.slopeV * a.y + min(t.slopeU, 0.0) + min(t.slopeV, 0.0);
    t.rise = abs(t.slopeU) + abs(t.slopeV);
    t.lowest = min(min(a.z, b.z), c.z);
    t.highest = max(max(a.z, b.z), c.z);
    return t;
}

// Cells of the column that may be met: first and number (0..4), within [wBegin, wEnd).
int columnCandidates(ColumnTest t, vec2 cell, int wBegin, int wEnd, out int first) {
    precise float low = t.height + t.slopeU * cell.x + t.slopeV * cell.y;
    precise float high = min(low + t.rise, t.highest) + kTouch;
    low = max(low, t.lowest) - kTouch;
    vec3 e = t.uvA * cell.x + t.uvB * cell.y + t.uvC;
    first = max(int(floor(low)), wBegin);
    int last = min(int(floor(high)), wEnd - 1);
    bool inside = min(min(e.x, e.y), e.z) >= 0.0 && low <= high;
    return inside ? clamp(last - first + 1, 0, 4) : 0;
}

// Bit i: cell first + i of the column is met.
uint columnMask(ColumnTest t, vec2 cell, int wBegin, int wEnd) {
    int first;
    int count = columnCandidates(t, cell, wBegin, wEnd, first);
    vec3 vw = t.vwA * cell.y + t.vwC;
    vec3 wu = t.wuB * cell.x + t.wuC;
    uint mask = 0u;
    int i = 0;
    do {
        float w = float(first + i);
        vec3 e = min(vw + t.vwB * w, wu + t.wuA * w);
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
