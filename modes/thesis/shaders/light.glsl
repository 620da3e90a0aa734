// SPDX-License-Identifier: MIT
// The thesis's view of a light: a point with a colour C and a falloff. Radiance of a diffuse surface of
// colour c is k_d c C (n.l) / falloff(D), without 1/pi (docs/theory/1_scene.md, "Two material models"): C = I
// / pi. Spot lights have their cone; rectangular ones act from their centre, with the intensity they have in
// the direction of the surface; directional ones are 1e4 m away and do not fall off.
#include "shared/scene.h"

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
    // Radiance times projected area; 4 |u x v| is the area.
    if (light.type == LIGHT_RECT)
        result.color *= 4.0 * length(cross(light.halfU, light.halfV)) * max(fromAxis, 0.0);
    if (light.range > 0.0 && result.distance > light.range) result.color = vec3(0.0);
    return result;
}
