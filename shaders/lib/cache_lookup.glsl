// SPDX-License-Identifier: MIT
// The irradiance cache at a point of a surface: faces of the eight voxels about it that look as the normal
// does, by trilinear weight, square of the normal's component and coverage:
//   E(p) = sum t n_k^2 W E(F) / sum t n_k^2 W      (docs/theory/4e_pixels.md, "The cache at pixels")
// Only axes along which the normal has a part worth a fetch are visited: on walls along the axes one of
// three.
//
// Reads what voxels::Voxels and light::LitVoxels declare.
#include "lib/dot.glsl"
#include "lib/ray_query.glsl"
#include "lib/record_face.glsl"
#include "shared/irradiance.h"
uniform usamplerBuffer faceLight;

// Squares of components below this are left out: 3 % of the normal's length.
const float kLeastAxis = 1e-3;
#ifndef CACHE_NORMALS
#define CACHE_NORMALS 0
#endif

// Faces count for the surface's normal fully where they are turned from it by less than the acos of the sum
// of these, and not beyond the acos of the first: on curved things neighbours do, across edges they do not.
const float kSameBend = 0.75;
const float kSameBendRange = 0.1;

// The normals of the faces about a point, as far as they are near a normal.
struct NormalSum {
    vec3 sum;       // of any length
    float weights;  // of this sum
    float spread;   // mean square of the distance of their places along the surface, voxels^2
};

// At the middle of a voxel places do not spread, and normals by their rounding.
const float kLeastSpread = 0.1;

// By how much normals turn per voxel, rad: their variance is that of the places times the square of it.
float curvatureOf(NormalSum bent) {
    float together = dot(bent.sum, bent.sum) / max(bent.weights * bent.weights, 1e-12);
    return bent.weights > 0.0 ? sqrt(max(1.0 - together, 0.0) / max(bent.spread, kLeastSpread)) : 0.0;
}

// rgb irradiance / pi; a: sum of weights, 0 where no face was found. `bent` is found with CACHE_NORMALS 1.
// Which of the eight voxels are there is asked first, then only those are visited, and of their faces those that
// count: on a wall four of eight voxels and one face each (platform figures: docs/theory/4e_pixels.md, "The cache at pixels").
vec4 irradianceInGrid(vec3 point, vec3 normal, bool wanted, out NormalSum bent) {
    vec3 corner = floor(point - 0.5);
    vec3 part = point - 0.5 - corner;
    ivec3 base = ivec3(corner);
    ivec3 last = gridSize() - 1;
    vec3 square = normal * normal;
    uint facing = (square.x > kLeastAxis ? (normal.x < 0.0 ? 2u : 1u) : 0u) |
                  (square.y > kLeastAxis ? (normal.y < 0.0 ? 8u : 4u) : 0u) |
                  (square.z > kLeastAxis ? (normal.z < 0.0 ? 32u : 16u) : 0u);
    COUNT_LOOKUP(wanted ? 8 : 0);
    uint corners = 0u;
    for (int i = 0; i < 8; ++i) {
        ivec3 voxel = clamp(base + ivec3(i & 1, (i >> 1) & 1, i >> 2), ivec3(0), last);
        uvec2 mask = imageLoad(voxelBrickImage, STORED_BRICK(voxel >> 2)).xy;
        corners |= brickHas(mask, bitOfVoxel(voxel)) ? 1u << i : 0u;
    }
    corners = wanted ? corners : 0u;
    vec4 sum = vec4(0.0);
    bent = NormalSum(vec3(0.0), 0.0, dot(part * (1.0 - part), 1.0 - square));
    do {
        bool any = corners != 0u;
        COUNT_LOOKUP(any ? 2 : 0);
        int i = max(findLSB(corners), 0);
        ivec3 offset = ivec3(i & 1, (i >> 1) & 1, i >> 2);
        ivec3 voxel = clamp(base + offset, ivec3(0), last);
        vec3 t = mix(1.0 - part, part, vec3(offset));
        uvec4 word = imageLoad(voxelBrickImage, STORED_BRICK(voxel >> 2));
        uint record = texelFetch(voxelRecords, any ? int(voxelRecordIndex(word, bitOfVoxel(voxel))) : 0).x;
        uint directions = faceDirections(record);
        int first = int(faceBase(record));
        uint left = any ? directions & facing : 0u;
        do {
            COUNT_LOOKUP(left != 0u ? 1 : 0);
            uint lowest = left & (0u - left);
            int face = left != 0u ? first + bitCount(directions & (lowest - 1u)) : 0;
            uvec2 light = texelFetch(faceLight, face).xy;
            float share = lowest < 4u ? square.x : (lowest < 16u ? square.y : square.z);
            float weight = left != 0u ? t.x * t.y * t.z * share * unpackWeight(light.y) : 0.0;
            vec3 irradiance = vec3(unpackHalf2x16(light.x), unpackHalf2x16(light.y).x);
            sum += weight * vec4(irradiance, 1.0);
#if CACHE_NORMALS
            COUNT_LOOKUP(left != 0u ? 1 : 0);
            vec3 turned = octDecode(unpackSnorm2x16(texelFetch(voxelFaces, face).x));
            float same = weight * clamp((dot(turned, normal) - kSameBend) / kSameBendRange, 0.0, 1.0);
            bent.sum += same * turned;
            bent.weights += same;
#endif
            RECORD_CACHE_FACE(GRID_POINT(point), face, weight, irradiance);
            left ^= lowest;
        } while (left != 0u);
        corners &= corners - 1u;
    } while (corners != 0u);
    return vec4(sum.rgb / max(sum.a, 1e-12), sum.a);
}

#if NESTED_GRIDS
// In the level that holds the point. Where it has nothing there, the point lies on a border by rounding: the surface is
// in the next coarser level, or the next finer one.
vec4 cachedIrradiance(vec3 point, vec3 normal, bool wanted, out NormalSum bent) {
    int own = levelAt(point), attempts = coarsestLevel() > 0 ? 3 : 1;
    vec4 found;
    int attempt = 0;
    do {
        int level = clamp(own + (attempt == 2 ? -1 : attempt), 0, coarsestLevel());
        levelOfRay = levelPlace(level);
        levelBricksBefore = level * int(grid.bricksZ);
        found = irradianceInGrid(levelFromGrid(point, levelOfRay), normal, wanted, bent);
    } while (wanted && found.a <= 0.0 && ++attempt < attempts);
    return found;
}
#else
vec4 cachedIrradiance(vec3 point, vec3 normal, bool wanted, out NormalSum bent) {
    return irradianceInGrid(point, normal, wanted, bent);
}
#endif

vec4 cachedIrradiance(vec3 point, vec3 normal, bool wanted) {
    NormalSum bent;
    return cachedIrradiance(point, normal, wanted, bent);
}
