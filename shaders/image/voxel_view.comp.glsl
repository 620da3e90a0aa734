#version 450 core
// SPDX-License-Identifier: MIT
// Camera -> voxels by ray casting, alone or among the objects of a picture (component voxels, view.voxels).
//
//   SOURCE  0 surface voxels: level 0 from their faces, coarser ones from means (voxel_view_level)
//           1 a volume of one colour and opacity a voxel (VoxelVolume)   2 the radiance volume of mode cones
//           (DIRECTIONAL: six blocks)
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
#include "lib/false_color.glsl"
#include "lib/gbuffer.glsl"
#include "lib/lighting.glsl"
#include "lib/voxel_address.glsl"
#include "shared/voxel_view.h"
layout(local_size_x = 8, local_size_y = 8) in;
layout(std140) uniform ViewBlock { VoxelViewConstants view; };
layout(rgba32f) uniform image2D picture;
layout(rgba32ui) readonly uniform uimage3D occupied;
uniform sampler3D volume;
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
// Half the width of an edge, pixels.
const float kHalfEdge = 0.75;

int levelShown(float t) {
    float level = view.level;
    if (view.spread > 0.0) level = round(log2(max(view.spread * t, 1e-6)));
    return int(clamp(level, 0.0, view.maxLevel));
}

ivec3 levelSize(int level) { return (ivec3(view.sizeX, view.sizeY, view.sizeZ) + (1 << level) - 1) >> level; }

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
#elif DIRECTIONAL
    // The block of the side that is entered, or the mean of all when nothing there looks that way.
    int block = int(view.sizeX) >> level;
    int facing = 2 * axis + (ray[axis] > 0.0 ? 1 : 0);
    vec4 side = texelFetch(volume, cell + ivec3(facing * block, 0, 0), level);
    if (side.a > 1.0 / 1024.0) return side;
    vec4 mean = vec4(0.0);
    for (int k = 0; k < 6; ++k) mean += texelFetch(volume, cell + ivec3(k * block, 0, 0), level);
    return mean / max(mean.a, 1.0);
#else
    return texelFetch(volume, cell, level);
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

// What the ray meets until `end` (m): colour, opacity; the distance of it in m.
vec4 castRay(vec3 ray, float end, out float distance) {
    distance = end;
    vec3 d = mix(ray, vec3(1e-7), lessThan(abs(ray), vec3(1e-7)));
    vec3 o = (frame.eye - view.origin) / view.voxelSize;
    vec3 inverse = 1.0 / d;
    vec3 size = vec3(view.sizeX, view.sizeY, view.sizeZ);
    vec3 toLow = -o * inverse, toHigh = (size - o) * inverse;
    vec3 near = min(toLow, toHigh), far = max(toLow, toHigh);
    float t = max(max(near.x, near.y), max(near.z, 0.0));
    float last = min(min(far.x, min(far.y, far.z)), end / view.voxelSize);
    int axis = near.x >= near.y && near.x >= near.z ? 0 : near.y >= near.z ? 1 : 2;
    vec4 result = vec4(0.0);
    int budget = kMostCells;
    bool going = t < last;
    last = going ? last : -1.0;
    do {
        // To the next cell that may hold something: `t` where it is entered, `leave` where it is left. The
        // loop is tested at its top: tested at its end, llvmpipe lost hits of rays that leave it before their
        // neighbours.
        ivec3 cell;
        int level, exitAxis = axis;
        float edge, leave = t;
        bool may = false;
        while (!may && leave < last && --budget > 0) {
            t = leave;
            axis = exitAxis;
            level = levelShown(t);
            edge = float(1 << level);
            cell = clamp(ivec3(floor((o + (t + kNudge) * d) / edge)), ivec3(0), levelSize(level) - 1);
            ivec3 low, high;
            may = mayHold(cell, level, low, high);
            vec3 exits = (vec3(mix(low, high, greaterThan(d, vec3(0.0)))) - o) * inverse;
            leave = max(min(exits.x, min(exits.y, exits.z)), t + kNudge);
            exitAxis = exits.x <= exits.y && exits.x <= exits.z ? 0 : exits.y <= exits.z ? 1 : 2;
        }
        vec4 found = may && going ? cellOf(cell, level, ray, axis) : vec4(0.0);
        if (found.a > kLeastOpacity) {
            vec3 color = shown(found, level);
#if SHAPE == VOLUME
            float part = clamp((min(leave, last) - t) / edge, 0.0, 1.0);
            float opacity = 1.0 - pow(1.0 - min(found.a, 0.9999), view.density * part);
            distance = result.a == 0.0 ? t * view.voxelSize : distance;
            result += (1.0 - result.a) * opacity * vec4(color, 1.0);
            going = result.a < 0.995;
#elif SHAPE == EDGES
            // The edges of the side that is entered, and behind them those of the side that is left.
            float depthOfMeter = dot(ray, frame.viewForward);
            vec2 halfWidth = kHalfEdge * view.pixelSize * depthOfMeter * vec2(t, leave) / edge;
            bool front = onEdge((o + t * d) / edge - vec3(cell), axis, halfWidth.x);
            bool back = onEdge((o + leave * d) / edge - vec3(cell), exitAxis, halfWidth.y);
            if (front || back) {
                result = vec4(color, 1.0);
                distance = (front ? t : leave) * view.voxelSize;
                going = false;
            }
#else
            result = vec4(color, 1.0);
            distance = t * view.voxelSize;
            going = false;
#endif
        }
        t = leave;
        axis = exitAxis;
        going = going && t < last;
    } while (going && --budget > 0);
    return result;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(picture)))) return;
    Surface s;
    bool seen = fetchSurface(pixel, s);
    vec3 perDepth = pixelRay(pixel);
    vec3 ray = normalize(perDepth);
    float end = AMONG == 1 && seen ? s.depth * length(perDepth) : 1e9;
    float distance;
#if SHAPE == SURFACES
    // The cell about the surface; with the surface exactly between two, the one behind it.
    vec3 at = (s.position - view.origin) / view.voxelSize;
    int level = levelShown(length(s.position - frame.eye) / view.voxelSize);
    float edge = exp2(float(level));
    vec4 result = vec4(0.0);
#if SOURCE == 1
    // Interpolated, as cones read it.
    vec4 texel = textureLod(volume, at / vec3(view.sizeX, view.sizeY, view.sizeZ), float(level));
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
    distance = end;
#elif SHAPE == FACES
    vec3 origin = gridFromWorld(frame.eye);
    VoxelHit hit = traceVoxels(origin, ray, end / view.voxelSize, vec3(0.0));
    distance = hit.t * view.voxelSize;
    vec4 result = vec4(0.0);
    if (hit.face >= 0)
        result = vec4(view.data == VIEW_LEVEL ? falseColor(0.0) : faceData(hit.face, view.data), 1.0);
#else
    vec4 result = castRay(ray, end, distance);
#endif
#if AMONG
    if (result.a > 0.0) imageStore(picture, pixel, result + (1.0 - result.a) * imageLoad(picture, pixel));
#else
    float shownPart = SHAPE == VOLUME ? result.a : result.a > 0.0 ? 1.0 : 0.0;
    imageStore(picture, pixel, vec4(result.rgb + (1.0 - shownPart) * lighting.sky, shownPart));
#endif
}
