// SPDX-License-Identifier: MIT
// The picture of mode `traced`, of one pixel: G-buffer, lights, cache or gathered pictures -> radiance (rgb),
// and 1 where a surface is seen, 0 in the background (a). One pass, so that no direct light travels through
// memory.
//   SHOW_DIRECT    emission and light that comes straight from lights; the sky behind
//   SHOW_DIFFUSE   indirect irradiance, reflected by the diffuse part
//   SHOW_SPECULAR  indirect radiance, reflected by the glossy part
//   IRRADIANCE     0 from the cache, 1 from irradiancePicture
//   LOBE           1: radiance of lobes from lobePicture where roughness is within the limit; elsewhere, and
//                  with 0, the irradiance stands in for it: the same in even light
#if !defined(SHOW_DIRECT) || !defined(SHOW_DIFFUSE) || !defined(SHOW_SPECULAR) || !defined(IRRADIANCE) || \
    !defined(LOBE)
#error SHOW_DIRECT, SHOW_DIFFUSE, SHOW_SPECULAR, IRRADIANCE and LOBE must be 0 or 1
#endif
// VISIBILITY_PICTURE 1: which lights without extent are seen is told by visibilityPicture, not by shadow maps.
// LAMP_PICTURE 1: direct light of lamps that are drawn by chance is told by lampPicture (gather/ray_lamps.comp.glsl).
// CAUSTICS 1: with what glass gathers, as a part of the irradiance.
// COUNT_LOOKUPS 1: adds lookups to the counters: of the cache, and of shadow maps as those of occlusion.
#ifndef LAMP_PICTURE
#define LAMP_PICTURE 0
#endif
#define GATHERS (SHOW_DIFFUSE || SHOW_SPECULAR)
#define RECORD_CACHE
#include "lib/brdf.glsl"
#include "lib/caustic_map.glsl"
#include "lib/dot.glsl"
#include "lib/gbuffer.glsl"
#include "lib/lighting.glsl"
#include "lib/lookup_count.glsl"
// For glass, before the others.
#include "lib/scene_tables.glsl"
#include "lib/surface_array.glsl"
// The others.
#if SHOW_DIRECT
#include "lib/lights.glsl"
#endif
#include "lib/pixel_history.glsl"
#include "lib/record_steps.glsl"
#include "shared/pixel_rays.h"
#if GATHERS && !IRRADIANCE
#include "lib/cache_lookup.glsl"
#endif
#if !FLAT_CONSTANTS
layout(std140) uniform PixelRayBlock { PixelRayConstants pixelRays; };
#endif
uniform usampler2D irradiancePicture;
uniform usampler2D lobePicture;
#if SHOW_DIRECT && VISIBILITY_PICTURE
uniform usampler2D visibilityPicture;
#endif
#if SHOW_DIRECT && LAMP_PICTURE
uniform usampler2D lampPicture;
#endif

// `pixel` is within the picture.
vec4 tracedShade(ivec2 pixel) {
    Surface s;
    bool seen = fetchSurface(pixel, s);
    Brdf b = makeBrdf(s.albedo, s.metallic, s.roughness, s.dielectricF0, dot(s.normal, s.toEye));
    vec3 radiance = vec3(0.0);
#if SHOW_DIRECT
#if VISIBILITY_PICTURE
    visibleLights = texelFetch(visibilityPicture, pixel, 0).x;
#endif
    DirectLight light =
        directLight(Receiver(litPosition(s), s.normal, s.geometricNormal, s.toEye, vec2(0.0)), b);
#if COUNT_LOOKUPS
    addLookups(LOOKUPS_OCCLUSION, seen);
#endif
    radiance = b.diffuse / kPi * (s.normalMean * light.irradiance) + s.emission +
               (s.unlit ? vec3(0.0) : light.specular);
#if LAMP_PICTURE
    vec3 lamps = pixelHistoryValue(texelFetch(lampPicture, pixel, 0));
    radiance += seen && !s.unlit ? (s.normalMean * b.diffuse + b.albedo) * lamps : vec3(0.0);
#endif
#endif
#if GATHERS
    bool gathers = seen && !s.unlit;
#if IRRADIANCE
    vec3 irradiance = pixelHistoryValue(texelFetch(irradiancePicture, pixel, 0));
#else
    vec3 irradiance = cachedIrradiance(gridFromWorld(s.position), s.normal, gathers).rgb;
#if COUNT_LOOKUPS
    addLookups(LOOKUPS_DIFFUSE, gathers);
#endif
#endif
    vec3 gathered = vec3(0.0);
#if SHOW_DIFFUSE
    gathered += b.diffuse * irradiance;
#if CAUSTICS
    gathered += b.diffuse / kPi * causticIrradiance(s.position, s.geometricNormal, 0.0);
#endif
#endif
#if SHOW_SPECULAR
    vec3 lobe = irradiance;
#if LOBE
    vec3 traced = pixelHistoryValue(texelFetch(lobePicture, pixel, 0));
    lobe = s.roughness <= pixelRays.specularLimit ? traced : lobe;
#endif
    gathered += b.albedo * lobe;
#endif
    radiance += gathers ? gathered : vec3(0.0);
#ifdef RECORD_STEPS
    RECORD_SURFACE(seen, s);
    RECORD_PART(PART_DIFFUSE, gathers ? irradiance : vec3(0.0), b.diffuse);
    RECORD_PART(PART_SPECULAR, gathers ? irradiance : vec3(0.0), b.albedo);
#endif
#endif
    vec3 behind = SHOW_DIRECT == 1 ? lighting.sky : vec3(0.0);
    return seen ? vec4(radiance, 1.0) : vec4(behind, 0.0);
}
