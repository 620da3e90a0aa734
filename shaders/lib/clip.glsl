// SPDX-License-Identifier: MIT
// What of a triangle lies in a voxel: exact area, centroid and bounds of the clipped polygon.
//
// The polygon that Sutherland and Hodgman (1974) would build has at most nine vertices, but building it needs
// lists that grow as they are indexed. Its area and centroid need only its boundary, in any order: Green's
// theorem sums over boundary segments (a, b) the terms (a x b)/2 and (a + b)(a x b)/6. The boundary is
//   3 pieces of triangle edges inside the cube, and
//   6 pieces of the lines in which the triangle meets the cube's sides, inside the side.
// Each is one segment, clipped by slabs (Liang and Barsky 1984). No list, no branch, the same work in each
// lane. The CPU reference (tests/support/reference_voxelizer.h) uses Sutherland-Hodgman.
//
// CLIP_SOLID_ANGLE 1: also how large the polygon looks from a point. Of a fan of triangles from a point of its plane to
// each piece of the boundary, signed, the solid angles add up to it, in any order as well.
//
// Borders: the cube is half-open, -1/2 in and +1/2 out, so a triangle that lies exactly in a side belongs to
// one voxel. Tiny gaps where rounding makes neighbouring segments miss each other cost area of the order of
// 1e-7.
#include "lib/dot.glsl"

#ifndef CLIP_SOLID_ANGLE
#define CLIP_SOLID_ANGLE 0
#endif
const float kLargestSection = 1.41422;  // sqrt 2, rounded up

struct ClippedPolygon {
    float area;  // 0: nothing inside
    vec3 center;
    vec3 lower;  // bounds
    vec3 upper;
#if CLIP_SOLID_ANGLE
    float solidAngle;  // sr, its sign that of the side it is seen from
#endif
};
#if CLIP_SOLID_ANGLE
vec3 clipEye;     // from where; from the cube's centre in units of its edge
vec3 clipMiddle;  // a point of the plane
#endif

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
#if CLIP_SOLID_ANGLE
    float solidAngle;
    vec3 eye, middle;
#endif
};

#if CLIP_SOLID_ANGLE
// Of a triangle, seen from where its corners are counted from: van Oosterom and Strackee, "The Solid Angle of a Plane
// Triangle", 1983.
float solidAngleOf(vec3 a, vec3 b, vec3 c) {
    float la = length(a), lb = length(b), lc = length(c);
    float across = dot(a, cross(b, c));
    float along = la * lb * lc + dot(a, b) * lc + dot(c, a) * lb + dot(b, c) * la;
    return across == 0.0 ? 0.0 : 2.0 * atan(across, along);
}
#endif

void addSegment(inout BoundarySum sum, vec3 a, vec3 b, bool inside, float orientation) {
    float twice = inside ? (a.x * b.y - a.y * b.x) * orientation : 0.0;
    sum.twiceArea += twice;
    sum.moment += (a.xy + b.xy) * twice;
#if CLIP_SOLID_ANGLE
    float seen = solidAngleOf(sum.middle - sum.eye, a - sum.eye, b - sum.eye);
    sum.solidAngle += inside ? seen * orientation : 0.0;
#endif
    sum.lower = inside ? min(sum.lower, min(a, b)) : sum.lower;
    sum.upper = inside ? max(sum.upper, max(a, b)) : sum.upper;
}

// 1/d with a huge finite value for zero: a segment that is constant along an axis is then wholly in or out of
// the slab, and out when it lies on the upper side.
vec3 safeInverse(vec3 d) { return 1.0 / mix(d, vec3(1e-20), lessThan(abs(d), vec3(1e-20))); }
vec2 safeInverse(vec2 d) { return 1.0 / mix(d, vec2(1e-20), lessThan(abs(d), vec2(1e-20))); }

// One edge of the triangle, and the parameters at which it crosses the cube's lower and upper sides, an axis
// per component.
struct ClippedEdge {
    vec3 start;
    vec3 way;  // to its end
    vec3 low;
    vec3 high;
};

struct ClippedTriangle {
    ClippedEdge ab, bc, ca;
};

ClippedEdge clippedEdge(vec3 from, vec3 to) {
    vec3 way = to - from;
    vec3 inverse = safeInverse(way);
    return ClippedEdge(from, way, (-0.5 - from) * inverse, (0.5 - from) * inverse);
}

// Adds the piece of the edge that lies in the cube.
void addEdge(inout BoundarySum sum, ClippedEdge e) {
    vec3 first = min(e.low, e.high);
    vec3 last = max(e.low, e.high);
    float begin = max(max(first.x, first.y), max(first.z, 0.0));
    float end = min(min(last.x, last.y), min(last.z, 1.0));
    addSegment(sum, e.start + begin * e.way, e.start + end * e.way, begin < end, 1.0);
}

// The two coordinates of a side across `axis`, and a point of it where the third is `at`.
vec2 alongSide(vec3 p, int axis) { return axis == 0 ? p.yz : (axis == 1 ? p.xz : p.xy); }
vec3 onSide(vec2 p, float at, int axis) {
    return axis == 0 ? vec3(at, p) : (axis == 1 ? vec3(p.x, at, p.y) : vec3(p, at));
}

// Piece of the side (coordinate = `at`, -1/2 or 1/2) between the points where the triangle's boundary leaves
// it upwards and comes back. Returns the ends (xy, zw) and whether it is inside.
bool sideSegment(ClippedTriangle c, int axis, float at, out vec4 ends) {
    // Find where the edges cross the side. Edge i goes from vertex i to i+1.
    bvec3 below = lessThan(vec3(c.ab.start[axis], c.bc.start[axis], c.ca.start[axis]), vec3(at));
    vec3 t = at > 0.0 ? vec3(c.ab.high[axis], c.bc.high[axis], c.ca.high[axis])
                      : vec3(c.ab.low[axis], c.bc.low[axis], c.ca.low[axis]);
    vec3 s = clamp(t, 0.0, 1.0);
    vec2 p0 = alongSide(c.ab.start, axis) + s.x * alongSide(c.ab.way, axis);
    vec2 p1 = alongSide(c.bc.start, axis) + s.y * alongSide(c.bc.way, axis);
    vec2 p2 = alongSide(c.ca.start, axis) + s.z * alongSide(c.ca.way, axis);

    // Exactly one edge leaves and one comes back when the vertices differ.
    vec2 leave = below.x && !below.y ? p0 : (below.y && !below.z ? p1 : p2);
    vec2 enter = !below.x && below.y ? p0 : (!below.y && below.z ? p1 : p2);
    bool crossed = any(below) && !all(below);

    // Clip the line between them by the side's own borders.
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

// Adds the pieces in the two sides across an axis: on the upper side the boundary runs from leaving to coming
// back, on the lower one the other way round.
void addSides(inout BoundarySum sum, ClippedTriangle c, int axis) {
    vec4 e;
    bool inside = sideSegment(c, axis, 0.5, e);
    addSegment(sum, onSide(e.xy, 0.5, axis), onSide(e.zw, 0.5, axis), inside, 1.0);
    inside = sideSegment(c, axis, -0.5, e);
    addSegment(sum, onSide(e.xy, -0.5, axis), onSide(e.zw, -0.5, axis), inside, -1.0);
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

// Area, centroid and bounds from the sums; p: a point of the plane; coordinates are dominant-axis ones.
ClippedPolygon polygonOf(BoundarySum sum, vec3 p, vec3 normal, int axis) {
    // Projected area is positive when the normal points up. The largest section of a cube is the diagonal
    // one.
    ClippedPolygon polygon;
    float twice = sum.twiceArea * sign(normal.z);
    polygon.area = clamp(0.5 * twice / abs(normal.z), 0.0, kLargestSection);
    vec2 center = twice > 1e-12 ? sum.moment / (3.0 * sum.twiceArea) : 0.5 * (sum.lower.xy + sum.upper.xy);
    center = clamp(center, sum.lower.xy, sum.upper.xy);
    // Height from the plane.
    float height = p.z - dot(normal.xy, center - p.xy) / normal.z;
    height = clamp(height, sum.lower.z, sum.upper.z);
    polygon.center = fromDominant(vec3(center, height), axis);
    polygon.lower = fromDominant(sum.lower, axis);
    polygon.upper = fromDominant(sum.upper, axis);
#if CLIP_SOLID_ANGLE
    polygon.solidAngle = sum.solidAngle;
#endif
    return polygon;
}

// Vertices relative to the cube's centre in units of its edge; n: unit normal (counter-clockwise side).
ClippedPolygon clipToVoxel(vec3 q0, vec3 q1, vec3 q2, vec3 n) {
    // Turn to the dominant axis, off the cube's edges.
    int axis = dominantAxis(n);
    vec3 normal = toDominant(n, axis);
    vec3 shift = edgeShift(q0, n) * sign(normal.z) * normal;
    vec3 a = toDominant(q0, axis) + shift;
    vec3 b = toDominant(q1, axis) + shift;
    vec3 c = toDominant(q2, axis) + shift;

    // Sum over the boundary: pieces of the three edges, pieces in the six sides.
    ClippedTriangle t = ClippedTriangle(clippedEdge(a, b), clippedEdge(b, c), clippedEdge(c, a));
#if CLIP_SOLID_ANGLE
    BoundarySum sum = BoundarySum(0.0, vec2(0.0), vec3(1.0), vec3(-1.0), 0.0, toDominant(clipEye, axis),
                                  toDominant(clipMiddle, axis));
#else
    BoundarySum sum = BoundarySum(0.0, vec2(0.0), vec3(1.0), vec3(-1.0));
#endif
    addEdge(sum, t.ab);
    addEdge(sum, t.bc);
    addEdge(sum, t.ca);
    addSides(sum, t, 0);
    addSides(sum, t, 1);
    addSides(sum, t, 2);
    return polygonOf(sum, a, normal, axis);
}
