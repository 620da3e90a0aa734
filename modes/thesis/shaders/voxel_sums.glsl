// SPDX-License-Identifier: MIT
// A piece of surface within one column of voxels -> its direct light, put into the volume or into sums: the Phong
// model without gloss (thesis, "3D texture storage"), radiance leaving the front of the surface.
//
// RACING_STORES: stored as it comes, opacity 1; the last of several pieces stays; OCTREE: in place of the sums,
// as places in a tree are known only later. Else: summed with the area it covers, in fixed point, so that the order
// does not matter; resolve.comp.glsl makes colours and opacities of the sums. The sum is shared by the two voxels
// along the dominant axis between whose centres the surface lies, in proportion, unless FACE_ROUNDING: all of it to
// the voxel of the truncated position. AXIS_AREAS: with its projections along the three axes, for occlusion cones. CONTENT: instead of light
// what bounces need. DARK_EMITTERS: without emission. Before it: ThesisGrid `grid`.
#include "lib/dot.glsl"
#include "lib/light_table.glsl"
#include "lib/octahedral.glsl"
#include "lib/scene_tables.glsl"
#include "lib/surface_array.glsl"
#include "thesis/shaders/constants.h"
#include "thesis/shaders/defects.glsl"
#include "thesis/shaders/dominant_axis.glsl"
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
#include "thesis/shaders/brick_slots.glsl"
#include "thesis/shaders/visibility.glsl"
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

// A piece of surface within one column of voxels.
struct Piece {
    vec3 gridPosition;  // in voxels
    vec3 normal;        // unit
    vec2 uv;
    float coverage;  // of the column's cross-section
};

// The surface that it is of, and what all of its pieces read: read once, as drivers do not keep it across stores.
struct SurfaceOfPiece {
    uint axis;  // along which it is voxelized
    uint material;
    uint flags;      // of the material
    vec4 color;      // without textures
    vec3 strengths;  // x ambient, y diffuse; z: cutoff of opacity
    vec3 emission;
    vec3 areas;   // seen along each axis, in parts of that along `axis`; signs of the normal
    bool isLamp;  // shines as a light of the table, not from the volume
    Light light;  // the first of the table
};

// `ofVertices`: RGBA8.
SurfaceOfPiece surfaceOfPiece(uint axis, uint index, uint ofVertices, vec3 areas, bool isLamp) {
    SurfaceOfPiece s;
    s.axis = axis;
    s.material = index;
    s.flags = materials[index].flags;
    // The Phong colour of the scene's file, else the base colour.
    bool hasPhong = (s.flags & MATERIAL_HAS_PHONG) != 0u;
    s.color = hasPhong ? vec4(materials[index].phongColor, 1.0)
                       : materials[index].baseColor * unpackUnorm4x8(ofVertices);
    s.strengths = vec3(0.0, materials[index].phongDiffuse, materials[index].alphaCutoff);
#if AMBIENT_TWICE
    s.strengths.x = materials[index].phongAmbient;
#endif
    s.emission = materials[index].emission;
    s.areas = areas;
    s.isLamp = isLamp;
    s.light = lightOfTable(0u);
    return s;
}

// Colour and opacity of the surface.
vec4 surfaceColor(SurfaceOfPiece s, vec2 uv) {
#if TEXTURED
    if ((s.flags & MATERIAL_HAS_PHONG) != 0u) return s.color;
    int layer = materials[s.material].layers.x;
    vec3 row0 = materials[s.material].uvRow[0].xyz, row1 = materials[s.material].uvRow[1].xyz;
    vec2 textureUv = vec2(dot(row0.xy, uv) + row0.z, dot(row1.xy, uv) + row1.z);
    // A sixteenth of the texture: voxels rarely see less of it, and the finest level would shimmer.
    vec4 texel = sampleSurfaceArray(max(layer, 0), textureUv, 1.0 / 16.0);
    return layer >= 0 ? s.color * texel : s.color;
#else
    return s.color;
#endif
}

#if !DARK_EMITTERS && CONTENT == CONTENT_LIGHT
vec3 emissionOf(SurfaceOfPiece s, vec2 uv) {
    vec3 emission = s.emission;
#if TEXTURED
    int layer = materials[s.material].layers.w;
    vec3 row0 = materials[s.material].uvRow[6].xyz, row1 = materials[s.material].uvRow[7].xyz;
    vec2 textureUv = vec2(dot(row0.xy, uv) + row0.z, dot(row1.xy, uv) + row1.z);
    vec3 texel = sampleSurfaceArray(max(layer, 0), textureUv, 1.0 / 16.0).rgb;
    if (layer >= 0) emission *= texel;
#endif
    return emission;
}
#endif

vec3 directLight(SurfaceOfPiece s, vec3 color, vec3 position, vec3 n) {
    vec3 sum = vec3(0.0);
    Light source = s.light;
    uint i = 0u;
    while (i < uint(grid.boxMin.w)) {
        ThesisLight light = thesisLight(source, position);
        vec3 part = light.color;
#if !UNATTENUATED_VOXELS
        part *= light.falloff;
#endif
        part *= lightVisibility(source, position, n);
        sum += part * (s.strengths.x + s.strengths.y * thesisCosine(source, light, position, n));
        ++i;
        if (i < uint(grid.boxMin.w)) source = lightOfTable(i);
    }
    return sum * color;
}

#if !RACING_STORES
void addToVoxel(ivec3 voxel, vec3 radiance, float weight, vec3 areas, vec2 column) {
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
    float dither = fract(dot(column, vec2(0.7548777, 0.5698403)) + 1e3 * weight);
    uvec3 seen = uvec3(abs(areas) * (weight * 512.0) + dither);
    // Axes along which a surface is not seen are most of all, and cost nothing.
    for (int k = 0; k < 3; ++k)
        if (seen[k] > 0u) atomicAdd(areaSums[3 * place + k], areas[k] > 0.0 ? seen[k] : seen[k] << 16);
#endif
}
#endif

// Light that the piece sends out, or what else is summed; `color` as of surfaceColor.
vec3 contentOf(Piece p, SurfaceOfPiece surface, vec4 color) {
    bool unlit = (surface.flags & MATERIAL_UNLIT) != 0u;
#if CONTENT == CONTENT_ALBEDO
    float mirrored =
        reflectance(materials[surface.material].phongSpecular, materials[surface.material].phongShininess);
    vec3 radiance = unlit ? vec3(0.0) : min(diffuseAlbedo(color.rgb, surface.strengths.y, mirrored), 1.0);
#elif CONTENT == CONTENT_NORMAL
    vec3 radiance = 0.5 + 0.5 * p.normal;
#else
    vec3 position = grid.origin + p.gridPosition * grid.voxelSize;
    vec3 radiance = unlit ? vec3(0.0) : directLight(surface, color.rgb, position, p.normal);
#if !DARK_EMITTERS
    if (!surface.isLamp) radiance += unlit ? color.rgb : emissionOf(surface, p.uv);
#endif
#endif
    return radiance;
}

// `column`: the lowest corner of the piece's, in the plane across the dominant axis.
void addPiece(Piece p, SurfaceOfPiece surface, vec2 column) {
    vec4 color = surfaceColor(surface, p.uv);
    uint flags = surface.flags;
    // Masked surfaces are there or not; blended ones cover in proportion, double-sided ones are lit from
    // the side the light comes from only as far as the thesis goes: their front.
    if ((flags & MATERIAL_ALPHA_MASK) != 0u) p.coverage *= color.a < surface.strengths.z ? 0.0 : 1.0;
    if ((flags & MATERIAL_ALPHA_BLEND) != 0u) p.coverage *= color.a;
    vec3 radiance = contentOf(p, surface, color);
    // The sums' scale holds radiance up to this; half floats hold 65,504.
    radiance = clamp(radiance, vec3(0.0), vec3(16777216.0 / grid.sumScale));

    ivec3 axisStep = surface.axis == 0u   ? ivec3(1, 0, 0)
                     : surface.axis == 1u ? ivec3(0, 1, 0)
                                          : ivec3(0, 0, 1);
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
    addToVoxel(ivec3(p.gridPosition), radiance, p.coverage, surface.areas, column + 0.5);
#else
    float depth = dot(p.gridPosition, vec3(axisStep)) - 0.5;
    float low = floor(depth);
    float share = depth - low;
    // Whatever rounding did to the point inside the column.
    ivec3 voxel = ivec3(permuted(vec3(column, 0.0), surface.axis)) + axisStep * int(low);
    addToVoxel(voxel, radiance, p.coverage * (1.0 - share), surface.areas, column + 0.5);
    addToVoxel(voxel + axisStep, radiance, p.coverage * share, surface.areas, column + 0.5);
#endif
#endif
}
