// SPDX-License-Identifier: MIT
// The diffuse cones of a pixel: surface -> light from all of them, and how many samples they took. Before it:
// lib/environment.glsl, cone_samples.glsl, ThesisConstants `thesis`, DIFFUSE and the numbers of cones.
#include "lib/dot.glsl"

// All loops of one kind together stay below this: llvmpipe ends loops at 65,535 turns per invocation.
const uint kMaxTurns = 20000u;
// Opacity at which the customised diffuse cone calls a sample a hit.
const float kHitOpacity = 0.01;

// Adds a sample of the diffuse cone; `stride` and `texelEdge` in metres.
void addDiffuseSample(inout Gathered got, vec4 texel, float stride, float texelEdge) {
#if DIFFUSE == CUSTOMISED
#if PREMULTIPLIED_FIRST_HIT
    vec3 color = texel.rgb;
#else
    vec3 color = texel.rgb / max(texel.a, 1e-6);
#endif
#if HARD_FIRST_HIT
    float hit = texel.a > kHitOpacity ? 1.0 : 0.0;
#else
    float hit = min(stepOpacity(texel.a, stride, texelEdge), 1.0 - got.opacity);
#endif
    got.color += hit * color;
    got.opacity += hit;
#else
    accumulate(got, texel, stepOpacity(texel.a, stride, texelEdge));
#endif
}

// The cone after cone k.
int nextCone(int k, ConeFrame axes) {
    ++k;
#if NAN_AXES
    // The original's cones along an undefined axis read an empty corner of the volume: black.
    if (!axes.defined && k >= FRONT_CONES && ((k - FRONT_CONES) & 2) != 0) k += 2;
#endif
    return k;
}

#ifdef RECORD_STEPS
// What the sum over cones is multiplied by in the end.
float setShare(float lift) {
#if NO_COSINE_WEIGHTS
    return 5.0 / float(DIFFUSE_CONES);
#else
    return 1.0 / weightOfSets(FRONT_CONES, INTERMEDIATE_CONES, SIDE_CONES, lift);
#endif
}
#endif

// The mean over all cones from their weighted sum.
vec3 meanOfCones(vec3 sum, float lift) {
#if NO_COSINE_WEIGHTS
    // The original's factor, tuned to five cones.
    return sum * (5.0 / float(DIFFUSE_CONES));
#else
    return sum / weightOfSets(FRONT_CONES, INTERMEDIATE_CONES, SIDE_CONES, lift);
#endif
}

// Light from all diffuse cones, weighted to a mean: what a white surface shows. One loop over all cones.
vec3 traceDiffuse(Surface s, bool isLit, out uint samples) {
    ConeFrame axes = coneFrame(s.normal);
    ThesisCone cone = coneOf(thesis.diffuseCone);
    float offset = originOffset(thesis.originOffset);
    vec3 origin = s.position + offset * s.normal;
    // Sine of half the aperture.
    float lift = cone.spread * inversesqrt(4.0 + cone.spread * cone.spread);
    vec3 sum = vec3(0.0);
    samples = 0u;
    uint coneSamples = 0u;
    int k = 0;
    vec4 direction = coneOfSets(0, FRONT_CONES, INTERMEDIATE_CONES, s.normal, axes, lift);
    float t = cone.start;
    Gathered got = Gathered(vec3(0.0), 0.0);
    bool running = isLit;
    do {
        float diameter = cone.spread * t;
        float size = sampleSize(diameter, offset + t * dot(direction.xyz, s.normal), grid.voxelSize);
        float texelEdge = max(size, grid.voxelSize);
        float stride = stepLength(cone, diameter, texelEdge);
        vec4 texel = sampleVolume(origin + t * direction.xyz, size);
        ++samples;
        ++coneSamples;
        Gathered before = got;
        addDiffuseSample(got, texel, stride, texelEdge);
        if (running)
            RECORD_STEP(STEP_SAMPLE, origin + t * direction.xyz, t, texelEdge,
                        sampleLevel(size, grid.voxelSize, grid.maxLevel), got.color - before.color,
                        got.opacity - before.opacity, got.opacity);
        t += stride;
        bool left = coneEnded(t, origin + t * direction.xyz, texelEdge, cone.reach);
        if (left || got.opacity >= 0.999 || coneSamples >= thesis.maxSamples) {
#if !SHORT_REACH
            if (left)
                got.color +=
                    max(1.0 - got.opacity, 0.0) * skyRadiance(direction.xyz, 2.0 * atan(0.5 * cone.spread));
#endif
            sum += direction.w * got.color;
            if (running)
                RECORD_PATH(PATH_DIFFUSE_CONE, origin, direction.xyz, 0.5 * cone.spread,
                            vec3(direction.w * setShare(lift)), got.color, got.opacity, t,
                            got.opacity >= 0.999 ? END_FULL : END_OPEN);
            k = nextCone(k, axes);
            direction = coneOfSets(k, FRONT_CONES, INTERMEDIATE_CONES, s.normal, axes, lift);
            t = cone.start;
            got = Gathered(vec3(0.0), 0.0);
            coneSamples = 0u;
        }
        running = running && k < DIFFUSE_CONES && samples < kMaxTurns;
    } while (running);
    return meanOfCones(sum, lift);
}
