// SPDX-License-Identifier: MIT
// What of a triangle lies in a voxel: exact area, centroid and bounds of the clipped polygon.
//
// The polygon that Sutherland and Hodgman (1974) would build has at most nine vertices, but building it needs
// lists that grow as they are indexed. Its area and centroid need only its boundary, in any order: Green's
// theorem sums over boundary segments (a, b) the terms (a x b)/2 and (a + b)(a x b)/6. The boundary consists
// of
//   3 pieces of triangle edges inside the cube, and
//   6 pieces of the lines in which the triangle meets the cube's sides, inside the side.
// Each is one segment, clipped by slabs (Liang and Barsky 1984). No list, no branch, the same work in each
// lane. The CPU reference (tests/support/reference_voxelizer.h) uses Sutherland-Hodgman.
//
// Borders: the cube is half-open, -1/2 in and +1/2 out, so a triangle that lies exactly in a side belongs to
// one voxel. Tiny gaps where rounding makes neighbouring segments miss each other cost area of the order of
// 1e-7.

const float kLargestSection = 1.41422;  // sqrt 2, rounded up

struct ClippedPolygon {
    float area;  // 0: nothing inside
    vec3 center;
    vec3 lower;  // bounds
    vec3 upper;
};

// Coordinates permuted so that z is the axis in which the normal is largest; cyclic, so orientation is kept.
int dominantAxis(vec3 n) {
    vec3 a = abs(n);
    return a.z >= a.x && a.z >= a.y ? 2 : (a.y >= a.x ? 1 : 0);
}
vec3 toDominant(vec3 p, int axis) { return axis == 2 ? p : (axis == 1 ? p.zxy : p.yzx); }
vec3 fromDominant(vec3 p, int axis) { return axis == 2 ? p : (axis == 1 ? p.yzx : p.zxy); }
ivec3 fromDominant(ivec3 p, int axis) { return axis == 2 ? p : (axis == 1 ? p.yzx : p.zxy); }

// Running sums over boundary segments, projected along z.
struct BoundarySum {
    float twiceArea;
    vec2 moment;
    vec3 lower;
    vec3 upper;
};

void addSegment(inout BoundarySum sum, vec3 a, vec3 b, bool inside, float orientation) {
    float twice = inside ? (a.x * b.y - a.y * b.x) * orientation : 0.0;
    sum.twiceArea += twice;
    sum.moment += (a.xy + b.xy) * twice;
    sum.lower = inside ? min(sum.lower, min(a, b)) : sum.lower;
    sum.upper = inside ? max(sum.upper, max(a, b)) : sum.upper;
}

// 1/d with a huge finite value for zero: a segment that is constant along an axis is then wholly in or out of
// the slab, and out when it lies on the upper side.
vec3 safeInverse(vec3 d) { return 1.0 / mix(d, vec3(1e-20), lessThan(abs(d), vec3(1e-20))); }
vec2 safeInverse(vec2 d) { return 1.0 / mix(d, vec2(1e-20), lessThan(abs(d), vec2(1e-20))); }

// Piece of the side (coordinate = `at`) between the points where the triangle's boundary leaves it upwards
// and comes back. `f`: vertex i is below the side. a, d: starts and directions of the edges in the side's two
// coordinates; t: edge parameters of the crossings. Returns the ends (xy, zw) and whether it is inside.
bool sideSegment(bvec3 f, vec2 a0, vec2 d0, vec2 a1, vec2 d1, vec2 a2, vec2 d2, vec3 t, out vec4 ends) {
    vec3 s = clamp(t, 0.0, 1.0);
    vec2 p0 = a0 + s.x * d0;
    vec2 p1 = a1 + s.y * d1;
    vec2 p2 = a2 + s.z * d2;
    // Edge i goes from vertex i to i+1. Exactly one leaves and one comes back when the vertices differ.
    vec2 leave = f.x && !f.y ? p0 : (f.y && !f.z ? p1 : p2);
    vec2 enter = !f.x && f.y ? p0 : (!f.y && f.z ? p1 : p2);
    bool crossed = any(f) && !all(f);
    vec2 d = enter - leave;
    vec2 inverse = safeInverse(d);
    vec2 u = (-0.5 - leave) * inverse;
    vec2 v = (0.5 - leave) * inverse;
    vec2 first = min(u, v);
    vec2 last = max(u, v);
    float begin = max(max(first.x, first.y), 0.0);
    float end = min(min(last.x, last.y), 1.0);
    ends = vec4(leave + begin * d, leave + end * d);
    return crossed && begin < end;
}

// A plane that holds an edge of the cube meets two sides there, and rounding would say of each by itself
// whether it does: a piece of the boundary counted twice or not at all, a quarter of the area. Such planes
// are moved off the edge, all of them the same way: planes along an edge and nearer to it than the first, in
// voxels, by the second. More than rounding in a grid of 512, less than 1/4096 voxel.
const float kEdgeNear = 1e-4;
const float kEdgeShift = 2e-4;
const float kAlongAxis = 0.9999;  // planes along the sides hold edges, too, but are right

float edgeShift(vec3 q0, vec3 n) {
    vec4 corners = abs(0.5 * vec4(n.x + n.y + n.z, n.x + n.y - n.z, n.x - n.y + n.z, n.y + n.z - n.x));
    vec4 off = abs(abs(dot(n, q0)) - corners);
    vec3 part = abs(n);
    bool alongEdge =
        min(part.x, min(part.y, part.z)) < kEdgeNear && max(part.x, max(part.y, part.z)) < kAlongAxis;
    return alongEdge && min(min(off.x, off.y), min(off.z, off.w)) < kEdgeNear ? kEdgeShift : 0.0;
}

// Vertices relative to the cube's centre in units of its edge; n: unit normal (counter-clockwise side).
ClippedPolygon clipToVoxel(vec3 q0, vec3 q1, vec3 q2, vec3 n) {
    int axis = dominantAxis(n);
    vec3 normal = toDominant(n, axis);
    vec3 shift = edgeShift(q0, n) * sign(normal.z) * normal;
    vec3 a = toDominant(q0, axis) + shift;
    vec3 b = toDominant(q1, axis) + shift;
    vec3 c = toDominant(q2, axis) + shift;
    BoundarySum sum = BoundarySum(0.0, vec2(0.0), vec3(1.0), vec3(-1.0));

    // Parameters at which each edge crosses the lower and upper sides.
    vec3 ab = b - a;
    vec3 bc = c - b;
    vec3 ca = a - c;
    vec3 iab = safeInverse(ab);
    vec3 ibc = safeInverse(bc);
    vec3 ica = safeInverse(ca);
    vec3 lowAb = (-0.5 - a) * iab;
    vec3 highAb = (0.5 - a) * iab;
    vec3 lowBc = (-0.5 - b) * ibc;
    vec3 highBc = (0.5 - b) * ibc;
    vec3 lowCa = (-0.5 - c) * ica;
    vec3 highCa = (0.5 - c) * ica;

    // Pieces of the three edges.
    vec3 first = min(lowAb, highAb);
    vec3 last = max(lowAb, highAb);
    float begin = max(max(first.x, first.y), max(first.z, 0.0));
    float end = min(min(last.x, last.y), min(last.z, 1.0));
    addSegment(sum, a + begin * ab, a + end * ab, begin < end, 1.0);
    first = min(lowBc, highBc);
    last = max(lowBc, highBc);
    begin = max(max(first.x, first.y), max(first.z, 0.0));
    end = min(min(last.x, last.y), min(last.z, 1.0));
    addSegment(sum, b + begin * bc, b + end * bc, begin < end, 1.0);
    first = min(lowCa, highCa);
    last = max(lowCa, highCa);
    begin = max(max(first.x, first.y), max(first.z, 0.0));
    end = min(min(last.x, last.y), min(last.z, 1.0));
    addSegment(sum, c + begin * ca, c + end * ca, begin < end, 1.0);

    // Pieces in the six sides: on an upper side the boundary runs from leaving to coming back, on a lower
    // side the other way round.
    vec4 e;
    bool in_;
    in_ = sideSegment(bvec3(a.x < 0.5, b.x < 0.5, c.x < 0.5), a.yz, ab.yz, b.yz, bc.yz, c.yz, ca.yz,
                      vec3(highAb.x, highBc.x, highCa.x), e);
    addSegment(sum, vec3(0.5, e.xy), vec3(0.5, e.zw), in_, 1.0);
    in_ = sideSegment(bvec3(a.x < -0.5, b.x < -0.5, c.x < -0.5), a.yz, ab.yz, b.yz, bc.yz, c.yz, ca.yz,
                      vec3(lowAb.x, lowBc.x, lowCa.x), e);
    addSegment(sum, vec3(-0.5, e.xy), vec3(-0.5, e.zw), in_, -1.0);
    in_ = sideSegment(bvec3(a.y < 0.5, b.y < 0.5, c.y < 0.5), a.xz, ab.xz, b.xz, bc.xz, c.xz, ca.xz,
                      vec3(highAb.y, highBc.y, highCa.y), e);
    addSegment(sum, vec3(e.x, 0.5, e.y), vec3(e.z, 0.5, e.w), in_, 1.0);
    in_ = sideSegment(bvec3(a.y < -0.5, b.y < -0.5, c.y < -0.5), a.xz, ab.xz, b.xz, bc.xz, c.xz, ca.xz,
                      vec3(lowAb.y, lowBc.y, lowCa.y), e);
    addSegment(sum, vec3(e.x, -0.5, e.y), vec3(e.z, -0.5, e.w), in_, -1.0);
    in_ = sideSegment(bvec3(a.z < 0.5, b.z < 0.5, c.z < 0.5), a.xy, ab.xy, b.xy, bc.xy, c.xy, ca.xy,
                      vec3(highAb.z, highBc.z, highCa.z), e);
    addSegment(sum, vec3(e.xy, 0.5), vec3(e.zw, 0.5), in_, 1.0);
    in_ = sideSegment(bvec3(a.z < -0.5, b.z < -0.5, c.z < -0.5), a.xy, ab.xy, b.xy, bc.xy, c.xy, ca.xy,
                      vec3(lowAb.z, lowBc.z, lowCa.z), e);
    addSegment(sum, vec3(e.xy, -0.5), vec3(e.zw, -0.5), in_, -1.0);

    // Projected area is positive when the normal points up. The largest section of a cube is the diagonal
    // one.
    ClippedPolygon polygon;
    float twice = sum.twiceArea * sign(normal.z);
    polygon.area = clamp(0.5 * twice / abs(normal.z), 0.0, kLargestSection);
    vec2 center = twice > 1e-12 ? sum.moment / (3.0 * sum.twiceArea) : 0.5 * (sum.lower.xy + sum.upper.xy);
    center = clamp(center, sum.lower.xy, sum.upper.xy);
    // Height from the plane, through the vertex nearest in the projection.
    float height = a.z - dot(normal.xy, center - a.xy) / normal.z;
    height = clamp(height, sum.lower.z, sum.upper.z);
    polygon.center = fromDominant(vec3(center, height), axis);
    polygon.lower = fromDominant(sum.lower, axis);
    polygon.upper = fromDominant(sum.upper, axis);
    return polygon;
}
