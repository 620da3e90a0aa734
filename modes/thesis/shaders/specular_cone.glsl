// SPDX-License-Identifier: MIT
// The specular cone of a pixel: surface and mirrored direction -> light from there. Before it:
// lib/environment.glsl, cone_samples.glsl, ThesisConstants `thesis`.
#include "lib/dot.glsl"

// Light from the mirrored direction.
vec3 traceSpecular(Surface s, vec3 mirrored, float shininess, bool isTraced, inout uint samples) {
    ThesisCone cone = coneOf(thesis.specularCone);
    if (cone.spread == 0.0) cone.spread = spreadOfShininess(shininess);
    float offset = originOffset(0.0);
    vec3 origin = s.position + offset * s.normal;
    float climb = dot(mirrored, s.normal);
    float t = cone.start;
    uint coneSamples = 0u;
    Gathered got = Gathered(vec3(0.0), 0.0);
    bool running = isTraced && t < cone.reach;
    do {
        float diameter = cone.spread * t;
        float size = sampleSize(diameter, offset + t * climb, grid.voxelSize);
        float texelEdge = max(size, grid.voxelSize);
        float stride = stepLength(cone, diameter, texelEdge);
        vec4 texel = sampleVolume(origin + t * mirrored, size);
        ++coneSamples;
        Gathered before = got;
        accumulate(got, texel, stepOpacity(texel.a, stride, texelEdge));
        if (running)
            RECORD_STEP(STEP_SAMPLE, origin + t * mirrored, t, texelEdge,
                        sampleLevel(size, grid.voxelSize, grid.maxLevel), got.color - before.color,
                        got.opacity - before.opacity, got.opacity);
        t += stride;
        bool left = coneEnded(t, origin + t * mirrored, texelEdge, cone.reach);
#if !SHORT_REACH
        if (left && running)
            got.color += max(1.0 - got.opacity, 0.0) * skyRadiance(mirrored, 2.0 * atan(0.5 * cone.spread));
#endif
        running = running && !left && got.opacity < 0.999 && coneSamples < thesis.maxSamples;
    } while (running);
    samples += isTraced ? coneSamples : 0u;
    if (isTraced)
        RECORD_PATH(PATH_SPECULAR_CONE, origin, mirrored, 0.5 * cone.spread, vec3(1.0), got.color,
                    got.opacity, t, got.opacity >= 0.999 ? END_FULL : END_OPEN);
    return isTraced ? got.color : vec3(0.0);
}
