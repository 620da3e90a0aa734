// SPDX-License-Identifier: MIT
// The occlusion cone from a pixel to a light -> share of the light that does not arrive. Before it:
// cone_samples.glsl, ThesisConstants `thesis`, OCCLUSION.

// What a sample's opacity is multiplied by, at distance t of a cone to a light at `distance`.
float occlusionGain(float t, float distance) {
#if OCCLUSION == CUSTOMISED
#if OCCLUSION_FUDGE
    float x = clamp(thesis.shadowStrength * sqrt(t) / distance, 0.0, 1.0);
#else
    float x = clamp(thesis.shadowStrength * sqrt(t / distance), 0.0, 1.0);
#endif
    return x * x * (3.0 - 2.0 * x);
#else
    return 1.0;
#endif
}

float withStep(float opacity, float added) {
#if NO_STEP_CORRECTION
    return opacity + (1.0 - opacity) * added;
#else
    return min(opacity + added, 1.0);
#endif
}

// Share of the light that does not arrive.
float traceOcclusion(Surface s, ThesisLight light, bool isTraced, inout uint samples) {
    ThesisCone cone = coneOf(thesis.occlusionCone);
    float offset = originOffset(0.0);
    vec3 origin = s.position + offset * s.normal;
    vec3 toLight = s.position + light.toLight * light.distance - origin;
    // Lights far outside act from just outside.
    float distance = min(length(toLight), 2.0 * grid.edge);
    vec3 direction = normalize(toLight);
    float climb = dot(direction, s.normal);
#if FIXED_OFFSETS
    float end = distance;
#else
    // The cone ends where its samples would touch what the light hangs on.
    float end = distance - kOriginOffset * grid.voxelSize;
#endif
    float t = cone.start;
    float opacity = 0.0;
    uint coneSamples = 0u;
    bool running = isTraced && t < end;
    bool started = running;
    do {
        float diameter = cone.spread * t;
        float size = sampleSize(diameter, min(offset + t * climb, distance - t), grid.voxelSize);
        float texelEdge = max(size, grid.voxelSize);
        float stride = stepLength(cone, diameter, texelEdge);
        float sampled = sampleVolume(origin + t * direction, size).a;
        ++coneSamples;
#if LAST_STEP
        float length = stride;
#else
        float length = min(stride, end - t);
#if NO_STEP_CORRECTION
        sampled *= length / stride;
#endif
#endif
        sampled *= occlusionGain(t, distance);
        float added = stepOpacity(sampled, length, texelEdge);
        float opacityBefore = opacity;
        opacity = withStep(opacity, added);
        if (running)
            RECORD_STEP(STEP_SAMPLE, origin + t * direction, t, texelEdge,
                        sampleLevel(size, grid.voxelSize, grid.maxLevel), vec3(0.0), opacity - opacityBefore,
                        opacity);
        t += stride;
        running = running && t < end && opacity < 0.999 && coneSamples < thesis.maxSamples;
    } while (running);
    samples += started ? coneSamples : 0u;
    RECORD_PATH(PATH_OCCLUSION_CONE, origin, direction, 0.5 * cone.spread,
                vec3(1.0 / float(max(thesis.lightCount, 1u))), vec3(started ? 1.0 - opacity : 1.0),
                started ? opacity : 0.0, min(t, end), opacity >= 0.999 ? END_FULL : END_OPEN);
    return started ? opacity : 0.0;
}
