// SPDX-License-Identifier: MIT
// Light that arrives straight from the lights of the scene: position and normal -> irradiance, and radiance
// reflected by the specular lobe. For pixels and for voxel faces alike. Units: include/conelight/scene.h.
//
// Defines (light::lightDefines gives them for a scene; unset: everything on):
// - LIGHTS_POINT, _SPOT, _DIRECTIONAL, _RECT: whether the table holds such lights. Others are left out.
// - LIGHTS_SHAPED: whether area lights may be round and others have profiles.
// - LIGHTS_FIXED 1: these four are the exact numbers of lights, at most 4 together. Loops are then unrolled
//   and read the table at constant places of a uniform block (mode phong: 21 instead of 25 cpu-ms on
//   llvmpipe, which reads storage once per lane wherever lanes may be idle, as in the loop over
//   a face's rays). Unrolled here, not by the compiler: Mesa leaves loops of this size as they are, and then
//   reads a light's numbers lane by lane.
// - LIGHTS_SHADOWS 0: everything is visible.
// - SHADOW_FILTER: radius of the shadow filter in texels.
// - CONE_SHADOWS 1: shadows are soft, by cones (lib/cone_shadow.glsl, to be included), not by maps.
// - VISIBILITY_PICTURE 1: which of the first 32 lights without extent are seen is known (visibleLights).
// - SHADOW_CASCADES 1: directional lights have maps about the eye (lib/shadow_cascades.glsl).
// - SHEEN 1: what sheen sends to the eye is added to sheenLight (lib/sheen.glsl, to be included).
// - GLASS 1: what is not in shadow may lie behind glass (lib/glass_tree.glsl).
// Reads what light::Lights declares.
#ifndef LIGHTS_POINT
#define LIGHTS_POINT 1
#endif
#ifndef LIGHTS_SPOT
#define LIGHTS_SPOT 1
#endif
#ifndef LIGHTS_DIRECTIONAL
#define LIGHTS_DIRECTIONAL 1
#endif
#ifndef LIGHTS_RECT
#define LIGHTS_RECT 1
#endif
#ifndef LIGHTS_FIXED
#define LIGHTS_FIXED 0
#endif
#ifndef LIGHTS_SHADOWS
#define LIGHTS_SHADOWS 1
#endif
#ifndef CONE_SHADOWS
#define CONE_SHADOWS 0
#endif
#ifndef SHADOW_CASCADES
#define SHADOW_CASCADES 0
#endif
#ifndef VISIBILITY_PICTURE
#define VISIBILITY_PICTURE 0
#endif
#ifndef SHEEN
#define SHEEN 0
#endif
#include "lib/brdf.glsl"
#include "lib/dot.glsl"
#include "lib/glass_tree.glsl"
#include "lib/light_profile.glsl"
#include "lib/light_table.glsl"
#include "lib/random.glsl"
#include "lib/rect_light.glsl"
#include "lib/rect_tint.glsl"
#include "lib/shadow.glsl"
#if SHADOW_CASCADES
#include "lib/shadow_cascades.glsl"
#endif

#define LIGHTS_TOTAL (LIGHTS_POINT + LIGHTS_SPOT + LIGHTS_DIRECTIONAL + LIGHTS_RECT)
#if LIGHTS_FIXED && LIGHTS_TOTAL > 0
#if FLAT_CONSTANTS && FLAT_LIGHTS
Light fixedLight(const int n) {
    int row = FLAT_LIGHT_ROW + 7 * n;
    uvec4 a = flatRows[row], b = flatRows[row + 1], c = flatRows[row + 2], d = flatRows[row + 3];
    uvec4 e = flatRows[row + 4], f = flatRows[row + 5], g = flatRows[row + 6];
    return Light(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), int(b.w), uintBitsToFloat(c.xyz),
                 uintBitsToFloat(c.w), uintBitsToFloat(d.xyz), uintBitsToFloat(d.w), uintBitsToFloat(e.xyz),
                 uintBitsToFloat(e.w), uintBitsToFloat(f.xyz), f.w, uintBitsToFloat(g.x),
                 uintBitsToFloat(g.y), g.z, g.w);
}
#else
layout(std140) uniform FixedLightBlock { Light fixedLights[LIGHTS_TOTAL]; };
Light fixedLight(const int n) { return fixedLights[n]; }
#endif
#endif

#if CONE_SHADOWS
// Share of a light's disc that is seen, `tanHalf` the tangent of half its aperture; and that of lights without
// a size.
float coneShadow(vec3 position, vec3 geometricNormal, vec3 toLight, float distance, float tanHalf);
float coneShadowTan();
#endif

// Lights of the table whose visibility gather/visibility_maps.comp.glsl tells, one bit each.
const uint kVisibilityLights = 32u;
#if VISIBILITY_PICTURE
uint visibleLights = 0u;  // of the pixel; set before lights are added
#endif

#if SHEEN
struct SheenLobe {
    vec3 normal;
    float roughness;
};
SheenLobe sheenLobe;          // of the surface; set before lights are added
vec3 sheenLight = vec3(0.0);  // W/(sr m^2) towards the eye, of white sheen by its term alone
#endif

struct DirectLight {
    vec3 irradiance;  // W/m^2 on a surface with the shading normal
    vec3 specular;    // W/(sr m^2) towards the eye
};

// Where light arrives. The geometric normal is for shadows; both point to the side that is lit.
struct Receiver {
    vec3 position;
    vec3 normal;
    vec3 geometricNormal;
    vec3 toEye;       // used for the specular part only
    vec2 shadowLift;  // 0 for an exact position, kShadowVoxelLift for a voxel's (lib/shadow.glsl)
};

// Intensity over distance: inverse square (not below 1 mm) or the light's own falloff, and glTF's range
// window (KHR_lights_punctual: 1 - (d/range)^4).
float distanceFalloff(Light light, float d2) {
    float d = sqrt(d2);
    float inverseSquare = 1.0 / max(d2, 1e-6);
    float custom = 1.0 / (light.falloff.x + light.falloff.y * d + light.falloff.z * d2);
    float ratio = light.range > 0.0 ? d2 / (light.range * light.range) : 0.0;
    return (light.customFalloff != 0u ? custom : inverseSquare) * clamp(1.0 - ratio * ratio, 0.0, 1.0);
}

// From 1 inside the inner to 0 outside the outer angle (KHR_lights_punctual), times the light's profile.
float spotFalloff(Light light, vec3 toLight) {
    float t = (dot(-toLight, light.direction) - light.cosOuter) / max(light.cosInner - light.cosOuter, 1e-3);
    t = clamp(t, 0.0, 1.0);
#if LIGHTS_SHAPED
    return t * t * profileFactor(light, toLight);
#else
    return t * t;
#endif
}

// Adds light from one direction; `facing` is the irradiance on a plane that faces it.
void addLight(inout DirectLight sum, const bool specular, Receiver r, Brdf b, vec3 toLight, vec3 facing) {
    vec3 irradiance = facing * max(dot(r.normal, toLight), 0.0);
    sum.irradiance += irradiance;
    if (specular && !b.ideal) sum.specular += irradiance * brdfSpecular(b, r.normal, toLight, r.toEye);
#if SHEEN
    sheenLight += facing * sheenTimesCosine(sheenLobe.normal, sheenLobe.roughness, toLight, r.toEye);
#endif
}

// `facing` as glass leaves it on its way of `distance` from a light that is seen.
vec3 throughGlass(vec3 facing, Receiver r, vec3 toLight, float distance) {
#if GLASS
    if (facing.r + facing.g + facing.b > 0.0)
        facing *= glassTransmittance(r.position, toLight, distance, kAnyBend, true);
#endif
    return facing;
}

float pointVisibility(Receiver r, Light light, uint number) {
#if VISIBILITY_PICTURE
    if (number < kVisibilityLights) return float(visibleLights >> number & 1u);
#endif
    return shadowVisibilityPoint(light, r.position, r.geometricNormal, r.shadowLift);
}

void addPoint(inout DirectLight sum, const bool specular, Receiver r, Brdf b, Light light, uint number) {
    vec3 l = light.position - r.position;
    float d2 = dot(l, l);
    l *= inversesqrt(max(d2, 1e-20));
    float visible = 1.0;
#if CONE_SHADOWS
    if (light.shadow >= 0) visible = coneShadow(r.position, r.geometricNormal, l, sqrt(d2), coneShadowTan());
#elif LIGHTS_SHADOWS
    visible = pointVisibility(r, light, number);
#endif
    vec3 facing = light.intensity * (distanceFalloff(light, d2) * spotFalloff(light, l) * visible);
    addLight(sum, specular, r, b, l, throughGlass(facing, r, l, sqrt(d2)));
}

float spotVisibility(Receiver r, Light light, uint number) {
#if VISIBILITY_PICTURE
    if (number < kVisibilityLights) return float(visibleLights >> number & 1u);
#endif
    return shadowVisibilitySpot(light, r.position, r.geometricNormal, r.shadowLift);
}

void addSpot(inout DirectLight sum, const bool specular, Receiver r, Brdf b, Light light, uint number) {
    vec3 l = light.position - r.position;
    float d2 = dot(l, l);
    l *= inversesqrt(max(d2, 1e-20));
    float visible = 1.0;
#if CONE_SHADOWS
    if (light.shadow >= 0) visible = coneShadow(r.position, r.geometricNormal, l, sqrt(d2), coneShadowTan());
#elif LIGHTS_SHADOWS
    visible = spotVisibility(r, light, number);
#endif
    vec3 facing = light.intensity * (distanceFalloff(light, d2) * spotFalloff(light, l) * visible);
    addLight(sum, specular, r, b, l, throughGlass(facing, r, l, sqrt(d2)));
}

// By maps; cascades are for exact positions.
float directionalMapVisibility(Light light, uint number, vec3 p, vec3 n, vec2 lift) {
#if SHADOW_CASCADES
    return shadowVisibilityCascaded(light, number - lighting.lightEnds.y, p, n);
#else
    return shadowVisibilityDirectional(light, p, n, lift);
#endif
}

float directionalVisibility(Receiver r, Light light, uint number) {
#if VISIBILITY_PICTURE
    if (number < kVisibilityLights) return float(visibleLights >> number & 1u);
#endif
    return directionalMapVisibility(light, number, r.position, r.geometricNormal, r.shadowLift);
}

void addDirectional(inout DirectLight sum, const bool specular, Receiver r, Brdf b, Light light,
                    uint number) {
    float visible = 1.0;
#if CONE_SHADOWS
    if (light.shadow >= 0)
        visible = coneShadow(r.position, r.geometricNormal, -light.direction, 1e9, coneShadowTan());
#elif LIGHTS_SHADOWS
    visible = directionalVisibility(r, light, number);
#endif
    vec3 facing = throughGlass(light.intensity * visible, r, -light.direction, 1e9);
    addLight(sum, specular, r, b, -light.direction, facing);
}

// The light as a cone to its middle sees it, as wide as the rectangle looks: a disc of its projected area.
Light rectBehindCone(Receiver r, Light light) {
#if CONE_SHADOWS
    vec3 l = light.position - r.position;
    float distance = max(length(l), 1e-6);
    l /= distance;
    float area = rectArea(light) * rectCosine(light, l);
    if (light.shadow >= 0)
        light.intensity *=
            coneShadow(r.position, r.geometricNormal, l, distance, sqrt(area / kPi) / distance);
#endif
    return light;
}

// Adds a sample point of a rectangle in the direction l to the sums of the lobe; returns its weight there. `cell`: what it
// emits, area.
float addLobePoint(inout RectSums points, Receiver r, Brdf b, RectLobe lobe, vec3 l, vec2 cell) {
    vec2 width2 = lobe.width * lobe.width;
    // With h half way between l and the eye: n.h and 1 - v.h.
    float height = dot(l, r.normal);
    float NoL = max(height, 0.0);
    float half2 = 0.5 + 0.5 * dot(l, r.toEye);
    float perHalf = inversesqrt(max(half2, 1e-6));
    float NoH = clamp(0.5 * (height + b.NoV) * perHalf, 0.0, 1.0);
    float c = 1.0 - half2 * perHalf;
    points.exact +=
        cell.x * NoL * ggxVisible(b.alpha, NoH, max(NoL, 1e-4), b.NoV) * vec2(1.0, (c * c) * (c * c) * c);
    vec3 inSpace = rectLobeSpace(lobe, l, height);
    float transformed = cell.x * rectLobeDensity(inSpace, width2);
    points.cosine += transformed;
    points.most = max(points.most, transformed);
    return cell.x * rectLobeDensity(inSpace, width2 + kRectCellWidening * cell.y * cell.x);
}

#if SHEEN
// Irradiance of a sample point, and the sheen of it.
vec2 sheenOfPoint(Receiver r, vec3 l) {
    return vec2(max(dot(l, sheenLobe.normal), 0.0),
                sheenTimesCosine(sheenLobe.normal, sheenLobe.roughness, l, r.toEye));
}

// Of a rectangle; `sums`: irradiance of all points, sheen of those that are seen.
void addRectSheen(Receiver r, Light light, vec2 sums, vec3 tint) {
    float whole = rectIrradiance(light, r.position, sheenLobe.normal);
    sheenLight += light.intensity * tint * (sums.x > 0.0 ? whole * sums.y / sums.x : 0.0);
}
#endif

// Diffuse: the exact irradiance of the whole rectangle times the visible share of its sample points, each
// weighted by the irradiance its cell gives. Specular: likewise the unshadowed reflection of the whole
// (lib/rect_light.glsl) times the visible share, weighted by the reflection of each cell.
void addRect(inout DirectLight sum, const bool specular, Receiver r, Brdf b, Light light) {
    float whole = rectIrradiance(light, r.position, r.normal);
    uint count = light.sampleGrid * light.sampleGrid;
    float cellArea = rectArea(light) / float(count);
    RectLobe lobe;
    if (specular) lobe = rectLobe(r.normal, r.toEye, b.alpha, b.NoV);
    vec2 weights = vec2(0.0), visibleWeights = vec2(0.0);  // irradiance, reflection
    vec2 sheenSums = vec2(0.0);
    RectSums points = RectSums(vec2(0.0), 0.0, 0.0);
#if GLASS
    RectTint tint = rectTint(r.position, light);
#endif
    // A light that shines elsewhere has no points: an `if` would skip nothing on a software driver.
#if SHEEN
    uint k = 0u;
#else
    uint k = whole > 0.0 ? 0u : count;
#endif
    while (k < count) {
        vec3 point = rectSamplePoint(light, k);
        vec3 l = point - r.position;
        float d2 = dot(l, l);
        l *= inversesqrt(max(d2, 1e-20));
        float emitted = rectCosine(light, l) / max(d2, cellArea);
        float visible = 1.0;
#if LIGHTS_SHADOWS && !CONE_SHADOWS
        visible = shadowVisibilityRect(light, k, point, r.position, r.geometricNormal);
#endif
        vec2 weight = vec2(emitted * max(dot(l, r.normal), 0.0), 0.0);
        if (specular) weight.y = addLobePoint(points, r, b, lobe, l, vec2(emitted, cellArea));
        weights += weight;
#if SHEEN
        sheenSums += emitted * vec2(1.0, visible) * sheenOfPoint(r, l);
#endif
#if GLASS
        addTint(tint, r.position, light, k, weight * visible);
#endif
        visibleWeights += weight * visible;
        ++k;
    }
    // No sample above the horizon, but a corner of the rectangle: its light is small, and taken as visible.
    vec2 share = mix(vec2(1.0), visibleWeights / weights, greaterThan(weights, vec2(0.0)));
    DirectLight added = DirectLight(light.intensity * (whole * share.x), vec3(0.0));
    RectSums sums =
        RectSums(points.exact * cellArea, points.cosine * cellArea / kPi, points.most * cellArea / kPi);
    if (specular && whole > 0.0)
        added.specular = light.intensity * rectSpecular(light, r.position, lobe, b, sums) * share.y;
    vec3 tinted = vec3(1.0);
#if GLASS
    tinted = tintOf(tint.irradiance, tint.weights.x);
    added.irradiance *= tinted;
    added.specular *= tintOf(tint.specular, tint.weights.y);
#endif
#if SHEEN
    addRectSheen(r, light, sheenSums, tinted);
#endif
    sum = DirectLight(sum.irradiance + added.irradiance, sum.specular + added.specular);
}

// Runs `statement` for every light of one kind: `light`, with its `number` in the table, begin..end. The table
// begins with `before` lights of other kinds and has `count` of this one when LIGHTS_FIXED.
#if LIGHTS_FIXED
#if LIGHTS_TOTAL > 4
#error more lights than FOR_LIGHTS unrolls
#endif
#define FIXED_LIGHT(n, before, count, statement)                         \
    if ((n) < (count)) {                                                 \
        Light light = fixedLight(min((before) + (n), LIGHTS_TOTAL - 1)); \
        const uint number = uint((before) + (n));                        \
        statement;                                                       \
    }
#define FOR_LIGHTS(before, count, begin, end, statement) \
    FIXED_LIGHT(0, before, count, statement)             \
    FIXED_LIGHT(1, before, count, statement)             \
    FIXED_LIGHT(2, before, count, statement)             \
    FIXED_LIGHT(3, before, count, statement)
#else
#define FOR_LIGHTS(before, count, begin, end, statement) \
    if ((begin) < (end)) {                               \
        uint number = (begin);                           \
        do {                                             \
            Light light = lightOfTable(number);          \
            statement;                                   \
        } while (++number < (end));                      \
    }
#endif
#define FOR_POINT_LIGHTS(statement) FOR_LIGHTS(0, LIGHTS_POINT, 0u, lighting.lightEnds.x, statement)
#define FOR_SPOT_LIGHTS(statement) \
    FOR_LIGHTS(LIGHTS_POINT, LIGHTS_SPOT, lighting.lightEnds.x, lighting.lightEnds.y, statement)
#define FOR_DIRECTIONAL_LIGHTS(statement)                                                                  \
    FOR_LIGHTS(LIGHTS_POINT + LIGHTS_SPOT, LIGHTS_DIRECTIONAL, lighting.lightEnds.y, lighting.lightEnds.z, \
               statement)
#define FOR_RECT_LIGHTS(statement)                                                                 \
    FOR_LIGHTS(LIGHTS_POINT + LIGHTS_SPOT + LIGHTS_DIRECTIONAL, LIGHTS_RECT, lighting.lightEnds.z, \
               lighting.lightEnds.w, statement)

void addPunctualLights(inout DirectLight sum, const bool specular, Receiver r, Brdf b) {
#if LIGHTS_POINT
    FOR_POINT_LIGHTS(addPoint(sum, specular, r, b, light, number))
#endif
#if LIGHTS_SPOT
    FOR_SPOT_LIGHTS(addSpot(sum, specular, r, b, light, number))
#endif
#if LIGHTS_DIRECTIONAL
    FOR_DIRECTIONAL_LIGHTS(addDirectional(sum, specular, r, b, light, number))
#endif
}

void addRectLights(inout DirectLight sum, const bool specular, Receiver r, Brdf b) {
#if LIGHTS_RECT
    FOR_RECT_LIGHTS(addRect(sum, specular, r, b, rectBehindCone(r, light)))
#endif
}

DirectLight allLights(const bool specular, Receiver r, Brdf b) {
    DirectLight sum = DirectLight(vec3(0.0), vec3(0.0));
    addPunctualLights(sum, specular, r, b);
    addRectLights(sum, specular, r, b);
    return sum;
}

// Irradiance of all lights, shadows included, on a surface at `position`, a voxel's. `geometricNormal` is the
// normal of the surface that casts shadows there (moves the look-up off it); equal to `normal` for a flat
// surface. `lift`: lib/shadow.glsl; for a voxel kShadowVoxelLift and the height in metres of what stands
// before the position and hides nothing of it.
vec3 directIrradiance(vec3 position, vec3 normal, vec3 geometricNormal, vec2 lift) {
    Brdf none;
    return allLights(false, Receiver(position, normal, geometricNormal, normal, lift), none).irradiance;
}

// Irradiance, and radiance that the specular lobe sends to the eye.
DirectLight directLight(Receiver r, Brdf b) { return allLights(true, r, b); }
