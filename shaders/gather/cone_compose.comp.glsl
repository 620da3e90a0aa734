#version 450 core
// SPDX-License-Identifier: MIT
// The picture of the cones mode from its parts: G-buffer, direct light, gathered light -> radiance (rgb), and
// 1 where a surface is seen, 0 in the background (a).
//   SHOW_DIRECT    emission and direct light (direct_light.comp.glsl); the sky behind
//   SHOW_DIFFUSE   gathered irradiance, reflected by the diffuse part
//   SHOW_SPECULAR  gathered radiance, reflected by the lobe: times its directional albedo
// CAUSTICS 1: with what glass gathers, as a part of the irradiance.
#if !defined(SHOW_DIRECT) || !defined(SHOW_DIFFUSE) || !defined(SHOW_SPECULAR)
#error SHOW_DIRECT, SHOW_DIFFUSE and SHOW_SPECULAR must be 0 or 1
#endif
#include "lib/brdf.glsl"
#include "lib/caustic_map.glsl"
#include "lib/dot.glsl"
#include "lib/gbuffer.glsl"
#include "lib/picture_pass.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba32f) writeonly uniform image2D result;
#if SHOW_DIRECT
uniform sampler2D directDiffuse;  // with emission and sky
uniform sampler2D directSpecular;
#endif
#if SHOW_DIFFUSE
uniform sampler2D diffuseIrradiance;  // / pi
#endif
#if SHOW_SPECULAR
uniform sampler2D specularRadiance;
#endif

void main() {
    ivec2 pixel = passPixel();
    if (any(greaterThanEqual(pixel, imageSize(result)))) return;
    Surface s;
    bool seen = fetchSurface(pixel, s);
    float NoV = dot(s.normal, s.toEye);
    Brdf b = makeBrdf(s.albedo, s.metallic, s.roughness, s.dielectricF0, NoV);
    vec3 direct = vec3(0.0);
#if SHOW_DIRECT
    direct = texelFetch(directDiffuse, pixel, 0).rgb + texelFetch(directSpecular, pixel, 0).rgb;
#endif
    vec3 gathered = vec3(0.0);
#if SHOW_DIFFUSE
    gathered += b.diffuse * texelFetch(diffuseIrradiance, pixel, 0).rgb;
#if CAUSTICS
    gathered += b.diffuse / kPi * causticIrradiance(s.position, s.geometricNormal, 0.0);
#endif
#endif
#if SHOW_SPECULAR
    vec2 dfg = directionalAlbedo(b.NoV, sqrt(b.alpha));
    gathered += specularAlbedo(b, dfg) * texelFetch(specularRadiance, pixel, 0).rgb;
#endif
    bool gathers = seen && !s.unlit;
    imageStore(result, pixel, vec4(direct + (gathers ? gathered : vec3(0.0)), seen ? 1.0 : 0.0));
}
