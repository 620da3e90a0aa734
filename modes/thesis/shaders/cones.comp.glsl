#version 450 core
// SPDX-License-Identifier: MIT
// G-buffer and lit volume -> the thesis's picture (its chapter 5, "Cone Tracing"): Phong light weakened by an
// occlusion cone per light, a specular cone, and a set of diffuse cones. Variants by #define: which cones,
// regular or customised, which defects of the original, which part is shown. One pixel per invocation.
//
// Loops end at the bottom and their conditions hold "is there a surface": branches skip nothing on llvmpipe.
#include "lib/dot.glsl"
#include "lib/environment.glsl"
#include "lib/gbuffer.glsl"
#include "lib/light_table.glsl"
#include "lib/picture_pass.glsl"
#include "lib/record_steps.glsl"
#include "thesis/shaders/albedo.glsl"
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
#if OCCLUSION && !ISOTROPIC_OPACITY
uniform sampler3D areasPlus;
uniform sampler3D areasMinus;
#endif
layout(rgba32f) uniform writeonly image2D picture;
#if COUNT_LOOKUPS
layout(std430) buffer LookupTable { uint lookups[]; };
#endif

#include "thesis/shaders/cone_samples.glsl"
#if DIFFUSE && DIFFUSE_CONES > 0
#include "thesis/shaders/diffuse_cones.glsl"
#endif
#if SPECULAR
#include "thesis/shaders/specular_cone.glsl"
#endif
#if OCCLUSION
#include "thesis/shaders/occlusion_cone.glsl"
#endif

bool has(uint switchBit) { return (thesis.switches & switchBit) != 0u; }

// Phong model at the surface (thesis, Phong listing), without occlusion.
vec3 phong(Surface s, vec3 color, uint material, Light source, ThesisLight light) {
    float ambient = has(THESIS_PHONG_AMBIENT) ? materials[material].phongAmbient : 0.0;
    float diffuse = has(THESIS_PHONG_DIFFUSE) ? materials[material].phongDiffuse : 0.0;
    float gloss = has(THESIS_PHONG_SPECULAR) ? materials[material].phongSpecular : 0.0;
    float lobe =
        pow(max(dot(s.toEye, reflect(-light.toLight, s.normal)), 1e-6), materials[material].phongShininess);
    float NoL = dot(s.normal, light.toLight);
    return light.color * light.falloff * color *
           (ambient + diffuse * thesisCosine(source, light, s.position, s.normal) +
            (NoL > 0.0 ? gloss * lobe : 0.0));
}

// What the cones need of a pixel's material.
struct Paint {
    uint material;
    vec3 color;
    float shininess;
    float strength;  // share that is reflected as by a mirror
    vec3 mirrored;   // direction, away from the surface
};

Paint paintOf(Surface s) {
    Paint paint;
    paint.material = s.material;
    paint.color = (materials[s.material].flags & MATERIAL_HAS_PHONG) != 0u ? materials[s.material].phongColor
                                                                           : s.albedo;
    paint.shininess = materials[s.material].phongShininess;
    paint.strength = reflectance(materials[s.material].phongSpecular, paint.shininess);
    paint.mirrored = reflect(-s.toEye, s.normal);
    return paint;
}

// Samples that a pixel's cones took, by kind.
struct SampleCounts {
    uint diffuse;
    uint specular;
    uint occlusion;
};

float occlusionOf(Surface s, Light source, ThesisLight light, bool isLit, inout SampleCounts samples) {
#if OCCLUSION
#if OCCLUDED_INDIRECT || OCCLUDED_SPECULAR || VIEW == VIEW_OCCLUSION
    bool isTraced = isLit;
#else
    // Light from behind adds nothing that could be hidden, unless ambient light is on.
    bool isTraced = isLit && (dot(s.normal, light.toLight) > 0.0 || has(THESIS_PHONG_AMBIENT));
#endif
    float spread = thesisSpread(source, light, thesis.occlusionCone.x, thesis.parallelSpread);
    return traceOcclusion(s, light, spread, isTraced, samples.occlusion);
#else
    return 0.0;
#endif
}

#if SPECULAR
float specularWeight(Paint paint, ThesisLight light, float visible) {
    float weight = 1.0;
#if SPECULAR == CUSTOMISED
    weight = angularWeight(dot(paint.mirrored, light.toLight), paint.shininess, thesis.shininessFalloff);
#endif
#if OCCLUDED_SPECULAR
    weight *= visible;
#endif
    return weight;
}

// The specular cone times its weight.
vec3 reflectedLight(Surface s, Paint paint, bool isLit, float weight, inout SampleCounts samples) {
    bool reflects = isLit && weight > thesis.minSpecular;
    vec3 light = weight * traceSpecular(s, paint.mirrored, paint.shininess, reflects, samples.specular);
    if (reflects) RECORD_WEIGHT(weight);
    return light;
}
#endif

// What a pixel has from its lights and its mirrored direction.
struct LightSum {
    vec3 direct;
    vec3 specular;
    float leastOcclusion;
    float visible;  // sum over lights
};

LightSum lightByLight(Surface s, Paint paint, bool isLit, inout SampleCounts samples) {
    LightSum sum = LightSum(vec3(0.0), vec3(0.0), 1.0, 0.0);
    float mirrorWeight = 0.0;
    for (uint i = 0u; i < thesis.lightCount; ++i) {
        Light source = lightOfTable(i);
        ThesisLight light = thesisLight(source, s.position);
        float occlusion = occlusionOf(s, source, light, isLit, samples);
        sum.leastOcclusion = min(sum.leastOcclusion, occlusion);
        sum.visible += 1.0 - occlusion;
        float visible = has(THESIS_SHADOWS) ? 1.0 - occlusion : 1.0;
        if (has(THESIS_PHONG)) sum.direct += visible * phong(s, paint.color, paint.material, source, light);
#if SPECULAR
        float weight = specularWeight(paint, light, visible);
#if SPECULAR_PER_LIGHT
        sum.specular += reflectedLight(s, paint, isLit, paint.strength * weight, samples);
#else
        mirrorWeight = max(mirrorWeight, weight);
#endif
#endif
    }
#if SPECULAR && !SPECULAR_PER_LIGHT
    // The light nearest to the mirrored direction sets the weight; without lights there is none to be near.
    mirrorWeight = paint.strength * (thesis.lightCount == 0u ? 1.0 : mirrorWeight);
    sum.specular = reflectedLight(s, paint, isLit, mirrorWeight, samples);
#endif
    return sum;
}

// Indirect light that a pixel reflects diffusely.
vec3 diffuseLight(Surface s, Paint paint, bool isLit, float leastOcclusion, inout SampleCounts samples) {
    vec3 diffuse = vec3(0.0);
#if DIFFUSE && DIFFUSE_CONES > 0
    vec3 scale = vec3(1.0);
    diffuse = traceDiffuse(s, isLit, samples.diffuse);
    vec3 gathered = isLit ? diffuse : vec3(0.0);
#if !NO_ALBEDO
    vec3 albedo = diffuseAlbedo(paint.color, materials[paint.material].phongDiffuse, paint.strength);
    diffuse *= albedo;
    scale = albedo;
#endif
#if OCCLUDED_INDIRECT
    diffuse *= 1.0 - leastOcclusion;
    scale *= 1.0 - leastOcclusion;
#endif
    RECORD_PART(PART_DIFFUSE, gathered, scale);
#endif
    return diffuse;
}

// The part of the picture that is asked for, without emission and sky.
vec3 shownPart(LightSum sum, vec3 diffuse) {
#if VIEW == VIEW_FULL
    return sum.direct + sum.specular + diffuse;
#elif VIEW == VIEW_DIRECT
    return sum.direct;
#elif VIEW == VIEW_INDIRECT
    return sum.specular + diffuse;
#elif VIEW == VIEW_DIFFUSE
    return diffuse;
#elif VIEW == VIEW_SPECULAR
    return sum.specular;
#else
    return vec3(sum.visible / max(float(thesis.lightCount), 1.0));
#endif
}

void main() {
    ivec2 pixel = passPixel();
    bool inside = all(lessThan(pixel, ivec2(frame.width, frame.height)));
    Surface s;
    bool seen = fetchSurface(min(pixel, ivec2(frame.width, frame.height) - 1), s) && inside;
    bool isLit = seen && !s.unlit;
    Paint paint = paintOf(s);
    SampleCounts samples = SampleCounts(0u, 0u, 0u);

    LightSum sum = lightByLight(s, paint, isLit, samples);
    vec3 diffuse = diffuseLight(s, paint, isLit, sum.leastOcclusion, samples);
#ifdef RECORD_STEPS
    RECORD_SURFACE(seen, s);
#if SPECULAR
    RECORD_PART(PART_SPECULAR, isLit ? sum.specular : vec3(0.0), vec3(1.0));
#endif
#if OCCLUSION
    RECORD_PART(PART_OCCLUSION, vec3(sum.visible / max(float(thesis.lightCount), 1.0)), vec3(1.0));
#endif
    return;
#endif

    vec3 shown = isLit ? shownPart(sum, diffuse) : vec3(0.0);
#if VIEW == VIEW_FULL || VIEW == VIEW_DIRECT
    shown += seen ? s.emission : lighting.sky;
#endif
    if (inside) imageStore(picture, pixel, vec4(shown, seen ? 1.0 : 0.0));
#if COUNT_LOOKUPS
    if (isLit) {
        atomicAdd(lookups[0], samples.diffuse);
        atomicAdd(lookups[1], samples.specular);
        atomicAdd(lookups[2], samples.occlusion);
    }
#endif
}
