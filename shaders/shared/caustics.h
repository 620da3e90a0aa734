// SPDX-License-Identifier: MIT
// Light that solids and panes of glass send on, filled by src/light/caustics.cpp and read by lib/caustic_map.glsl.
//   causticMap  sampler2DArray RGBA32F, a layer per solid over the octahedron of directions from its middle
//               (lib/caustic_map.glsl): W/sr; a: the sum of its three channels times the distance, m, at which
//               the light ends
#pragma once
#include "shared/prelude.h"
CONELIGHT_SHARED_BEGIN

// Solids and smooth panes that have a map; light goes straight through others. In what follows panes count as solids.
#define CAUSTIC_SOLIDS 16

// GlassTriangle::solid of what has no number.
#define CAUSTIC_NO_SOLID 0xffffffffu

// Uniform block of readers.
struct CausticConstants {
    uint count;  // of solids with maps: the first ones
    float edge;  // of a map, texels
    float voxelSize;
    uint turnsAll;  // a bit per solid: light of lamps comes through it by its map alone, never straight
    // ---- 16 B
    vec4 middle[CAUSTIC_SOLIDS];  // w: radius
};                                // 272 B

// Ways on which a path goes through a solid: its first surface reflects it; it is let out at once; the inner
// side of a surface reflects it first.
#define CAUSTIC_WAYS 3u

// Uniform block of the passes that fill the map of one solid by the light of one lamp.
struct CausticPass {
    vec3 middle;
    float radius;
    // ---- 16 B
    uint solid;
    uint light;     // number in the table
    uint grid;      // paths per edge, over the directions towards the solid
    uint lampGrid;  // points of the lamp per edge
    // ---- 32 B
    float scale;  // counts per W
    float far;    // m: beyond all that is there
    uint edge;    // of the map, texels
    uint level;   // of the sums, of the pass that adds up levels
};                // 48 B

// Where a path ended.
struct CausticEnd {
    vec2 place;  // on the octahedron
    float distance;
    uint history;  // of its surfaces; 0: it did not end on a voxel; CAUSTIC_ROUGH: a path by itself
    // ---- 16 B
    vec3 flux;  // W
    uint
        entry;  // normal where it entered: octahedral, 2 x 16 bit signed-normalised; of rough ones the lobes' alpha
};              // 32 B

// Part of a history: a rough surface has turned the path, for itself.
#define CAUSTIC_ROUGH 0x80000000u

// Words per texel of the sums: four channels, lower and upper half.
#define CAUSTIC_WORDS 8u

// The sums have levels, each of half the edge of the one before, one after the other. A path is added to that whose
// texels are about as large as its share of what it covers.
#define CAUSTIC_LEVELS 6u

// The first texel of a level, of maps whose edge is a power of two: the sum of the squares before it.
#define CAUSTIC_LEVEL_START(edge, level) \
    (((edge) * (edge) - ((edge) >> (level)) * ((edge) >> (level))) / 3u * 4u)

CONELIGHT_SHARED_END
#ifdef __cplusplus
static_assert(sizeof(conelight::gpu::CausticConstants) == 272);
static_assert(sizeof(conelight::gpu::CausticPass) == 48);
static_assert(sizeof(conelight::gpu::CausticEnd) == 32);
#endif
