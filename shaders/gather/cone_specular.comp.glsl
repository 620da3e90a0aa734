#version 450 core
// SPDX-License-Identifier: MIT
// G-buffer -> radiance that arrives in the GGX lobe, by one cone (rgb), and the cone's openness (a).
//
// Axis: the lobe's mean direction, which leans from the mirrored direction to the normal as roughness grows
// (Lagarde and de Rousiers 2014, "Moving Frostbite to Physically Based Rendering", section 4.9.3).
// Aperture: half of the lobe's energy. Microfacet normals of GGX lie within atan(alpha) of the normal with
// probability 1/2 (Walter et al. 2007, eq. 35 at xi = 1/2), reflected directions within twice that. The upper
// limit is the single cone of a diffuse surface (cos = 1/3, src/gather/cone_set.cpp), which alpha = 1 gives.
// COUNT_LOOKUPS: adds the texture fetches to the counters.
#ifndef COUNT_LOOKUPS
#error COUNT_LOOKUPS must be 0 or 1
#endif
#include "lib/brdf.glsl"
#include "lib/cone_trace.glsl"
#include "lib/dot.glsl"
#include "lib/gbuffer.glsl"
#include "lib/lighting.glsl"
#include "lib/picture_pass.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba16f) writeonly uniform image2D result;
#if COUNT_LOOKUPS
layout(std430) buffer LookupCounters { uint lookups[]; };
#endif

const float kWidestTan = 2.8284271;  // tan(acos(1/3))

void main() {
    ivec2 pixel = passPixel();
    Surface s;
    bool seen = fetchSurface(min(pixel, imageSize(result) - 1), s) &&
                all(lessThan(pixel, imageSize(result))) && !s.unlit;
    float alpha = s.roughness * s.roughness;
    // tan(2 atan(alpha)); beyond alpha = 0.707 it is wider than the limit.
    float tanHalf = alpha < 0.7071 ? 2.0 * alpha / (1.0 - alpha * alpha) : kWidestTan;
    tanHalf = clamp(tanHalf, cones.specularMinTan, kWidestTan);
    float lean = (1.0 - alpha) * (sqrt(1.0 - alpha) + alpha);
    vec3 direction = normalize(mix(s.normal, reflect(-s.toEye, s.normal), lean));
    // A bent normal can mirror into the surface: keep to the side of the triangle.
    float below = min(dot(direction, s.geometricNormal), 0.0);
    direction = normalize(direction - 1.01 * below * s.geometricNormal);

    March m = startMarch(s.position + cones.offset * s.geometricNormal, direction, tanHalf,
                         seen ? cones.maxDistance : 0.0, 0.0);
    uint samples = 0u;
    do {
        stepMarch(m, cones.step);
        ++samples;
    } while (!isFinished(m) && samples < kMaxSamples);
    float open = m.gathered.a >= kFullOpacity ? 0.0 : 1.0 - m.gathered.a;
#ifdef RECORD_STEPS
    Brdf b = makeBrdf(s.albedo, s.metallic, s.roughness, s.dielectricF0, dot(s.normal, s.toEye));
    RECORD_SURFACE(seen, s);
    if (seen) {
        RECORD_PATH(PATH_SPECULAR_CONE, m.origin, direction, tanHalf, vec3(1.0), marchedRadiance(m),
                    1.0 - open, m.t, open == 0.0 ? END_FULL : END_OPEN);
        RECORD_PART(PART_SPECULAR, marchedRadiance(m),
                    specularAlbedo(b, directionalAlbedo(b.NoV, sqrt(b.alpha))));
    }
#else
    imageStore(result, pixel, vec4(marchedRadiance(m), open));
#endif
#if COUNT_LOOKUPS
    if (seen) atomicAdd(lookups[LOOKUPS_SPECULAR], samples * kFetchesPerSample);
#endif
}
