// SPDX-License-Identifier: MIT
// The scene tables on the GPU; filled by src/scene/gpu_scene.cpp.
#pragma once
#include "shared/prelude.h"
CONELIGHT_SHARED_BEGIN

// In Vertex::tangentOct: how thick the closed solid is that the vertex belongs to (scene/closed_solids.h), at most
// 2^(code - VERTEX_SOLID_BIAS) in the mesh's units, 0: none. The code's two lowest bits lie in the lower half.
#define VERTEX_SOLID_BITS 0x00070006u
#define VERTEX_SOLID_BIAS 20
#define VERTEX_SOLID_WORD(code) ((((code)&3u) << 1) | (((code) >> 2) << 16))
#define VERTEX_SOLID_CODE(word) ((((word) >> 1) & 3u) | (((word) >> 14) & 28u))

// 32 bytes. Normal and tangent: octahedral, 2 x 16 bit signed-normalised; tangent sign in the lowest bit of
// its uint, VERTEX_SOLID_BITS above it and in the upper half.
struct Vertex {
    vec3 position;
    uint normalOct;
    // ---- 16 B
    float u;
    float v;
    uint tangentOct;
    uint color;  // linear, r lowest: RGBA8 unorm, or RGB9E5 (INSTANCE_WIDE_COLORS)
};               // 32 B

#define INSTANCE_VISIBLE 1u
#define INSTANCE_VOXELIZED 2u
#define INSTANCE_CASTS_SHADOW 4u
#define INSTANCE_WIDE_COLORS 64u  // vertex colours are RGB9E5: above 1, or finer than 8 bits
#define INSTANCE_GLASS \
    128u  // transmissive: drawn in front of the picture (shared/glass.h), no voxels, no shadow
#define INSTANCE_BAKED 256u  // stands where its light was baked
#define INSTANCE_VEIL \
    512u  // blended: light that passes it in part may be told by its triangles (shared/glass.h)
#define INSTANCE_FLIPPED 16u  // negative determinant: winding is reversed

struct Instance {
    mat4 worldFromObject;
    // ---- 64 B: columns of the inverse transpose of the upper 3x3
    vec4 normalColumn0;
    vec4 normalColumn1;
    vec4 normalColumn2;
    // ---- 112 B
    uint firstIndex;
    uint indexCount;
    uint firstVertex;  // added to every index
    uint material;
    // ---- 128 B
    uint flags;          // INSTANCE_*
    uint firstTriangle;  // number of triangles of all instances before this one, counting every instance
    uint pad0;
    uint pad1;
};  // 144 B

#define MATERIAL_ALPHA_MASK 1u
#define MATERIAL_ALPHA_BLEND 2u
#define MATERIAL_DOUBLE_SIDED 4u
#define MATERIAL_UNLIT 8u
#define MATERIAL_HAS_PHONG 16u        // phong* given by the scene, not derived
#define MATERIAL_BASE_TEXTURE 32u     // has a base colour texture
#define MATERIAL_DETAIL_TEXTURES 64u  // has any of the other five
#define MATERIAL_SOLID 128u           // glass that bends light: a closed surface
#define MATERIAL_LAYERED 256u         // has a coat or sheen that shows
#define MATERIAL_UNIT_NORMALS 512u    // its normal map holds unit normals: shorter means tell their spread
#define UNIT_NORMAL_ROUNDING 4e-3f    // unit normals of 8 bits have lengths of 1 within this

struct Material {
    vec4 baseColor;
    // ---- 16 B
    vec3 emission;  // W/(sr m^2)
    float alphaCutoff;
    // ---- 32 B
    vec3 specularF0;  // dielectric reflectance at normal incidence
    float metallic;
    // ---- 48 B
    float roughness;
    float normalScale;
    uint flags;  // MATERIAL_*
    // Of coat and sheen in even light: the reflectance that they add (rgb), and their share of the light from below (a), as
    // square roots of 8 bits each.
    uint evenLayers;
    // ---- 64 B: layers of the surface array (GpuScene), -1 none: base colour, metallic-roughness, normal,
    // emissive
    ivec4 layers;
    // ---- 80 B: uv' = (dot(row0.xy, uv) + row0.z, dot(row1.xy, uv) + row1.z), rows of the four uses above,
    // then of specular and specular colour
    vec4 uvRow[12];
    // ---- 272 B
    vec3 phongColor;
    float phongShininess;
    // ---- 288 B
    float phongAmbient;
    float phongDiffuse;
    float phongSpecular;
    float transmission;
    // ---- 304 B: of glass
    vec3 absorption;  // 1/m, in a solid
    float ior;
    // ---- 320 B
    vec4 transmissionUvRow[2];  // as uvRow
    // ---- 352 B
    int transmissionLayer;  // of the surface array, -1 none
    int coatNormalMap;      // a texture, -1 none
    float coatNormalScale;
    uint pad0;
    // ---- 368 B: layers
    vec3 sheenColor;
    float sheenRoughness;
    // ---- 384 B
    float coat;
    float coatRoughness;
    uint pad1;
    uint pad2;
    // ---- 400 B: as uvRow: of coat, its roughness and its normal, of the sheen's colour and roughness
    vec4 layerUvRow[10];
};  // 560 B

// Kinds of lights by how they are evaluated; the table is sorted by them (FrameConstants::lightEnds).
#define LIGHT_POINT 0u  // also spots wider than a single shadow map can cover
#define LIGHT_SPOT 1u
#define LIGHT_DIRECTIONAL 2u
#define LIGHT_RECT 3u  // and disks and spheres: area lights

// Light::flags
#define LIGHT_CASTS_SHADOW 1u
#define LIGHT_PROFILE_SHIFT 16  // above: 1 + the layer of its profile (lib/light_profile.glsl), 0: none
// Of a rectangle: the front maps of its sample points are aimed at one place, as far away along the axis as shadowNear
// times LIGHT_AIM_DISTANCE, aside by cosInner and cosOuter in parts of that.
#define LIGHT_AIMED 0x100u
#define LIGHT_AIM_DISTANCE 1e5f
#define LIGHT_FROM_EMITTER 2u  // stands for an emissive instance (scene/emissive_quads.h, small_lamps.h)
#define LIGHT_DISK 4u          // the ellipse in the rectangle
#define LIGHT_SPHERE 8u        // halfU, halfV and direction times the radius are its axes
#define LIGHT_SIDE 0x10u       // of a small box: voxels that the box meets show none of its emission

struct Light {
    vec3 position;
    uint type;
    // ---- 16 B
    vec3 direction;  // unit, where light travels to
    int shadow;      // first tile of the light's shadow maps (lib/shadow.glsl), -1: unshadowed
    // ---- 32 B
    vec3 intensity;  // W/sr, W/m^2 or W/(sr m^2), see conelight::Light
    float range;     // 0: unlimited
    // ---- 48 B
    vec3 halfU;      // area lights: centre to edge; others: unit axes, of the shadow map and of the profile
    float cosInner;  // full intensity inside; a point light has -2 and -3: inside everywhere
    // ---- 64 B
    vec3 halfV;
    float cosOuter;  // none outside
    // ---- 80 B
    vec3 falloff;        // constant, linear, quadratic
    uint customFalloff;  // 1: use it, 0: inverse square; of LIGHT_FROM_EMITTER: the instance
    // ---- 96 B: filled in by the light stage
    float shadowNear;   // depth in the map is shadowNear / distance along the map's axis; directional: 1 -
                        // shadowNear * distance
    float shadowTexel;  // edge of a texel, m at 1 m from the light (perspective) or m (directional)
    uint flags;         // LIGHT_CASTS_SHADOW ...
    uint
        sampleGrid;  // area lights: sample points, their square root; lamps of a tree: their slots (shared/lamps.h)
};                   // 112 B

CONELIGHT_SHARED_END
#ifdef __cplusplus
static_assert(sizeof(conelight::gpu::Vertex) == 32);
static_assert(sizeof(conelight::gpu::Instance) == 144);
static_assert(sizeof(conelight::gpu::Material) == 560);
static_assert(sizeof(conelight::gpu::Light) == 112);
#endif
