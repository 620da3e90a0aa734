// SPDX-License-Identifier: MIT
// The irradiance cache at a point of a surface: faces of the eight voxels about it that look as the normal
// does, by trilinear weight, square of the normal's component and coverage:
//   E(p) = sum t n_k^2 W E(F) / sum t n_k^2 W      (docs/theory/4_gather.md, "The cache at pixels")
// Only axes along which the normal has a part worth a fetch are visited: on walls along the axes one of
// three.
//
// Before the call: SurfaceVoxels::bind. Includers that also trace rays share the samplers with
// lib/ray_query.glsl.
#include "lib/ray_query.glsl"
#include "lib/record_face.glsl"
#include "shared/irradiance.h"

// Squares of components below this are left out: 3 % of the normal's length.
const float kLeastAxis = 1e-3;

// rgb irradiance / pi; a: sum of weights, 0 where no face was found.
vec4 cachedIrradiance(vec3 point, vec3 normal, bool wanted) {
    vec3 corner = floor(point - 0.5);
    vec3 part = point - 0.5 - corner;
    ivec3 base = ivec3(corner);
    ivec3 last = gridSize() - 1;
    vec3 square = normal * normal;
    uint axes = (square.x > kLeastAxis ? 1u : 0u) | (square.y > kLeastAxis ? 2u : 0u) |
                (square.z > kLeastAxis ? 4u : 0u);
    axes = wanted ? axes : 0u;
    vec4 sum = vec4(0.0);
    do {
        uint lowest = axes & (0u - axes);
        int axis = lowest == 4u ? 2 : (lowest == 2u ? 1 : 0);
        float component = axis == 0 ? normal.x : (axis == 1 ? normal.y : normal.z);
        int direction = 2 * axis + (component < 0.0 ? 1 : 0);
        float share = axes != 0u ? component * component : 0.0;
        for (int i = 0; i < 8; ++i) {
            ivec3 offset = ivec3(i & 1, (i >> 1) & 1, i >> 2);
            ivec3 voxel = clamp(base + offset, ivec3(0), last);
            vec3 t = mix(1.0 - part, part, vec3(offset));
            uvec4 word = texelFetch(voxelBricks, voxel >> 2, 0);
            uint bit = bitOfVoxel(voxel);
            bool occupied = brickHas(word.xy, bit);
            uint record = texelFetch(voxelRecords, occupied ? int(voxelRecordIndex(word, bit)) : 0).x;
            bool faces = occupied && ((faceDirections(record) >> direction) & 1u) != 0u;
            int face = faces ? int(faceIndex(record, direction)) : 0;
            float coverage = unpackWeight(texelFetch(voxelFaces, 2 * face).y);
            uvec4 light = texelFetch(voxelFaces, 2 * face + 1);
            uint updates = light.w >> 16;
            faces = faces && updates != 0u && updates < IRRADIANCE_DEAD;
            float weight = faces ? t.x * t.y * t.z * share * coverage : 0.0;
            sum += weight * vec4(unpackHalf2x16(light.z), unpackHalf2x16(light.w).x, 1.0);
            RECORD_CACHE_FACE(point, face, weight, vec3(unpackHalf2x16(light.z), unpackHalf2x16(light.w).x));
        }
        axes ^= lowest;
    } while (axes != 0u);
    return vec4(sum.rgb / max(sum.a, 1e-12), sum.a);
}
