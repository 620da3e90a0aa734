#version 450 core
// SPDX-License-Identifier: MIT
// G-buffer and lit volume -> the thesis's picture (its chapter 5, "Cone Tracing"): Phong light weakened by an
// occlusion cone per light, a specular cone, and a set of diffuse cones. Variants by #define: which cones,
// regular or customised, which defects of the original, which part is shown. One pixel per invocation.
//
// Loops end at the bottom and their conditions hold "is there a surface": branches skip nothing on llvmpipe.
#include "lib/gbuffer.glsl"
#include "lib/light_table.glsl"
#include "lib/record_steps.glsl"
#include "thesis/shaders/constants.h"
#include "thesis/shaders/defects.glsl"
#include "thesis/shaders/light.glsl"
#include "thesis/shaders/march.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

#if !defined(FRONT_CONES) || !defined(INTERMEDIATE_CONES) || !defined(SIDE_CONES)
#error FRONT_CONES, INTERMEDIATE_CONES and SIDE_CONES must be the sizes of the enabled sets
#endif
#if !defined(DIFFUSE) || !defined(SPECULAR) || !defined(OCCLUSION)
#error DIFFUSE, SPECULAR and OCCLUSION must be 0 (no cones), 1 (regular) or 2 (customised)
#endif
#if !defined(VIEW) || !defined(COUNT_LOOKUPS)
#error VIEW must be a VIEW_ number below, COUNT_LOOKUPS 0 or 1
#endif
#define VIEW_FULL 0
#define VIEW_DIRECT 1
#define VIEW_INDIRECT 2
#define VIEW_DIFFUSE 3
#define VIEW_SPECULAR 4
#define VIEW_OCCLUSION 5

#define DIFFUSE_CONES (FRONT_CONES + INTERMEDIATE_CONES + SIDE_CONES)
#define REGULAR 1
#define CUSTOMISED 2

layout(std140) uniform ThesisGridBlock { ThesisGrid grid; };
layout(std140) uniform ThesisBlock { ThesisConstants thesis; };
uniform sampler3D volume;
layout(rgba32f) uniform writeonly image2D picture;
#if COUNT_LOOKUPS
layout(std430) buffer LookupTable { uint lookups[]; };
#endif

// All loops of one kind together stay below this: llvmpipe ends loops at 65,535 turns per invocation.
const uint kMaxTurns = 20000u;
// Opacity at which the customised diffuse cone calls a sample a hit.
const float kHitOpacity = 0.01;
// The smooth hit: counts as full at half a surface. Chosen by eye: at 1 far walls darken (regular
// cone), at 0.05 the rims of near objects show.
const float kHitGain = 2.0;

vec4 sampleVolume(vec3 position, float size) {
    return textureLod(volume, (position - grid.origin) / grid.edge,
                      sampleLevel(size, grid.voxelSize, grid.maxLevel));
}

bool outsideGrid(vec3 position) {
    return any(greaterThan(abs((position - grid.origin) / grid.edge - 0.5), vec3(0.5)));
}

// One march (constants.h).
struct ThesisCone {
    float spread;
    float stepFactor;
    float start;
    float reach;
};
ThesisCone coneOf(vec4 v) { return ThesisCone(v.x, v.y, v.z, v.w); }

// What a cone has gathered.
struct Gathered {
    vec3 color;
    float opacity;
};

// Opacity that a step of length `length` through a sample of size `size` adds: its part of a surface that the
// sample holds. Pieces of one surface add up, they do not hide each other.
float stepOpacity(float opacity, float length, float size) {
#if NO_STEP_CORRECTION
    return opacity;
#else
    return min(opacity * (length / size), 1.0);
#endif
}

// Front to back. `texel` is premultiplied (mips average empty space in).
void accumulate(inout Gathered sum, vec4 texel, float added) {
#if NO_STEP_CORRECTION
    float seen = (1.0 - sum.opacity) * added;
#else
    float seen = min(added, 1.0 - sum.opacity);
#endif
#if DOUBLE_ALPHA
    vec3 color = seen * texel.rgb;
#else
    vec3 color = seen * texel.rgb / max(texel.a, 1e-6);
#endif
#if FORGET_NEAR_COLOR
    sum.color = sum.opacity * sum.color + color;
#else
    sum.color += color;
#endif
    sum.opacity += seen;
}

float stepLength(ThesisCone cone, float diameter, float size) {
#if FINE_STEPS
    return cone.stepFactor * diameter;
#else
    return cone.stepFactor * size;
#endif
}

// Where cones begin: the original at fixed distances in world units; here just clear of the own surface.
float originOffset(float fixedOffset) {
#if FIXED_OFFSETS
    return fixedOffset;
#else
    return kOriginOffset * grid.voxelSize;
#endif
}

bool coneEnded(float t, vec3 position, float reach) {
#if SHORT_REACH
    return t >= reach;
#else
    return outsideGrid(position);
#endif
}

#if DIFFUSE && DIFFUSE_CONES > 0
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
#if DIFFUSE == CUSTOMISED
#if PREMULTIPLIED_FIRST_HIT
        vec3 color = texel.rgb;
#else
        vec3 color = texel.rgb / max(texel.a, 1e-6);
#endif
#if HARD_FIRST_HIT
        float hit = texel.a > kHitOpacity ? 1.0 : 0.0;
#else
        float hit = min(stepOpacity(texel.a, stride, texelEdge) * kHitGain, 1.0 - got.opacity);
#endif
        got.color += hit * color;
        got.opacity += hit;
#else
        accumulate(got, texel, stepOpacity(texel.a, stride, texelEdge));
#endif
        if (running)
            RECORD_STEP(STEP_SAMPLE, origin + t * direction.xyz, t, texelEdge,
                        sampleLevel(size, grid.voxelSize, grid.maxLevel), got.color - before.color,
                        got.opacity - before.opacity, got.opacity);
        t += stride;
        bool left = coneEnded(t, origin + t * direction.xyz, cone.reach);
        if (left || got.opacity >= 0.999 || coneSamples >= thesis.maxSamples) {
#if !SHORT_REACH
            if (left) got.color += max(1.0 - got.opacity, 0.0) * lighting.sky;
#endif
            sum += direction.w * got.color;
            if (running)
                RECORD_PATH(PATH_DIFFUSE_CONE, origin, direction.xyz, 0.5 * cone.spread,
                            vec3(direction.w * setShare(lift)), got.color, got.opacity, t,
                            got.opacity >= 0.999 ? END_FULL : END_OPEN);
            ++k;
#if NAN_AXES
            // The original's cones along an undefined axis read an empty corner of the volume: black.
            if (!axes.defined && k >= FRONT_CONES && ((k - FRONT_CONES) & 2) != 0) k += 2;
#endif
            direction = coneOfSets(k, FRONT_CONES, INTERMEDIATE_CONES, s.normal, axes, lift);
            t = cone.start;
            got = Gathered(vec3(0.0), 0.0);
            coneSamples = 0u;
        }
        running = running && k < DIFFUSE_CONES && samples < kMaxTurns;
    } while (running);
#if NO_COSINE_WEIGHTS
    // The original's factor, tuned to five cones.
    return sum * (5.0 / float(DIFFUSE_CONES));
#else
    return sum / weightOfSets(FRONT_CONES, INTERMEDIATE_CONES, SIDE_CONES, lift);
#endif
}
#endif

#if SPECULAR
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
        bool left = coneEnded(t, origin + t * mirrored, cone.reach);
#if !SHORT_REACH
        if (left && running) got.color += max(1.0 - got.opacity, 0.0) * lighting.sky;
#endif
        running = running && !left && got.opacity < 0.999 && coneSamples < thesis.maxSamples;
    } while (running);
    samples += isTraced ? coneSamples : 0u;
    if (isTraced)
        RECORD_PATH(PATH_SPECULAR_CONE, origin, mirrored, 0.5 * cone.spread, vec3(1.0), got.color,
                    got.opacity, t, got.opacity >= 0.999 ? END_FULL : END_OPEN);
    return isTraced ? got.color : vec3(0.0);
}
#endif

#if OCCLUSION
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
#if OCCLUSION == CUSTOMISED
#if OCCLUSION_FUDGE
        float x = clamp(thesis.shadowStrength * sqrt(t) / distance, 0.0, 1.0);
#else
        float x = clamp(thesis.shadowStrength * sqrt(t / distance), 0.0, 1.0);
#endif
        sampled *= x * x * (3.0 - 2.0 * x);
#endif
        float added = stepOpacity(sampled, length, texelEdge);
        float opacityBefore = opacity;
#if NO_STEP_CORRECTION
        opacity += (1.0 - opacity) * added;
#else
        opacity = min(opacity + added, 1.0);
#endif
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
#endif

bool has(uint switchBit) { return (thesis.switches & switchBit) != 0u; }

// Phong model at the surface (thesis, Phong listing), without occlusion.
vec3 phong(Surface s, vec3 color, uint material, ThesisLight light) {
    float ambient = has(THESIS_PHONG_AMBIENT) ? materials[material].phongAmbient : 0.0;
    float diffuse = has(THESIS_PHONG_DIFFUSE) ? materials[material].phongDiffuse : 0.0;
    float gloss = has(THESIS_PHONG_SPECULAR) ? materials[material].phongSpecular : 0.0;
    float lobe =
        pow(max(dot(s.toEye, reflect(-light.toLight, s.normal)), 1e-6), materials[material].phongShininess);
    float NoL = dot(s.normal, light.toLight);
    return light.color * light.falloff * color *
           (ambient + diffuse * max(NoL, 0.0) + (NoL > 0.0 ? gloss * lobe : 0.0));
}

// Share of light that is reflected as by a mirror. The Phong model's strength is the height of its lobe, not
// a share; scenes give broad lobes strengths of 1 and more. The rule is that of setPbrFromPhong
// (src/scene/scene.cpp), so that all modes see the same material.
float reflectance(float phongSpecular, float shininess) {
#if UNBOUNDED_SPECULAR
    return phongSpecular;
#else
    return min(phongSpecular, 1.0) * shininess / (shininess + 62.0);
#endif
}

void main() {
    ivec2 pixel = INVOCATION_PIXEL;
    bool inside = all(lessThan(pixel, ivec2(frame.width, frame.height)));
    Surface s;
    bool seen = fetchSurface(min(pixel, ivec2(frame.width, frame.height) - 1), s) && inside;
    bool isLit = seen && !s.unlit;
    uint material = s.material;
    vec3 color =
        (materials[material].flags & MATERIAL_HAS_PHONG) != 0u ? materials[material].phongColor : s.albedo;
    float shininess = materials[material].phongShininess;
    float strength = reflectance(materials[material].phongSpecular, shininess);
    vec3 mirrored = reflect(-s.toEye, s.normal);
    uint diffuseSamples = 0u, specularSamples = 0u, occlusionSamples = 0u;

    // Direct light, light by light.
    vec3 direct = vec3(0.0), specular = vec3(0.0);
    float leastOcclusion = 1.0, visibleSum = 0.0, mirrorWeight = 0.0;
    for (uint i = 0u; i < thesis.lightCount; ++i) {
        ThesisLight light = thesisLight(lights[i], s.position);
        float occlusion = 0.0;
#if OCCLUSION
#if OCCLUDED_INDIRECT || OCCLUDED_SPECULAR || VIEW == VIEW_OCCLUSION
        bool isTraced = isLit;
#else
        // Light from behind adds nothing that could be hidden, unless ambient light is on.
        bool isTraced = isLit && (dot(s.normal, light.toLight) > 0.0 || has(THESIS_PHONG_AMBIENT));
#endif
        occlusion = traceOcclusion(s, light, isTraced, occlusionSamples);
#endif
        leastOcclusion = min(leastOcclusion, occlusion);
        visibleSum += 1.0 - occlusion;
        float visible = has(THESIS_SHADOWS) ? 1.0 - occlusion : 1.0;
        if (has(THESIS_PHONG)) direct += visible * phong(s, color, material, light);
#if SPECULAR
        float weight = 1.0;
#if SPECULAR == CUSTOMISED
        weight = angularWeight(dot(mirrored, light.toLight), shininess, thesis.shininessFalloff);
#endif
#if OCCLUDED_SPECULAR
        weight *= visible;
#endif
#if SPECULAR_PER_LIGHT
        bool reflects = isLit && strength * weight > thesis.minSpecular;
        specular += strength * weight * traceSpecular(s, mirrored, shininess, reflects, specularSamples);
        if (reflects) RECORD_WEIGHT(strength * weight);
#else
        mirrorWeight = max(mirrorWeight, weight);
#endif
#endif
    }
#if SPECULAR && !SPECULAR_PER_LIGHT
    // The light nearest to the mirrored direction sets the weight; without lights there is none to be near.
    mirrorWeight = strength * (thesis.lightCount == 0u ? 1.0 : mirrorWeight);
    bool reflects = isLit && mirrorWeight > thesis.minSpecular;
    specular = mirrorWeight * traceSpecular(s, mirrored, shininess, reflects, specularSamples);
    if (reflects) RECORD_WEIGHT(mirrorWeight);
#endif

    vec3 diffuse = vec3(0.0);
    vec3 diffuseScale = vec3(1.0);
#if DIFFUSE && DIFFUSE_CONES > 0
    diffuse = traceDiffuse(s, isLit, diffuseSamples);
    vec3 gathered = isLit ? diffuse : vec3(0.0);
#if !NO_ALBEDO
    vec3 albedo = color * materials[material].phongDiffuse;
#if !UNBOUNDED_SPECULAR
    albedo = min(albedo, 1.0) * (1.0 - strength);
#endif
    diffuse *= albedo;
    diffuseScale = albedo;
#endif
#if OCCLUDED_INDIRECT
    diffuse *= 1.0 - leastOcclusion;
    diffuseScale *= 1.0 - leastOcclusion;
#endif
    RECORD_PART(PART_DIFFUSE, gathered, diffuseScale);
#endif
#ifdef RECORD_STEPS
    RECORD_SURFACE(seen, s);
#if SPECULAR
    RECORD_PART(PART_SPECULAR, isLit ? specular : vec3(0.0), vec3(1.0));
#endif
#if OCCLUSION
    RECORD_PART(PART_OCCLUSION, vec3(visibleSum / max(float(thesis.lightCount), 1.0)), vec3(1.0));
#endif
    return;
#endif

#if VIEW == VIEW_FULL
    vec3 shown = direct + specular + diffuse;
#elif VIEW == VIEW_DIRECT
    vec3 shown = direct;
#elif VIEW == VIEW_INDIRECT
    vec3 shown = specular + diffuse;
#elif VIEW == VIEW_DIFFUSE
    vec3 shown = diffuse;
#elif VIEW == VIEW_SPECULAR
    vec3 shown = specular;
#else
    vec3 shown = vec3(visibleSum / max(float(thesis.lightCount), 1.0));
#endif
    shown = isLit ? shown : vec3(0.0);
#if VIEW == VIEW_FULL || VIEW == VIEW_DIRECT
    shown += seen ? s.emission : lighting.sky;
#endif
    if (inside) imageStore(picture, pixel, vec4(shown, seen ? 1.0 : 0.0));
#if COUNT_LOOKUPS
    if (isLit) {
        atomicAdd(lookups[0], diffuseSamples);
        atomicAdd(lookups[1], specularSamples);
        atomicAdd(lookups[2], occlusionSamples);
    }
#endif
}
