// SPDX-License-Identifier: MIT
// Rays through the surface voxels: origin, direction -> the face that is met first, by the plane piece and
// the bounds that the face records (shared/voxels.h), not by the voxel's cube. Method and figures:
// docs/theory/4_gather.md, "A ray"; C++ twin: src/voxels/ray_query.h.
//
// Coordinates are those of the grid, in voxels (lib/voxel_grid.glsl); directions are unit vectors, so that t
// is a distance in voxels. Rays may start and end anywhere, also outside the grid, and may be parallel to
// axes.
//
// Empty space is crossed by octWord: one texel per brick of 4^3 and octant of directions, with the voxels
// that hold a face towards the octant and the edge of the empty cube that starts here and reaches forward. So
// a ray that leaves a wall never meets that wall's own voxels. One loop; a step leaves a voxel, an empty
// block of 2^3, or an empty cube of bricks. Measured against seven other shapes: docs/theory/4_gather.md.
// A surface that is met from behind is not there.
//
// TRIANGLE_HITS 1: rays of which rayCone.width is not negative meet the triangles of the voxels, not their
// plane pieces (lib/triangle_hit.glsl).
//
// Before the call: SurfaceVoxels::bind, OctantWords::bind.
#include "lib/lookup_count.glsl"
#include "lib/record_steps.glsl"
#include "lib/voxel_grid.glsl"
#include "lib/voxel_record.glsl"
uniform usampler3D voxelBricks;
uniform usamplerBuffer voxelRecords;
uniform usamplerBuffer voxelFaces;
layout(rgba32ui) readonly uniform uimage3D voxelBrickImage;
layout(rg32ui) readonly uniform uimage3D voxelOctants;

#ifndef TRIANGLE_HITS
#define TRIANGLE_HITS 0
#endif
struct VoxelHit {
    int face;  // index of the face record; -1: nothing was met
    float t;   // distance in voxels; tMax when nothing was met
#if TRIANGLE_HITS
    int triangle;  // that was met; -1: a plane piece
    vec2 at;       // barycentric coordinates of its second and third corner
#endif
};

// A face is met when its normal turns against the ray by more than this: flatter crossings have no
// usable distance. From the accuracy experiments, as the next three.
const float kRayFacing = 1e-3;
const float kRayNear = 0.05;   // a ray starts this far in front of its surface, voxels
const float kRayStart = 1e-3;  // nearest crossing that counts, voxels
// A two-sided surface has faces on both sides. Of the surface that a ray leaves the other side does not hide
// it, where plane pieces are not quite where the surface is: what is turned from the start by more than this
// cosine and nearer to it than this, in voxels.
const float kRayOtherSide = -0.1;
const float kRayOtherNear = 0.5;
const float kRayBackNear = 1.5;  // backs nearer than this are the ray's own surface
const float kRayTie = 0.5;       // crossings nearer together than this: the face that covers more
// Stay clear of the grid's far side, so that rounding cannot step out of it.
const float kRayEnd = 1e-3;

// The only offset there is: a ray starts this far in front of its surface.
vec3 rayOrigin(vec3 pointGrid, vec3 geometricNormal) { return pointGrid + kRayNear * geometricNormal; }

// From what a camera sees: also towards the eye, where nothing is. A pixel in a corner lies on both walls, or
// by rounding behind one of them; from there rays would leave the room.
vec3 seenRayOrigin(vec3 pointGrid, vec3 geometricNormal, vec3 toEye) {
    return rayOrigin(pointGrid, geometricNormal) + kRayNear * toEye;
}

// 1 / direction; 1e7 where that is larger, so that no product with it is NaN.
vec3 rayInverse(vec3 direction) {
    vec3 safe = mix(vec3(1.0), direction, greaterThan(abs(direction), vec3(1e-7)));
    return mix(vec3(1e7), 1.0 / safe, greaterThan(abs(direction), vec3(1e-7)));
}

// Tests the faces of a voxel that face the ray. Nearest crossing wins, among equals the largest coverage.
void testVoxelFaces(ivec3 voxel, vec3 origin, vec3 direction, vec3 leaves, uint facing, float tMax,
                    inout VoxelHit hit, inout float weight) {
    uvec4 word = imageLoad(voxelBrickImage, voxel >> 2);
    uint record = texelFetch(voxelRecords, int(voxelRecordIndex(word, bitOfVoxel(voxel)))).x;
    // A spare bit of octWord names a voxel that may have none.
    uint directions = brickHas(word.xy, bitOfVoxel(voxel)) ? faceDirections(record) : 0u;
    int base = int(faceBase(record));
    vec3 toCenter = vec3(voxel) + 0.5 - origin;
    COUNT_LOOKUP(facing != 0u ? 2 : 0);
    uint left = directions & facing;
    do {
        COUNT_LOOKUP(left != 0u ? 1 : 0);
        uint lowest = left & (0u - left);
        int face = base + bitCount(directions & (max(lowest, 1u) - 1u));
        uvec4 r = texelFetch(voxelFaces, 2 * (left != 0u ? face : 0));
        vec3 n = octDecode(unpackSnorm2x16(r.x));
        float towards = dot(n, direction);
        float ahead = unpackOffset(r.y) + dot(n, toCenter);
        float t = ahead / min(towards, -kRayFacing);
        vec3 at = t * direction - toCenter + 0.5;
        vec3 shrunk = (kRayBoundsSlack + kRayBoundsShrink) * n * n - kRayBoundsShrink;
        vec3 grown = (kRayBoundsSlack - kRayBoundsOverlap) * n * n + kRayBoundsOverlap;
        vec3 slack = t > kRayNear ? grown : shrunk;
        vec3 lower = unpackBoundsMin(r.z);
        vec3 upper = unpackBoundsMax(r.z);
        vec3 below = mix(slack, shrunk, greaterThan(lower, vec3(0.0)));
        vec3 above = mix(slack, shrunk, lessThan(upper, vec3(1.0)));
        bool own = (r.z & FACE_TWO_SIDED) != 0u && dot(n, leaves) < kRayOtherSide && ahead > -kRayOtherNear;
        bool inside = left != 0u && !own && t < tMax && all(greaterThanEqual(at, lower - below)) &&
                      all(lessThanEqual(at, upper + above));
        float w = unpackWeight(r.y);
        bool nearer = hit.face < 0 || t < hit.t - kRayTie || (t <= hit.t + kRayTie && w > weight);
        bool better = inside && towards < -kRayFacing && t > kRayStart && nearer;
        hit.face = better ? face : hit.face;
        hit.t = better ? t : hit.t;
        weight = better ? w : weight;
        left ^= lowest;
    } while (left != 0u);
}

#include "lib/triangle_hit.glsl"

// `leaves`: normal of the surface that the ray starts from, or 0.
VoxelHit traceVoxels(vec3 origin, vec3 direction, float tMax, vec3 leaves) {
    vec3 size = vec3(gridSize());
    ivec3 last = gridSize() - 1;
    bvec3 down = lessThan(direction, vec3(0.0));
    int octantX = (int(down.x) | (int(down.y) << 1) | (int(down.z) << 2)) * gridBricks().x;
    // Faces that look against the ray: -k for the components that are not negative.
    uint facing = (down.x ? 1u : 2u) | (down.y ? 4u : 8u) | (down.z ? 16u : 32u);

    // In the octant's own coordinates, mirrored so that no ray goes down.
    vec3 from = mix(origin, size - origin, down);
    vec3 along = abs(direction);
    vec3 inverse = 1.0 / max(along, vec3(1e-7));

    // Clipped to the grid. All that follows counts from the entry, where rounding is least.
    vec3 enter = -from * inverse;
    vec3 leave = (size - from) * inverse;
    float tEnter = max(max(enter.x, enter.y), max(enter.z, 0.0));
    float tEnd = min(min(min(leave.x, leave.y), leave.z) - kRayEnd, tMax);
#if TRIANGLE_HITS
    VoxelHit hit = VoxelHit(-1, tMax, -1, vec2(0.0));
#else
    VoxelHit hit = VoxelHit(-1, tMax);
#endif
    bool alive = tEnd > tEnter;
    float t = alive ? tEnter : 0.0;
    tEnd = alive ? tEnd : -3e38;  // below every t, also those of cells behind the origin
    ivec3 cell = clamp(ivec3(floor(from + t * along)), ivec3(0), last);
    float weight = 0.0;
    do {
        bool candidate;
        ivec3 at;
        do {
            ivec3 brick = cell >> 2;
            COUNT_LOOKUP(alive ? 1 : 0);
            uvec2 word = imageLoad(voxelOctants, ivec3(brick.x + octantX, brick.yz)).xy;
            bool empty = word.y == OCTANT_EMPTY;
            candidate = !empty && brickHas(word, bitOfVoxel(cell));
            at = cell;
            // What is left behind: the empty cube of bricks, the empty block of 2^3 voxels, the voxel.
            uint half32 = (cell.z & 2) != 0 ? word.y : word.x;
            bool emptyBlock = (half32 >> ((cell.x & 2) + 4 * (cell.y & 2)) & 0x00330033u) == 0u;
            int edge = empty ? 4 * int(word.x) : (emptyBlock ? 2 : 1);
            ivec3 border = (cell & (empty ? ~3 : (emptyBlock ? ~1 : ~0))) + edge;
#ifdef RECORD_STEPS
            if (alive)
                RECORD_STEP(candidate  ? STEP_TESTED
                            : edge > 1 ? STEP_EMPTY
                                       : STEP_VOXEL,
                            worldFromGrid(origin + t * direction), t * grid.voxelSize,
                            float(edge) * grid.voxelSize, log2(float(edge)), vec3(0.0), 0.0, 0.0);
#endif
            vec3 exits = (vec3(border) - from) * inverse;
            t = min(exits.x, min(exits.y, exits.z));
            // Beyond the grid's border t is beyond tEnd.
            ivec3 there = clamp(ivec3(from + t * along), cell, border - 1);
            cell = mix(there, border, lessThanEqual(exits, vec3(t)));
        } while (!candidate && t < tEnd);
        uint tested = candidate && alive ? facing : 0u;
#if TRIANGLE_HITS
        bool triangles = rayCone.width >= 0.0;
        testVoxelTriangles(mix(at, last - at, down), origin, direction, tested != 0u && triangles, tMax, hit);
        tested = triangles ? 0u : tested;
#endif
        testVoxelFaces(mix(at, last - at, down), origin, direction, leaves, tested, tMax, hit, weight);
    } while (hit.face < 0 && t < tEnd);
    return hit;
}

bool voxelsOcclude(vec3 origin, vec3 direction, float tMax) {
    return traceVoxels(origin, direction, tMax, vec3(0.0)).face >= 0;
}
