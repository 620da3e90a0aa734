#version 450 core
// SPDX-License-Identifier: MIT
// Fragment of a triangle seen along its dominant axis -> its direct light, put into the volume: the Phong
// model without gloss (thesis, "3D texture storage"), radiance leaving the front of the surface.
//
// RACING_STORES: stored as it comes, opacity 1; the last of several fragments stays; OCTREE: in place of the sums,
// as places in a tree are known only later. Else: summed with the
// area it covers, in fixed point, so that the order does not matter; resolve.comp.glsl makes colours
// and opacities of the sums. The sum is shared by the two voxels along the dominant axis between whose
// centres the surface lies, in proportion, unless FACE_ROUNDING: all of it to the voxel of the truncated
// position. AXIS_AREAS: with its projections along the three axes, for occlusion cones. CONTENT: instead of light
// what bounces need. DARK_EMITTERS: without emission, as for emitters that are lights as well
// (LIGHT_FROM_EMITTER), which would light everything twice.
#include "lib/light_table.glsl"
#include "lib/octahedral.glsl"
#include "lib/scene_tables.glsl"
#include "lib/surface_array.glsl"
#include "thesis/shaders/constants.h"
#include "thesis/shaders/coverage.glsl"
#include "thesis/shaders/defects.glsl"
#include "thesis/shaders/light.glsl"
#ifndef SHADOWED
#error SHADOWED must be 0 or 1: 1 tests the lights' shadow maps, with the defines of light::lightDefines
#endif
#ifndef TEXTURED
#error TEXTURED must be 0 or 1: 1 when a material of the scene has a base colour texture
#endif
// What is summed.
#define CONTENT_LIGHT 0
#define CONTENT_ALBEDO 1  // of diffuse light
#define CONTENT_NORMAL 2  // 0..1 for -1..1
#ifndef CONTENT
#define CONTENT CONTENT_LIGHT
#endif
#ifndef AXIS_AREAS
#define AXIS_AREAS 0
#endif
#ifndef OCTREE
#define OCTREE 0
#endif
#include "thesis/shaders/albedo.glsl"
#include "thesis/shaders/visibility.glsl"
layout(std140) uniform ThesisGridBlock { ThesisGrid grid; };
#include "thesis/shaders/brick_slots.glsl"
layout(std430) buffer SumTable { uint sums[]; };  // 4 per voxel of the marked bricks
#if AXIS_AREAS
// 3 per such voxel, one per axis: what faces its positive side in the lower half, the other in the upper.
layout(std430) buffer AreaTable { uint areaSums[]; };
#endif
#if RACING_STORES && !OCTREE
#if CLIPPED_RADIANCE
layout(rgba8) uniform writeonly image3D volume;
#else
layout(rgba16f) uniform writeonly image3D volume;
#endif
#endif

layout(location = 0) flat in uvec3 constant;
#if CENTER_COVERAGE
layout(location = 1) in vec3 gridPositionIn;
layout(location = 2) in vec3 normalIn;
layout(location = 3) in vec2 uvIn;
#else
layout(location = 1) flat in vec4 corner0;
layout(location = 2) flat in vec4 corner1;
layout(location = 3) flat in vec4 corner2;
layout(location = 4) flat in vec4 uv01;
layout(location = 5) flat in vec2 uv2;
#endif
#if AXIS_AREAS
layout(location = 6) flat in vec3 areas;
#endif

// A piece of surface within one column of voxels.
struct Piece {
    vec3 gridPosition;  // in voxels
    vec3 normal;        // unit
    vec2 uv;
    float coverage;  // of the column's cross-section
};

vec3 permuted(vec3 v, uint axis) { return axis == 0u ? v.zyx : axis == 1u ? v.xzy : v; }

Piece piece() {
    Piece result;
#if CENTER_COVERAGE
    result.gridPosition = gridPositionIn;
    result.normal = normalize(normalIn);
    result.uv = uvIn;
    result.coverage = 1.0;
#else
    // Relative to the pixel, so that the digits are spent on the pixel.
    vec2 corner = floor(gl_FragCoord.xy);
    vec2 a = corner0.xy - corner, b = corner1.xy - corner, c = corner2.xy - corner;
    result.coverage = triangleCoverage(a, b, c);
    vec3 w = nearestBarycentrics(a, b, c, vec2(0.5));
    result.gridPosition = permuted(w.x * corner0.xyz + w.y * corner1.xyz + w.z * corner2.xyz, constant.x);
    vec3 n = w.x * octDecode(unpackSnorm2x16(floatBitsToUint(corner0.w))) +
             w.y * octDecode(unpackSnorm2x16(floatBitsToUint(corner1.w))) +
             w.z * octDecode(unpackSnorm2x16(floatBitsToUint(corner2.w)));
    result.normal = n * inversesqrt(max(dot(n, n), 1e-12));
    result.uv = w.x * uv01.xy + w.y * uv01.zw + w.z * uv2;
#endif
    return result;
}

// Colour and opacity of the surface: the Phong colour of the scene's file, else the base colour.
vec4 surfaceColor(uint index, vec2 uv) {
    if ((materials[index].flags & MATERIAL_HAS_PHONG) != 0u) return vec4(materials[index].phongColor, 1.0);
    vec4 color = materials[index].baseColor * unpackUnorm4x8(constant.z);
#if TEXTURED
    int layer = materials[index].layers.x;
    vec3 row0 = materials[index].uvRow[0].xyz, row1 = materials[index].uvRow[1].xyz;
    vec2 textureUv = vec2(dot(row0.xy, uv) + row0.z, dot(row1.xy, uv) + row1.z);
    // A sixteenth of the texture: voxels rarely see less of it, and the finest level would shimmer.
    vec4 texel = sampleSurfaceArray(max(layer, 0), textureUv, 1.0 / 16.0);
    return layer >= 0 ? color * texel : color;
#else
    return color;
#endif
}

#if !DARK_EMITTERS && CONTENT == CONTENT_LIGHT
vec3 emissionOf(uint index, vec2 uv) {
    vec3 emission = materials[index].emission;
#if TEXTURED
    int layer = materials[index].layers.w;
    vec3 row0 = materials[index].uvRow[6].xyz, row1 = materials[index].uvRow[7].xyz;
    vec2 textureUv = vec2(dot(row0.xy, uv) + row0.z, dot(row1.xy, uv) + row1.z);
    vec3 texel = sampleSurfaceArray(max(layer, 0), textureUv, 1.0 / 16.0).rgb;
    if (layer >= 0) emission *= texel;
#endif
    return emission;
}
#endif

vec3 directLight(uint index, vec3 color, vec3 position, vec3 n) {
    float diffuse = materials[index].phongDiffuse;
#if AMBIENT_TWICE
    float ambient = materials[index].phongAmbient;
#else
    float ambient = 0.0;
#endif
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < uint(grid.boxMin.w); ++i) {
        ThesisLight light = thesisLight(lights[i], position);
        vec3 part = light.color;
#if !UNATTENUATED_VOXELS
        part *= light.falloff;
#endif
        part *= lightVisibility(lights[i], position, n);
        sum += part * (ambient + diffuse * thesisCosine(lights[i], light, position, n));
    }
    return sum * color;
}

#if !RACING_STORES
void addToVoxel(ivec3 voxel, vec3 radiance, float weight) {
    // Radiance is at most 2^24 steps (ThesisVolume chooses the scale), weights 2^24 per full column: up to
    // 255 layers of surface fit into one voxel. What weighs less than half a step is nothing.
    uint steps = uint(weight * 16777216.0 + 0.5);
    int place = sumPlace(voxel);
    if (steps == 0u || place < 0) return;
    int at = 4 * place;
    uvec3 color = uvec3(radiance * (weight * grid.sumScale) + 0.5);
    atomicAdd(sums[at], color.r);
    atomicAdd(sums[at + 1], color.g);
    atomicAdd(sums[at + 2], color.b);
    atomicAdd(sums[at + 3], steps);
#if AXIS_AREAS
    // Steps of 1/512. Rounded up in proportion, by numbers that are even over the places of pieces and differ
    // with their size (the R2 sequence, Roberts 2018), so that small triangles add up to their area.
    float dither = fract(dot(gl_FragCoord.xy, vec2(0.7548777, 0.5698403)) + 1e3 * weight);
    uvec3 seen = uvec3(abs(areas) * (weight * 512.0) + dither);
    // Axes along which a surface is not seen are most of all, and cost nothing.
    for (int k = 0; k < 3; ++k)
        if (seen[k] > 0u) atomicAdd(areaSums[3 * place + k], areas[k] > 0.0 ? seen[k] : seen[k] << 16);
#endif
}
#endif

void main() {
    uint material = constant.y;
    Piece p = piece();
    vec3 position = grid.origin + p.gridPosition * grid.voxelSize;
    vec4 color = surfaceColor(material, p.uv);
    uint flags = materials[material].flags;
    // Masked surfaces are there or not; blended ones cover in proportion, double-sided ones are lit from
    // the side the light comes from only as far as the thesis goes: their front.
    if ((flags & MATERIAL_ALPHA_MASK) != 0u)
        p.coverage *= color.a < materials[material].alphaCutoff ? 0.0 : 1.0;
    if ((flags & MATERIAL_ALPHA_BLEND) != 0u) p.coverage *= color.a;
    bool unlit = (flags & MATERIAL_UNLIT) != 0u;
#if CONTENT == CONTENT_ALBEDO
    float mirrored = reflectance(materials[material].phongSpecular, materials[material].phongShininess);
    vec3 radiance =
        unlit ? vec3(0.0) : min(diffuseAlbedo(color.rgb, materials[material].phongDiffuse, mirrored), 1.0);
#elif CONTENT == CONTENT_NORMAL
    vec3 radiance = 0.5 + 0.5 * p.normal;
#else
    vec3 radiance = unlit ? vec3(0.0) : directLight(material, color.rgb, position, p.normal);
#if !DARK_EMITTERS
    radiance += unlit ? color.rgb : emissionOf(material, p.uv);
#endif
#endif
    // The sums' scale holds radiance up to this; half floats hold 65,504.
    radiance = clamp(radiance, vec3(0.0), vec3(16777216.0 / grid.sumScale));

    ivec3 axisStep = constant.x == 0u ? ivec3(1, 0, 0) : constant.x == 1u ? ivec3(0, 1, 0) : ivec3(0, 0, 1);
#if RACING_STORES
#if FACE_ROUNDING
    ivec3 voxel = ivec3(p.gridPosition);
#else
    // Half-open, and on a face the voxel behind the surface: 1/1000 voxel against the normal decides.
    ivec3 voxel = ivec3(floor(p.gridPosition - 1e-3 * p.normal));
#endif
#if OCTREE
    int place = sumPlace(voxel);
    if (p.coverage > 0.0 && place >= 0) {
        uvec3 steps = uvec3(radiance * grid.sumScale + 0.5);
        sums[4 * place] = steps.r;
        sums[4 * place + 1] = steps.g;
        sums[4 * place + 2] = steps.b;
        sums[4 * place + 3] = 16777216u;
    }
#else
    ivec3 inBox = voxel - grid.boxMin.xyz;
    if (p.coverage > 0.0 && isInBox(inBox)) {
        // A brick that is in the list already has its number here.
        uint brick = brickIndex(inBox / THESIS_BRICK);
        if (brickSlots[brick] == 0u) atomicOr(brickSlots[brick], 1u);
        imageStore(volume, voxel, vec4(radiance, 1.0));
    }
#endif
#else
#if FACE_ROUNDING
    addToVoxel(ivec3(p.gridPosition), radiance, p.coverage);
#else
    float depth = dot(p.gridPosition, vec3(axisStep)) - 0.5;
    float low = floor(depth);
    float share = depth - low;
    // The column is the pixel's, whatever rounding did to the point inside it.
    vec3 column = permuted(vec3(floor(gl_FragCoord.xy), 0.0), constant.x);
    ivec3 voxel = ivec3(column) + axisStep * int(low);
    addToVoxel(voxel, radiance, p.coverage * (1.0 - share));
    addToVoxel(voxel + axisStep, radiance, p.coverage * share);
#endif
#endif
}
