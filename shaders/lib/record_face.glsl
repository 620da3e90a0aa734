// SPDX-License-Identifier: MIT
// Hooks of lib/record_steps.glsl for paths that end at a face of a voxel: rays, and lookups in the cache.
// After lib/ray_query.glsl.
#include "lib/record_steps.glsl"
#ifdef RECORD_STEPS
void recordFace(uint path, int face) {
    if (path >= RECORD_MAX_PATHS || face < 0) return;
    uvec4 a = texelFetch(voxelFaces, 2 * face);
    uvec4 b = texelFetch(voxelFaces, 2 * face + 1);
    record.paths[path].face = face;
    record.paths[path].faceNormal = octDecode(unpackSnorm2x16(a.x));
    record.paths[path].facePlane = unpackOffset(a.y);
    record.paths[path].faceCoverage = unpackWeight(a.y);
    record.paths[path].faceVoxel = a.w;
    record.paths[path].faceAlbedo = unpackAlbedo(b.x);
    record.paths[path].faceRadiance = unpackRgb9e5(b.y);
    record.paths[path].faceIrradiance = vec3(unpackHalf2x16(b.z), unpackHalf2x16(b.w).x);
    record.paths[path].faceUpdates = faceUpdates(b.w);
}

// A ray from `origin` (grid coordinates) that went by traceVoxels; its steps are those since the last path.
void recordRay(uint kind, vec3 origin, vec3 direction, VoxelHit hit, float opacity, vec3 weight,
               vec3 radiance, bool used) {
    bool met = hit.face >= 0;
    // What leaves the grid ends where the last step began.
    float t =
        met ? hit.t : min(hit.t, distance(origin, 0.5 * vec3(gridSize())) + 0.5 * length(vec3(gridSize())));
    vec3 at = worldFromGrid(origin + t * direction);
    if (met) recordStep(STEP_HIT, at, t * grid.voxelSize, grid.voxelSize, 0.0, radiance, opacity, opacity);
    uint end = !used ? END_UNUSED : met ? END_FACE : END_OPEN;
    uint path = recordPath(kind, worldFromGrid(origin), direction, 0.0, used ? weight : vec3(0.0), radiance,
                           met ? opacity : 0.0, t * grid.voxelSize, end);
    recordFace(path, hit.face);
}

// A face that the cache's lookup about `point` (grid coordinates) read.
void recordCacheFace(vec3 point, int face, float weight, vec3 irradiance) {
    if (!recording() || weight <= 0.0) return;
    vec3 toVoxel = vec3(unpackVoxel(texelFetch(voxelFaces, 2 * face).w)) + 0.5 - point;
    float t = max(length(toVoxel), 1e-6);
    uint path = recordPath(PATH_CACHE_FACE, worldFromGrid(point), toVoxel / t, 0.0, vec3(weight), irradiance,
                           1.0, t * grid.voxelSize, END_FACE);
    recordFace(path, face);
}

#define RECORD_RAY(kind, origin, direction, hit, opacity, weight, radiance, used) \
    recordRay(kind, origin, direction, hit, opacity, weight, radiance, used)
#else
#define RECORD_RAY(kind, origin, direction, hit, opacity, weight, radiance, used)
#endif
#if defined(RECORD_STEPS) && defined(RECORD_CACHE)
#define RECORD_CACHE_FACE(point, face, weight, irradiance) recordCacheFace(point, face, weight, irradiance)
#else
#define RECORD_CACHE_FACE(point, face, weight, irradiance)
#endif
