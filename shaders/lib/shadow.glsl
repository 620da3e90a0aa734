// SPDX-License-Identifier: MIT
// Visibility of lights by shadow maps (drawn by src/light/shadow_maps.cpp): position and normal -> [0,1].
// docs/theory/3_light.md, "Visibility" and "Outlines".
//
// One array texture holds all maps. Its layers are cut into n x n tiles, counted row by row, layer by layer:
// n = 1 for spots and directional lights, 2 for points (six tiles, one per side of a cube), 4 for sample
// points of area lights (three tiles: one side of a cube in front, four half sides around, two to a tile; of a
// sphere six).
// Depth is reversed: shadowNear / distance along the map's axis, 0 where nothing was drawn, a float's
// relative precision everywhere. A point lies in the map at tile centre + lateral / (distance * shadowTexel).
//
// The front maps of a rectangle that is far from the scene hold no more than the scene, about one place (LIGHT_AIMED).
//
// Besides its depth a texel keeps the slopes of its triangle and where that ends. It hides the receiver if
// (3.2) both
//   1. the texel's point is nearer than the receiver's plane at that texel,
//   2. the texel's plane is nearer than the receiver where the receiver is,
// and over the texel's triangle by 2 alone. What is left is rounding (kShadowSlack).
//
// SHADOW_FILTER 0: the outline between texels is that of their triangles. Above: share of visible texels in a
// box of (2 SHADOW_FILTER + 1)^2 texels around the point with fractional edges (Reeves et al. 1987). -1: the
// nearest texel says yes or no; for rays whose mean is taken. SHADOW_DIVIDED 1, with SHADOW_FILTER 0: shadowDivided
// tells of the last lookup whether the texels around the point disagree.
//
// Maps of rectangles have depths alone. There the receiver is moved along its normal n by o >= max |n.e| over
// the texels e that are compared, which puts it in front of its own plane at each of them:
//   o = texel * (|n.a| + |n.b|), a and b the map's lateral axes.
//
// Positions of voxels are not exact: `lift` moves them towards the light, until they are so many of these
// offsets (x) and so many metres (y) in front of their plane. Moved along the normal they would be looked up
// beside their place, and shadows would lie there.
#ifndef SHADOW_FILTER
#define SHADOW_FILTER 0
#endif
#ifndef SHADOW_DIVIDED
#define SHADOW_DIVIDED 0
#endif
#include "lib/dot.glsl"
#include "lib/lookup_count.glsl"
#include "lib/rect_points.glsl"
#include "shared/scene.h"
uniform sampler2DArrayShadow shadowMaps;
uniform sampler2DArray shadowDepths;
uniform usampler2DArray shadowSurfaces;

// Texels along the surface by which one is taken for another, at most: vertices are snapped to 1/256 texel
// when drawn, slopes are halves, positions rebuilt from the G-buffer err by up to 3e-5 of their distance, and
// a texel is about 4e-3 of the distance to the light.
const float kShadowSlack = 0.03;
// For the maps of rectangles, in texels too, for the same reasons; three times as much, as nothing but the
// move separates a surface from itself.
const float kShadowRectSlack = 0.1;

#if SHADOW_DIVIDED
bool shadowDivided = false;
#endif

// Up to how many texels from its centre a texel knows where its triangle ends; light/shadow.frag.glsl too.
const float kShadowEnd = 2.0;

// lift for the positions of voxels.
const vec2 kShadowVoxelLift = vec2(3.0, 0.0);
// Where light comes in flatter than this cosine, it is not moved farther: it might pass through a wall.
const float kShadowLiftCosine = 0.5;

// Where an outline crosses the line from one texel's centre (0) to the next (1), of which the first is lit by
// `lit0` and the second by `lit1`: where the hidden one's triangle ends.
float shadowCrossing(float lit0, float lit1, float end0, float end1) {
    float t = lit0 < lit1 ? end0 : 1.0 - end1;
    return (lit0 < lit1 ? end0 : end1) > 0.998 ? 0.5 : t;
}

// Visible or not, at f between the centres of four texels that are (lit) or are not: the outline of what
// hides them runs straight between the two places where it crosses the lines between neighbours (marching
// squares). endX, endY: where the texels' triangles end towards each other. Order as of a gather: (0,1),
// (1,1), (1,0), (0,0).
float shadowOutline(vec4 lit, vec4 endX, vec4 endY, vec2 f) {
    float bottom = shadowCrossing(lit.w, lit.z, endX.w, endX.z);
    float top = shadowCrossing(lit.x, lit.y, endX.x, endX.y);
    float left = shadowCrossing(lit.w, lit.x, endY.w, endY.x);
    float right = shadowCrossing(lit.z, lit.y, endY.z, endY.y);
    // Within the corner that the outline cuts off.
    vec4 u = vec4(f.x, 1.0 - f.x, 1.0 - f.x, f.x), tu = vec4(top, 1.0 - top, 1.0 - bottom, bottom);
    vec4 v = vec4(1.0 - f.y, 1.0 - f.y, f.y, f.y), tv = vec4(1.0 - left, 1.0 - right, right, left);
    vec4 within = step(u * tv + v * tu, tu * tv);
    float count = dot(lit, vec4(1.0));
    float hiddenCorner = 1.0 - min(dot(within, 1.0 - lit), 1.0);  // lit but for corners
    float litCorner = min(dot(within, lit), 1.0);                 // hidden but for corners
    float across = f.x < mix(bottom, top, f.y) ? lit.w : lit.z;
    float along = f.y < mix(left, right, f.x) ? lit.w : lit.x;
    float result = lit.w == lit.x ? across : (lit.w == lit.z ? along : hiddenCorner);
    result = count > 2.5 ? hiddenCorner : (count < 1.5 ? litCorner : result);
    return count > 3.5 ? 1.0 : (count < 0.5 ? 0.0 : result);
}

// Whether the receiver is visible, for the `texel` of a layer (z) where it is, its reversed depth `ref` and its
// plane's `slope`; with a filter a share. Slopes are in units of unit.x + unit.y * depth per texel.
#if SHADOW_FILTER < 0
float shadowFilter(sampler2DArray depths, usampler2DArray surfaces, vec3 texel, float ref, vec2 slope,
                   vec2 unit) {
    ivec3 at = ivec3(texel);
    COUNT_LOOKUP(2);
    float depth = texelFetch(depths, at, 0).x;
    vec2 texelSlope = unpackHalf2x16(texelFetch(surfaces, at, 0).x);
    vec2 d = floor(texel.xy) + 0.5 - texel.xy;
    float refUnit = unit.x + unit.y * ref;
    float slopes = abs(slope.x) + abs(slope.y) + abs(texelSlope.x) + abs(texelSlope.y);
    float overReceiver = depth - refUnit * dot(slope, d);
    float overTexel = depth - (unit.x + unit.y * depth) * dot(texelSlope, d);
    return min(overReceiver, overTexel) <= ref + kShadowSlack * refUnit * (1.0 + slopes) ? 1.0 : 0.0;
}
#else
float shadowFilter(sampler2DArray depths, usampler2DArray surfaces, vec3 texel, float ref, vec2 slope,
                   vec2 unit) {
    const int radius = SHADOW_FILTER;
    vec2 corner = floor(texel.xy - 0.5);
    vec2 f = texel.xy - 0.5 - corner;
    corner -= float(radius);
    vec2 uvFromTexel = 1.0 / vec2(textureSize(depths, 0).xy);
    float refUnit = unit.x + unit.y * ref;
    float slack = kShadowSlack * refUnit;
    float refSlack = ref + slack * (1.0 + abs(slope.x) + abs(slope.y));
    vec2 refSlope = slope * refUnit;
    float sum = 0.0;
    COUNT_LOOKUP((radius + 1) * (radius + 1) * (radius > 0 ? 2 : 3));
    for (int y = 0; y <= radius; ++y) {
        for (int x = 0; x <= radius; ++x) {
            // A gather at a corner between texels returns (0,1), (1,1), (1,0), (0,0).
            vec3 uv = vec3((corner + vec2(2 * x + 1, 2 * y + 1)) * uvFromTexel, texel.z);
            vec4 depth = textureGather(depths, uv);
            uvec4 bits = textureGather(surfaces, uv, 0);
            vec2 s0 = unpackHalf2x16(bits.x), s1 = unpackHalf2x16(bits.y);
            vec2 s2 = unpackHalf2x16(bits.z), s3 = unpackHalf2x16(bits.w);
            vec4 slopeX = vec4(s0.x, s1.x, s2.x, s3.x), slopeY = vec4(s0.y, s1.y, s2.y, s3.y);
            // From the receiver to the texels' centres.
            vec4 dx = vec4(0.0, 1.0, 1.0, 0.0) + (float(2 * x - radius) - f.x);
            vec4 dy = vec4(1.0, 1.0, 0.0, 0.0) + (float(2 * y - radius) - f.y);
            vec4 bound = refSlack + slack * (abs(slopeX) + abs(slopeY));
            vec4 overReceiver = depth - (refSlope.x * dx + refSlope.y * dy);
            vec4 overTexel = depth - (unit.x + unit.y * depth) * (slopeX * dx + slopeY * dy);
#if SHADOW_FILTER
            vec4 lit = step(min(overReceiver, overTexel), bound);
            vec2 wx = vec2(x == 0 ? 1.0 - f.x : 1.0, x == radius ? f.x : 1.0);
            vec2 wy = vec2(y == 0 ? 1.0 - f.y : 1.0, y == radius ? f.y : 1.0);
            sum += wy.x * dot(wx, lit.wz) + wy.y * dot(wx, lit.xy);
#else
            uvec4 ends = textureGather(surfaces, uv, 1);
            vec4 e0 = unpackUnorm4x8(ends.x), e1 = unpackUnorm4x8(ends.y);
            vec4 e2 = unpackUnorm4x8(ends.z), e3 = unpackUnorm4x8(ends.w);
            vec4 endX = kShadowEnd * vec4(e0.x, e1.y, e2.y, e3.x);
            vec4 endY = kShadowEnd * vec4(e0.w, e1.w, e2.z, e3.z);
            // Over the texel's triangle 2 alone decides: that is a ray against a triangle. One that ends at
            // the texel's centre, both ways 0, is over nothing.
            vec4 within = step(abs(dx) * endY + abs(dy) * endX, endX * endY - 1e-6);
            vec4 lit = step(max(min(overReceiver, overTexel), overTexel * within), bound);
#if SHADOW_DIVIDED
            shadowDivided = any(notEqual(lit, lit.xxxx));
#endif
            // A triangle that a line through the texel's centre crosses in less than a texel is found by
            // chance. Its share of the area comes out right only if it then counts for the whole texel.
            vec4 acrossX = vec4(e0.x + e0.y, e1.x + e1.y, e2.x + e2.y, e3.x + e3.y);
            vec4 acrossY = vec4(e0.z + e0.w, e1.z + e1.w, e2.z + e2.w, e3.z + e3.w);
            vec4 large = clamp(2.0 * kShadowEnd * min(acrossX, acrossY) - 1.0, 0.0, 1.0);
            float trusted = dot(large, 1.0 - lit) / max(4.0 - dot(lit, vec4(1.0)), 1.0);
            float whole = mix(mix(lit.w, lit.z, f.x), mix(lit.x, lit.y, f.x), f.y);
            sum = mix(whole, shadowOutline(lit, endX, endY, f), trusted);
#endif
        }
    }
    return sum / float((2 * radius + 1) * (2 * radius + 1));
}
#endif

// Slopes of the depth of a plane with normal n that is seen at lateral tangents `at` (0, 0 for a parallel
// projection), over the unit; the light is on the side that n points to.
vec2 shadowPlane(vec3 n, vec2 at) { return n.xy / min(dot(n, vec3(at, 1.0)), -1e-4); }

// Bilinear share of visible texels in the map of a rectangle's sample point.
float shadowBilinear(vec2 texel, float layer, float ref) {
    vec2 corner = floor(texel - 0.5);
    vec2 f = texel - 0.5 - corner;
    COUNT_LOOKUP(1);
    vec2 uv = (corner + 1.0) / vec2(textureSize(shadowMaps, 0).xy);
    vec4 lit = textureGather(shadowMaps, vec3(uv, layer), ref);
    return mix(mix(lit.w, lit.z, f.x), mix(lit.x, lit.y, f.x), f.y);
}

// Lower left corner of a tile, in texels (xy), and its layer (z).
vec3 shadowTile(int tile, const int tilesPerEdge) {
    int perLayer = tilesPerEdge * tilesPerEdge;
    int size = textureSize(shadowMaps, 0).x / tilesPerEdge;
    int inLayer = tile % perLayer;
    return vec3(float((inLayer % tilesPerEdge) * size), float((inLayer / tilesPerEdge) * size),
                float(tile / perLayer));
}

// How far a receiver is moved along its normal, from the lateral components of the normal.
float shadowOffset(float texels, vec2 lateralNormal) {
    return texels * (abs(lateralNormal.x) + abs(lateralNormal.y));
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

// How far a receiver is moved towards the light, which comes in under `cosine`.
float shadowLift(vec2 lift, float texelSize, vec2 lateralNormal, float cosine) {
    return (shadowOffset(lift.x * texelSize, lateralNormal) + lift.y) / max(cosine, kShadowLiftCosine);
}

// Visibility of a point light (or a wide spot) from p with geometric normal n.
float shadowVisibilityPoint(Light light, vec3 p, vec3 n, vec2 lift) {
    int side;
    vec3 toP = p - light.position;
    vec3 lateral = cubeSide(toP, toP, side);
    vec3 ln = cubeSide(n, toP, side);
    vec2 at = lateral.xy / max(lateral.z, 1e-20);
    float distance = max(length(toP), 1e-20);
    float moved = shadowLift(lift, lateral.z * light.shadowTexel, ln.xy, -dot(n, toP) / distance);
    float z = max(lateral.z * (1.0 - moved / distance), 1e-20);
    vec3 tile = shadowTile(max(light.shadow, 0) + side, 2);
    float centre = 0.25 * float(textureSize(shadowDepths, 0).x);
    float lit =
        shadowFilter(shadowDepths, shadowSurfaces, vec3(tile.xy + centre + at / light.shadowTexel, tile.z),
                     light.shadowNear / z, shadowPlane(ln, at), vec2(0.0, light.shadowTexel));
    return light.shadow < 0 ? 1.0 : (dot(n, toP) < 0.0 ? lit : 0.0);
}

// Visibility of a spot with one map.
float shadowVisibilitySpot(Light light, vec3 p, vec3 n, vec2 lift) {
    vec3 toP = p - light.position;
    vec3 lateral = vec3(dot(toP, light.halfU), dot(toP, light.halfV), dot(toP, light.direction));
    vec3 ln = vec3(dot(n, light.halfU), dot(n, light.halfV), dot(n, light.direction));
    vec2 at = lateral.xy / max(lateral.z, 1e-20);
    float distance = max(length(toP), 1e-20);
    float moved = shadowLift(lift, max(lateral.z, 0.0) * light.shadowTexel, ln.xy, -dot(n, toP) / distance);
    float z = max(lateral.z * (1.0 - moved / distance), 1e-20);
    float size = float(textureSize(shadowDepths, 0).x);
    vec2 texel = clamp(0.5 * size + at / light.shadowTexel, 0.0, size);
    float lit = shadowFilter(shadowDepths, shadowSurfaces, vec3(texel, float(light.shadow)),
                             light.shadowNear / z, shadowPlane(ln, at), vec2(0.0, light.shadowTexel));
    return light.shadow < 0 ? 1.0 : (dot(n, toP) < 0.0 ? lit : 0.0);
}

// A map of parallel light: the centre of its near side, depth 1 - near * distance, the edge of a texel in m.
struct ParallelShadow {
    vec3 position;
    float near, texel;
    int layer;  // -1: none
    vec2 lift;
};

// Visibility of a directional light in one of its maps, which `depths` and `surfaces` hold.
float shadowVisibilityParallel(sampler2DArray depths, usampler2DArray surfaces, Light light,
                               ParallelShadow map, vec3 p, vec3 n) {
    vec3 toP = p - map.position;
    vec3 ln = vec3(dot(n, light.halfU), dot(n, light.halfV), dot(n, light.direction));
    toP -= light.direction * shadowLift(map.lift, map.texel, ln.xy, -ln.z);
    float ref = 1.0 - dot(toP, light.direction) * map.near;
    float size = float(textureSize(depths, 0).x);
    vec2 texel = 0.5 * size + vec2(dot(toP, light.halfU), dot(toP, light.halfV)) / map.texel;
    float lit = shadowFilter(depths, surfaces, vec3(clamp(texel, 0.0, size), float(map.layer)), ref,
                             shadowPlane(ln, vec2(0.0)), vec2(map.near * map.texel, 0.0));
    return map.layer < 0 ? 1.0 : (ln.z < 0.0 ? lit : 0.0);
}

// Visibility of a directional light; light.position is the centre of the map's near side.
float shadowVisibilityDirectional(Light light, vec3 p, vec3 n, vec2 lift) {
    return shadowVisibilityParallel(
        shadowDepths, shadowSurfaces, light,
        ParallelShadow(light.position, light.shadowNear, light.shadowTexel, light.shadow, lift), p, n);
}

// The k-th sample point of an area light (lib/rect_points.glsl). Moved off the surface by a thousandth of its
// size, which an emitter's own triangles lie in.
vec3 rectSamplePoint(Light light, uint k) {
    float lift = isSphere(light) ? 0.0 : 1e-3 * min(length(light.halfU), length(light.halfV));
    return light.position + rectPointOffset(light, k) + lift * light.direction;
}

// Where the middle of the front map of a sample point lies that is so far from the rectangle's middle: a tangent.
vec2 shadowRectMiddle(Light light, vec3 place) {
    vec3 axisU = normalize(light.halfU);
    vec3 axisV = cross(light.direction, axisU);
    float ahead = light.shadowNear * LIGHT_AIM_DISTANCE;
    vec2 aside = ahead * vec2(light.cosInner, light.cosOuter) - vec2(dot(place, axisU), dot(place, axisV));
    vec2 tangent = aside / max(ahead - dot(place, light.direction), 1e-20);
    return (light.flags & LIGHT_AIMED) != 0u ? tangent : vec2(0.0);
}

#if LIGHTS_SHAPED
// As below, for a sphere: all sides of a cube, a tile each.
float shadowVisibilitySphere(Light light, uint k, vec3 point, vec3 p, vec3 n) {
    int side;
    vec3 toP = p - point;
    vec3 lateral = cubeSide(toP, toP, side);
    vec3 ln = cubeSide(n, toP, side);
    float texelSize = lateral.z * light.shadowTexel;
    lateral += (shadowOffset(texelSize, ln.xy) + kShadowRectSlack * texelSize) * ln;
    float z = max(lateral.z, 1e-20);
    vec3 tile = shadowTile(max(light.shadow, 0) + 6 * int(k) + side, 4);
    float centre = 0.125 * float(textureSize(shadowMaps, 0).x);
    float lit =
        shadowBilinear(tile.xy + centre + lateral.xy / (z * light.shadowTexel), tile.z, light.shadowNear / z);
    return light.shadow < 0 ? 1.0 : lit;
}
#endif

// Visibility of the k-th sample point of an area light, unfiltered but for the bilinear weights: the samples
// blur each other's edges.
float shadowVisibilityRect(Light light, uint k, vec3 point, vec3 p, vec3 n) {
#if LIGHTS_SHAPED
    if (isSphere(light)) return shadowVisibilitySphere(light, k, point, p, n);
#endif
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
    float texelSize = lateral.z * light.shadowTexel;
    lateral += (shadowOffset(texelSize, ln.xy) + kShadowRectSlack * texelSize) * ln;
    float z = max(lateral.z, 1e-20);
    bool front = side >= 4;
    vec2 across = side == 2 || side == 3 ? lateral.yx : lateral.xy;  // x along the rectangle, y to the front

    float size = 0.25 * float(textureSize(shadowMaps, 0).x);
    vec3 tile = shadowTile(max(light.shadow, 0) + 3 * int(k) + (front ? 0 : 1 + side / 2), 4);
    vec2 texel = (across / z - (front ? shadowRectMiddle(light, point - light.position) : vec2(0.0))) /
                 light.shadowTexel;
    // Half sides begin two texels (SHADOW_RECT_GUARD) below the rectangle's plane.
    texel += front ? vec2(0.5 * size) : vec2(0.5 * size, (side & 1) != 0 ? 0.5 * size + 2.0 : 2.0);
    float lit = shadowBilinear(tile.xy + texel, tile.z, light.shadowNear / z);
    return light.shadow < 0 ? 1.0 : lit;
}
