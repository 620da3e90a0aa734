// SPDX-License-Identifier: MIT
// What was gathered at a host's pixels -> textures for its own shading (GatheredLight of
// conelight/light_field.h): irradiance / pi, and the mean radiance in the specular lobe.
//   IRRADIANCE  0: from the cache, 1: from irradiancePicture
//   LOBE        1: from lobePicture where roughness is within the limit; elsewhere, and with 0, the irradiance
//               stands in for it: the same in even light
#if !defined(IRRADIANCE) || !defined(LOBE)
#error IRRADIANCE and LOBE must be 0 or 1
#endif
#define SURFACE_EMISSION 0
#include "lib/gbuffer.glsl"
#include "lib/pixel_history.glsl"
#include "shared/pixel_rays.h"
#if !IRRADIANCE
#include "lib/cache_lookup.glsl"
#endif
layout(std140) uniform PixelRayBlock { PixelRayConstants pixelRays; };
uniform usampler2D irradiancePicture;
uniform usampler2D lobePicture;

// Irradiance / pi and the lobe's radiance at a pixel; 1 where there is a surface.
void lightOutputs(ivec2 pixel, out vec4 diffuse, out vec4 specular) {
    Surface s;
    bool seen = fetchSurface(pixel, s);
#if IRRADIANCE
    vec3 irradiance = pixelHistoryValue(texelFetch(irradiancePicture, pixel, 0));
#else
    vec3 irradiance = cachedIrradiance(gridFromWorld(s.position), s.normal, seen).rgb;
#endif
    vec3 lobe = irradiance;
#if LOBE
    vec3 traced = pixelHistoryValue(texelFetch(lobePicture, pixel, 0));
    lobe = s.roughness <= pixelRays.specularLimit ? traced : irradiance;
#endif
    // Below the largest half.
    diffuse = seen ? vec4(min(irradiance, 65000.0), 1.0) : vec4(0.0);
    specular = seen ? vec4(min(lobe, 65000.0), 1.0) : vec4(0.0);
}
