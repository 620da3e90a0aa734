#version 450 core
// SPDX-License-Identifier: MIT
// G-buffer + lights -> radiance by Phong's model: per light
//   (ka + kd max(0, n.l) + ks max(0, v.r)^shininess) * C * c / attenuation,   r = reflect(-l, n),
// C = intensity / pi (docs/theory/1_scene.md, two material models), attenuation of the light's own kind and
// on every term, the ambient one included. Unlit surfaces show their colour. PHONG_SHADOWS: shadow maps on
// the diffuse and specular terms (the model has none).
#ifndef PHONG_SHADOWS
#error PHONG_SHADOWS must be 0 or 1
#endif
#define LIGHTS_SHADOWS PHONG_SHADOWS
#include "lib/dot.glsl"
#include "lib/gbuffer.glsl"
// For glass, before the others.
#include "lib/scene_tables.glsl"
#include "lib/surface_array.glsl"
// The others.
#include "lib/lights.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba32f) writeonly uniform image2D outputImage;

struct Phong {
    vec3 color;
    float ambient, diffuse, specular, shininess;
};

// The scene's own Phong material; else the G-buffer's base colour (textures, vertex colours) with strengths
// derived at upload.
Phong phongOf(Surface s) {
    Phong m;
    m.color = (materials[s.material].flags & MATERIAL_HAS_PHONG) != 0u ? materials[s.material].phongColor
                                                                       : s.albedo;
    m.ambient = materials[s.material].phongAmbient;
    m.diffuse = materials[s.material].phongDiffuse;
    m.specular = materials[s.material].phongSpecular;
    m.shininess = max(materials[s.material].phongShininess, 1e-3);  // pow(0, 0) is undefined
    return m;
}

// One light from direction l; `light` is its colour over the attenuation.
vec3 phongTerm(Phong m, Surface s, vec3 l, vec3 light, float visible) {
    float diffuse = m.diffuse * max(dot(s.normal, l), 0.0);
    float specular = m.specular * pow(max(dot(s.toEye, reflect(-l, s.normal)), 0.0), m.shininess);
    return (m.ambient + (diffuse + specular) * visible) * light;
}

vec3 phongPoint(Phong m, Surface s, Light light, const bool single) {
    vec3 l = light.position - s.position;
    float d2 = dot(l, l);
    l *= inversesqrt(max(d2, 1e-20));
    float visible = 1.0;
#if LIGHTS_SHADOWS
    visible = single ? shadowVisibilitySpot(light, litPosition(s), s.geometricNormal, vec2(0.0))
                     : shadowVisibilityPoint(light, litPosition(s), s.geometricNormal, vec2(0.0));
#endif
    return phongTerm(m, s, l, light.intensity * (distanceFalloff(light, d2) * spotFalloff(light, l)),
                     visible);
}

vec3 phongDirectional(Phong m, Surface s, Light light, uint number) {
    float visible = 1.0;
#if LIGHTS_SHADOWS
    visible = directionalMapVisibility(light, number, litPosition(s), s.geometricNormal, vec2(0.0));
#endif
    return phongTerm(m, s, -light.direction, light.intensity, visible);
}

// The model knows no areas: each sample point of a rectangle is a light of its share.
vec3 phongRect(Phong m, Surface s, Light light) {
    uint count = light.sampleGrid * light.sampleGrid;
    float cellArea = rectArea(light) / float(count);
    vec3 sum = vec3(0.0);
    uint k = 0u;
    do {
        vec3 point = rectSamplePoint(light, k);
        vec3 l = point - s.position;
        float d2 = dot(l, l);
        l *= inversesqrt(max(d2, 1e-20));
        float visible = 1.0;
#if LIGHTS_SHADOWS
        visible = shadowVisibilityRect(light, k, point, litPosition(s), s.geometricNormal);
#endif
        float share = cellArea * rectCosine(light, l) / max(d2, cellArea);
        sum += phongTerm(m, s, l, light.intensity * share, visible);
    } while (++k < count);
    return sum;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    Surface s;
    bool seen = fetchSurface(pixel, s);
    Phong m = phongOf(s);
    vec3 sum = vec3(0.0);
#if LIGHTS_POINT
    FOR_POINT_LIGHTS(sum += phongPoint(m, s, light, false))
#endif
#if LIGHTS_SPOT
    FOR_SPOT_LIGHTS(sum += phongPoint(m, s, light, true))
#endif
#if LIGHTS_DIRECTIONAL
    FOR_DIRECTIONAL_LIGHTS(sum += phongDirectional(m, s, light, number))
#endif
#if LIGHTS_RECT
    FOR_RECT_LIGHTS(sum += phongRect(m, s, light))
#endif
    vec3 radiance = s.unlit ? s.emission : sum * m.color / kPi + s.emission;
    if (pixel.x >= int(frame.width) || pixel.y >= int(frame.height)) return;
    imageStore(outputImage, pixel, seen ? vec4(radiance, 1.0) : vec4(lighting.sky, 0.0));
}
