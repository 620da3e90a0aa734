// SPDX-License-Identifier: MIT
// The voxel structures that C++ and GLSL share. Written by src/voxels/surface_voxels.cpp, read by whoever
// lights, gathers or shows voxels. Packing and unpacking: lib/voxel_record.glsl and
// src/voxels/voxel_record.h; addresses: lib/voxel_address.glsl and src/voxels/voxel_grid.h.
//
//   brickWord  RGBA32UI 3D texture, one texel per brick of 4^3 voxels:
//              x, y  occupancy: bit i (lo: 0..31, hi: 32..63) is voxel i = x + 4 y + 16 z of the brick
//              z     index of the brick's first voxel record; voxel i has index
//                    z + (occupied voxels below bit i)
//              w     0, reserved
//   voxRec     one uint per occupied voxel, ordered by brick (x fastest) and voxel: bits 0..25 index of its
//              first face, bits 26..31 the directions in which it has faces (bit 26 + k)
//   face       FaceRecord per voxel and facing direction, ordered by voxel and direction: what rays test
//   material   FaceMaterial per face: what light reads
//
//   octWord    RG32UI 3D texture (8 Bx, By, Bz), for rays (src/voxels/octant_words.h): at x = brick.x +
//              octant * Bx, with bit i of the octant set for rays that go down along axis i; bricks, and the
//              voxels within, are counted from the other end along those axes, so that rays go up. One of
//              - which voxels of the brick have a face that looks against such rays (lo, hi)
//              - there are none: x edge, in bricks, of an empty cube that starts with this brick and reaches
//                forward along the rays, OCTANT_REACH at most; y OCTANT_EMPTY. What lies outside the grid is
//                empty
//              A mask whose upper half happens to be OCTANT_EMPTY has bit OCTANT_EMPTY_SPARE of it set, too:
//              rays look at one voxel more, and find no face there.
#pragma once
#include "shared/prelude.h"

// Facing directions k, in the order of face indices and of the flags in voxRec: +x -x +y -y +z -z.
// A triangle with normal n has a face in direction k when n.k exceeds this (sine of 1.1 degrees): below it,
// what it adds to the coverage seen along k is less than 2 % of its area, and a plane seen that flatly has no
// usable crossing. From the accuracy experiments behind docs/theory/2_voxels.md.
#define VOXEL_FACING_THRESHOLD 0.02

// Rougher dielectrics are treated as diffuse where rays hit: their lobe is wide, and has a few percent of their light.
#define LOBE_MAX_ROUGHNESS 0.75

// Names under which shaders read voxels (SurfaceVoxels::declare, OctantWords::declare):
//   VoxelGridBlock         uniform block: VoxelGrid
//   voxelBricks            usampler3D (brickWord); voxelBrickImage  uimage3D, the same
//   voxelRecords           usamplerBuffer R32UI (voxRec); RecordTable  storage, the same
//   voxelFaces             usamplerBuffer RGBA32UI, a texel per face; FaceTable  storage, FaceRecord[]
//   voxelFaceMaterials     usamplerBuffer RGBA32UI, a texel per face; FaceMaterialTable  storage,
//                          FaceMaterial[]
//   BrickTable             storage: packVoxel(brick) of each occupied brick
//   voxelOctants           uimage3D RG32UI (octWord)
// and triangles (SurfaceVoxels::declareTriangles):
//   voxelChains            usamplerBuffer RG32UI: first fragment + 1, directions; of each record
//   voxelFragments         usamplerBuffer RGBA32UI, two texels per fragment (surface_clip)
//   voxelPairs             usamplerBuffer RG32UI: triangle, voxel; of each fragment
//   voxelTriangles         samplerBuffer RGBA32F, three texels per triangle: corners, voxels
// Images are for reads that are many: software drivers fetch texels of such formats by a call each, and load
// from images in line (rays 11 % faster, the cache at pixels 17 %).

// In the first corner's fourth number, above the 24 bits of the instance.
#define VOXEL_TRIANGLE_TWO_SIDED 0x1000000u
// Above those, of closed solids: thickness in voxels of the (finest) grid, as 2 log2 of it plus 16, from 1 to 31.
#define VOXEL_TRIANGLE_SOLID_SHIFT 26
// Its texture, its instance or its material may let rays or light pass: those are to be asked.
#define VOXEL_TRIANGLE_PASSABLE 0x80000000u
#define FRAGMENT_TWO_SIDED 0x40000000u  // in the bounds of a fragment

// Longest step over empty bricks. 2 costs rays 15 to 30 % more, 6 and 8 gain no more than they cost to find.
#define OCTANT_REACH 4
// Any pattern that few surfaces make will do; the spare bit is one that it does not have.
#define OCTANT_EMPTY 0x9d2c5681u
#define OCTANT_EMPTY_SPARE 0x00000002u

// In FaceRecord::bounds, above them: what most of the face is made of.
#define FACE_TWO_SIDED 0x40000000u  // triangles with a face on their other side, too
#define FACE_REVERSE 0x80000000u    // that other side, which solids have within them

// Nested grids (src/voxels/nested_grid.h): levels at most, and voxels along z of all levels together, which are
// stored one behind the other along z.
#define VOXEL_MOST_LEVELS 8
#define VOXEL_MOST_STORED 1024

CONELIGHT_SHARED_BEGIN

// Uniform block. Voxel (i,j,k) is the cube origin + voxelSize * [i,i+1) x [j,j+1) x
// [k,k+1).
struct VoxelGrid {
    vec3 origin;      // world position of the lowest corner, m
    float voxelSize;  // edge of a voxel, m
    // ---- 16 B
    uint sizeX;  // voxels per axis, multiples of 4
    uint sizeY;
    uint sizeZ;
    uint voxelCount;  // occupied voxels
    // ---- 32 B
    uint bricksX;  // size / 4
    uint bricksY;
    uint bricksZ;
    uint faceCount;
    // ---- 48 B
    float inverseVoxelSize;  // 1 / voxelSize
    uint occupiedBricks;
    uint pad0;
    uint pad1;
};  // 64 B

// Uniform block VoxelLevelBlock: the levels of nested grids (lib/voxel_levels.glsl).
struct VoxelLevels {
    uint count;
    uint sizeX;  // voxels of each level
    uint sizeY;
    uint sizeZ;
    // ---- 16 B
    vec4 levels[VOXEL_MOST_LEVELS];  // xyz lowest corner, w edge of a voxel: in voxels of level 0
};                                   // 144 B

// Uniform block VoxelScrollBlock: how an update of nested grids moves their levels (shaders/voxels/surface_scroll.glsl).
struct VoxelScroll {
    ivec4 shifts
        [VOXEL_MOST_LEVELS];  // xyz: what coordinates in a level gain, in its voxels; w of the first: nothing emits
    ivec4
        finer[VOXEL_MOST_LEVELS];  // xyz: lowest voxel that the next finer level held, in coordinates before
};                                 // 256 B

// What a voxel shows towards one facing direction k: the plane piece that rays hit.
struct FaceRecord {
    uint
        normal;  // octahedral, 2 x 16 bit snorm: mean of the triangle normals, weighted by w = area (n.k)/h^2
    uint offsetWeight;  // low 16: plane offset n.(c - voxel centre) / h, snorm; high 16: coverage W = sum of
                        // w of what is not hidden, 0..4
    uint bounds;        // 6 x 5 bit: min x y z, max x y z of the surface in the voxel, in 1/31 voxel, rounded
                        // outwards; FACE_TWO_SIDED, FACE_REVERSE
    uint
        voxel;  // 3 x 10 bit: x, y, z of the voxel as stored; bits 30, 31: axis of the direction (0 x .. 2 z)
};              // 16 B

// What that piece is made of: means over its surface.
struct FaceMaterial {
    uint albedo;         // 11 | 11 | 10 bit unorm, linear
    uint emission;       // W/(sr m^2): halves r, g
    uint emissionBArea;  // half b | area of the surface that is the face's own, in voxel sides^2, 0..4
    uint lobe;           // bits 5..8 metalness; 0..4 roughness of what is metallic, else of all (1: no lobe)
};                       // 16 B

// Uniform block of the voxelizer's own passes (shaders/voxels/surface_*).
struct SurfaceConstants {
    uint triangleCount;
    uint instanceCount;
    uint tileCapacity;  // of the voxelizer's lists; what does not fit is counted and dropped
    uint fragmentCapacity;
    // ---- 16 B
    uint voxelCapacity;
    uint faceCapacity;
    uint brickCapacity;
    uint bricksPerChunk;  // prefix sums: elements one invocation adds up
    // ---- 32 B
    uint voxelsPerChunk;
    float emissionScale;  // power of two >= largest emission of any material: sums of emission are relative
                          // to it
    uint editedBricks;    // updates: bricks whose chains are searched for fragments to drop
    uint pad0;
};  // 48 B

// Words of the voxelizer's counters. Arguments: three group counts each, for indirect dispatches.
#define SURFACE_TILES 0
#define SURFACE_FRAGMENTS 1
#define SURFACE_VOXELS 2
#define SURFACE_BRICKS 3
#define SURFACE_FACES 4
// Updates: entries of the list of free slots; first slot that was never used; faces that are summed up again
#define SURFACE_FREE 5
#define SURFACE_TAIL 6
#define SURFACE_WORK 7
#define SURFACE_ARGS_TILES 8
#define SURFACE_ARGS_FRAGMENTS 12
#define SURFACE_ARGS_VOXELS 16
#define SURFACE_ARGS_FACES 20
#define SURFACE_ARGS_BRICKS 24
#define SURFACE_ARGS_WORK 28
#define SURFACE_ARGS_LAYERS 32
// Faces in which something covers something else, and others whose bounds are too wide
#define SURFACE_LAYERS 36
#define SURFACE_WIDE 37
// Updates: places of fragments from here on are not in use
#define SURFACE_SLOTS 38
#define SURFACE_ARGS_WIDE 40
#define SURFACE_COUNTER_WORDS 44

CONELIGHT_SHARED_END
#ifdef __cplusplus
static_assert(sizeof(conelight::gpu::VoxelGrid) == 64);
static_assert(sizeof(conelight::gpu::VoxelLevels) == 16 + 16 * VOXEL_MOST_LEVELS);
static_assert(sizeof(conelight::gpu::VoxelScroll) == 32 * VOXEL_MOST_LEVELS);
static_assert(sizeof(conelight::gpu::SurfaceConstants) == 48);
static_assert(sizeof(conelight::gpu::FaceRecord) == 16);
static_assert(sizeof(conelight::gpu::FaceMaterial) == 16);
#endif
