#version 450 core
// SPDX-License-Identifier: MIT
// Triangle -> the same triangle seen along its dominant axis (thesis, "Dominant Axis Selection"): the largest
// component of its normal becomes the direction of view, so that the viewport of N x N pixels shows it with
// as many pixels as it has voxels.
//
// CENTER_COVERAGE: the triangle itself; the rasterizer makes fragments at covered pixel centres, attributes
// are interpolated. Else: a shape that covers every pixel the triangle touches (Hasselgren et al. 2005, GPU
// Gems 2 chapter 42: the triangle with its edges moved outward by half a pixel; or its bounding rectangle
// where that is smaller), with the triangle itself as flat data for the fragment shader's exact coverage.
// AXIS_AREAS: with what the fragment shader needs for areas along the other axes. MARK_BRICKS: pixels are columns
// of bricks, and every one is covered that a covered column of voxels lies in, with some room for rounding.
#include "lib/octahedral.glsl"
#include "thesis/shaders/constants.h"
#include "thesis/shaders/defects.glsl"
#ifndef AXIS_AREAS
#define AXIS_AREAS 0
#endif
#ifndef MARK_BRICKS
#define MARK_BRICKS 0
#endif
layout(triangles) in;
layout(triangle_strip, max_vertices = 4) out;
layout(std140) uniform ThesisGridBlock { ThesisGrid grid; };

layout(location = 0) in vec3 position[];
layout(location = 1) in vec3 normal[];
layout(location = 2) in vec2 uv[];
layout(location = 3) flat in uint color[];
layout(location = 4) flat in uint material[];

layout(location = 0) flat out uvec3 outConstant;  // axis, material, vertex colour
#if CENTER_COVERAGE
layout(location = 1) out vec3 outGridPosition;  // in voxels, not permuted
layout(location = 2) out vec3 outNormal;
layout(location = 3) out vec2 outUv;
#else
layout(location = 1) flat out vec4 outCorner0;  // permuted position in voxels, octahedral normal
layout(location = 2) flat out vec4 outCorner1;
layout(location = 3) flat out vec4 outCorner2;
layout(location = 4) flat out vec4 outUv01;
layout(location = 5) flat out vec2 outUv2;
#endif
#if AXIS_AREAS
// Area seen along each axis, in parts of that along the dominant one; the signs are those of the normal.
layout(location = 6) flat out vec3 outAreas;
#endif

// Voxels along the edge of a pixel, and room in pixels about what is covered: an eighth of a voxel.
#if MARK_BRICKS
const float kPixel = float(THESIS_BRICK);
const float kRoom = 0.125 / kPixel;
#else
const float kPixel = 1.0;
const float kRoom = 0.0;
#endif

// The dominant axis last; its own inverse.
vec3 permuted(vec3 v, uint axis) { return axis == 0u ? v.zyx : axis == 1u ? v.xzy : v; }

#if !CENTER_COVERAGE
vec4 packedCorner(vec3 p, vec3 n) { return vec4(p, uintBitsToFloat(packSnorm2x16(octEncode(n)))); }

// Lines as vec3 (normal, offset): normal . p = offset. Where two meet.
vec2 intersection(vec3 e, vec3 f) {
    float det = e.x * f.y - e.y * f.x;
    return vec2(e.z * f.y - e.y * f.z, e.x * f.z - e.z * f.x) / det;
}

// The edge p -> q of a counter-clockwise triangle, moved outward by half a pixel in the sense of the box
// norm.
vec3 movedEdge(vec2 p, vec2 q) {
    vec2 outward = vec2(q.y - p.y, p.x - q.x);
    return vec3(outward, dot(outward, p) + (0.5 + kRoom) * (abs(outward.x) + abs(outward.y)));
}

float twiceArea(vec2 a, vec2 b, vec2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

struct FlatData {
    uvec3 constant;
    vec3 areas;
    vec4 corner0, corner1, corner2;
};

void emitPoint(vec2 p, FlatData data) {
    outConstant = data.constant;
#if AXIS_AREAS
    outAreas = data.areas;
#endif
    outCorner0 = data.corner0;
    outCorner1 = data.corner1;
    outCorner2 = data.corner2;
    outUv01 = vec4(uv[0], uv[1]);
    outUv2 = uv[2];
    gl_Position = vec4(p * (2.0 * kPixel / grid.size) - 1.0, 0.0, 1.0);
    EmitVertex();
}
#endif

void main() {
    vec3 world[3] = vec3[3](position[0], position[1], position[2]);
    vec3 across = cross(world[1] - world[0], world[2] - world[0]);
    vec3 weight = abs(across);
    // Ties: x before y before z, as in the original.
    uint axis = weight.x >= weight.y && weight.x >= weight.z ? 0u : weight.y >= weight.z ? 1u : 2u;
    vec3 p[3];
    for (int i = 0; i < 3; ++i) p[i] = permuted((world[i] - grid.origin) / (kPixel * grid.voxelSize), axis);
    uvec3 constant = uvec3(axis, material[0], color[0]);
    float front = dot(across, normal[0] + normal[1] + normal[2]) < 0.0 ? -1.0 : 1.0;
    vec3 areas = across * (front / max(weight[axis], 1e-30));

#if CENTER_COVERAGE
    for (int i = 0; i < 3; ++i) {
        outConstant = constant;
#if AXIS_AREAS
        outAreas = areas;
#endif
        outGridPosition = (world[i] - grid.origin) / grid.voxelSize;
        outNormal = normal[i];
        outUv = uv[i];
        gl_Position = vec4(p[i] * (2.0 / grid.size) - 1.0, 1.0);
        EmitVertex();
    }
    EndPrimitive();
#else
    vec2 low = floor(min(min(p[0].xy, p[1].xy), p[2].xy) - kRoom);
    vec2 high = ceil(max(max(p[0].xy, p[1].xy), p[2].xy) + kRoom);
    float doubled = twiceArea(p[0].xy, p[1].xy, p[2].xy);
    // Degenerate triangles cover nothing.
    if (!(abs(doubled) > 0.0)) return;
    vec2 b = doubled > 0.0 ? p[1].xy : p[2].xy;
    vec2 c = doubled > 0.0 ? p[2].xy : p[1].xy;
    vec3 ab = movedEdge(p[0].xy, b), bc = movedEdge(b, c), ca = movedEdge(c, p[0].xy);
    vec2 grownA = intersection(ca, ab), grownB = intersection(ab, bc), grownC = intersection(bc, ca);
    float grownArea = 0.5 * twiceArea(grownA, grownB, grownC);
    vec2 extent = high - low;
    // Also false when the intersections overflowed.
    bool grown = grownArea < extent.x * extent.y;

    FlatData data = FlatData(constant, areas, packedCorner(p[0], normal[0]), packedCorner(p[1], normal[1]),
                             packedCorner(p[2], normal[2]));
    emitPoint(grown ? grownA : low, data);
    emitPoint(grown ? grownB : vec2(high.x, low.y), data);
    emitPoint(grown ? grownC : vec2(low.x, high.y), data);
    if (!grown) emitPoint(high, data);
    EndPrimitive();
#endif
}
