// SPDX-License-Identifier: MIT
// The thesis's view of a light: a point with a colour C and a falloff. Radiance of a diffuse surface of
// colour c is k_d c C (n.l) / falloff(D), without 1/pi (docs/theory/1_scene.md, "Two material models"): C = I
// / pi. Spot lights have their cone; directional ones are 1e4 m away and do not fall off. What needs one
// direction acts from a rectangle's centre, with the intensity that it has towards the surface.
// RECTANGLES 1: rectangles among the lights have a size.
#include "lib/dot.glsl"
#include "lib/light_profile.glsl"
#include "lib/rect_light.glsl"
#ifndef RECTANGLES
#define RECTANGLES 0
#endif

struct ThesisLight {
    vec3 toLight;    // unit
    float distance;  // m
    vec3 color;      // C, falloff not included
    float falloff;   // 1 at falloff 1, smaller farther away
};

ThesisLight thesisLight(Light light, vec3 position) {
    const float kPerPi = 0.31830989;
    ThesisLight result;
    vec3 toLight = light.type == LIGHT_DIRECTIONAL ? light.direction * -1e4 : light.position - position;
    float d2 = max(dot(toLight, toLight), 1e-12);
    result.distance = sqrt(d2);
    result.toLight = toLight / result.distance;
    result.color = light.intensity * kPerPi;
    result.falloff = 1.0 / (light.customFalloff != 0u
                                ? light.falloff.x + light.falloff.y * result.distance + light.falloff.z * d2
                                : max(d2, 1e-6));
    float fromAxis = dot(light.direction, -result.toLight);
    if (light.type == LIGHT_DIRECTIONAL) result.falloff = 1.0;
    // glTF's angular falloff (KHR_lights_punctual); point lights have angles that let everything pass.
    float angular = clamp((fromAxis - light.cosOuter) / max(light.cosInner - light.cosOuter, 1e-3), 0.0, 1.0);
    if (light.type == LIGHT_POINT || light.type == LIGHT_SPOT) result.color *= angular * angular;
#if LIGHTS_SHAPED
    if (light.type == LIGHT_POINT || light.type == LIGHT_SPOT)
        result.color *= profileFactor(light, result.toLight);
#endif
    // Radiance times projected area.
    if (light.type == LIGHT_RECT) result.color *= rectArea(light) * rectCosine(light, result.toLight);
    if (light.range > 0.0 && result.distance > light.range) result.color = vec3(0.0);
    return result;
}

// Of a rectangle: its area as it is seen from the surface.
float thesisRectArea(Light light, ThesisLight seen) {
    return rectArea(light) * rectCosine(light, seen.toLight);
}

// Cosine between the normal n and the light, not below 0. Of a rectangle the one with which its colour over the
// falloff gives what the whole of it does.
float thesisCosine(Light light, ThesisLight seen, vec3 position, vec3 n) {
    float cosine = max(dot(n, seen.toLight), 0.0);
#if RECTANGLES
    float fromCentre = thesisRectArea(light, seen) / (seen.distance * seen.distance);
    if (light.type == LIGHT_RECT) cosine = rectIrradiance(light, position, n) / max(fromCentre, 1e-12);
#endif
    return cosine;
}

// Diameter per distance of the cone in which a light is seen: a rectangle is as wide as the disc of its
// projected area, one without a place as `parallel` says, others as `lamp` does.
float thesisSpread(Light light, ThesisLight seen, float lamp, float parallel) {
#if RECTANGLES
    float wide = 2.0 * sqrt(thesisRectArea(light, seen) * 0.31830989) / seen.distance;
    if (light.type == LIGHT_RECT) return max(wide, 1e-3);
#endif
    return light.type == LIGHT_DIRECTIONAL ? parallel : lamp;
}
