// SPDX-License-Identifier: MIT
// Faces on the plane of another: pixels see what is noise shared among them. Behind
// light/cache_common.glsl; the includer declares voxelFaces, voxelRecords and voxelBrickImage.
#include "lib/dot.glsl"

// How far two means of faces may be apart, over the noise of one.
const float kSharedApart = 4.0;
// Part that one mean counts to another: none where more than noise parts them, such as a wall between both.
float likeness(vec3 own, vec3 other, uint updates) {
    // IRRADIANCE_NOISE is that of two rays of each kind.
    float averaged = float(max(updates, uint(IRRADIANCE_SETTLE)) - uint(IRRADIANCE_SETTLE)) + 1.0;
    float noise = kSharedApart * IRRADIANCE_NOISE * inversesqrt(0.5 * float(cache.cosineRays) * averaged);
    float apart = dot(abs(own - other), vec3(1.0)) / max(dot(max(own, other), vec3(1.0)), 1e-20);
    return max(1.0 - apart * apart / (noise * noise), 0.0);
}

// What is one plane: by the cosine between normals, and by the distance of the planes in voxels.
const float kSamePlaneNormal = 0.95;
const float kSamePlaneOffset = 0.2;

// The face so many voxels aside on side 0 to 3 of one with the normal n, if it is on the same plane; else -1.
int neighbourOnPlane(int side, int reach, uvec4 hitTexel, vec3 n) {
    ivec3 voxel = unpackVoxel(hitTexel.w);
    int axis = int(hitTexel.w >> 30);
    int direction = faceDirection(hitTexel, n);
    int towards = (axis + 1 + (side >> 1)) % 3;
    ivec3 step = ivec3(towards == 0, towards == 1, towards == 2) * (reach * (1 - 2 * (side & 1)));
#if NESTED_GRIDS
    int level = levelOfStored(voxel);
    ivec3 within = withinLevel(voxel, level) + step;
    ivec3 at = clamp(within, ivec3(0), gridSize() - 1);
    bool inside = at == within;
    at = storedVoxel(at, level);
#else
    ivec3 at = clamp(voxel + step, ivec3(0), gridSize() - 1);
    const bool inside = true;
#endif
    uvec4 word = imageLoad(voxelBrickImage, at >> 2);
    bool there = inside && brickHas(word.xy, bitOfVoxel(at));
    uint record = there ? texelFetch(voxelRecords, int(voxelRecordIndex(word, bitOfVoxel(at)))).x : 0u;
    there = there && (faceDirections(record) >> direction & 1u) != 0u;
    int face = there ? int(faceIndex(record, direction)) : 0;
    uvec4 other = texelFetch(voxelFaces, face);
    vec3 turned = octDecode(unpackSnorm2x16(other.x));
    float apart = dot(n, vec3(step) + unpackOffset(other.y) * turned) - unpackOffset(hitTexel.y);
    bool same = there && dot(n, turned) > kSamePlaneNormal && abs(apart) < kSamePlaneOffset &&
                ((other.z ^ hitTexel.z) & FACE_REVERSE) == 0u;
    return same ? face : -1;
}
