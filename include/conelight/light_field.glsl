// SPDX-License-Identifier: MIT
// Indirect light in shaders of your own, as a LightField has it (conelight/light_field.h): docs/guide/light_field.md.
// Made of the library's shaders by tools/make_lookups: change those.
//
//   vec3 conelight_irradiance(vec3 position, vec3 normal)
//       Indirect irradiance / pi, W/(sr m^2): times albedo it is radiance. A normal of zero: the mean over all
//       directions, for dust and fog.
//   vec3 conelight_trace(vec3 origin, vec3 direction)
//   vec3 conelight_trace(vec3 origin, vec3 direction, out float distance)
//       Radiance that arrives along a ray, W/(sr m^2); how far it comes from, m, -1: from the surroundings. Rays
//       from surfaces of the scene begin a tenth of conelight_voxelSize before them.
//   float conelight_voxelSize(vec3 position)
//       Edge of the voxels about a point, m. Nested grids have one for each level, other fields one.
//
// World space, metres. Light that comes straight from the scene's lights is not in it, but what surfaces reflect of it
// and what glows is. For #version 450 and any stage. Define the first binding point of 3 uniform blocks and the first of
// 7 texture units before, or leave them at 0; LightField::bindLookups binds them.
#ifndef CONELIGHT_LIGHT_FIELD_GLSL
#define CONELIGHT_LIGHT_FIELD_GLSL
#ifndef CONELIGHT_FIRST_BLOCK
#define CONELIGHT_FIRST_BLOCK 0
#endif
#ifndef CONELIGHT_FIRST_TEXTURE
#define CONELIGHT_FIRST_TEXTURE 0
#endif

float conelight_dot(vec2 a, vec2 b) {
    precise float sum = a.y * b.y + a.x * b.x;
    return sum;
}

float conelight_dot(vec3 a, vec3 b) {
    precise float sum = a.z * b.z + a.y * b.y + a.x * b.x;
    return sum;
}

float conelight_dot(vec4 a, vec4 b) {
    precise float sum = a.w * b.w + a.z * b.z + a.y * b.y + a.x * b.x;
    return sum;
}

vec2 conelight_normalize(vec2 v) { return v * inversesqrt(conelight_dot(v, v)); }

vec3 conelight_normalize(vec3 v) { return v * inversesqrt(conelight_dot(v, v)); }

uint conelight_bitOfVoxel(ivec3 voxel) {
    return uint((voxel.x & 3) | ((voxel.y & 3) << 2) | ((voxel.z & 3) << 4));
}

bool conelight_brickHas(uvec2 mask, uint bit) {
    return (((bit < 32u ? mask.x : mask.y) >> (bit & 31u)) & 1u) != 0u;
}

uint conelight_brickRank(uvec2 mask, uint bit) {
    uint below = (1u << (bit & 31u)) - 1u;
    return bit < 32u ? uint(bitCount(mask.x & below))
                     : uint(bitCount(mask.x)) + uint(bitCount(mask.y & below));
}

uint conelight_voxelRecordIndex(uvec4 brickWord, uint bit) {
    return brickWord.z + conelight_brickRank(brickWord.xy, bit);
}

uint conelight_faceBase(uint record) { return record & 0x3ffffffu; }

uint conelight_faceDirections(uint record) { return record >> 26; }

struct conelight_VoxelGrid {
    vec3 origin;
    float voxelSize;
    uint sizeX;
    uint sizeY;
    uint sizeZ;
    uint voxelCount;
    uint bricksX;
    uint bricksY;
    uint bricksZ;
    uint faceCount;
    float inverseVoxelSize;
    uint occupiedBricks;
    uint pad0;
    uint pad1;
};

struct conelight_VoxelLevels {
    uint count;
    uint sizeX;
    uint sizeY;
    uint sizeZ;
    vec4 levels[8];
};

layout(std140, binding = CONELIGHT_FIRST_BLOCK + 2) uniform conelight_VoxelLevelBlock {
    conelight_VoxelLevels conelight_voxelLevels;
};

vec3 conelight_levelSize() {
    return vec3(conelight_voxelLevels.sizeX, conelight_voxelLevels.sizeY, conelight_voxelLevels.sizeZ);
}

int conelight_coarsestLevel() { return int(conelight_voxelLevels.count) - 1; }

vec4 conelight_levelPlace(int level) { return conelight_voxelLevels.levels[level]; }

vec3 conelight_levelFromGrid(vec3 point, vec4 place) { return (point - place.xyz) / place.w; }

int conelight_levelAt(vec3 point) {
    int level = conelight_coarsestLevel();
    int i = level - 1;
    while (i >= 0) {
        vec3 within = conelight_levelFromGrid(point, conelight_voxelLevels.levels[i]);
        bool holds = all(greaterThanEqual(within, vec3(0.0))) && all(lessThan(within, conelight_levelSize()));
        level = holds ? i : level;
        --i;
    }
    return level;
}

float conelight_voxelEdgeAt(vec3 point) { return conelight_levelPlace(conelight_levelAt(point)).w; }

layout(std140, binding = CONELIGHT_FIRST_BLOCK + 0) uniform conelight_VoxelGridBlock {
    conelight_VoxelGrid conelight_grid;
};

vec3 conelight_gridFromWorld(vec3 world) {
    return (world - conelight_grid.origin) * conelight_grid.inverseVoxelSize;
}

ivec3 conelight_gridSize() { return ivec3(conelight_grid.sizeX, conelight_grid.sizeY, conelight_grid.sizeZ); }

ivec3 conelight_gridBricks() {
    return ivec3(conelight_grid.bricksX, conelight_grid.bricksY, conelight_grid.bricksZ);
}

vec2 conelight_octWrap(vec2 v) {
    return (1.0 - abs(v.yx)) * vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0);
}

vec3 conelight_octDecode(vec2 p) {
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    if (n.z < 0.0) n.xy = conelight_octWrap(n.xy);
    return conelight_normalize(n);
}

const float conelight_kVoxelWeightScale = 65535.0 / 4.0;

float conelight_unpackOffset(uint bits) { return max(float(int(bits << 16) >> 16) / 32767.0, -1.0); }

float conelight_unpackWeight(uint bits) { return float(bits >> 16) / conelight_kVoxelWeightScale; }

vec3 conelight_unpackBoundsMin(uint bits) { return vec3(uvec3(bits, bits >> 5, bits >> 10) & 31u) / 31.0; }

vec3 conelight_unpackBoundsMax(uint bits) {
    return vec3(uvec3(bits >> 15, bits >> 20, bits >> 25) & 31u) / 31.0;
}

vec3 conelight_unpackAlbedo(uint bits) {
    return vec3(bits & 2047u, (bits >> 11) & 2047u, bits >> 22) / vec3(2047.0, 2047.0, 1023.0);
}

vec3 conelight_unpackRgb9e5(uint bits) {
    return vec3(bits & 511u, (bits >> 9) & 511u, (bits >> 18) & 511u) *
           uintBitsToFloat(((bits >> 27) + 103u) << 23);
}

const float conelight_kRayBoundsSlack = 0.1;

const float conelight_kRayBoundsOverlap = 0.04;

const float conelight_kRayBoundsShrink = 0.02;

layout(binding = CONELIGHT_FIRST_TEXTURE + 0) uniform usampler3D conelight_voxelBricks;

layout(binding = CONELIGHT_FIRST_TEXTURE + 2) uniform usamplerBuffer conelight_voxelRecords;

layout(binding = CONELIGHT_FIRST_TEXTURE + 3) uniform usamplerBuffer conelight_voxelFaces;

layout(binding = CONELIGHT_FIRST_TEXTURE + 1) uniform usampler3D conelight_voxelOctants;

struct conelight_VoxelHit {
    int face;
    float t;
};

const float conelight_kRayFacing = 1e-3;

const float conelight_kRayNear = 0.05;

const float conelight_kRayStart = 1e-3;

const float conelight_kRayTie = 0.5;

const float conelight_kRayEnd = 1e-3;

const float conelight_kRayNearReach = 1.0;

const float conelight_kRayOtherSide = -0.1;

const float conelight_kRayOtherNear = 0.5;

struct conelight_Ray {
    vec3 origin;
    vec3 direction;
    float tMax;
    vec3 startNormal;
};

vec3 conelight_rayInverse(vec3 direction) {
    vec3 safe = mix(vec3(1.0), direction, greaterThan(abs(direction), vec3(1e-7)));
    return mix(vec3(1e7), 1.0 / safe, greaterThan(abs(direction), vec3(1e-7)));
}

int conelight_levelBricksBefore = 0;

vec4 conelight_levelOfRay = vec4(0.0, 0.0, 0.0, 1.0);

struct conelight_LevelPath {
    int level;
    float edge;
    float inverse;
    float begin;
    float end;
    float exit;
    int next;
    bool outward;
    bool goesOn;
};

vec2 conelight_levelSpan(conelight_Ray ray, vec3 inverse, int level) {
    vec4 place = conelight_levelPlace(level);
    vec3 a = (place.xyz - ray.origin) * inverse;
    vec3 b = (place.xyz + place.w * conelight_levelSize() - ray.origin) * inverse;
    vec3 low = min(a, b), high = max(a, b);
    return vec2(max(max(low.x, low.y), low.z), min(min(high.x, high.y), high.z));
}

void conelight_endLevel(conelight_Ray ray, inout conelight_LevelPath path) {
    vec3 inverse = conelight_rayInverse(ray.direction);
    path.edge = conelight_levelPlace(path.level).w;
    path.inverse = 1.0 / path.edge;
    path.exit = conelight_levelSpan(ray, inverse, path.level).y;
    vec2 finer = conelight_levelSpan(ray, inverse, max(path.level - 1, 0));
    bool inward = !path.outward && path.level > 0 && finer.x < finer.y && finer.y > path.begin;
    path.next = inward ? path.level - 1 : path.level + 1;
    path.outward = !inward;
    path.end = min(inward ? finer.x : path.exit - conelight_kRayEnd * path.edge, ray.tMax);
    path.exit = inward ? finer.x : path.exit;
    path.goesOn = path.exit < ray.tMax && path.next <= conelight_coarsestLevel();
}

conelight_LevelPath conelight_levelPath(conelight_Ray ray) {
    conelight_LevelPath path;
    path.level = conelight_levelAt(ray.origin);
    path.outward = false;
    vec2 whole = conelight_levelSpan(ray, conelight_rayInverse(ray.direction), conelight_coarsestLevel());
    path.begin = max(whole.x, 0.0);
    conelight_endLevel(ray, path);
    bool met = whole.x < whole.y && whole.y > 0.0 && path.begin < ray.tMax;
    path.end = met ? path.end : -3e38;
    path.goesOn = met && path.goesOn;
    return path;
}

conelight_Ray conelight_enterLevel(conelight_Ray ray, conelight_LevelPath path) {
    conelight_levelOfRay = conelight_levelPlace(path.level);
    conelight_levelBricksBefore = path.level * int(conelight_grid.bricksZ);
    return conelight_Ray(conelight_levelFromGrid(ray.origin, conelight_levelOfRay), ray.direction,
                         ray.tMax * path.inverse, ray.startNormal);
}

void conelight_leaveLevel(conelight_Ray ray, inout conelight_LevelPath path) {
    path.level = path.next;
    path.begin = max(path.begin, path.exit);
    conelight_endLevel(ray, path);
}

struct conelight_VoxelBounds {
    vec3 lowest, highest;
    float margin;
};

conelight_VoxelBounds conelight_voxelBounds() {
    vec4 place = conelight_levelPlace(conelight_coarsestLevel());
    return conelight_VoxelBounds(place.xyz, place.xyz + place.w * conelight_levelSize(),
                                 conelight_kRayEnd * place.w);
}

bool conelight_insideRayBounds(uint bounds, vec3 n, float t, vec3 position) {
    vec3 shrunk =
        (conelight_kRayBoundsSlack + conelight_kRayBoundsShrink) * n * n - conelight_kRayBoundsShrink;
    vec3 grown =
        (conelight_kRayBoundsSlack - conelight_kRayBoundsOverlap) * n * n + conelight_kRayBoundsOverlap;
    vec3 slack = t > conelight_kRayNear ? grown : shrunk;
    vec3 lower = conelight_unpackBoundsMin(bounds);
    vec3 upper = conelight_unpackBoundsMax(bounds);
    vec3 below = mix(slack, shrunk, greaterThan(lower, vec3(0.0)));
    vec3 above = mix(slack, shrunk, lessThan(upper, vec3(1.0)));
    return all(greaterThanEqual(position, lower - below)) && all(lessThanEqual(position, upper + above));
}

void conelight_testVoxelFaces(ivec3 voxel, conelight_Ray ray, uint facing, inout conelight_VoxelHit hit,
                              inout float hitCoverage) {
    uvec4 word =
        texelFetch(conelight_voxelBricks, ((voxel >> 2) + ivec3(0, 0, conelight_levelBricksBefore)), 0);
    uint record =
        texelFetch(conelight_voxelRecords, int(conelight_voxelRecordIndex(word, conelight_bitOfVoxel(voxel))))
            .x;
    uint directions =
        conelight_brickHas(word.xy, conelight_bitOfVoxel(voxel)) ? conelight_faceDirections(record) : 0u;
    int base = int(conelight_faceBase(record));
    vec3 toCenter = vec3(voxel) + 0.5 - ray.origin;
    uint remaining = directions & facing;
    do {
        uint lowest = remaining & (0u - remaining);
        int face = base + bitCount(directions & (max(lowest, 1u) - 1u));
        uvec4 r = texelFetch(conelight_voxelFaces, remaining != 0u ? face : 0);
        vec3 n = conelight_octDecode(unpackSnorm2x16(r.x));
        float cosine = conelight_dot(n, ray.direction);
        float planeDistance = conelight_unpackOffset(r.y) + conelight_dot(n, toCenter);
        float t = planeDistance / min(cosine, -conelight_kRayFacing);
        bool ownFarSide = (r.z & 0x40000000u) != 0u &&
                          conelight_dot(n, ray.startNormal) < conelight_kRayOtherSide &&
                          planeDistance > -conelight_kRayOtherNear;
        bool inBounds = conelight_insideRayBounds(r.z, n, t, t * ray.direction - toCenter + 0.5);
        bool inside = remaining != 0u && !ownFarSide && t < ray.tMax && inBounds;
        float coverage = conelight_unpackWeight(r.y);
        bool nearer = hit.face < 0 || t < hit.t - conelight_kRayTie ||
                      (t <= hit.t + conelight_kRayTie && coverage > hitCoverage);
        bool better = inside && cosine < -conelight_kRayFacing && t > conelight_kRayStart && nearer;
        hit.face = better ? face : hit.face;
        hit.t = better ? t : hit.t;
        hitCoverage = better ? coverage : hitCoverage;
        remaining ^= lowest;
    } while (remaining != 0u);
}

struct conelight_OctantRay {
    vec3 origin;
    vec3 direction;
    vec3 inverse;
    bvec3 mirrored;
    int octantX;
};

conelight_OctantRay conelight_octantRay(conelight_Ray ray) {
    bvec3 mirrored = lessThan(ray.direction, vec3(0.0));
    int octant = int(mirrored.x) | (int(mirrored.y) << 1) | (int(mirrored.z) << 2);
    vec3 direction = abs(ray.direction);
    return conelight_OctantRay(mix(ray.origin, vec3(conelight_gridSize()) - ray.origin, mirrored), direction,
                               1.0 / max(direction, vec3(1e-7)), mirrored, octant * conelight_gridBricks().x);
}

struct conelight_OctantWalk {
    float t;
    ivec3 cell;
    ivec3 left;
};

const ivec3 conelight_kNoVoxel = ivec3(-1);

void conelight_leaveCell(conelight_Ray ray, conelight_OctantRay mirrored, bool alive,
                         inout conelight_OctantWalk walk) {
    ivec3 brick = walk.cell >> 2;
    uvec2 word =
        texelFetch(conelight_voxelOctants,
                   ((ivec3(brick.x + mirrored.octantX, brick.yz)) + ivec3(0, 0, conelight_levelBricksBefore)),
                   0)
            .xy;
    bool empty = word.y == 0x9d2c5681u;
    bool occupied = !empty && conelight_brickHas(word, conelight_bitOfVoxel(walk.cell));
    uint half32 = (walk.cell.z & 2) != 0 ? word.y : word.x;
    bool emptyBlock = (half32 >> ((walk.cell.x & 2) + 4 * (walk.cell.y & 2)) & 0x00330033u) == 0u;
    int edge = empty ? 4 * int(word.x) : (emptyBlock ? 2 : 1);
    walk.left = occupied && alive ? walk.cell : walk.left;
    ivec3 border = (walk.cell & (empty ? ~3 : (emptyBlock ? ~1 : ~0))) + edge;
    vec3 exits = (vec3(border) - mirrored.origin) * mirrored.inverse;
    walk.t = alive ? min(exits.x, min(exits.y, exits.z)) : walk.t;
    ivec3 next = clamp(ivec3(mirrored.origin + walk.t * mirrored.direction), walk.cell, border - 1);
    walk.cell = alive ? mix(next, border, lessThanEqual(exits, vec3(walk.t))) : walk.cell;
}

ivec3 conelight_nextVoxel(conelight_Ray ray, conelight_OctantRay mirrored, bool alive, float end,
                          inout conelight_OctantWalk walk) {
    ivec3 last = conelight_gridSize() - 1;
    walk.left = conelight_kNoVoxel;
    do conelight_leaveCell(ray, mirrored, alive, walk);
    while (walk.left.x < 0 && walk.t < end);
    ivec3 left = max(walk.left, ivec3(0));
    return mix(left, last - left, mirrored.mirrored);
}

uint conelight_facingRay(bvec3 mirrored) {
    return (mirrored.x ? 1u : 2u) | (mirrored.y ? 4u : 8u) | (mirrored.z ? 16u : 32u);
}

conelight_VoxelHit conelight_traceLevel(conelight_Ray ray, vec2 span, float nearEnd) {
    ivec3 last = conelight_gridSize() - 1;
    conelight_OctantRay mirrored = conelight_octantRay(ray);
    uint facing = conelight_facingRay(mirrored.mirrored);
    float tEnter = span.x, tEnd = span.y;
    conelight_VoxelHit hit = conelight_VoxelHit(-1, ray.tMax);
    bool alive = tEnd > tEnter;
    float t = alive ? tEnter : 0.0;
    tEnd = alive ? tEnd : -3e38;
    ivec3 cell = clamp(ivec3(floor(mirrored.origin + t * mirrored.direction)), ivec3(0), last);
    conelight_OctantWalk walk = conelight_OctantWalk(t, cell, conelight_kNoVoxel);
    float hitCoverage = 0.0;
    do {
        ivec3 voxel = conelight_nextVoxel(ray, mirrored, alive, tEnd, walk);
        conelight_testVoxelFaces(voxel, ray, walk.left.x >= 0 ? facing : 0u, hit, hitCoverage);
    } while (hit.face < 0 && walk.t < tEnd);
    return hit;
}

conelight_VoxelHit conelight_traceVoxels(conelight_Ray ray) {
    conelight_LevelPath path = conelight_levelPath(ray);
    float nearEnd = conelight_kRayNearReach * path.edge;
    conelight_VoxelHit hit;
    bool goesOn;
    do {
        vec2 span = vec2(path.begin, path.end) * path.inverse;
        hit = conelight_traceLevel(conelight_enterLevel(ray, path), span, nearEnd * path.inverse);
        goesOn = hit.face < 0 && path.goesOn;
        if (goesOn) conelight_leaveLevel(ray, path);
    } while (goesOn);
    hit.t = hit.face < 0 ? ray.tMax : hit.t * path.edge;
    return hit;
}

layout(binding = CONELIGHT_FIRST_TEXTURE + 5) uniform usamplerBuffer conelight_litFaces;

vec3 conelight_litIrradiance(uvec4 lit) { return vec3(unpackHalf2x16(lit.z), unpackHalf2x16(lit.w).x); }

layout(binding = CONELIGHT_FIRST_TEXTURE + 4) uniform usamplerBuffer conelight_faceLight;

const float conelight_kLeastAxis = 1e-3;

struct conelight_NormalSum {
    vec3 sum;
    float weights;
    float spread;
};

vec4 conelight_irradianceInGrid(vec3 point, vec3 normal, bool wanted, out conelight_NormalSum bent) {
    vec3 corner = floor(point - 0.5);
    vec3 part = point - 0.5 - corner;
    ivec3 base = ivec3(corner);
    ivec3 last = conelight_gridSize() - 1;
    vec3 square = normal * normal;
    uint facing = (square.x > conelight_kLeastAxis ? (normal.x < 0.0 ? 2u : 1u) : 0u) |
                  (square.y > conelight_kLeastAxis ? (normal.y < 0.0 ? 8u : 4u) : 0u) |
                  (square.z > conelight_kLeastAxis ? (normal.z < 0.0 ? 32u : 16u) : 0u);
    uint corners = 0u;
    for (int i = 0; i < 8; ++i) {
        ivec3 voxel = clamp(base + ivec3(i & 1, (i >> 1) & 1, i >> 2), ivec3(0), last);
        uvec2 mask =
            texelFetch(conelight_voxelBricks, ((voxel >> 2) + ivec3(0, 0, conelight_levelBricksBefore)), 0)
                .xy;
        corners |= conelight_brickHas(mask, conelight_bitOfVoxel(voxel)) ? 1u << i : 0u;
    }
    corners = wanted ? corners : 0u;
    vec4 sum = vec4(0.0);
    bent = conelight_NormalSum(vec3(0.0), 0.0, conelight_dot(part * (1.0 - part), 1.0 - square));
    do {
        bool any = corners != 0u;
        int i = max(findLSB(corners), 0);
        ivec3 offset = ivec3(i & 1, (i >> 1) & 1, i >> 2);
        ivec3 voxel = clamp(base + offset, ivec3(0), last);
        vec3 t = mix(1.0 - part, part, vec3(offset));
        uvec4 word =
            texelFetch(conelight_voxelBricks, ((voxel >> 2) + ivec3(0, 0, conelight_levelBricksBefore)), 0);
        uint record = texelFetch(conelight_voxelRecords,
                                 any ? int(conelight_voxelRecordIndex(word, conelight_bitOfVoxel(voxel))) : 0)
                          .x;
        uint directions = conelight_faceDirections(record);
        int first = int(conelight_faceBase(record));
        uint left = any ? directions & facing : 0u;
        do {
            uint lowest = left & (0u - left);
            int face = left != 0u ? first + bitCount(directions & (lowest - 1u)) : 0;
            uvec2 light = texelFetch(conelight_faceLight, face).xy;
            float share = lowest < 4u ? square.x : (lowest < 16u ? square.y : square.z);
            float weight = left != 0u ? t.x * t.y * t.z * share * conelight_unpackWeight(light.y) : 0.0;
            vec3 irradiance = vec3(unpackHalf2x16(light.x), unpackHalf2x16(light.y).x);
            sum += weight * vec4(irradiance, 1.0);
            left ^= lowest;
        } while (left != 0u);
        corners &= corners - 1u;
    } while (corners != 0u);
    return vec4(sum.rgb / max(sum.a, 1e-12), sum.a);
}

vec4 conelight_cachedIrradiance(vec3 point, vec3 normal, bool wanted, out conelight_NormalSum bent) {
    int own = conelight_levelAt(point), attempts = conelight_coarsestLevel() > 0 ? 3 : 1;
    vec4 found;
    int attempt = 0;
    do {
        int level = clamp(own + (attempt == 2 ? -1 : attempt), 0, conelight_coarsestLevel());
        conelight_levelOfRay = conelight_levelPlace(level);
        conelight_levelBricksBefore = level * int(conelight_grid.bricksZ);
        found = conelight_irradianceInGrid(conelight_levelFromGrid(point, conelight_levelOfRay), normal,
                                           wanted, bent);
    } while (wanted && found.a <= 0.0 && ++attempt < attempts);
    return found;
}

vec4 conelight_cachedIrradiance(vec3 point, vec3 normal, bool wanted) {
    conelight_NormalSum bent;
    return conelight_cachedIrradiance(point, normal, wanted, bent);
}

struct conelight_LightingConstants {
    vec3 sky;
    float environmentScale;
    uvec4 lightEnds;
    float environmentTurn;
    float environmentInverseFlux;
    float environmentLevel0;
    float environmentCellLevel;
};

layout(std140, binding = CONELIGHT_FIRST_BLOCK + 1) uniform conelight_LightingBlock {
    conelight_LightingConstants conelight_lighting;
};

layout(binding = CONELIGHT_FIRST_TEXTURE + 6) uniform sampler2D conelight_environmentPicture;

const float conelight_kEnvironmentTurn = 6.28318530717959;

vec2 conelight_environmentUv(vec3 direction) {
    bool upright = direction.x == 0.0 && direction.z == 0.0;
    float azimuth = upright ? 0.0 : atan(direction.x, -direction.z);
    return vec2(azimuth / conelight_kEnvironmentTurn + 0.5 + conelight_lighting.environmentTurn,
                2.0 * acos(clamp(direction.y, -1.0, 1.0)) / conelight_kEnvironmentTurn);
}

vec3 conelight_skyRadiance(vec3 direction, float width) {
    float level = log2(max(width, 1e-6) / conelight_kEnvironmentTurn) + conelight_lighting.environmentLevel0;
    vec3 texel =
        textureLod(conelight_environmentPicture, conelight_environmentUv(direction), max(level, 0.0)).rgb;
    return conelight_lighting.sky + conelight_lighting.environmentScale * texel;
}

void conelight_tangentFrame(vec3 n, out vec3 u, out vec3 v) {
    float s = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (s + n.z);
    float b = n.x * n.y * a;
    u = vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x);
    v = vec3(b, s + n.y * n.y * a, -n.y);
}

float conelight_voxelSize(vec3 position) {
    return conelight_grid.voxelSize * conelight_voxelEdgeAt(conelight_gridFromWorld(position));
}

vec3 conelight_trace(vec3 origin, vec3 direction, out float distance) {
    vec3 unit = conelight_normalize(direction);
    conelight_VoxelHit hit =
        conelight_traceVoxels(conelight_Ray(conelight_gridFromWorld(origin), unit, 1e9, vec3(0.0)));
    bool met = hit.face >= 0;
    int face = max(hit.face, 0);
    vec3 normal = conelight_octDecode(unpackSnorm2x16(texelFetch(conelight_voxelFaces, face).x));
    vec3 point = conelight_gridFromWorld(origin) + (met ? hit.t : 0.0) * unit;
    vec4 cached = conelight_cachedIrradiance(point, normal, met);
    uvec4 lit = texelFetch(conelight_litFaces, face);
    vec3 irradiance = cached.a > 0.0 ? cached.rgb : conelight_litIrradiance(lit);
    vec3 radiance = conelight_unpackRgb9e5(lit.y) + conelight_unpackAlbedo(lit.x) * irradiance;
    distance = met ? hit.t * conelight_grid.voxelSize : -1.0;
    return met ? radiance : conelight_skyRadiance(unit, 0.0);
}

vec3 conelight_trace(vec3 origin, vec3 direction) {
    float distance;
    return conelight_trace(origin, direction, distance);
}

const float conelight_kSpiralTurn = 2.39996323;

const int conelight_kOpenRays = 8;

vec3 conelight_openIrradiance(vec3 position, vec3 normal, bool sphere) {
    vec3 u, v;
    conelight_tangentFrame(normal, u, v);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < conelight_kOpenRays; ++i) {
        float share = (float(i) + 0.5) / float(conelight_kOpenRays);
        float height = sphere ? 1.0 - 2.0 * share : sqrt(1.0 - share);
        float radius = sqrt(max(1.0 - height * height, 0.0));
        float turn = conelight_kSpiralTurn * float(i);
        sum += conelight_trace(position, radius * (cos(turn) * u + sin(turn) * v) + height * normal);
    }
    return sum / float(conelight_kOpenRays);
}

vec3 conelight_irradiance(vec3 position, vec3 normal) {
    bool sphere = conelight_dot(normal, normal) < 1e-12;
    vec3 axis = sphere ? vec3(0.0, 1.0, 0.0) : conelight_normalize(normal);
    vec3 point = conelight_gridFromWorld(position);
    conelight_VoxelBounds bounds = conelight_voxelBounds();
    bool inGrid = all(greaterThanEqual(point, bounds.lowest)) && all(lessThanEqual(point, bounds.highest));
    vec4 cached = conelight_cachedIrradiance(point, axis, inGrid && !sphere);
    return cached.a > 0.0 ? cached.rgb : conelight_openIrradiance(position, axis, sphere);
}
#endif
