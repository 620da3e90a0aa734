// SPDX-License-Identifier: MIT
// Visibility of lights by shadow maps (drawn by src/light/shadow_maps.cpp): position and normal -> [0,1].
// Filter: share of visible texels in a box of (2 SHADOW_FILTER + 1)^2 texels around the point with fractional
// edges (Reeves et al. 1987, "Rendering Antialiased Shadows with Depth Maps"), four comparisons per gather.
//
// One array texture holds all maps. Its layers are cut into n x n tiles, counted row by row, layer by layer:
// n = 1 for spots and directional lights, 2 for points (six tiles, one per side of a cube), 4 for sample
// points of rectangles (three tiles: one side of a cube in front, four half sides around, two to a tile).
// Depth is reversed: shadowNear / distance along the map's axis, 0 where nothing was drawn, a float's
// relative precision everywhere. A point lies in the map at tile centre + lateral / (distance * shadowTexel).
//
// No acne, no peter-panning: a texel away by e from the point, measured across the map's axis at the point's
// distance, holds the depth of a plane through the point, which lies nearer than the point's own if n.e < 0.
// Moving the point along its normal n by o >= max |n.e| puts it in front of the plane at every texel of the
// filter. With the two lateral axes a, b of the map and |e.a|, |e.b| <= (SHADOW_FILTER + 1) texels:
//   o = (SHADOW_FILTER + 1) * texel * (|n.a| + |n.b|),
// exact for planes at every angle, zero where the plane faces the light, a bounded number of texels at
// grazing light: nothing thicker than that loses its shadow's foot.
#ifndef SHADOW_FILTER
#define SHADOW_FILTER 2
#endif
#include "shared/bindings.h"
#include "shared/scene.h"
layout(binding = UNIT_SHADOW) uniform sampler2DArrayShadow shadowMaps;

// Added to the offset above, in texels: vertices are snapped to 1/256 texel when drawn, positions rebuilt
// from the G-buffer err by up to 3e-5 of their distance, and a texel is about 4e-3 of the distance to the
// light.
const float kShadowSlack = 0.1;

// Texels away from the point are compared at a depth less by this share of their lateral distance, so that
// the filter's outer texels do not find a wall that meets the surface at an angle. 0.5 by eye (2026-11):
// corners of a room stay clean, and light leaks by no more than one texel below a standing object.
const float kShadowCornerSlope = 0.5;

// Share of visible texels around `texel` of a layer, for the reversed depth `ref`; `refSlope` is added per
// texel of distance. `radius` must be constant.
float shadowFilter(const int radius, vec2 texel, float layer, float ref, float refSlope) {
    vec2 corner = floor(texel - 0.5);
    vec2 f = texel - 0.5 - corner;
    corner -= float(radius);
    vec2 uvFromTexel = 1.0 / vec2(textureSize(shadowMaps, 0).xy);
    float sum = 0.0;
    for (int y = 0; y <= radius; ++y) {
        for (int x = 0; x <= radius; ++x) {
            // A gather at a corner between texels returns (0,1), (1,1), (1,0), (0,0).
            float away = float(max(abs(2 * x - radius), abs(2 * y - radius)));
            vec2 uv = (corner + vec2(2 * x + 1, 2 * y + 1)) * uvFromTexel;
            vec4 lit = textureGather(shadowMaps, vec3(uv, layer), ref + away * refSlope);
            vec2 wx = vec2(x == 0 ? 1.0 - f.x : 1.0, x == radius ? f.x : 1.0);
            vec2 wy = vec2(y == 0 ? 1.0 - f.y : 1.0, y == radius ? f.y : 1.0);
            sum += wy.x * dot(wx, lit.wz) + wy.y * dot(wx, lit.xy);
        }
    }
    return sum / float((2 * radius + 1) * (2 * radius + 1));
}

// Lower left corner of a tile, in texels (xy), and its layer (z).
vec3 shadowTile(int tile, const int tilesPerEdge) {
    int perLayer = tilesPerEdge * tilesPerEdge;
    int size = textureSize(shadowMaps, 0).x / tilesPerEdge;
    int inLayer = tile % perLayer;
    return vec3(float((inLayer % tilesPerEdge) * size), float((inLayer / tilesPerEdge) * size),
                float(tile / perLayer));
}

// How far a receiver is moved along its normal, from the lateral components of the normal and the texel's
// edge.
float shadowOffset(const int radius, vec2 lateralNormal, float texel) {
    return texel * (float(radius + 1) * (abs(lateralNormal.x) + abs(lateralNormal.y)) + kShadowSlack);
}

// Components along the axes of the cube side that v lies on: xy lateral, z along the side's axis (positive).
// The side (0..5: +x -x +y -y +z -z) is chosen by `chooser`.
vec3 cubeSide(vec3 v, vec3 chooser, out int side) {
    vec3 a = abs(chooser);
    int axis = a.x >= a.y && a.x >= a.z ? 0 : (a.y >= a.z ? 1 : 2);
    vec3 turned = axis == 0 ? v.yzx : (axis == 1 ? v.zxy : v);
    float along = axis == 0 ? chooser.x : (axis == 1 ? chooser.y : chooser.z);
    side = 2 * axis + (along < 0.0 ? 1 : 0);
    return vec3(turned.xy, along < 0.0 ? -turned.z : turned.z);
}

// Visibility of a point light (or a wide spot) from p with geometric normal n.
float shadowVisibilityPoint(Light light, vec3 p, vec3 n) {
    int side;
    vec3 toP = p - light.position;
    vec3 lateral = cubeSide(toP, toP, side);
    vec3 ln = cubeSide(n, toP, side);
    float offset = shadowOffset(SHADOW_FILTER, ln.xy, lateral.z * light.shadowTexel);
    // The side stays that of p: it has a margin that takes the filter and the move.
    lateral += offset * ln;
    float z = max(lateral.z, 1e-20);
    float ref = light.shadowNear / z;
    vec3 tile = shadowTile(max(light.shadow, 0) + side, 2);
    float centre = 0.25 * float(textureSize(shadowMaps, 0).x);
    vec2 texel = tile.xy + centre + lateral.xy / (z * light.shadowTexel);
    float lit = shadowFilter(SHADOW_FILTER, texel, tile.z, ref, ref * light.shadowTexel * kShadowCornerSlope);
    return light.shadow < 0 ? 1.0 : lit;
}

// Visibility of a spot with one map.
float shadowVisibilitySpot(Light light, vec3 p, vec3 n) {
    vec3 toP = p - light.position;
    vec3 lateral = vec3(dot(toP, light.halfU), dot(toP, light.halfV), dot(toP, light.direction));
    vec3 ln = vec3(dot(n, light.halfU), dot(n, light.halfV), dot(n, light.direction));
    lateral += shadowOffset(SHADOW_FILTER, ln.xy, max(lateral.z, 0.0) * light.shadowTexel) * ln;
    float z = max(lateral.z, 1e-20);
    float ref = light.shadowNear / z;
    float size = float(textureSize(shadowMaps, 0).x);
    vec2 texel = clamp(0.5 * size + lateral.xy / (z * light.shadowTexel), 0.0, size);
    float lit = shadowFilter(SHADOW_FILTER, texel, float(light.shadow), ref,
                             ref * light.shadowTexel * kShadowCornerSlope);
    return light.shadow < 0 ? 1.0 : lit;
}

// Visibility of a directional light; light.position is the centre of the map's near side.
float shadowVisibilityDirectional(Light light, vec3 p, vec3 n) {
    vec3 toP = p - light.position;
    vec2 ln = vec2(dot(n, light.halfU), dot(n, light.halfV));
    toP += n * shadowOffset(SHADOW_FILTER, ln, light.shadowTexel);
    float ref = 1.0 - dot(toP, light.direction) * light.shadowNear;
    float size = float(textureSize(shadowMaps, 0).x);
    vec2 texel = 0.5 * size + vec2(dot(toP, light.halfU), dot(toP, light.halfV)) / light.shadowTexel;
    float lit = shadowFilter(SHADOW_FILTER, clamp(texel, 0.0, size), float(light.shadow), ref,
                             light.shadowNear * light.shadowTexel * kShadowCornerSlope);
    return light.shadow < 0 ? 1.0 : lit;
}

// The k-th sample point of a rectangle, k < sampleGrid^2: one per cell of a grid, at places that differ in
// both coordinates, so that an edge parallel to the rectangle meets them one by one (Chiu et al. 1994,
// "Multi-Jittered Sampling", without the jitter). Moved off the surface by a thousandth of its size, which an
// emitter's own triangles lie in.
vec3 rectSamplePoint(Light light, uint k) {
    float grid = float(light.sampleGrid);
    vec2 cell = vec2(k % light.sampleGrid, k / light.sampleGrid);
    vec2 uv = (cell + (cell.yx + 0.5) / grid) / grid * 2.0 - 1.0;
    float lift = 1e-3 * min(length(light.halfU), length(light.halfV));
    return light.position + uv.x * light.halfU + uv.y * light.halfV + lift * light.direction;
}

// Visibility of the k-th sample point of a rectangle, unfiltered but for the bilinear weights: the samples
// blur each other's edges.
float shadowVisibilityRect(Light light, uint k, vec3 point, vec3 p, vec3 n) {
    vec3 axisU = normalize(light.halfU);
    vec3 axisV = cross(light.direction, axisU);
    vec3 toP = p - point;
    vec3 local = vec3(dot(toP, axisU), dot(toP, axisV), dot(toP, light.direction));
    vec3 localNormal = vec3(dot(n, axisU), dot(n, axisV), dot(n, light.direction));

    // Sides: 0 +u, 1 -u, 2 +v, 3 -v, 4 front. Lateral axes of the side ones end with the front's: (v, n), (n,
    // u).
    int side;
    vec3 lateral = cubeSide(local, local, side);
    vec3 ln = cubeSide(localNormal, local, side);
    lateral += shadowOffset(0, ln.xy, lateral.z * light.shadowTexel) * ln;
    float z = max(lateral.z, 1e-20);
    bool front = side >= 4;
    vec2 across = side == 2 || side == 3 ? lateral.yx : lateral.xy;  // x along the rectangle, y to the front

    float size = 0.25 * float(textureSize(shadowMaps, 0).x);
    vec3 tile = shadowTile(max(light.shadow, 0) + 3 * int(k) + (front ? 0 : 1 + side / 2), 4);
    vec2 texel = across / (z * light.shadowTexel);
    // Half sides begin two texels (SHADOW_RECT_GUARD) below the rectangle's plane.
    texel += front ? vec2(0.5 * size) : vec2(0.5 * size, (side & 1) != 0 ? 0.5 * size + 2.0 : 2.0);
    float lit = shadowFilter(0, tile.xy + texel, tile.z, light.shadowNear / z, 0.0);
    return light.shadow < 0 ? 1.0 : lit;
}
