// SPDX-License-Identifier: MIT
// Share of a light that arrives at a voxel's surface, by the light's shadow map. SHADOWED 0: all of it. Else
// with the defines of light::lightDefines. Of rectangles, the middle one of their sample points is asked;
// RECTANGLES: all, each by the light that its part of the rectangle gives.
#include "lib/dot.glsl"
#include "shared/scene.h"
#ifndef SHADOWED
#error SHADOWED must be 0 or 1
#endif
#if SHADOWED
#include "lib/shadow.glsl"
#endif

#if SHADOWED && LIGHTS_SHADOWS && LIGHTS_RECT && RECTANGLES
float rectVisibility(Light light, vec3 position, vec3 n) {
    uint count = light.sampleGrid * light.sampleGrid;
    float cellArea = rectArea(light) / float(count);
    float sum = 0.0, all = 0.0;
    uint k = 0u;
    do {
        vec3 point = rectSamplePoint(light, k);
        vec3 toPoint = point - position;
        float d2 = dot(toPoint, toPoint);
        vec3 l = toPoint * inversesqrt(max(d2, 1e-20));
        float weight = max(dot(l, n), 0.0) * rectCosine(light, l) / max(d2, cellArea);
        all += weight;
        sum += weight * shadowVisibilityRect(light, k, point, position, n);
    } while (++k < count);
    return all > 0.0 ? sum / all : 1.0;
}
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
#if RECTANGLES
    if (light.type == LIGHT_RECT) visible = rectVisibility(light, position, n);
#else
    if (light.type == LIGHT_RECT) {
        uint middle = light.sampleGrid * light.sampleGrid / 2u;
        visible = shadowVisibilityRect(light, middle, rectSamplePoint(light, middle), position, n);
    }
#endif
#endif
#endif
    return visible;
}
