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
// a ray that leaves a wall never meets that wall's own voxels. One loop; a step leaves a voxel or an empty
// cube of bricks. Measured against seven other shapes: docs/theory/4_gather.md.
//
// RAY_BACK_FACES 1: a surface met from behind ends the ray, with backFirst. 0: it is not there, which costs
// less. Closed objects look the same from outside either way.
//
// Before the call: SurfaceVoxels::bind, OctantWords::bind.
#ifndef RAY_BACK_FACES
#define RAY_BACK_FACES 0
#endif
#include "lib/lookup_count.glsl"
#include "lib/record_steps.glsl"
#include "lib/voxel_grid.glsl"
#include "lib/voxel_record.glsl"
layout(binding = UNIT_VOXEL_BRICKS) uniform usampler3D voxelBricks;
layout(binding = UNIT_VOXEL_RECORDS) uniform usamplerBuffer voxelRecords;
layout(binding = UNIT_VOXEL_FACES) uniform usamplerBuffer voxelFaces;
layout(binding = IMAGE_VOXEL_OCTANTS, rg32ui) readonly uniform uimage3D voxelOctants;

struct VoxelHit {
    int face;        // index of the face record; -1: nothing was met
    float t;         // distance in voxels; tMax when nothing was met
    bool backFirst;  // only with RAY_BACK_FACES: a surface was met from behind, before anything else
};

// A face is met when its normal turns against the ray by more than this: flatter crossings have no
// usable distance. From the accuracy experiments, as the next three.
const float kRayFacing = 1e-3;
const float kRayNear = 0.05;        // a ray starts this far in front of its surface, voxels
const float kRayStart = 1e-3;       // nearest crossing that counts, voxels
const float kRayBoundsSlack = 0.1;  // a face's bounds are grown by this, voxels
// But shrunk by this for crossings before kRayNear, along the surface: there lies the other wall of a corner,
// whose bounds hold the ray's start, or the other side of an edge, whose bounds (rounded outwards by 1/31)
// end below it.
const float kRayBoundsShrink = 0.02;
// A two-sided surface has faces on both sides. Of the surface that a ray leaves the other side does not hide
// it, where plane pieces are not quite where the surface is: neither what is turned from the start by more
// than this cosine and nearer to it than this, in voxels, ...
const float kRayOtherSide = -0.1;
const float kRayOtherNear = 0.5;
// ... nor, met by rays from elsewhere, the insides of solids next to an edge: bounds of reverses that end
// within the voxel are shrunk, too.
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
// With RAY_BACK_FACES also the others: one that is crossed from behind, beyond kRayBackNear and before all
// else, ends the ray. A back behind a front in the same voxel does not: thin walls have both there.
void testVoxelFaces(ivec3 voxel, vec3 origin, vec3 direction, vec3 leaves, uint facing, float tMax,
                    inout VoxelHit hit, inout float weight, inout float tBack) {
    uvec4 word = texelFetch(voxelBricks, voxel >> 2, 0);
    uint record = texelFetch(voxelRecords, int(voxelRecordIndex(word, bitOfVoxel(voxel)))).x;
    // A spare bit of octWord names a voxel that may have none.
    uint directions = brickHas(word.xy, bitOfVoxel(voxel)) ? faceDirections(record) : 0u;
    int base = int(faceBase(record));
    vec3 toCenter = vec3(voxel) + 0.5 - origin;
    COUNT_LOOKUP(facing != 0u ? 2 : 0);
#if RAY_BACK_FACES
    uint left = facing != 0u ? directions : 0u;
#else
    uint left = directions & facing;
#endif
    do {
        COUNT_LOOKUP(left != 0u ? 1 : 0);
        uint lowest = left & (0u - left);
        int face = base + bitCount(directions & (max(lowest, 1u) - 1u));
        uvec4 r = texelFetch(voxelFaces, 2 * (left != 0u ? face : 0));
        vec3 n = octDecode(unpackSnorm2x16(r.x));
        float towards = dot(n, direction);
        float ahead = unpackOffset(r.y) + dot(n, toCenter);
        float t = ahead / (abs(towards) > kRayFacing ? towards : -kRayFacing);
        vec3 at = t * direction - toCenter + 0.5;
        vec3 shrunk = (kRayBoundsSlack + kRayBoundsShrink) * n * n - kRayBoundsShrink;
        vec3 slack = t > kRayNear ? vec3(kRayBoundsSlack) : shrunk;
        vec3 lower = unpackBoundsMin(r.z);
        vec3 upper = unpackBoundsMax(r.z);
        bool reverse = (r.z & FACE_REVERSE) != 0u;
        vec3 below = reverse ? mix(slack, shrunk, greaterThan(lower, vec3(0.0))) : slack;
        vec3 above = reverse ? mix(slack, shrunk, lessThan(upper, vec3(1.0))) : slack;
        bool own = (r.z & FACE_TWO_SIDED) != 0u && dot(n, leaves) < kRayOtherSide && ahead > -kRayOtherNear;
        bool inside = left != 0u && !own && t < tMax && all(greaterThanEqual(at, lower - below)) &&
                      all(lessThanEqual(at, upper + above));
        float w = unpackWeight(r.y);
        bool nearer = hit.face < 0 || t < hit.t - kRayTie || (t <= hit.t + kRayTie && w > weight);
        bool better = inside && towards < -kRayFacing && t > kRayStart && nearer;
#if RAY_BACK_FACES
        better = better && (lowest & facing) != 0u;
        bool back = inside && towards > kRayFacing && t > kRayBackNear && (lowest & facing) == 0u;
        tBack = back ? min(tBack, t) : tBack;
#endif
        hit.face = better ? face : hit.face;
        hit.t = better ? t : hit.t;
        weight = better ? w : weight;
        left ^= lowest;
    } while (left != 0u);
}

// `leaves`: normal of the surface that the ray starts from, or 0.
VoxelHit traceVoxels(vec3 origin, vec3 direction, float tMax, vec3 leaves) {
    ivec3 bricks = gridBricks();
    vec3 size = vec3(gridSize());
    vec3 inverse = rayInverse(direction);
    bvec3 forward = greaterThanEqual(direction, vec3(0.0));
    ivec3 pos = ivec3(forward);
    int octantX = (7 - (pos.x | (pos.y << 1) | (pos.z << 2))) * bricks.x;
    // Faces that look against the ray: -k for the positive components.
    uint facing = (forward.x ? 2u : 1u) | (forward.y ? 8u : 4u) | (forward.z ? 32u : 16u);

    // An empty cube ends so far from its first brick's lowest corner: nearSide + 4 reach, negated when it
    // goes down.
    ivec3 turn = pos - 1;
    ivec3 nearSide = 4 - 4 * pos;

    // Clipped to the grid. All that follows counts from the entry, where rounding is least.
    vec3 enter = (mix(size, vec3(0.0), forward) - origin) * inverse;
    vec3 leave = (mix(vec3(0.0), size, forward) - origin) * inverse;
    float tEnter = max(max(enter.x, enter.y), max(enter.z, 0.0));
    float tEnd = min(min(min(leave.x, leave.y), leave.z) - kRayEnd, tMax);
    VoxelHit hit = VoxelHit(-1, tMax, false);
    bool alive = tEnd > tEnter;
    float t = alive ? tEnter : 0.0;
    tEnd = alive ? tEnd : -3e38;  // below every t, also those of cells behind the origin
    ivec3 last = gridSize() - 1;
    ivec3 cell = clamp(ivec3(floor(origin + t * direction)), ivec3(0), last);
    float weight = 0.0;
    float tBack = tMax;
    do {
        bool candidate;
        ivec3 at;
        do {
            ivec3 brick = cell >> 2;
            COUNT_LOOKUP(alive ? 1 : 0);
            uvec2 word = imageLoad(voxelOctants, ivec3(brick.x + octantX, brick.yz)).xy;
            int empty = word.y == OCTANT_EMPTY ? int(word.x) : 0;
            word = empty > 0 ? uvec2(0u) : word;
#if RAY_BACK_FACES
            // Faces that look the other way are what the opposite octant's rays meet; nothing is known of how
            // far they are.
            uvec2 backs = imageLoad(voxelOctants, ivec3(brick.x + 7 * bricks.x - octantX, brick.yz)).xy;
            bool none = backs.y == OCTANT_EMPTY;
            word |= none ? uvec2(0u) : backs;
            empty = none ? min(empty, 1) : 0;
#endif
            candidate = brickHas(word, bitOfVoxel(cell));
            at = cell;
#ifdef RECORD_STEPS
            float edge = empty > 0 ? float(4 * empty) : 1.0;
            if (alive)
                RECORD_STEP(empty > 0   ? STEP_EMPTY
                            : candidate ? STEP_TESTED
                                        : STEP_VOXEL,
                            worldFromGrid(origin + t * direction), t * grid.voxelSize, edge * grid.voxelSize,
                            log2(edge), vec3(0.0), 0.0, 0.0);
#endif
            // The planes through which the voxel, or the empty cube, is left.
            ivec3 border = empty > 0 ? (cell & ~3) + nearSide + ((4 * empty) ^ turn) - turn : cell + pos;
            vec3 exits = (vec3(border) - origin) * inverse;
            t = min(exits.x, min(exits.y, exits.z));
            ivec3 there = ivec3(floor(origin + t * direction));
            there = clamp(there, min(cell, border), max(cell, border - 1));
            cell = clamp(mix(there, border - 1 + pos, lessThanEqual(exits, vec3(t))), ivec3(0), last);
        } while (!candidate && t < tEnd);
        uint tested = candidate && alive ? facing : 0u;
        testVoxelFaces(at, origin, direction, leaves, tested, tMax, hit, weight, tBack);
    } while (hit.face < 0 && tBack == tMax && t < tEnd);
    if (tBack < hit.t) hit = VoxelHit(-1, tBack, true);
    return hit;
}

bool voxelsOcclude(vec3 origin, vec3 direction, float tMax) {
    return traceVoxels(origin, direction, tMax, vec3(0.0)).face >= 0;
}
