// SPDX-License-Identifier: MIT
// One invocation per fragment: clips the triangle to the voxel, evaluates its material there, stores both
// (32 bytes, below), and puts the fragment into its voxel's chain.
//
//   word 0  next fragment of the voxel + 1, 0: last    4  normal z | centroid x, 16 bit each
//        1  area / h^2 x coverage, float, its lowest   5  centroid y | z, 16 bit each, [0,1] of the voxel
//           9 bits: SURFACE_LOBES (2^-15 of the area)
//        2  bounds (lib/voxel_record.glsl), bit 30:    6  albedo
//           two-sided                                  7  emission RGB9E5, or the voxel when nothing emits
//        3  normal x | y, 16 bit snorm each
//
// SURFACE_DETAIL 0: materials without textures or vertex colours. 1: with, sampled at the centroid and
// averaged over the polygon's area. 2: and alpha tests, 16 samples over the polygon's bounds give coverage
// and albedo.
// SURFACE_LOBES 1: metalness and roughness as well (lib/voxel_record.glsl, packLobe); only with
// SURFACE_DETAIL > 0.
#version 450
#ifndef SURFACE_UPDATE
#error SURFACE_UPDATE must be 0 or 1
#endif
#ifndef SURFACE_DETAIL
#error SURFACE_DETAIL must be 0, 1 or 2
#endif
#ifndef SURFACE_EMISSION
#error SURFACE_EMISSION must be 0 or 1
#endif
#if !defined(SURFACE_LOBES) || SURFACE_LOBES && SURFACE_DETAIL == 0
#error SURFACE_LOBES must be 0 or 1, 0 with SURFACE_DETAIL 0
#endif
layout(local_size_x = 64) in;
#include "lib/clip.glsl"
#include "lib/dot.glsl"
#include "lib/voxel_grid.glsl"
#include "lib/voxel_record.glsl"
#include "voxels/surface_common.glsl"
layout(std430) readonly buffer CounterTable { uint counters[]; };
layout(std430) buffer ChainTable { uint chains[]; };
layout(std430) writeonly buffer FragmentTable { uvec4 fragments[]; };
uniform samplerBuffer triangles;
uniform usamplerBuffer pairs;
uniform usampler3D brickWords;

#if SURFACE_UPDATE
layout(std430) readonly buffer FreeTable { uint freeSlots[]; };
layout(std430) buffer ChangedTable { uint changedBricks[]; };
#endif

struct Surface {
    vec3 albedo;
    vec3 emission;
    float coverage;
    uint lobe;
};

// A triangle as a voxel sees it: corners from the voxel's centre.
struct VoxelTriangle {
    uint triangle;
    uint instance;
    vec3 q0, q1, q2;
    vec3 normal;  // unit
    float twiceArea;
    bool twoSided;
    uint albedo;    // packed, of materials that are the same all over
    uint emission;  // packed
};
#if SURFACE_DETAIL > 0
#include "voxels/surface_material.glsl"
#endif

// Less area than this (in voxel sides) counts as none: in fixed point its weight would vanish too. Such a
// fragment stays in its chain, which says with it that the voxel is occupied.
const float kLeastArea = 1e-7;

// Place of this invocation's fragment; `used`: there is one.
uint slotOf(uint index, out bool used) {
#if SURFACE_UPDATE
    used = index < counters[SURFACE_FRAGMENTS];
    uint slot = used ? FRAGMENT_SLOT(index) : 0u;
    used = used && slot < surface.fragmentCapacity;
    return used ? slot : 0u;
#else
    used = index < min(counters[SURFACE_FRAGMENTS], surface.fragmentCapacity);
    return used ? index : 0u;
#endif
}

// Closed solids thicker than this have insides that may be looked at: rooms. As triangles have it: 2 voxels.
const int kThickSolid = 18;

bool isThinSolid(uint flags, int level) {
    int code = int((flags >> VOXEL_TRIANGLE_SOLID_SHIFT) & 31u);
    return code != 0 && code - 2 * level <= kThickSolid;
}

VoxelTriangle readTriangle(uint triangle, ivec3 voxel) {
    vec4 t0 = texelFetch(triangles, 3 * int(triangle));
    vec4 t1 = texelFetch(triangles, 3 * int(triangle) + 1);
    vec4 t2 = texelFetch(triangles, 3 * int(triangle) + 2);
    int level = 0;
#if NESTED_GRIDS
    level = levelOfStored(voxel);
    vec4 place = levelPlace(level);
    t0.xyz = levelFromGrid(t0.xyz, place);
    t1.xyz = levelFromGrid(t1.xyz, place);
    t2.xyz = levelFromGrid(t2.xyz, place);
    voxel = withinLevel(voxel, level);
#endif
    vec3 center = vec3(voxel) + 0.5;
    vec3 cr = cross(t1.xyz - t0.xyz, t2.xyz - t0.xyz);
    float twiceArea = length(cr);
    uint flags = floatBitsToUint(t0.w);
    bool twoSided = (flags & TRIANGLE_TWO_SIDED) != 0u && !isThinSolid(flags, level);
    return VoxelTriangle(triangle, flags & 0xffffffu, t0.xyz - center, t1.xyz - center, t2.xyz - center,
                         cr / twiceArea, twiceArea, twoSided, floatBitsToUint(t1.w), floatBitsToUint(t2.w));
}

// A normal as three 16-bit numbers, and the directions that it faces as it is stored: surface_resolve must
// come to the same.
struct StoredNormal {
    uint x, y, z;
    uint directions;
};

StoredNormal storedNormal(vec3 n, bool twoSided) {
    uint nx = packSnorm16(n.x);
    uint ny = packSnorm16(n.y);
    uint nz = packSnorm16(n.z);
    vec3 stored = vec3(unpackSnorm16(nx), unpackSnorm16(ny), unpackSnorm16(nz));
    uint directions = facingDirections(stored) | (twoSided ? facingDirections(-stored) : 0u);
    return StoredNormal(nx, ny, nz, directions);
}

// Puts a fragment before the others of its voxel, and says which directions are faced there. Returns the
// next one of the chain.
uint enchain(uint record, uint slot, ivec3 voxel, uint directions) {
#if SURFACE_UPDATE
    directions |= CHAIN_EDITED;
    uint brick = brickIndex(voxel >> 2, gridBricks());
    atomicOr(changedBricks[brick >> 5], 1u << (brick & 31u));
#endif
    uint next = atomicExchange(chains[2u * record], slot + 1u);
    atomicOr(chains[2u * record + 1u], directions);
    return next;
}

void main() {
    // Clip the triangle to the voxel.
    bool used;
    uint slot = slotOf(linearInvocation(), used);
    uvec2 pair = texelFetch(pairs, int(slot)).xy;
    ivec3 voxel = unpackVoxel(pair.y);
    VoxelTriangle t = readTriangle(pair.x, voxel);
    ClippedPolygon polygon = clipToVoxel(t.q0, t.q1, t.q2, t.normal);

    // Evaluate its material there.
    Surface s = Surface(vec3(0.0), vec3(0.0), 1.0, 0u);
    uint albedoBits = t.albedo;
    uint emissionBits = t.emission;
#if SURFACE_DETAIL > 0
    s = evaluateSurface(t, polygon);
    albedoBits = packAlbedo(s.albedo);
    emissionBits = packRgb9e5(s.emission);
#endif
#if !SURFACE_EMISSION
    emissionBits = pair.y;
#endif
    float area = polygon.area * clamp(s.coverage, 0.0, 1.0);

    // Put it into the chain of the voxel, which has a record because its bit was set with this fragment.
    uvec4 word = texelFetch(brickWords, voxel >> 2, 0);
    uint record = voxelRecordIndex(word, bitOfVoxel(voxel));
    bool chained = used && record < surface.voxelCapacity;
    bool kept = chained && area >= kLeastArea;
    StoredNormal n = storedNormal(t.normal, t.twoSided);
    uint next = 0u;
    if (chained) next = enchain(record, slot, voxel, kept ? n.directions : 0u);

    // Store both.
    uvec3 c = uvec3(floor(clamp(polygon.center + 0.5, 0.0, 1.0) * 65535.0 + 0.5));
    uint bounds =
        packBounds(polygon.lower + 0.5, polygon.upper + 0.5) | (t.twoSided ? FRAGMENT_TWO_SIDED : 0u);
    uint areaBits = floatBitsToUint(kept ? area : 0.0);
#if SURFACE_LOBES
    areaBits = kept ? ((areaBits + 0x100u) & ~0x1ffu) | s.lobe : 0u;
#endif
    if (used) {
        fragments[2u * slot] = uvec4(next, areaBits, bounds, n.x | (n.y << 16));
        fragments[2u * slot + 1u] = uvec4(n.z | (c.x << 16), c.y | (c.z << 16), albedoBits, emissionBits);
    }
}
