// SPDX-License-Identifier: MIT
// Clusters of faces that send light, and cells of places that get it (shared/irradiance.h): which is where, and how much
// of a cell's light samples a cluster gets. Method: docs/theory/4c_estimator.md, "The pool".
#include "lib/dot.glsl"
#include "lib/random.glsl"
#include "lib/voxel_grid.glsl"
#include "lib/voxel_record.glsl"
#include "shared/irradiance.h"

#if NESTED_GRIDS
const int kLightBlocks = LIGHT_BLOCKS_OF_LEVEL;  // of each level
#else
const int kLightBlocks = LIGHT_BLOCKS_OF_GRID;
#endif

// One entry of a pool in so many has its bounds moved the other way (lightSampleBounds). Without them only cosine-sampled
// rays would find the rim of a light face that ends at a voxel's side: white dots far away from it, because one such ray
// carries as much as a hundred light-sampled ones. A smaller number wastes more rays.
const int kMovedBoundsPeriod = 16;

// A cube of the grid, and a direction in which faces there look.
struct LightCell {
    int row;
    vec3 lowest;  // corner, grid coordinates
    float edge;   // voxels of level 0
};

// What of a cube has faces of the direction.
struct LightBounds {
    vec3 middle, extent;  // half of the sizes
    vec3 axis;            // unit vector of the direction
    float voxelArea;      // of its level, in those of level 0: fluxes are in these
};

// Bricks along an edge of a block: two to the power of this.
int blockShift() {
    ivec3 bricks = gridBricks();
    int most = max(bricks.x, max(bricks.y, bricks.z));
    return findMSB((most - 1) / kLightBlocks) + 1;
}

vec3 axisOfSide(int side) {
    return vec3(side >> 1 == 0, side >> 1 == 1, side >> 1 == 2) * ((side & 1) != 0 ? -1.0 : 1.0);
}

// The cube `at` of a level, of cubes of this edge whose first begins at -shift; both in voxels of the level.
LightCell lightCube(ivec3 at, int level, int side, float edge, vec3 shift) {
    int cube = at.x + kLightBlocks * (at.y + kLightBlocks * (at.z + kLightBlocks * level));
    vec3 lowest = vec3(at) * edge - shift;
#if NESTED_GRIDS
    vec4 place = levelPlace(level);
    lowest = gridFromLevel(lowest, place);
    edge *= place.w;
#endif
    return LightCell(6 * cube + side, lowest, edge);
}

// The cube of a row and its level.
ivec3 cubeOfRow(int row) {
    uint cube = uint(row) / 6u;
    const uint n = uint(kLightBlocks);
    return ivec3(cube % n, cube / n % n, cube / (n * n) % n);
}
int levelOfRow(int row) { return int(uint(row) / uint(6 * kLightBlocks * kLightBlocks * kLightBlocks)); }
int sideOfRow(int row) { return int(uint(row) % 6u); }

float voxelAreaOfRow(int row) {
#if NESTED_GRIDS
    float edge = levelPlace(levelOfRow(row)).w;
    return edge * edge;
#else
    return 1.0;
#endif
}

// The parts of a cell along an axis that hold something, as bits of 32 -> first and last, of all three axes in one word.
uint packExtents(uvec3 bits) {
    uvec3 first = uvec3(findLSB(bits)), last = uvec3(findMSB(bits));
    uvec3 both = (first & 31u) | (last & 31u) << 5;
    return both.x | both.y << 10 | both.z << 20;
}

// Bits of a point of a cell.
uvec3 extentBits(LightCell cell, vec3 point) {
    uvec3 part = uvec3(clamp((point - cell.lowest) / cell.edge, 0.0, 0.999) * 32.0);
    return uvec3(1u << part.x, 1u << part.y, 1u << part.z);
}

LightBounds lightBounds(LightCell cell, uint extents) {
    uvec3 both = uvec3(extents, extents >> 10, extents >> 20);
    vec3 first = vec3(both & 31u) / 32.0, end = vec3((both >> 5 & 31u) + 1u) / 32.0;
    return LightBounds(cell.lowest + 0.5 * cell.edge * (first + end), 0.5 * cell.edge * (end - first),
                       axisOfSide(sideOfRow(cell.row)), voxelAreaOfRow(cell.row));
}

// The flux of a face, its last bits telling where it looks to.
float sidedFlux(float flux, int side) { return uintBitsToFloat((floatBitsToUint(flux) & ~7u) | uint(side)); }
uint sideOfFlux(float flux) { return floatBitsToUint(flux) & 7u; }
float withoutSide(float flux) { return uintBitsToFloat(floatBitsToUint(flux) & ~7u); }

LightCell clusterOfRow(int row) {
    return lightCube(cubeOfRow(row), levelOfRow(row), sideOfRow(row), float(4 << blockShift()), vec3(0.0));
}

LightCell clusterOfFace(uvec4 hitTexel, vec3 normal) {
    ivec3 voxel = unpackVoxel(hitTexel.w);
    int level = 0;
#if NESTED_GRIDS
    level = levelOfStored(voxel);
    voxel = withinLevel(voxel, level);
#endif
    int shift = 2 + blockShift();
    return lightCube(voxel >> shift, level, faceDirection(hitTexel, normal), float(1 << shift), vec3(0.0));
}

// Edge of cells, voxels of their level: however they are moved, they cover the grid.
float cellEdge() {
#if NESTED_GRIDS
    vec3 size = levelSize();
#else
    vec3 size = vec3(gridSize());
#endif
    return max(size.x, max(size.y, size.z)) / float(kLightBlocks - 1);
}

// Seed of the random numbers that an entry or a row is drawn with.
// `draw`: of several for one update.
uint drawSeed(uint number, uint update, uint draw, uint seed) {
    return randomHash(number ^ randomHash(update ^ randomHash(seed ^ 0x51ed270bu) ^ draw * 0x9e3779b9u));
}

// Cells are elsewhere after each update, so that none of their borders shows: by this part of their edge, 10 bits an axis.
uint cellShift(uint update, uint seed) { return randomHash(update ^ randomHash(seed ^ 0x2545f491u)); }
vec3 shiftOfCells(uint shift) { return vec3(uvec3(shift, shift >> 10, shift >> 20) & 1023u) / 1024.0; }

LightCell cellOfRow(int row, uint shift) {
    float edge = cellEdge();
    return lightCube(cubeOfRow(row), levelOfRow(row), sideOfRow(row), edge, shiftOfCells(shift) * edge);
}

LightCell cellAt(vec3 point, vec3 normal, uint shift) {
    int level = 0;
#if NESTED_GRIDS
    level = levelAt(point);
    point = levelFromGrid(point, levelPlace(level));
#endif
    float edge = cellEdge();
    vec3 moved = shiftOfCells(shift);
    ivec3 at = clamp(ivec3(floor(point / edge + moved)), ivec3(0), ivec3(kLightBlocks - 1));
    return lightCube(at, level, mainDirection(normal), edge, moved * edge);
}

// What a cluster brings to a cell for its flux, were nothing between them: a form factor, blurred by the size of both.
float lightGain(LightBounds cell, LightBounds cluster) {
    vec3 towards = cluster.middle - cell.middle;
    vec3 extents = cell.extent + cluster.extent;
    float reach = length(extents);
    float distance = length(towards);
    float above = dot(extents, abs(cluster.axis)) - dot(towards, cluster.axis);
    float seen = dot(extents, abs(cell.axis)) + dot(towards, cell.axis);
    vec2 cosines = clamp(vec2(above, seen) / (distance + reach), 0.0, 1.0);
    return cluster.voxelArea * cosines.x * cosines.y / (distance * distance + reach * reach);
}

// The part of a row that is drawn by flux alone, for what gains tell wrong.
const float kByFluxAlone = 0.1;

// How many times its share of the flux a cluster gets. `scale`: of the cell's row; 0: that is the row of all.
float shareOfCluster(float gain, float scale) { return scale > 0.0 ? kByFluxAlone + gain * scale : 1.0; }
