#version 450 core
// SPDX-License-Identifier: MIT
// Coat and sheen over a picture of what lies below them, at the listed pixels (gather/layer_select.comp.glsl):
// docs/theory/3_light.md, "Coat and sheen".
//   SHOW_DIRECT    light that comes straight from lights
//   SHOW_SPECULAR  gathered light: radiance in the coat's lobe, irradiance for sheen
//   IRRADIANCE     0 from the cache, 1 from irradiancePicture, 2 from diffuseIrradiance, of cones
//   LOBE           1: radiance in the coat's lobe from lobePicture where the coat's roughness is within the limit; 2: from
//                  specularRadiance, of cones; elsewhere, and with 0, the irradiance stands in for it
//   SHEEN          0: no material has any
// VISIBILITY_PICTURE 1: which lights without extent are seen is told by visibilityPicture, not by shadow maps.
#if !defined(SHOW_DIRECT) || !defined(SHOW_SPECULAR) || !defined(IRRADIANCE) || !defined(LOBE) || \
    !defined(SHEEN)
#error SHOW_DIRECT, SHOW_SPECULAR and SHEEN must be 0 or 1, IRRADIANCE and LOBE 0, 1 or 2
#endif
#define SURFACE_EMISSION 0
layout(local_size_x = 8, local_size_y = 8) in;
#define LOBE_LIST_ACCESS readonly
// Before what includes it for some variants only.
#include "lib/layers.glsl"
// The others.
#include "lib/brdf.glsl"
#include "lib/dot.glsl"
#include "lib/gbuffer.glsl"
#include "lib/lighting.glsl"
#include "lib/lobe_list.glsl"
#include "lib/pixel_history.glsl"
#include "lib/scene_tables.glsl"
#if SHEEN
#include "lib/sheen.glsl"
#endif
#include "lib/surface_array.glsl"
#if SHOW_DIRECT
#include "lib/lights.glsl"
#endif
#if SHOW_SPECULAR && IRRADIANCE == 0
#include "lib/cache_lookup.glsl"
#endif
layout(std140) uniform PixelRayBlock { PixelRayConstants pixelRays; };
layout(rgba32f) uniform image2D result;
uniform usampler2D surfaceLayers;
uniform usampler2D irradiancePicture;
uniform usampler2D lobePicture;
uniform sampler2D diffuseIrradiance;  // / pi
uniform sampler2D specularRadiance;
#if SHOW_DIRECT && VISIBILITY_PICTURE
uniform usampler2D visibilityPicture;
#endif

#if SHOW_SPECULAR
// Over pi.
vec3 irradianceAt(ivec2 pixel, Surface s) {
#if IRRADIANCE == 2
    return texelFetch(diffuseIrradiance, pixel, 0).rgb;
#elif IRRADIANCE == 1
    return pixelHistoryValue(texelFetch(irradiancePicture, pixel, 0));
#else
    return cachedIrradiance(gridFromWorld(s.position), s.normal, true).rgb;
#endif
}

vec3 lobeAt(ivec2 pixel, Layers l, vec3 irradiance) {
#if LOBE == 2
    return texelFetch(specularRadiance, pixel, 0).rgb;
#elif LOBE == 1
    vec3 traced = pixelHistoryValue(texelFetch(lobePicture, pixel, 0));
    return l.coatRoughness <= pixelRays.specularLimit ? traced : irradiance;
#else
    return irradiance;
#endif
}
#endif

void main() {
    ivec2 size = imageSize(result);
    ivec2 pixel = listedPixel(size);
    bool listed = all(lessThan(pixel, size));
    pixel = min(pixel, size - 1);
    Surface s;
    fetchSurface(pixel, s);
    Layers l = unpackLayers(texelFetch(surfaceLayers, pixel, 0));
    Brdf coat = makeBrdf(vec3(0.0), 0.0, l.coatRoughness, vec3(kCoatF0), dot(l.coatNormal, s.toEye));
    float coatAlbedo = l.coat * coat.albedo.r;
    float below = 1.0 - coatAlbedo;
    vec3 added = vec3(0.0);
#if SHEEN
    vec2 sheen = sheenShare(max(dot(s.normal, s.toEye), 1e-4), l.sheenRoughness);
    vec3 sheenFactor = l.sheenColor * (below * sheen.x);
    vec3 sheenAlbedo = l.sheenColor * (below * sheen.y);
    below *= 1.0 - max(l.sheenColor.r, max(l.sheenColor.g, l.sheenColor.b)) * sheen.y;
#endif

#if SHOW_DIRECT
#if VISIBILITY_PICTURE
    visibleLights = texelFetch(visibilityPicture, pixel, 0).x;
#endif
#if SHEEN
    sheenLobe = SheenLobe(s.normal, l.sheenRoughness);
    sheenLight = vec3(0.0);
#endif
    DirectLight light =
        directLight(Receiver(litPosition(s), l.coatNormal, s.geometricNormal, s.toEye, vec2(0.0)), coat);
    added += l.coat * light.specular;
#if SHEEN
    added += sheenFactor * sheenLight;
#endif
#endif
#if SHOW_SPECULAR
    vec3 irradiance = irradianceAt(pixel, s);
    added += coatAlbedo * lobeAt(pixel, l, irradiance);
#if SHEEN
    added += sheenAlbedo * irradiance;
#endif
#endif
    vec4 picture = imageLoad(result, pixel);
    if (listed) imageStore(result, pixel, vec4(picture.rgb * below + added, picture.a));
}
