// SPDX-License-Identifier: MIT
// Share of a light that arrives at a voxel's surface, by the light's shadow map. SHADOWED 0: all of it. Else
// with the defines of light::lightDefines. Of rectangles, the middle one of their sample points is asked.
#include "shared/scene.h"
#ifndef SHADOWED
#error SHADOWED must be 0 or 1
#endif
#if SHADOWED
#include "lib/shadow.glsl"
#endif

float lightVisibility(Light light, vec3 position, vec3 n) {
    float visible = 1.0;
#if SHADOWED && LIGHTS_SHADOWS
#if LIGHTS_POINT
    if (light.type == LIGHT_POINT) visible = shadowVisibilityPoint(light, position, n, kShadowVoxelLift);
#endif
#if LIGHTS_SPOT
    if (light.type == LIGHT_SPOT) visible = shadowVisibilitySpot(light, position, n, kShadowVoxelLift);
#endif
#if LIGHTS_DIRECTIONAL
    if (light.type == LIGHT_DIRECTIONAL)
        visible = shadowVisibilityDirectional(light, position, n, kShadowVoxelLift);
#endif
#if LIGHTS_RECT
    if (light.type == LIGHT_RECT) {
        uint middle = light.sampleGrid * light.sampleGrid / 2u;
        visible = shadowVisibilityRect(light, middle, rectSamplePoint(light, middle), position, n);
    }
#endif
#endif
    return visible;
}
