#version 450 core
// SPDX-License-Identifier: MIT
// G-buffer -> irradiance / pi by a set of cones (rgb), and how much of the hemisphere is open (a).
//   OCCLUSION      short cones whose surfaces fade with distance, for component occlusion; rgb is of no use
//   COUNT_LOOKUPS  adds the texture fetches to the counters
#if !defined(OCCLUSION) || !defined(COUNT_LOOKUPS)
#error OCCLUSION and COUNT_LOOKUPS must be 0 or 1
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

void main() {
    ivec2 pixel = passPixel();
    Surface s;
    bool seen = fetchSurface(min(pixel, imageSize(result) - 1), s) && all(lessThan(pixel, imageSize(result)));
    vec3 origin = s.position + cones.offset * s.geometricNormal;
    uint samples;
#if OCCLUSION
    bool asks = seen;
    ConeReach reach = ConeReach(cones.occlusionDistance, 1.0 / max(cones.occlusionDistance, 1e-9));
#else
    // Metals and unlit surfaces have no diffuse part.
    bool asks = seen && !s.unlit && s.metallic < 1.0;
    ConeReach reach = ConeReach(cones.maxDistance, 0.0);
#endif
    vec4 gathered = gatherCones(origin, s.normal, asks ? cones.count : 0u, reach, samples);
#ifdef RECORD_STEPS
    Brdf b = makeBrdf(s.albedo, s.metallic, s.roughness, s.dielectricF0, dot(s.normal, s.toEye));
    RECORD_SURFACE(seen, s);
    RECORD_PART(OCCLUSION == 1 ? PART_OCCLUSION : PART_DIFFUSE, OCCLUSION == 1 ? gathered.aaa : gathered.rgb,
                OCCLUSION == 1 ? vec3(1.0) : b.diffuse);
#else
    imageStore(result, pixel, gathered);
#endif
#if COUNT_LOOKUPS
    atomicAdd(lookups[OCCLUSION == 1 ? LOOKUPS_OCCLUSION : LOOKUPS_DIFFUSE], samples * kFetchesPerSample);
#endif
}
