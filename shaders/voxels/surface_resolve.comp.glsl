// SPDX-License-Identifier: MIT
// One invocation per face: walks the chain of its voxel, sums up the fragments that face its direction
// (docs/theory/2_voxels.md, eq. 2.2), writes FaceRecord and FaceMaterial. Faces in which something may cover
// something else, or whose bounds are too wide, are put on the lists of surface_layers, which does them
// again.
//
// The sum of weights is kept in 64 bits: should it reach 16 (never in a sane scene), the chain is walked
// again with units coarse enough that nothing overflows.
//
// Tried on a software driver (cost of this pass): fragments through storage reads instead of a buffer texture
// +17 %; fetching the next fragment while this one is added, no gain; all sums in 64 bits +50 %; looking up
// chain and voxel through the voxel's record instead of the owner list +15 %.
#version 450
#ifndef SURFACE_UPDATE
#error SURFACE_UPDATE must be 0 or 1
#endif
#ifndef SURFACE_EMISSION
#error SURFACE_EMISSION must be 0 or 1
#endif
layout(local_size_x = 64) in;
#include "lib/voxel_record.glsl"
#include "voxels/surface_common.glsl"
#include "voxels/surface_sums.glsl"
layout(std430) buffer CounterTable { uint counters[]; };
layout(std430) writeonly buffer FaceTable { uvec4 faces[]; };
layout(std430) writeonly buffer LayerTable { uint layered[]; };
#if SURFACE_UPDATE
layout(std430) readonly buffer WorkTable { uint work[]; };
#endif

void main() {
    uint index = linearInvocation();
#if SURFACE_UPDATE
    bool used = index < min(counters[SURFACE_WORK], surface.faceCapacity);
    index = work[used ? index : 0u];
#else
    bool used = index < min(counters[SURFACE_FACES], surface.faceCapacity);
#endif
    uint owner = texelFetch(owners, int(used ? index : 0u)).x;
    int direction = int(owner >> 29);
    uint head = owner & 0x1fffffffu;
    vec3 k = directionVector(direction);

    FaceSums sums;
    int shift = SURFACE_FINEST_UNIT;
    bool again;
    uint voxel = 0u;
    do {
        float units = unitsOf(shift);
        sums = emptySums();
        uint at = used ? head : 0u;
        do {
            Fragment f = readFragment(at, k);
            addFragment(sums, f, f.area * units, f.area > 0.0);
#if !SURFACE_EMISSION
            voxel = at != 0u ? f.emission : voxel;
#endif
            at = f.next;
        } while (at != 0u);
        // Next time the sum is below 2^30.
        again = sums.weightHigh != 0u || sums.weightLow < 0 || sums.weightLow >= 1 << 30;
        shift -= again ? (sums.weightHigh != 0u ? findMSB(sums.weightHigh) + 3 : 2) : 0;
    } while (again);
#if SURFACE_EMISSION
    voxel = texelFetch(pairs, int(head) - 1).y;
#endif

    ResolvedFace face = resolvedFace(sums, shift, direction, voxel);
    float weight = float(sums.weightLow) * inverseUnits(shift);
    bool covers = weight > boundsArea(sums.lower, sums.upper, direction >> 1) + SURFACE_LEAST_EXCESS;
    bool wide = !covers && boundsTooWide(facePlane(sums, shift, k, face.hit));
    if (used) {
        faces[index] = face.hit;
        faceMaterials[index] = face.material;
        uint entry = index | (uint(SURFACE_FINEST_UNIT - shift) << 26);
        if (covers) layered[atomicAdd(counters[SURFACE_LAYERS], 1u)] = entry;
        if (wide) layered[surface.faceCapacity - 1u - atomicAdd(counters[SURFACE_WIDE], 1u)] = entry;
    }
}
