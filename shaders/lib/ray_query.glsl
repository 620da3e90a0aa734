// SPDX-License-Identifier: MIT
// Ray casting through the surface voxels: Ray -> VoxelHit, the first face that the ray hits. Faces are hit by
// their plane piece and bounds (shared/voxels.h), not by the voxel's cube. Back faces are transparent.
// Method: docs/theory/4b_rays.md, "A ray"; C++ twin: src/voxels/ray_query.h.
//
// Coordinates are those of the grid, in voxels (lib/voxel_grid.glsl), so that t is a distance in voxels. Rays
// may start and end outside the grid and may be parallel to axes.
//
// Empty space is skipped by octWord: one texel per brick of 4^3 voxels and octant of directions. It holds the
// voxels with a face towards the octant, and the edge of the empty cube that starts here and reaches forward.
// A ray that leaves a wall never tests that wall's own voxels. One step leaves an empty cube of bricks, an
// empty block of 2^3 voxels, or one voxel.
//
// NESTED_GRIDS 1: a ray goes through the levels that it meets one after the other, in coordinates of each
// (lib/level_path.glsl). Ray, VoxelHit and t are in those of level 0; lengths named voxels below are the level's.
//
// TRIANGLE_HITS 1: rays with rayCone.width >= 0 hit the triangles of the voxels instead of their plane pieces
// (lib/triangle_hit.glsl). NEAR_TRIANGLES 1: all rays hit triangles in the voxels that they enter within
// kRayNearReach of their start, and plane pieces after that.
#include "lib/dot.glsl"
#include "lib/execution.glsl"
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
#ifndef NEAR_TRIANGLES
#define NEAR_TRIANGLES 0
#endif
struct VoxelHit {
    int face;  // index of the face record; -1: a miss
    float t;   // distance in voxels; tMax for a miss
#if TRIANGLE_HITS
    int triangle;      // -1: a plane piece
    vec2 barycentric;  // of the triangle's second and third corner
#endif
#if NEAR_TRIANGLES
    bool near;    // a triangle within kRayNearReach of the ray's start
    vec3 normal;  // of that, unit, against the ray
#endif
};

// ---- Constants ------------------------------------------------------------------------------------------
// Fitted on rays through boxes, spheres, textured and thin walls (tests/gl/ray_query_test.cpp): the values
// with the fewest rays that pass a wall or meet their own surface.

// A face is hit only if the cosine between its normal and the reversed ray exceeds this. Flatter crossings
// have no usable distance.
const float kRayFacing = 1e-3;
const float kRayNear = 0.05;      // offset of a ray's origin along the normal, voxels
const float kRayStart = 1e-3;     // nearest crossing that counts, voxels
const float kRayTie = 0.5;        // voxels: among crossings this close together the largest coverage wins
const float kRayEnd = 1e-3;       // voxels: rays end this far inside the grid, so that rounding stays in it
const float kRayNearReach = 1.0;  // voxels, with NEAR_TRIANGLES
const float kRayBackNear = 1.5;   // voxels: back faces nearer than this belong to the ray's own surface
// A two-sided surface has faces on both sides. The far side of the surface that a ray starts on is ignored,
// because plane pieces of a curved surface lie beside it: normals whose cosine with the start normal is below
// the first value, on planes less than the second (voxels) in front of the origin.
const float kRayOtherSide = -0.1;
const float kRayOtherNear = 0.5;

// ---- Rays -----------------------------------------------------------------------------------------------

struct Ray {
    vec3 origin;       // grid coordinates
    vec3 direction;    // unit
    float tMax;        // voxels; negative: the ray hits nothing
    vec3 startNormal;  // geometric normal of the surface that the ray starts on; 0: none
};

// The only offset along the normal, voxels. Triangles are where they are seen, but for the rounding of
// positions: 3e-5 of their distance from the eye.
#if NEAR_TRIANGLES
const float kRayOffset = 0.01;
#else
const float kRayOffset = kRayNear;
#endif
#if NESTED_GRIDS
vec3 rayOrigin(vec3 pointGrid, vec3 geometricNormal) {
    return pointGrid + kRayOffset * voxelEdgeAt(pointGrid) * geometricNormal;
}
#else
vec3 rayOrigin(vec3 pointGrid, vec3 geometricNormal) { return pointGrid + kRayOffset * geometricNormal; }
#endif

// Origin at a point that the camera sees: offset towards the eye as well, where space is empty. A pixel in a
// corner lies on both walls, or behind one of them by rounding.
vec3 seenRayOrigin(vec3 pointGrid, vec3 geometricNormal, vec3 toEye) {
#if NESTED_GRIDS
    return pointGrid + kRayOffset * voxelEdgeAt(pointGrid) * (geometricNormal + toEye);
#else
    return rayOrigin(pointGrid, geometricNormal) + kRayOffset * toEye;
#endif
}

// Height above the surface at which a ray starts that meets triangles from there on: kStartVoxels, or this part of the
// distance to the eye, three times what positions err; and the cosine below which it is no longer kept.
const float kStartDepth = 1e-4;
const float kStartCosine = 0.05;

// Where on its own line such a ray starts, m from the surface: moved along the normal it would meet what is beside.
// `towards`: cosine between the ray and the geometric normal; `depth`: of the surface, m.
float startOnLine(float towards, float depth) {
    return max(kStartVoxels * grid.voxelSize, kStartDepth * depth) / max(towards, kStartCosine);
}

// 1 / direction; 1e7 where that is larger, so that no product with it is NaN.
vec3 rayInverse(vec3 direction) {
    vec3 safe = mix(vec3(1.0), direction, greaterThan(abs(direction), vec3(1e-7)));
    return mix(vec3(1e7), 1.0 / safe, greaterThan(abs(direction), vec3(1e-7)));
}

#include "lib/level_path.glsl"

// Bounds of all voxels in grid coordinates, and how far before its border rays end.
struct VoxelBounds {
    vec3 lowest, highest;
    float margin;
};
VoxelBounds voxelBounds() {
#if NESTED_GRIDS
    vec4 place = levelPlace(coarsestLevel());
    return VoxelBounds(place.xyz, place.xyz + place.w * levelSize(), kRayEnd * place.w);
#else
    return VoxelBounds(vec3(0.0), vec3(gridSize()), kRayEnd);
#endif
}

// ---- Faces of one voxel ---------------------------------------------------------------------------------

// Whether a crossing at distance t, at `position` in the voxel, lies within the bounds of a face.
bool insideRayBounds(uint bounds, vec3 n, float t, vec3 position) {
    vec3 shrunk = (kRayBoundsSlack + kRayBoundsShrink) * n * n - kRayBoundsShrink;
    vec3 grown = (kRayBoundsSlack - kRayBoundsOverlap) * n * n + kRayBoundsOverlap;
    vec3 slack = t > kRayNear ? grown : shrunk;
    vec3 lower = unpackBoundsMin(bounds);
    vec3 upper = unpackBoundsMax(bounds);
    vec3 below = mix(slack, shrunk, greaterThan(lower, vec3(0.0)));
    vec3 above = mix(slack, shrunk, lessThan(upper, vec3(1.0)));
    return all(greaterThanEqual(position, lower - below)) && all(lessThanEqual(position, upper + above));
}

// Tests the faces of a voxel whose direction is in the mask `facing`. The nearest crossing wins; among ties
// the largest coverage.
void testVoxelFaces(ivec3 voxel, Ray ray, uint facing, inout VoxelHit hit, inout float hitCoverage) {
#if EXECUTION_GPU
    if (facing == 0u) return;
    uvec4 word = texelFetch(voxelBricks, STORED_BRICK(voxel >> 2), 0);  // by the cache of textures
#else
    uvec4 word = imageLoad(voxelBrickImage, STORED_BRICK(voxel >> 2));
#endif
    uint record = texelFetch(voxelRecords, int(voxelRecordIndex(word, bitOfVoxel(voxel)))).x;
    // OCTANT_EMPTY_SPARE names a voxel that may have no faces.
    uint directions = brickHas(word.xy, bitOfVoxel(voxel)) ? faceDirections(record) : 0u;
    int base = int(faceBase(record));
    vec3 toCenter = vec3(voxel) + 0.5 - ray.origin;
    COUNT_LOOKUP(facing != 0u ? 2 : 0);
    uint remaining = directions & facing;
    do {
        // Fetch the next face
        COUNT_LOOKUP(remaining != 0u ? 1 : 0);
        uint lowest = remaining & (0u - remaining);
        int face = base + bitCount(directions & (max(lowest, 1u) - 1u));
        uvec4 r = texelFetch(voxelFaces, remaining != 0u ? face : 0);

        // Intersect its plane (4.10)
        vec3 n = octDecode(unpackSnorm2x16(r.x));
        float cosine = dot(n, ray.direction);
        float planeDistance = unpackOffset(r.y) + dot(n, toCenter);
        float t = planeDistance / min(cosine, -kRayFacing);

        // Reject crossings out of bounds and the far side of the ray's own surface
        bool ownFarSide = (r.z & FACE_TWO_SIDED) != 0u && dot(n, ray.startNormal) < kRayOtherSide &&
                          planeDistance > -kRayOtherNear;
        bool inBounds = insideRayBounds(r.z, n, t, t * ray.direction - toCenter + 0.5);
        bool inside = remaining != 0u && !ownFarSide && t < ray.tMax && inBounds;

        // Keep the nearest
        float coverage = unpackWeight(r.y);
        bool nearer = hit.face < 0 || t < hit.t - kRayTie || (t <= hit.t + kRayTie && coverage > hitCoverage);
        bool better = inside && cosine < -kRayFacing && t > kRayStart && nearer;
        hit.face = better ? face : hit.face;
        hit.t = better ? t : hit.t;
        hitCoverage = better ? coverage : hitCoverage;
        remaining ^= lowest;
    } while (remaining != 0u);
}

#include "lib/triangle_hit.glsl"

// ---- Traversal ------------------------------------------------------------------------------------------

// A ray in the coordinates of its octant, mirrored so that no component of its direction is negative.
struct OctantRay {
    vec3 origin;
    vec3 direction;
    vec3 inverse;  // 1 / direction
    bvec3 mirrored;
    int octantX;  // x of the octant's first brick in octWord
};

OctantRay octantRay(Ray ray) {
    bvec3 mirrored = lessThan(ray.direction, vec3(0.0));
    int octant = int(mirrored.x) | (int(mirrored.y) << 1) | (int(mirrored.z) << 2);
    vec3 direction = abs(ray.direction);
    return OctantRay(mix(ray.origin, vec3(gridSize()) - ray.origin, mirrored), direction,
                     1.0 / max(direction, vec3(1e-7)), mirrored, octant * gridBricks().x);
}

// A walk through the cells of an octant.
struct OctantWalk {
    float t;
    ivec3 cell;
    ivec3 left;  // the last cell on its way with faces towards the octant; kNoVoxel: none
};
const ivec3 kNoVoxel = ivec3(-1);

// Leaves the cell: an empty cube of bricks, an empty block of 2^3 voxels, or one voxel. Moves t and the cell to the exit.
// `alive`: others stay where they are. What changes depends on what it was: so it can be used behind a loop
// (shaders/README.md, 5).
void leaveCell(Ray ray, OctantRay mirrored, bool alive, inout OctantWalk walk) {
    // Look up what the cell is part of
    ivec3 brick = walk.cell >> 2;
    COUNT_LOOKUP(alive ? 1 : 0);
    uvec2 word = imageLoad(voxelOctants, STORED_BRICK(ivec3(brick.x + mirrored.octantX, brick.yz))).xy;
    bool empty = word.y == OCTANT_EMPTY;
    bool occupied = !empty && brickHas(word, bitOfVoxel(walk.cell));
    uint half32 = (walk.cell.z & 2) != 0 ? word.y : word.x;
    bool emptyBlock = (half32 >> ((walk.cell.x & 2) + 4 * (walk.cell.y & 2)) & 0x00330033u) == 0u;
    int edge = empty ? 4 * int(word.x) : (emptyBlock ? 2 : 1);
#ifdef RECORD_STEPS
    if (alive)
        RECORD_STEP(occupied ? STEP_TESTED : (edge > 1 ? STEP_EMPTY : STEP_VOXEL),
                    worldFromGrid(GRID_POINT(ray.origin + walk.t * ray.direction)),
                    GRID_LENGTH(walk.t) * grid.voxelSize, GRID_LENGTH(float(edge)) * grid.voxelSize,
                    log2(float(edge)), vec3(0.0), 0.0, 0.0);
#endif

    // Step through its exit plane
    walk.left = occupied && alive ? walk.cell : walk.left;
    ivec3 border = (walk.cell & (empty ? ~3 : (emptyBlock ? ~1 : ~0))) + edge;
    vec3 exits = (vec3(border) - mirrored.origin) * mirrored.inverse;
    walk.t = alive ? min(exits.x, min(exits.y, exits.z)) : walk.t;
    // Beyond the grid's border t is beyond the ray's end.
    ivec3 next = clamp(ivec3(mirrored.origin + walk.t * mirrored.direction), walk.cell, border - 1);
    walk.cell = alive ? mix(next, border, lessThanEqual(exits, vec3(walk.t))) : walk.cell;
}

// On to the next voxel with faces towards the octant; walk.left is kNoVoxel where there is none before `end`, and what is
// returned any voxel.
ivec3 nextVoxel(Ray ray, OctantRay mirrored, bool alive, float end, inout OctantWalk walk) {
    ivec3 last = gridSize() - 1;
    walk.left = kNoVoxel;
    do leaveCell(ray, mirrored, alive, walk);
    while (walk.left.x < 0 && walk.t < end);
    ivec3 left = max(walk.left, ivec3(0));
    return mix(left, last - left, mirrored.mirrored);
}

// Directions of faces that look against a ray: -k where the component along k is not negative.
uint facingRay(bvec3 mirrored) {
    return (mirrored.x ? 1u : 2u) | (mirrored.y ? 4u : 8u) | (mirrored.z ? 16u : 32u);
}

#if NEAR_TRIANGLES || TRIANGLE_HITS
// On to the first triangle before `end` that is no hole; negative: none.
TriangleCrossing nextTriangle(Ray ray, OctantRay mirrored, float end, inout OctantWalk walk) {
    bool alive = end >= 0.0;
    TriangleCrossing met, passed = noCrossing(ray);
    bool hole;
    do {
        met = noCrossing(ray);
        do {
            ivec3 voxel = nextVoxel(ray, mirrored, alive, end, walk);
            nearestTriangle(voxel, ray, walk.left.x >= 0, passed, met);
            passed = noCrossing(ray);
        } while (met.triangle < 0 && walk.t < end);
        // Behind a hole once more from its voxel on
        hole = isHole(met);
        passed = met;
        if (hole) walk.cell = walk.left;
    } while (hole);
    return met;
}
#endif

#if NEAR_TRIANGLES
#if BLOCKING_TRIANGLES
// A ray's own way through all voxels: not only those with faces towards it, as single-sided sheets have none on their back.
struct VoxelWalk {
    vec3 inverse;
    bvec3 forward;
    float t;
    float end;
    ivec3 cell;
    ivec3 left;  // the last voxel on its way; kNoVoxel: none
};

// Leaves a brick without voxels, or the place of a voxel, which is kept if there is one.
void leaveVoxel(Ray ray, bool alive, inout VoxelWalk walk) {
    ivec3 last = gridSize() - 1;
    COUNT_LOOKUP(alive ? 1 : 0);
    uvec2 word = imageLoad(voxelBrickImage, STORED_BRICK(walk.cell >> 2)).xy;
    walk.left = brickHas(word, bitOfVoxel(walk.cell)) ? walk.cell : walk.left;
    int edge = word == uvec2(0u) ? 4 : 1;
    ivec3 lower = walk.cell & ~(edge - 1);
    vec3 exits = (vec3(lower) + mix(vec3(0.0), vec3(edge), walk.forward) - ray.origin) * walk.inverse;
    walk.t = alive ? min(exits.x, min(exits.y, exits.z)) : walk.t;
    ivec3 next = clamp(ivec3(floor(ray.origin + walk.t * ray.direction)), lower, lower + (edge - 1));
    ivec3 cell = mix(next, mix(lower - 1, lower + edge, walk.forward), lessThanEqual(exits, vec3(walk.t)));
    walk.cell = clamp(cell, ivec3(0), last);
    walk.end = all(equal(cell, walk.cell)) ? walk.end : -3e38;
}

// Whether a ray that starts within the grid meets no triangle up to its tMax; `otherwise` where a software driver gave
// up.
bool reachesEndInGrid(Ray ray, float begin, bool otherwise) {
    bool alive = ray.tMax > 0.0;
    VoxelWalk walk = VoxelWalk(
        rayInverse(ray.direction), greaterThan(ray.direction, vec3(0.0)), begin, alive ? ray.tMax : -3e38,
        clamp(ivec3(floor(ray.origin + begin * ray.direction)), ivec3(0), gridSize() - 1), kNoVoxel);
    int blocker = -1;
    do {
        // On to the next voxel
        walk.left = kNoVoxel;
        do leaveVoxel(ray, alive, walk);
        while (walk.left.x < 0 && walk.t < walk.end);
        findBlocker(max(walk.left, ivec3(0)), ray, walk.left.x >= 0 && alive, blocker);
    } while (blocker < 0 && walk.t < walk.end);
    return blocker < 0 && (walk.t >= walk.end || otherwise);
}

bool reachesEnd(Ray ray, bool otherwise) {
#if NESTED_GRIDS
    LevelPath path = levelPath(ray);
    bool reached, goesOn;
    do {
        Ray own = enterLevel(ray, path);
        own.tMax = path.end * path.inverse;
        reached = reachesEndInGrid(own, path.begin * path.inverse, otherwise);
        goesOn = reached && path.goesOn;
        if (goesOn) leaveLevel(ray, path);
    } while (goesOn);
    return reached;
#else
    return reachesEndInGrid(ray, 0.0, otherwise);
#endif
}
#endif

// The nearest triangle on a ray that starts within the grid. `reached`: it met none up to its tMax. Neither
// where a software driver gave up.
TriangleCrossing traceTrianglesInGrid(Ray ray, out bool reached) {
    ivec3 last = gridSize() - 1;
    OctantRay mirrored = octantRay(ray);
    vec3 leave = (vec3(gridSize()) - mirrored.origin) * mirrored.inverse;
    bool alive = ray.tMax > 0.0;
    float end = alive ? min(min(min(leave.x, leave.y), leave.z) - kRayEnd, ray.tMax) : -3e38;
    OctantWalk walk = OctantWalk(0.0, clamp(ivec3(floor(mirrored.origin)), ivec3(0), last), kNoVoxel);
    TriangleCrossing hit = nextTriangle(ray, mirrored, end, walk);
    reached = hit.triangle < 0 && walk.t >= end;
    return hit;
}

// With nested grids within the level that it starts in.
TriangleCrossing traceTriangles(Ray ray, out bool reached) {
#if NESTED_GRIDS
    LevelPath path = levelPath(ray);
    TriangleCrossing hit = traceTrianglesInGrid(enterLevel(ray, path), reached);
    hit.t *= path.edge;
    return hit;
#else
    return traceTrianglesInGrid(ray, reached);
#endif
}
#endif

#if NEAR_TRIANGLES || TRIANGLE_HITS
// Tests the triangles of the voxels that a ray enters before `end`, and goes to where it stops. Negative: none, and it
// stays.
void testTriangles(Ray ray, OctantRay mirrored, float end, inout OctantWalk walk, inout VoxelHit hit) {
    TriangleCrossing met = nextTriangle(ray, mirrored, end, walk);
    if (met.triangle >= 0) hit = hitOf(met);
}
#endif

#if NESTED_GRIDS
// In one level; `span` of t, triangles up to nearEnd.
VoxelHit traceLevel(Ray ray, vec2 span, float nearEnd) {
#else
VoxelHit traceVoxels(Ray ray) {
    vec3 size = vec3(gridSize());
#endif
    ivec3 last = gridSize() - 1;
    OctantRay mirrored = octantRay(ray);
    uint facing = facingRay(mirrored.mirrored);

#if NESTED_GRIDS
    float tEnter = span.x, tEnd = span.y;
#else
    // Clip the ray to the grid; t counts from the entry, where rounding is least
    vec3 enter = -mirrored.origin * mirrored.inverse;
    vec3 leave = (size - mirrored.origin) * mirrored.inverse;
    float tEnter = max(max(enter.x, enter.y), max(enter.z, 0.0));
    float tEnd = min(min(min(leave.x, leave.y), leave.z) - kRayEnd, ray.tMax);
#endif
#if TRIANGLE_HITS
    VoxelHit hit = VoxelHit(-1, ray.tMax, -1, vec2(0.0));
#elif NEAR_TRIANGLES
    VoxelHit hit = VoxelHit(-1, ray.tMax, false, vec3(0.0));
#else
VoxelHit hit = VoxelHit(-1, ray.tMax);
#endif
    bool alive = tEnd > tEnter;
    float t = alive ? tEnter : 0.0;
    tEnd = alive ? tEnd : -3e38;  // below every t, also those of cells behind the origin
    ivec3 cell = clamp(ivec3(floor(mirrored.origin + t * mirrored.direction)), ivec3(0), last);
    OctantWalk walk = OctantWalk(t, cell, kNoVoxel);
    float hitCoverage = 0.0;
#if NEAR_TRIANGLES
#if NESTED_GRIDS
    if (nearEnd > tEnter) testTriangles(ray, mirrored, min(tEnd, nearEnd), walk, hit);
#else
    testTriangles(ray, mirrored, min(tEnd, kRayNearReach), walk, hit);
#endif
    if (hit.face >= 0 || walk.t >= tEnd) return hit;
#endif
#if TRIANGLE_HITS
    bool triangles = rayCone.width >= 0.0;
    testTriangles(ray, mirrored, triangles ? tEnd : -3e38, walk, hit);
    alive = alive && !triangles;
    tEnd = triangles ? -3e38 : tEnd;
#endif
    do {
        ivec3 voxel = nextVoxel(ray, mirrored, alive, tEnd, walk);
        testVoxelFaces(voxel, ray, walk.left.x >= 0 ? facing : 0u, hit, hitCoverage);
    } while (hit.face < 0 && walk.t < tEnd);
    return hit;
}

#if NESTED_GRIDS
VoxelHit traceVoxels(Ray ray) {
    LevelPath path = levelPath(ray);
    float nearEnd = kRayNearReach * path.edge;
    VoxelHit hit;
    bool goesOn;
    do {
        vec2 span = vec2(path.begin, path.end) * path.inverse;
        hit = traceLevel(enterLevel(ray, path), span, nearEnd * path.inverse);
        goesOn = hit.face < 0 && path.goesOn;
        // A ray that ends keeps its level: Mesa's software driver (22.3) moves what is used behind a loop out of it, with
        // what the loop's last turn leaves in all lanes.
        if (goesOn) leaveLevel(ray, path);
    } while (goesOn);
    hit.t = hit.face < 0 ? ray.tMax : hit.t * path.edge;
    return hit;
}
#endif
