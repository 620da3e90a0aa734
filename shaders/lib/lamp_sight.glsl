// SPDX-License-Identifier: MIT
// Whether a place sees a lamp, by a ray that meets the triangles in the voxels. Includers define NEAR_TRIANGLES 1 and
// BLOCKING_TRIANGLES 1, and include before what lib/triangle_hit.glsl asks for. Outside of all voxels nothing is in the way.
#include "lib/dot.glsl"
#include "lib/ray_query.glsl"

// Of the way to a lamp, which stays out of the lamp's own place.
const float kLampEnd = 1.0 - 1e-5;

// `start`: off its surface, world space.
bool seesLamp(vec3 start, vec3 lamp, bool wanted) {
    vec3 way = lamp - start;
    float distance = length(way);
    vec3 direction = way / max(distance, 1e-20);
    vec3 origin = gridFromWorld(start);
    float end = kLampEnd * distance * grid.inverseVoxelSize;

    // The part of the way that lies in the voxels
    VoxelBounds bounds = voxelBounds();
    vec3 inverse = rayInverse(direction);
    vec3 a = (bounds.lowest + bounds.margin - origin) * inverse,
         b = (bounds.highest - bounds.margin - origin) * inverse;
    vec3 low = min(a, b), high = max(a, b);
    float enter = max(max(low.x, max(low.y, low.z)), 0.0);
    float leave = min(min(high.x, min(high.y, high.z)), end);
    bool meets = wanted && enter < leave;
    Ray ray = Ray(origin + enter * direction, direction, meets ? leave - enter : -1.0, vec3(0.0));
    return reachesEnd(ray, true) || !meets;
}
