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
// it. Light is looked up where faceRise says, on top of the front.
#version 450
#ifndef SURFACE_ONLY_WIDE
#error SURFACE_ONLY_WIDE must be 0 or 1
#endif
#ifndef SURFACE_EMISSION
#error SURFACE_EMISSION must be 0 or 1
#endif
layout(local_size_x = 64) in;
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

// Depth of a fragment along n: middle and half its extent, from the voxel's centre. In its plane, n changes
// along the part of n that lies in the plane.
vec2 depthOf(Fragment f, vec3 n) {
    vec3 along = n - dot(n, f.normal) * f.normal;
    vec3 size = unpackBoundsMax(f.bounds) - unpackBoundsMin(f.bounds);
    return vec2(dot(n, vec3(f.center) * (1.0 / 65535.0) - 0.5), 0.5 * dot(abs(along), size));
}

// Share of [lower, upper] in the four slices from `first` on; a slice is 1 long.
vec4 shareOf(vec2 reach, float first) {
    vec4 begin = first + vec4(0.0, 1.0, 2.0, 3.0);
    vec4 inside = min(vec4(reach.y), begin + 1.0) - max(vec4(reach.x), begin);
    return clamp(inside, 0.0, 1.0) / (reach.y - reach.x);
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

void main() {
    uint invocation = linearInvocation();
#if SURFACE_ONLY_WIDE
    bool used = invocation < min(counters[SURFACE_WIDE], surface.faceCapacity);
    uint entry = layered[surface.faceCapacity - 1u - (used ? invocation : 0u)];
#else
    bool used = invocation < min(counters[SURFACE_LAYERS], surface.faceCapacity);
    uint entry = layered[used ? invocation : 0u];
#endif
    uint index = entry & 0x3ffffffu;
    uint owner = texelFetch(owners, int(index)).x;
    int direction = int(owner >> 29);
    uint head = owner & 0x1fffffffu;
    vec3 k = directionVector(direction);
    uvec4 hit = faces[2u * index];
#if SURFACE_ONLY_WIDE
    FaceSums sums = emptySums();
    uint at = used ? head : 0u;
    do {
        Fragment f = readFragment(at, k);
        addFragment(sums, f, f.area * unitsOf(SURFACE_FINEST_UNIT), f.area > 0.0);
        at = f.next;
    } while (at != 0u);
    ResolvedFace face = resolvedFace(sums, SURFACE_FINEST_UNIT, direction, hit.w & 0x3fffffffu);
#else
    vec3 n = octDecode(unpackSnorm2x16(hit.x));

    // Range of depth.
    float nearest = -1e9;
    float farthest = 1e9;
    uint at = used ? head : 0u;
    do {
        Fragment f = readFragment(at, k);
        vec2 depth = depthOf(f, n);
        nearest = f.area > 0.0 ? max(nearest, depth.x + depth.y) : nearest;
        farthest = f.area > 0.0 ? min(farthest, depth.x - depth.y) : farthest;
        at = f.next;
    } while (at != 0u);
    // Slices per voxel; the ends of the range are the middles of the first slice and the last, so that flat
    // layers there have a slice each.
    float slices = 15.0 / max(nearest - farthest, kLeastRange);

    // Cover of the slices, in units that surface_resolve found to be coarse enough.
    float units = unitsOf(SURFACE_FINEST_UNIT - int(entry >> 26));
    ivec4 cover0 = ivec4(0), cover1 = ivec4(0), cover2 = ivec4(0), cover3 = ivec4(0);
    at = used ? head : 0u;
    do {
        Fragment f = readFragment(at, k);
        vec2 depth = depthOf(f, n);
        vec2 reach = (depth.x - farthest + vec2(-depth.y, depth.y)) * slices + vec2(0.0, 1.0);
        float w = f.area * units * f.facing;
        cover0 += ivec4(w * shareOf(reach, 0.0) + 0.5);
        cover1 += ivec4(w * shareOf(reach, 4.0) + 0.5);
        cover2 += ivec4(w * shareOf(reach, 8.0) + 0.5);
        cover3 += ivec4(w * shareOf(reach, 12.0) + 0.5);
        at = f.next;
    } while (at != 0u);

    // Seen share of the slices. All that is seen along k fits into the bounds.
    ivec3 lower = ivec3(uvec3(hit.z, hit.z >> 5, hit.z >> 10) & 31u);
    ivec3 upper = ivec3(uvec3(hit.z >> 15, hit.z >> 20, hit.z >> 25) & 31u);
    int room = int(boundsArea(lower, upper, direction >> 1) * units);
    ivec4 cover = cover0 + cover1 + cover2 + cover3;
    float leastSeen = kLeastSeen * float(room) / float(max(cover.x + cover.y + cover.z + cover.w, 1));
    vec4 seen3 = seenOf(cover3, room);
    vec4 seen2 = seenOf(cover2, room);
    vec4 seen1 = seenOf(cover1, room);
    vec4 seen0 = seenOf(cover0, room);

    // Sums of what is seen. It is at most 1, and fits into the finest unit.
    FaceSums sums = emptySums();
    float rear = 1.0;
    at = used ? head : 0u;
    do {
        Fragment f = readFragment(at, k);
        vec2 depth = depthOf(f, n);
        vec2 reach = (depth.x - farthest + vec2(-depth.y, depth.y)) * slices + vec2(0.0, 1.0);
        float seen = dot(shareOf(reach, 0.0), seen0) + dot(shareOf(reach, 4.0), seen1) +
                     dot(shareOf(reach, 8.0), seen2) + dot(shareOf(reach, 12.0), seen3);
        seen = clamp(seen, 0.0, 1.0);
        bool shows = f.area > 0.0 && seen > leastSeen;
        addFragment(sums, f, f.area * seen * unitsOf(SURFACE_FINEST_UNIT), shows);
        rear = shows ? min(rear, depth.x) : rear;
        at = f.next;
    } while (at != 0u);

    ResolvedFace face = resolvedFace(sums, SURFACE_FINEST_UNIT, direction, hit.w & 0x3fffffffu);
    float behind = dot(n, vec3(sums.center) / float(max(sums.weightLow, 1)) - 0.5) - rear;
    float offset = unpackOffset(face.hit.y) - max(behind, 0.0);
    face.hit.y = (face.hit.y & 0xffff0000u) | (packOffsetWeight(offset, 0.0) & 0xffffu);
#endif
    FacePlane plane = facePlane(sums, SURFACE_FINEST_UNIT, k, face.hit);
    fitBounds(sums, plane, k, used && boundsTooWide(plane) ? head : 0u, face);
    if (used) {
        faces[2u * index] = face.hit;
        faces[2u * index + 1u] = face.shade;
        faceSources[index] = face.source;
    }
}
