// SPDX-License-Identifier: MIT
// Hooks of lib/record_steps.glsl for paths that end at a face of a voxel: rays, and lookups in the cache.
// After lib/ray_query.glsl.
#include "lib/dot.glsl"
#include "lib/lit_face.glsl"
#include "lib/record_steps.glsl"
#ifdef RECORD_STEPS
void recordFace(uint path, int face) {
    if (path >= RECORD_MAX_PATHS || face < 0) return;
    uvec4 a = texelFetch(voxelFaces, face);
    uvec4 b = texelFetch(litFaces, face);
    record.paths[path].face = face;
    record.paths[path].faceNormal = octDecode(unpackSnorm2x16(a.x));
    record.paths[path].facePlane = unpackOffset(a.y);
    record.paths[path].faceCoverage = unpackWeight(a.y);
    record.paths[path].faceVoxel = a.w;
    record.paths[path].faceAlbedo = unpackAlbedo(b.x);
    record.paths[path].faceRadiance = unpackRgb9e5(b.y);
    record.paths[path].faceIrradiance = litIrradiance(b);
    record.paths[path].faceUpdates = faceUpdates(b.w);
}

// What a ray contributes to the value of its pixel.
struct RaySample {
    float opacity;
    vec3 weight;
    vec3 radiance;
    bool used;
};

// A ray that traceVoxels followed; its steps are those since the last path.
void recordRay(uint kind, Ray ray, VoxelHit hit, RaySample s) {
    bool met = hit.face >= 0;
    // A miss ends where the grid ends.
    float t = met ? hit.t
                  : min(hit.t, length(ray.origin - 0.5 * vec3(gridSize())) + 0.5 * length(vec3(gridSize())));
    vec3 end = worldFromGrid(ray.origin + t * ray.direction);
    float meters = t * grid.voxelSize;
    if (met)
        recordStep(
            RecordedStep(end, grid.voxelSize, s.radiance, s.opacity, meters, 0.0, s.opacity, STEP_HIT));
    uint reason = !s.used ? END_UNUSED : met ? END_FACE : END_OPEN;
    vec3 weight = s.used ? s.weight : vec3(0.0);
    RecordedPath recorded =
        newPath(kind, worldFromGrid(ray.origin), ray.direction, weight, s.radiance, meters);
    recorded.opacity = met ? s.opacity : 0.0;
    recorded.end = reason;
    recordFace(recordPath(recorded), hit.face);
}

// A face that the cache's lookup about `point` (grid coordinates) read.
void recordCacheFace(vec3 point, int face, float weight, vec3 irradiance) {
    if (!recording() || weight <= 0.0) return;
#if NESTED_GRIDS
    vec4 place = voxelPlace(texelFetch(voxelFaces, face).w);
    vec3 toVoxel = place.xyz + 0.5 * place.w - point;
#else
    vec3 toVoxel = vec3(unpackVoxel(texelFetch(voxelFaces, face).w)) + 0.5 - point;
#endif
    float t = max(length(toVoxel), 1e-6);
    RecordedPath recorded = newPath(PATH_CACHE_FACE, worldFromGrid(point), toVoxel / t, vec3(weight),
                                    irradiance, t * grid.voxelSize);
    recorded.opacity = 1.0;
    recorded.end = END_FACE;
    recordFace(recordPath(recorded), face);
}

#define RECORD_RAY(kind, ray, hit, opacity, weight, radiance, used) \
    recordRay(kind, ray, hit, RaySample(opacity, weight, radiance, used))
#else
#define RECORD_RAY(kind, ray, hit, opacity, weight, radiance, used)
#endif
#if defined(RECORD_STEPS) && defined(RECORD_CACHE)
#define RECORD_CACHE_FACE(point, face, weight, irradiance) recordCacheFace(point, face, weight, irradiance)
#else
#define RECORD_CACHE_FACE(point, face, weight, irradiance)
#endif
