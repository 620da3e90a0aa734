#version 450 core
// SPDX-License-Identifier: MIT
// Pixels and lights that shadow maps leave open -> whether they see them, by rays that meet the triangles in the
// voxels. So outlines of shadows are those of triangles (docs/theory/3_light.md, "Edges by rays").
// COUNT_LOOKUPS 1: adds the lookups, as those of occlusion.
#define NEAR_TRIANGLES 1
#define BLOCKING_TRIANGLES 1
layout(local_size_x = 64) in;
#define VISIBILITY_LIST_ACCESS readonly
#include "lib/dot.glsl"
#include "lib/gbuffer.glsl"
// For rays, before them.
#include "lib/surface_array.glsl"
// The others.
#include "lib/light_table.glsl"
#include "lib/lighting.glsl"
#include "lib/linear_index.glsl"
#include "lib/ray_query.glsl"
#include "lib/visibility_list.glsl"
layout(r32ui) uniform uimage2D result;

const float kFarLight = 1e9;  // m, in the place of an infinite distance

// Whether nothing stands between a surface and a light; `otherwise` where no ray can tell. The ray starts on its own
// line, off the surface by more than positions err. Moved along the normal it would shift the shadow.
bool seesLight(uint number, Surface s, bool otherwise, bool wanted) {
    Light light = lightOfTable(number);
    bool parallel = number >= lighting.lightEnds.y;
    vec3 toLight = parallel ? -kFarLight * light.direction : light.position - s.position;
    float distance = length(toLight);
    vec3 direction = toLight / max(distance, 1e-20);
    float start = startOnLine(dot(direction, s.geometricNormal), s.depth);
    vec3 origin = gridFromWorld(s.position + start * direction);

    // The part of the way that lies in the grid; pixels outside have maps alone
    VoxelBounds bounds = voxelBounds();
    vec3 border = mix(bounds.lowest, bounds.highest, greaterThan(direction, vec3(0.0)));
    vec3 exits = (border - origin) * rayInverse(direction);
    float end = min(min(min(exits.x, exits.y), exits.z) - bounds.margin, (distance - start) / grid.voxelSize);
    bool inside = all(greaterThan(origin, bounds.lowest)) && all(lessThan(origin, bounds.highest));
    bool reached = reachesEnd(Ray(origin, direction, wanted && inside ? end : -1.0, vec3(0.0)), otherwise);
    return inside ? reached || end <= 0.0 : otherwise;
}

void main() {
    uint index = visibilityList.firstRow * VISIBILITY_GROUPS_X * VISIBILITY_GROUP + linearIndex();
    bool listed = index < visibilityList.count;
    uvec2 entry = visibilityList.pixels[listed ? index : 0u];
    ivec2 pixel = ivec2(entry.x & 0xffffu, entry.x >> 16);
    Surface s;
    fetchSurface(pixel, s);
    uint seen = imageLoad(result, pixel).x;
    uint open = listed ? entry.y : 0u;
    do {
        uint bit = open & (0u - open);
        int number = max(findLSB(bit), 0);
        bool sees = seesLight(uint(number), s, (seen & bit) != 0u, bit != 0u);
        seen = sees ? seen | bit : seen & ~bit;
        open ^= bit;
    } while (open != 0u);
#if COUNT_LOOKUPS
    addLookups(LOOKUPS_OCCLUSION, listed);
#endif
    if (listed) imageStore(result, pixel, uvec4(seen));
}
