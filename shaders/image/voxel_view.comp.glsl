#version 450 core
// SPDX-License-Identifier: MIT
// Camera -> voxels by ray casting, alone or among the objects of a picture (component voxels, view.voxels).
//
//   SOURCE  0 surface voxels: level 0 from their faces, coarser ones from means (voxel_view_level)
//           1 a volume of one colour and opacity a voxel (VoxelVolume)   2 the radiance volume of mode cones
//           (DIRECTIONAL: six blocks)   3 the same, stored in an octree   4 as 1, stored in an octree
//   SHAPE   0 cubes   1 their edges   2 plane pieces as rays meet them (SOURCE 0)   3 by opacity, front to
//           back   4 on the surfaces of the picture
//   AMONG   1: in front of what the G-buffer holds, on the picture; 0: alone, on the sky
//
// Rays go from cell to cell (Amanatides and Woo 1987). A cell is a voxel of the level that is shown; with
// view.spread the level a cone of that spread from the eye reads there (levelAt of lib/cone_trace.glsl), so
// it grows with the distance. What is empty is crossed in an inner loop by one image load a step: `occupied`
// (voxel_view_occupied) has the voxels of a brick, or how far around it there is nothing. Data are fetched
// once that loop has found something for every ray of a vector; software drivers run both sides of branches.
#if !defined(SOURCE) || !defined(SHAPE) || !defined(AMONG) || !defined(DIRECTIONAL)
#error SOURCE, SHAPE, AMONG and DIRECTIONAL must be defined
#endif
#include "lib/dot.glsl"
#include "lib/false_color.glsl"
#include "lib/gbuffer.glsl"
#include "lib/lighting.glsl"
#include "lib/voxel_address.glsl"
#include "shared/voxel_view.h"
layout(local_size_x = 8, local_size_y = 8) in;
layout(std140) uniform ViewBlock { VoxelViewConstants view; };
layout(rgba32f) uniform image2D picture;
layout(rgba32ui) readonly uniform uimage3D occupied;
#if SOURCE >= 3
#include "lib/radiance_octree.glsl"
#endif
#if SOURCE == 3
#include "lib/radiance_bricks.glsl"
#else
uniform sampler3D volume;
#endif
#if SOURCE == 0
#include "lib/ray_query.glsl"
#include "lib/voxel_data.glsl"
#endif

#define CUBES 0
#define EDGES 1
#define FACES 2
#define VOLUME 3
#define SURFACES 4

// Cells with less are dust of halves.
const float kLeastOpacity = 1e-6;
// A ray that has passed so many cells is lost: 512^3 has 1,536 on a diagonal.
const int kMostCells = 4096;
// Steps go so far into the next cell, voxels.
const float kNudge = 1e-3;
// A wall that is looked through is so thick at most, cells.
const int kWallCells = 2;
// Half the width of an edge, pixels.
const float kHalfEdge = 0.75;

int levelShown(float t) {
    float level = view.level;
    if (view.spread > 0.0) level = round(log2(max(view.spread * t, 1e-6)));
    return int(clamp(level, 0.0, view.maxLevel));
}

ivec3 levelSize(int level) { return (ivec3(view.sizeX, view.sizeY, view.sizeZ) + (1 << level) - 1) >> level; }

#if SOURCE == 2 || SOURCE == 3
// A texel of the radiance volume.
vec4 radianceOf(ivec3 cell, int level, int block) {
#if SOURCE == 3
    return octreeTexel(cell, level, block);
#else
    return texelFetch(volume, cell + ivec3(block * (int(view.sizeX) >> level), 0, 0), level);
#endif
}
#endif

// Premultiplied data and opacity of a cell, seen along `ray` through the side of `axis`.
vec4 cellOf(ivec3 cell, int level, vec3 ray, int axis) {
#if SOURCE == 0
    if (level == 0) {
        uvec4 word = imageLoad(voxelBrickImage, cell >> 2);
        uint bit = bitOfVoxel(cell);
        if (!brickHas(word.xy, bit)) return vec4(0.0);
        return voxelMean(texelFetch(voxelRecords, int(voxelRecordIndex(word, bit))).x, ray, view.data);
    }
    return texelFetch(volume, cell, level - 1);
#elif SOURCE == 1
    return texelFetch(volume, cell, level);
#elif SOURCE == 4
    return octreeFetched(volume, cell, level, 0);
#elif DIRECTIONAL
    // The block of the side that is entered, or the mean of all when nothing there looks that way.
    vec4 side = radianceOf(cell, level, 2 * axis + (ray[axis] > 0.0 ? 1 : 0));
    if (side.a > 1.0 / 1024.0) return side;
    vec4 mean = vec4(0.0);
    for (int k = 0; k < 6; ++k) mean += radianceOf(cell, level, k);
    return mean / max(mean.a, 1.0);
#else
    return radianceOf(cell, level, 0);
#endif
}

// Whether `cell` may hold something; if not, `low` and `high` (voxels) are a box of whole empty cells about
// it.
bool mayHold(ivec3 cell, int level, out ivec3 low, out ivec3 high) {
    ivec3 voxel = cell << level;
    ivec3 brick = voxel >> 2;
    uvec4 word = imageLoad(occupied, brick);
    bool empty = (word.x | word.y) == 0u;
    // Within a brick: the voxel, or the block of 2^3.
    uint half32 = (voxel.z & 2) != 0 ? word.y : word.x;
    bool emptyBlock = (half32 >> ((voxel.x & 2) + 4 * (voxel.y & 2)) & 0x00330033u) == 0u;
    bool may = level == 0 ? brickHas(word.xy, bitOfVoxel(voxel)) : level == 1 ? !emptyBlock : !empty;
    int within = emptyBlock ? 1 : 0;
    low = (voxel >> within) << within;
    high = low + (1 << within);
    // Empty bricks all around, word.z of them to each side. Where the cells are larger than bricks or may
    // grow on the way, the box is one that all levels up to its own divide.
    int around = int(word.z);
    bool free = level <= 2 && view.spread == 0.0;
    int up = 2 + findMSB(around + 1);
    ivec3 corner = (voxel >> up) << up;
    if (empty) {
        low = free ? 4 * (brick - around) : corner;
        high = free ? 4 * (brick + around + 1) : corner + (1 << up);
        may = !free && up < level;
    }
    // Larger cells may have something beside an empty brick.
    low = may ? voxel : low;
    high = may ? voxel + (1 << level) : high;
    return may;
}

vec3 shown(vec4 cell, int level) {
    if (view.data == VIEW_LEVEL) return falseColor(float(level) / 6.0);
#if SOURCE != 0
    if (view.data == VIEW_COVERAGE) return vec3(cell.a);
#endif
    return cell.rgb / max(cell.a, 1e-12);
}

#if SHAPE == EDGES
// Whether a point of a cell's side (0..1 in the cell) lies on one of its edges.
bool onEdge(vec3 inCell, int axis, float halfWidth) {
    vec3 away = min(inCell, 1.0 - inCell);
    away[axis] = 1.0;
    return min(away.x, min(away.y, away.z)) < halfWidth;
}
#endif

// A ray on its way from cell to cell, in voxels; the way is in multiples of its direction.
struct CellWalk {
    vec3 origin;
    vec3 direction;
    vec3 inverse;  // 1 / direction
    float last;    // where the way ends; -1: it never was in the grid
    float t;       // where the cell is entered, through a side of `axis`
    int axis;
    float leave;  // where it is left, through a side of `exitAxis`
    int exitAxis;
    ivec3 cell;
    int level;
    float edge;  // of the cell
    int budget;  // cells that are left to pass
};

// `eye`, `end`: m.
CellWalk startWalk(vec3 eye, vec3 ray, float end) {
    CellWalk w;
    w.direction = mix(ray, vec3(1e-7), lessThan(abs(ray), vec3(1e-7)));
    w.origin = (eye - view.origin) / view.voxelSize;
    w.inverse = 1.0 / w.direction;
    vec3 size = vec3(view.sizeX, view.sizeY, view.sizeZ);
    vec3 toLow = -w.origin * w.inverse, toHigh = (size - w.origin) * w.inverse;
    vec3 near = min(toLow, toHigh), far = max(toLow, toHigh);
    w.leave = max(max(near.x, near.y), max(near.z, 0.0));
    float last = min(min(far.x, min(far.y, far.z)), end / view.voxelSize);
    w.last = w.leave < last ? last : -1.0;
    w.exitAxis = near.x >= near.y && near.x >= near.z ? 0 : near.y >= near.z ? 1 : 2;
    w.t = w.leave;
    w.axis = w.exitAxis;
    w.budget = kMostCells;
    return w;
}

// To the next cell that may hold something; whether there is one. The loop is tested at its top: tested at
// its end, llvmpipe lost hits of rays that leave it before their neighbours.
bool nextCell(inout CellWalk w) {
    bool may = false;
    while (!may && w.leave < w.last && --w.budget > 0) {
        w.t = w.leave;
        w.axis = w.exitAxis;
        w.level = levelShown(w.t);
        w.edge = float(1 << w.level);
        ivec3 cell = ivec3(floor((w.origin + (w.t + kNudge) * w.direction) / w.edge));
        w.cell = clamp(cell, ivec3(0), levelSize(w.level) - 1);
        ivec3 low, high;
        may = mayHold(w.cell, w.level, low, high);
        vec3 exits = (vec3(mix(low, high, greaterThan(w.direction, vec3(0.0)))) - w.origin) * w.inverse;
        w.leave = max(min(exits.x, min(exits.y, exits.z)), w.t + kNudge);
        w.exitAxis = exits.x <= exits.y && exits.x <= exits.z ? 0 : exits.y <= exits.z ? 1 : 2;
    }
    return may;
}

// Adds a cell that the ray is in to what it met, colour and opacity; whether the ray goes on behind.
bool meetCell(inout vec4 met, CellWalk w, vec4 found, vec3 ray) {
    vec3 color = shown(found, w.level);
#if SHAPE == VOLUME
    float part = clamp((min(w.leave, w.last) - w.t) / w.edge, 0.0, 1.0);
    float opacity = 1.0 - pow(1.0 - min(found.a, 0.9999), view.density * part);
    met += (1.0 - met.a) * opacity * vec4(color, 1.0);
    return met.a < 0.995;
#elif SHAPE == EDGES
    // The edges of the side that is entered, and behind them those of the side that is left.
    float depthOfMeter = dot(ray, frame.viewForward);
    vec2 depth = mix(depthOfMeter * vec2(w.t, w.leave), vec2(1.0 / view.voxelSize), frame.parallel);
    vec2 halfWidth = kHalfEdge * view.pixelSize * depth / w.edge;
    bool front = onEdge((w.origin + w.t * w.direction) / w.edge - vec3(w.cell), w.axis, halfWidth.x);
    bool back = onEdge((w.origin + w.leave * w.direction) / w.edge - vec3(w.cell), w.exitAxis, halfWidth.y);
    if (front || back) met = vec4(color, 1.0);
    return !front && !back;
#else
    met = vec4(color, 1.0);
    return false;
#endif
}

// What the ray meets until `end` (m): colour, opacity.
vec4 castRay(vec3 eye, vec3 ray, float end) {
    vec4 met = vec4(0.0);
    CellWalk w = startWalk(eye, ray, end);
    bool going = w.last >= 0.0;
    bool through = view.inside != 0u && w.leave > 0.0;
    int entryAxis = w.axis, wall = -1;  // layer of cells along that axis
    do {
        bool may = nextCell(w);
        vec4 found = may && going ? cellOf(w.cell, w.level, ray, w.axis) : vec4(0.0);
        bool meets = found.a > kLeastOpacity;
        int layer = w.cell[entryAxis];
        wall = wall < 0 && meets ? layer : wall;
        if (meets && !(through && abs(layer - wall) < kWallCells)) going = meetCell(met, w, found, ray);
        going = going && w.leave < w.last;
    } while (going && --w.budget > 0);
    return met;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(picture)))) return;
    Surface s;
    bool seen = fetchSurface(pixel, s);
    vec3 perDepth = pixelRay(pixel);
    vec3 eye = pixelOrigin(pixel), ray = normalize(perDepth);
    float end = AMONG == 1 && seen ? s.depth * length(perDepth) : 1e9;
#if SHAPE == SURFACES
    // The cell about the surface; with the surface exactly between two, the one behind it.
    vec3 at = (s.position - view.origin) / view.voxelSize;
    int level = levelShown(length(s.position - eye) / view.voxelSize);
    float edge = exp2(float(level));
    vec4 result = vec4(0.0);
#if SOURCE == 1 || SOURCE == 4
    // Interpolated, as cones read it.
    vec3 q = at / vec3(view.sizeX, view.sizeY, view.sizeZ);
#if SOURCE == 4
    vec3 place;
    uvec2 node = octreePlace(q, levelSize(level), level, place);
    vec4 texel = octreeFiltered(volume, node, 0, place);
#else
    vec4 texel = textureLod(volume, q, float(level));
#endif
    if (seen) result = vec4(shown(texel, level), 1.0);
#else
    vec3 n = s.geometricNormal;
    int axis = abs(n.x) >= abs(n.y) && abs(n.x) >= abs(n.z) ? 0 : abs(n.y) >= abs(n.z) ? 1 : 2;
    for (int i = 0; i < 2 && seen; ++i) {
        ivec3 cell = ivec3(floor((at - (kNudge + 0.5 * float(i)) * n) / edge));
        cell = clamp(cell, ivec3(0), levelSize(level) - 1);
        vec4 found = cellOf(cell, level, ray, axis);
        if (result.a == 0.0 && found.a > kLeastOpacity) result = vec4(shown(found, level), 1.0);
    }
#endif
#elif SHAPE == FACES
    vec3 origin = gridFromWorld(eye);
    VoxelHit hit = traceVoxels(Ray(origin, ray, end / view.voxelSize, vec3(0.0)));
    vec4 result = vec4(0.0);
    if (hit.face >= 0)
        result = vec4(view.data == VIEW_LEVEL ? falseColor(0.0) : faceData(hit.face, view.data), 1.0);
#else
    vec4 result = castRay(eye, ray, end);
#endif
#if AMONG
    if (result.a > 0.0) imageStore(picture, pixel, result + (1.0 - result.a) * imageLoad(picture, pixel));
#else
    float shownPart = SHAPE == VOLUME ? result.a : result.a > 0.0 ? 1.0 : 0.0;
    imageStore(picture, pixel, vec4(result.rgb + (1.0 - shownPart) * lighting.sky, shownPart));
#endif
}
