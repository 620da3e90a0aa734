// SPDX-License-Identifier: MIT
// Read access to the G-buffer: pixel -> Surface. Bits: lib/gbuffer_pack.glsl. What a shader does not use of
// the Surface costs nothing: the compiler drops the fetches and unpacking behind it.
// SURFACE_EMISSION 0: no material emits light, and the tables of storage that say how much are not asked.
// SURFACE_COATS 1: the surface is its clear coat, and none where there is no coat.
#ifndef SURFACE_EMISSION
#define SURFACE_EMISSION 1
#endif
#ifndef SURFACE_COATS
#define SURFACE_COATS 0
#endif
#include "lib/dot.glsl"
#include "lib/frame_block.glsl"
#include "lib/gbuffer_pack.glsl"
#include "lib/octahedral.glsl"
#include "lib/scene_tables.glsl"
#include "lib/surface.glsl"
// After what it includes.
#if SURFACE_COATS
#include "lib/layers.glsl"
#endif
uniform usampler2D gbufferGeometry;
uniform usampler2D gbufferMaterial;
#if SURFACE_COATS
uniform usampler2D surfaceLayers;
#endif

// World-space direction, not unit: position = pixelOrigin + view depth * direction. Row 0 is the bottom row.
vec3 pixelRay(ivec2 pixel) {
    vec2 clip = (vec2(pixel) + 0.5) / vec2(frame.width, frame.height) * 2.0 - 1.0;
    vec3 ray = frame.viewForward + clip.x * frame.viewRight + clip.y * frame.viewUp;
    return frame.parallel != 0.0 ? frame.viewForward : ray;
}

// Where the ray of a pixel begins: the eye, but of parallel rays.
vec3 pixelOrigin(ivec2 pixel) {
    vec2 clip = (vec2(pixel) + 0.5) / vec2(frame.width, frame.height) * 2.0 - 1.0;
    return frame.eye + frame.parallel * (clip.x * frame.viewRight + clip.y * frame.viewUp);
}

// Where a surface begins for shadow maps. Rasterizers snap corners to 1/256 of a pixel, and planes go along: a position is
// off by up to this share of a pixel's width across. Behind its plane it would lie in its own shadow.
const float kSnapped = 1.0 / 362.0;
vec3 litPosition(Surface s) {
    float pixel =
        2.0 * max(length(frame.viewRight) / float(frame.width), length(frame.viewUp) / float(frame.height));
    return s.position + kSnapped * pixel * mix(s.depth, 1.0, frame.parallel) * s.geometricNormal;
}

// The surface seen at the centre of `pixel`; false in the background, where `s` is a default surface at the
// eye.
bool fetchSurface(ivec2 pixel, out Surface s) {
    uvec4 geometry = texelFetch(gbufferGeometry, pixel, 0);
    uvec4 material = texelFetch(gbufferMaterial, pixel, 0);
    vec3 ray = pixelRay(pixel);
    s.depth = uintBitsToFloat(geometry.x);
    s.position = pixelOrigin(pixel) + s.depth * ray;
    s.toEye = -normalize(ray);
    s.normal = octDecode(unpackSnorm2x16(geometry.y));
    s.geometricNormal = octDecode(unpackSnorm2x16(geometry.z));
    s.instance = instanceOfWord(geometry.w);
    s.normalMean = 1.0 - spreadOfWord(geometry.w);
    s.backFacing = (geometry.w & 1u) != 0u;
    s.unlit = (geometry.w & 2u) != 0u;
    s.material = instances[s.instance].material;

    vec2 blueRough = unpackUnorm2x16(material.y);
    vec3 base = vec3(unpackUnorm2x16(material.x), blueRough.x);
    s.roughness = blueRough.y;
    vec3 unlitRadiance = base * unlitScale(material.y);
    if (s.unlit) s.roughness = 1.0;
    unpackReflectance(material.z, s.dielectricF0, s.metallic);
    s.albedo = s.unlit ? vec3(0.0) : base;
    s.emission = s.unlit ? unlitRadiance : vec3(0.0);
#if SURFACE_EMISSION
    if (!s.unlit) s.emission = materials[s.material].emission * unpackEmissionFactor(material.w);
#endif
#if SURFACE_COATS
    Layers layers = unpackLayers(texelFetch(surfaceLayers, pixel, 0));
    s.normal = layers.coatNormal;
    s.normalMean = 1.0;
    s.albedo = s.emission = vec3(0.0);
    s.metallic = 0.0;
    s.roughness = layers.coatRoughness;
    s.dielectricF0 = vec3(kCoatF0);
    return geometry.x != 0u && layers.coat > 0.0;
#endif
    return geometry.x != 0u;
}
