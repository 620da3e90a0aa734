// SPDX-License-Identifier: MIT
// What the irradiance cache (src/light/irradiance_cache.h) and its readers (lib/voxel_light.glsl) share.
//
//   litFaces      LitFace per face, what rays read where they hit
//   lightSamples  uints, LIGHT_*: pools of faces that light samples are drawn from, anew for every update
//   cachedDirect  uint per face: RGB9E5 of its radiance less what point, spot and directional lights give
//   faceLight     two uints per face, what lookups at pixels read: irradiance / pi as three halves, and 16
//                 bits of its weight as in FaceRecord::offsetWeight: its coverage, less for reverse faces, 0
//                 for those that are dead or were never updated
#pragma once
#include "shared/prelude.h"

// Names: litFaces (usamplerBuffer RGBA32UI; as storage LitFaceTable), lightSamples, cachedDirect
// (usamplerBuffer R32UI) and faceLight (usamplerBuffer RG32UI) for readers;
// the cache's passes read tables of their own through buffer textures, too (`...Texels`), because software
// drivers read storage lane by lane in loops.

// Light samples (docs/theory/4c_estimator.md, "The pool"). Clusters are the faces of one direction in a block of the grid, or
// of one of nested ones, so many blocks a side; each has a pool of faces, drawn by flux. Cells are where faces gather, the
// same numbers of them; each has a row of slots, half a word each: clusters, drawn by what they bring there. Behind the
// rows of cells is one for all places, of flux alone.
#define LIGHT_BLOCKS_OF_GRID 8
#define LIGHT_BLOCKS_OF_LEVEL 4
#define LIGHT_CLUSTERS 3072  // 6 * 8^3, and 6 * 4^3 * VOXEL_MOST_LEVELS
#define LIGHT_ROWS (LIGHT_CLUSTERS + 1)
#define LIGHT_ROW_OF_ALL LIGHT_CLUSTERS
#define LIGHT_PLACE_OF_ALL 0u  // in the list of rows
// Room for rows: the fewer are in use, the larger they are, from this size down.
#define LIGHT_MOST_SLOTS 128u  // of a row
#define LIGHT_ROOM 1024u       // rows that can have so many
// Room for all pools, entries. A pool is as large as its part of all slots, within these powers of two.
#define LIGHT_POOL_ENTRIES 32768u
#define LIGHT_LEAST_POOL_SHIFT 3u
#define LIGHT_MOST_POOL_SHIFT 10u
// Of the faces one in so many marks its cell and its cluster, eight side by side: where all are missed, the row of all is
// drawn from once, and clusters are taken to be whole blocks.
#define LIGHT_MARKED_PERIOD 2u
// Marks: three words of bits for each row, and for each cluster (packExtents).
#define LIGHT_CLUSTER_MARKS_AT (3 * LIGHT_CLUSTERS)
#define LIGHT_MARK_WORDS (2 * LIGHT_CLUSTER_MARKS_AT)
// Words of lightSamples: three about all; then a scale per row, place per row, extents per row, extents per cluster; pool
// of each listed cluster (first entry * 16 + exponent of the size), slots of rows, entries of pools, all in the order of lists.
#define LIGHT_INVERSE_FLUX_AT 0  // 1 / flux of all faces as a float, per voxel side; 0: nothing sends light
#define LIGHT_SHIFT_AT 1         // by how much cells are moved (cellShift)
#define LIGHT_SLOT_COUNT_AT 2    // slots of a row
#define LIGHT_SCALES_AT 3
#define LIGHT_PLACES_AT (LIGHT_SCALES_AT + LIGHT_ROWS)
#define LIGHT_CELL_EXTENTS_AT (LIGHT_PLACES_AT + LIGHT_ROWS)
#define LIGHT_CLUSTER_EXTENTS_AT (LIGHT_CELL_EXTENTS_AT + LIGHT_CLUSTERS)
#define LIGHT_CLUSTER_POOLS_AT (LIGHT_CLUSTER_EXTENTS_AT + LIGHT_CLUSTERS)
#define LIGHT_SLOTS_AT (LIGHT_CLUSTER_POOLS_AT + LIGHT_CLUSTERS)
#define LIGHT_POOLS_AT (LIGHT_SLOTS_AT + LIGHT_ROOM * LIGHT_MOST_SLOTS / 2)
#define LIGHT_SAMPLE_WORDS (LIGHT_POOLS_AT + LIGHT_POOL_ENTRIES)
// An entry of a pool is a face, and whether its bounds are moved the other way (kMovedBoundsPeriod).
#define LIGHT_MOVED 0x80000000u

// Updates after a change that replace what was there; averages begin then, in which early ones count for
// less. Averages of all updates from the first one keep 2 to 4 % of the light out for good: bounces have not
// settled (docs/theory/4d_cache.md, "The cache").
#define IRRADIANCE_SETTLE 8
// The least weight of an update of a face that is far from what changed.
#define IRRADIANCE_FAR_WEIGHT 0.125
// The noise of a face's update, over its mean, that weights after a change are the best for.
#define IRRADIANCE_NOISE 0.7
// Of what changed last so many places are known, and so many lights.
#define CHANGED_PLACES 16u
#define CHANGED_FOURS 4u  // fours of them
// As many that are others than they were, and that are others than `lightScale` times that.
#define CHANGED_LIGHTS 32u
// A face lies inside a closed object when of at least so many cosine rays more than a quarter meet a surface
// from behind first, farther than 1.5 voxels away.
#define IRRADIANCE_INTERIOR_RAYS 16

// What faces gather is added up by groups of so many lanes, of which each takes so many faces (cache_balance).
#define BALANCE_LANES 64u
#define BALANCE_FACES_OF_LANE 16u
#define BALANCE_GROUP 256  // invocations that add up the groups
// Of the cached light that faces send out, what other faces gather is taken to be this part of it at most: noise never
// makes light more than 50 times its sources.
#define BALANCE_MOST_RETURNED 0.98

// Order in which updates visit faces (cache_order): six directions and 64 places in a brick per block of 4^3
// bricks.
#define CACHE_BINS_PER_BLOCK 384u
// What cache_ranges writes: so many ranges of the order, of so many words each: first place, number of faces, three
// counts of groups of an indirect dispatch.
#define CACHE_RANGES 4u
#define CACHE_RANGE_WORDS 5u

#define CACHE_SHARES 0x8000u
#define CACHE_SCALED 0x4000u  // between cache_scale and cache_restart: of CacheConstants::lightScale
#define CACHE_UPDATES_MASK 0x3fffu

// Upper half of LitFace::irradiance1.
#define FACE_LOBE_SHIFT 16u  // 9 bit: FaceMaterial::lobe
#define FACE_LOBE_BITS 0x01ff0000u
#define FACE_AREA_LIGHT 0x02000000u  // its emission is the light of a rectangle, not in `radiance`
#define FACE_AGE_SHIFT 26u           // 4 bit: updates behind the irradiance, 0: none, n: 2^(n-1) to 2^n - 1
#define FACE_AGE_MASK 15u
#define FACE_UPDATES_INTERIOR 0xffffffffu  // faceUpdates of what is inside a closed object
#define FACE_LIT 0x40000000u               // irradiance was gathered at least once
#define FACE_INTERIOR 0x80000000u          // inside a closed object: left out

CONELIGHT_SHARED_BEGIN

// What a face sends out, complete, so that a ray that hit it needs one texel.
struct LitFace {
    uint albedo;    // FaceMaterial::albedo
    uint radiance;  // RGB9E5: emission + reflected direct light, W/(sr m^2)
    // Indirect irradiance / pi: the radiance of a white diffuse surface there
    uint irradiance0;  // halves r, g
    uint irradiance1;  // half b | FACE_* in the upper half
};                     // 16 B

// State of one face of the cache.
struct FaceCache {
    vec3 irradiance;  // irradiance / pi, the mean so far
    // Updates since a change, 0: never | rays looked at for interior faces << 16 | of these, met a surface from
    // behind first << 24. CACHE_SHARES: the state is that of another face, whose number stands in
    // irradiance.x, as bits.
    uint counts;
};  // 16 B

// Uniform block of the cache's passes.
struct CacheConstants {
    uint firstFace;  // of the faces to update, a place in their order
    uint faceCount;
    uint cosineRays;
    uint lightRays;
    // ---- 16 B
    uint update;  // number of the update, part of every seed
    uint seed;
    uint longestWindow;  // updates that are averaged at most
    uint reflections;    // on metals, of one ray
    // ---- 32 B
    float fireflyClamp;  // as in PixelRayConstants
    // 1: after a change windows are short near `places`, elsewhere no longer than IRRADIANCE_FAR_WEIGHT lets them
    uint restartsNear;
    uint placeCount;
    uint draw;  // of light samples from the same light; 0: that of the update
    // ---- 48 B
    vec4 places[CHANGED_PLACES];     // of changes, world space; w: radius, m
    vec4 placeParts[CHANGED_FOURS];  // of their cross-sections, how much changed, [0,1]
    // ---- 368 B: light::EditList
    uint lightEdits;
    float editedEverywhere;  // W/m^2
    float editedEverywherePart;
    uint allLightEdits;  // from lightEdits on, what is left of a change when light is scaled
    // ---- 384 B
    vec3 lightScale;  // times the light that was there
    float scaledEverywhere;
    // ---- 400 B
    float scaledEverywherePart;
    uint pad0;
    uint pad1;
    uint pad2;
    // ---- 416 B
    // Of editedEverywhere, editedEverywherePart and the scaled ones, by which there is more or less light.
    vec4 dimmed;
    // ---- 432 B
    vec4 editedLights[CHANGED_LIGHTS];  // world space; w: flux, W
    vec4 editedAxes[CHANGED_LIGHTS];    // w: radius, m
    vec4 editedLimits[CHANGED_LIGHTS];  // reach, m; part; whole, W; 1: there is more or less of it
};                                      // 1968 B

// The balance of the cache's light (cache_balance), over all faces that gather, by their areas and albedos.
struct CacheBalance {
    vec3 cached;  // the light that they have cached
    float pad0;
    // ---- 16 B
    vec3 fresh;  // what an update gathers from sources: mean of updates
    float pad1;
    // ---- 32 B
    vec3 returned;  // the part of the cached light that an update gathers again, [0,1]: mean of updates
    float pad2;
    // ---- 48 B
    vec3 correction;  // factor that makes the cached light what fresh light and all its returns add up to
    float pad3;
};  // 64 B

// Uniform block of cache_balance.
struct CacheBalancing {
    uint groups;         // of STEP 0
    float weight;        // of this update in means, as (4.13) has it; 0: light is added up alone
    float cachedBefore;  // part of the light that rays have read which is of before the update, [0,1]
    float step;          // part of the correction that is made, [0,1]
    // ---- 16 B
    float rounds;  // of updates since light changed, this one included
    float pad0;
    float pad1;
    float pad2;
};  // 32 B

// Uniform block of cache_ranges: the part of the faces that gather, of so many parts, where an update looks for faces
// inside closed objects.
struct CacheRanges {
    uint part;
    uint parts;
    uint pad0;
    uint pad1;
};  // 16 B

// Uniform block of the pass that carries light over.
struct CacheReprojection {
    vec3 oldOrigin;
    float oldInverseVoxelSize;
    // ---- 16 B
    uint oldSizeX;
    uint oldSizeY;
    uint oldSizeZ;
    uint pad0;
};  // 32 B

// Uniform block of the passes that put faces in order.
struct CacheOrder {
    uint number;    // of the sort
    uint searches;  // 1: faces that may be inside closed objects, or are, are visited to find out
    uint binsPerChunk;
    uint chunkCount;
    // ---- 16 B
    uint firstBlock;  // of the sweep
    uint binCount;    // of the sweep
    uint lastSweep;   // 1: doubtful faces follow
    uint pad0;
};  // 32 B

CONELIGHT_SHARED_END
#ifdef __cplusplus
static_assert(sizeof(conelight::gpu::LitFace) == 16);
static_assert(sizeof(conelight::gpu::FaceCache) == 16);
static_assert(sizeof(conelight::gpu::CacheConstants) == 1968);
static_assert(sizeof(conelight::gpu::CacheBalance) == 64);
static_assert(sizeof(conelight::gpu::CacheBalancing) == 32);
static_assert(sizeof(conelight::gpu::CacheRanges) == 16);
static_assert(sizeof(conelight::gpu::CacheReprojection) == 32);
static_assert(sizeof(conelight::gpu::CacheOrder) == 32);
#endif
