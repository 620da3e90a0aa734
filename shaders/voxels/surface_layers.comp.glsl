// SPDX-License-Identifier: MIT
// One invocation per face whose fragments cover more than their bounds have room for: some lie behind others.
// Each is weighted by how much of it is seen, and the face is summed up again (docs/theory/2_voxels.md,
// "Layers within a voxel"). Then its bounds are fitted ("Bounds that fit").
// SURFACE_ONLY_WIDE 1: one invocation per face in which nothing is covered and only the bounds are too wide;
// a program of its own, as these are many more, and a software driver does the work of a branch that is not
// taken.
//
// Depth is measured along the face's mean normal and cut into 16 slices. From front to back each slice is
// seen as far as those before it leave room. A fragment that tilts against the mean normal reaches over
// several slices. Three walks over the chain: range of depth, cover of the slices, sums.
//
// The plane goes through the rearmost that is seen: a ray that starts at a step's foot must not start below
// it. Light is looked up where faceFrontOffset says, on top of the front.
#version 450
#ifndef SURFACE_ONLY_WIDE
#error SURFACE_ONLY_WIDE must be 0 or 1
#endif
#ifndef SURFACE_EMISSION
#error SURFACE_EMISSION must be 0 or 1
#endif
layout(local_size_x = 64) in;
#include "lib/dot.glsl"
#include "lib/voxel_record.glsl"
#include "voxels/surface_common.glsl"
#include "voxels/surface_sums.glsl"
layout(std430) readonly buffer CounterTable { uint counters[]; };
layout(std430) buffer FaceTable { uvec4 faces[]; };
layout(std430) readonly buffer LayerTable { uint layered[]; };

// Depths that differ by less than this in all, in voxels, are one: centroids and normals have 16 bits.
const float kLeastRange = 1.0 / 256.0;
// A fragment of which less is seen, relative to the mean, does not widen the bounds: what is let through
// where bounds are rounded outwards.
const float kLeastSeen = 1.0 / 8.0;

// A face of the list, and the head of its chain; 0: none.
struct ListedFace {
    uint index;
    uint head;
    int direction;
    int coarser;  // binary digits by which its units are coarser than the finest
};

ListedFace listedFace(uint invocation, out bool used) {
#if SURFACE_ONLY_WIDE
    used = invocation < min(counters[SURFACE_WIDE], surface.faceCapacity);
    uint entry = layered[surface.faceCapacity - 1u - (used ? invocation : 0u)];
#else
    used = invocation < min(counters[SURFACE_LAYERS], surface.faceCapacity);
    uint entry = layered[used ? invocation : 0u];
#endif
    uint index = entry & 0x3ffffffu;
    uint owner = texelFetch(owners, int(index)).x;
    return ListedFace(index, used ? owner & 0x1fffffffu : 0u, int(owner >> 29), int(entry >> 26));
}

#if SURFACE_ONLY_WIDE
// Sums of all fragments: nothing is covered.
FaceSums sumAll(uint head, vec3 k) {
    FaceSums sums = emptySums();
    uint at = head;
    do {
        Fragment f = readFragment(at, k);
        addFragment(sums, f, f.area * unitsOf(SURFACE_FINEST_UNIT), f.area > 0.0);
        at = f.next;
    } while (at != 0u);
    return sums;
}
#else
// The 16 slices of a face.
struct Slices {
    vec3 normal;     // depth is measured along it
    float farthest;  // depth of the rearmost, voxels
    float perVoxel;
};

// A number per slice, the rearmost first: of slices 0-3, 4-7, 8-11 and 12-15.
struct SliceUnits {
    ivec4 from0, from4, from8, from12;
};
struct SliceShares {
    vec4 from0, from4, from8, from12;
};

// Depth of a fragment along n: middle and half its extent, from the voxel's centre. In its plane, n changes
// along the part of n that lies in the plane.
vec2 depthOf(Fragment f, vec3 n) {
    vec3 along = n - dot(n, f.normal) * f.normal;
    vec3 size = unpackBoundsMax(f.bounds) - unpackBoundsMin(f.bounds);
    return vec2(dot(n, vec3(f.center) * (1.0 / 65535.0) - 0.5), 0.5 * dot(abs(along), size));
}

// Cuts the range of depth of a face with mean normal n.
Slices slicesOf(uint head, vec3 k, vec3 n) {
    float nearest = -1e9;
    float farthest = 1e9;
    uint at = head;
    do {
        Fragment f = readFragment(at, k);
        vec2 depth = depthOf(f, n);
        nearest = f.area > 0.0 ? max(nearest, depth.x + depth.y) : nearest;
        farthest = f.area > 0.0 ? min(farthest, depth.x - depth.y) : farthest;
        at = f.next;
    } while (at != 0u);
    // The ends of the range are the middles of the first slice and the last, so that flat layers there have a
    // slice each.
    return Slices(n, farthest, 15.0 / max(nearest - farthest, kLeastRange));
}

// Shares of a fragment in the slices; a slice is 1 long.
vec4 shareOf(vec2 reach, float first) {
    vec4 begin = first + vec4(0.0, 1.0, 2.0, 3.0);
    vec4 inside = min(vec4(reach.y), begin + 1.0) - max(vec4(reach.x), begin);
    return clamp(inside, 0.0, 1.0) / (reach.y - reach.x);
}
SliceShares sharesOf(vec2 depth, Slices slices) {
    vec2 reach = (depth.x - slices.farthest + vec2(-depth.y, depth.y)) * slices.perVoxel + vec2(0.0, 1.0);
    return SliceShares(shareOf(reach, 0.0), shareOf(reach, 4.0), shareOf(reach, 8.0), shareOf(reach, 12.0));
}

// Cover of the slices; `units`: per voxel side.
SliceUnits coverOf(uint head, vec3 k, Slices slices, float units) {
    SliceUnits cover = SliceUnits(ivec4(0), ivec4(0), ivec4(0), ivec4(0));
    uint at = head;
    do {
        Fragment f = readFragment(at, k);
        SliceShares share = sharesOf(depthOf(f, slices.normal), slices);
        float w = f.area * units * f.facing;
        cover.from0 += ivec4(w * share.from0 + 0.5);
        cover.from4 += ivec4(w * share.from4 + 0.5);
        cover.from8 += ivec4(w * share.from8 + 0.5);
        cover.from12 += ivec4(w * share.from12 + 0.5);
        at = f.next;
    } while (at != 0u);
    return cover;
}

// What of slices with these covers is seen; `room`: what those before leave, and after the call what is left.
// x is the rearmost.
vec4 seenOf(ivec4 cover, inout int room) {
    ivec4 seen;
    seen.w = min(cover.w, room);
    seen.z = min(cover.z, room - seen.w);
    seen.y = min(cover.y, room - seen.w - seen.z);
    seen.x = min(cover.x, room - seen.w - seen.z - seen.y);
    room -= seen.x + seen.y + seen.z + seen.w;
    return vec4(seen) / vec4(max(cover, 1));
}
SliceShares seenShares(SliceUnits cover, int room) {
    SliceShares seen;
    seen.from12 = seenOf(cover.from12, room);
    seen.from8 = seenOf(cover.from8, room);
    seen.from4 = seenOf(cover.from4, room);
    seen.from0 = seenOf(cover.from0, room);
    return seen;
}

// The least that is seen of a fragment that widens the bounds.
float leastSeenOf(SliceUnits cover, int room) {
    ivec4 all4 = cover.from0 + cover.from4 + cover.from8 + cover.from12;
    return kLeastSeen * float(room) / float(max(all4.x + all4.y + all4.z + all4.w, 1));
}

// Sums of what is seen, which is at most 1 and fits into the finest unit. `rear`: depth of the rearmost.
FaceSums sumSeen(ListedFace face, Slices slices, SliceShares seen, float leastSeen, out float rear) {
    vec3 k = directionVector(face.direction);
    FaceSums sums = emptySums();
    rear = 1.0;
    uint at = face.head;
    do {
        Fragment f = readFragment(at, k);
        vec2 depth = depthOf(f, slices.normal);
        SliceShares share = sharesOf(depth, slices);
        float part = dot(share.from0, seen.from0) + dot(share.from4, seen.from4) +
                     dot(share.from8, seen.from8) + dot(share.from12, seen.from12);
        part = clamp(part, 0.0, 1.0);
        bool shows = f.area > 0.0 && part > leastSeen;
        addFragment(sums, f, f.area * part * unitsOf(SURFACE_FINEST_UNIT), shows);
        rear = shows ? min(rear, depth.x) : rear;
        at = f.next;
    } while (at != 0u);
    return sums;
}

// Weighs each fragment by how much of it is seen. `hit`: what surface_resolve made of the face. All that is
// seen along k fits into the bounds.
ResolvedFace resolveSeen(ListedFace listed, uvec4 hit, out FaceSums sums) {
    vec3 k = directionVector(listed.direction);
    vec3 n = octDecode(unpackSnorm2x16(hit.x));
    Slices slices = slicesOf(listed.head, k, n);

    // Share the room out to the slices, in units that surface_resolve found to be coarse enough.
    float units = unitsOf(SURFACE_FINEST_UNIT - listed.coarser);
    SliceUnits cover = coverOf(listed.head, k, slices, units);
    ivec3 lower = ivec3(uvec3(hit.z, hit.z >> 5, hit.z >> 10) & 31u);
    ivec3 upper = ivec3(uvec3(hit.z >> 15, hit.z >> 20, hit.z >> 25) & 31u);
    int room = int(boundsArea(lower, upper, listed.direction >> 1) * units);

    // Sum up again, and put the plane through the rearmost.
    float rear;
    sums = sumSeen(listed, slices, seenShares(cover, room), leastSeenOf(cover, room), rear);
    ResolvedFace face = resolvedFace(sums, SURFACE_FINEST_UNIT, listed.direction, hit.w & 0x3fffffffu);
    float behind = dot(n, vec3(sums.center) / float(max(sums.weightLow, 1)) - 0.5) - rear;
    float offset = unpackOffset(face.hit.y) - max(behind, 0.0);
    face.hit.y = (face.hit.y & 0xffff0000u) | (packOffsetWeight(offset, 0.0) & 0xffffu);
    return face;
}
#endif

void main() {
    bool used;
    ListedFace listed = listedFace(linearInvocation(), used);
    vec3 k = directionVector(listed.direction);
    uvec4 hit = faces[listed.index];

    // Sum up again what is seen.
#if SURFACE_ONLY_WIDE
    FaceSums sums = sumAll(listed.head, k);
    ResolvedFace face = resolvedFace(sums, SURFACE_FINEST_UNIT, listed.direction, hit.w & 0x3fffffffu);
#else
    FaceSums sums;
    ResolvedFace face = resolveSeen(listed, hit, sums);
#endif

    // Fit the bounds.
    FacePlane plane = facePlane(sums, SURFACE_FINEST_UNIT, k, face.hit);
    fitBounds(sums, plane, k, boundsTooWide(plane) ? listed.head : 0u, face);
    if (used) {
        faces[listed.index] = face.hit;
        faceMaterials[listed.index] = face.material;
    }
}
