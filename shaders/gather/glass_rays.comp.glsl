#version 450 core
// SPDX-License-Identifier: MIT
// Glass in front of a finished picture: its tint on what lies behind, highlights, and what it reflects and
// refracts. Two paths per pass and pixel, one that the first surface reflects and one that it lets through. Where
// a path leaves the line of sight, its rays meet the triangles and the cached light of the voxels
// (lib/voxel_light.glsl). `sums` holds their sum until the last pass. Pixels that see no glass stay as they are.
// Method: docs/theory/4h_glass.md.
layout(local_size_x = 8, local_size_y = 8) in;
#include "lib/frame_block.glsl"
#include "lib/glass_sight.glsl"
#include "lib/random.glsl"
#include "lib/surface_array.glsl"
// What needs them.
#include "lib/glass_path.glsl"
#define SMOOTH_HITS 1
#define TRIANGLE_HITS 1
#include "lib/voxel_light.glsl"
layout(rgba32f) uniform image2D sums;
layout(rgba32f) uniform image2D picture;
layout(std140) uniform GlassBlock { GlassConstants glassPass; };

// Surfaces that one path meets at most.
const int kMostGlass = 12;

// Light that lights send straight into the lobe of a surface.
vec3 glassHighlights(GlassSurface s, vec3 toEye, float xi) {
    if (s.back && s.solid) return vec3(0.0);
    vec3 light = vec3(0.0);
#if EXACT_DIRECT
    DirectLight punctual = DirectLight(vec3(0.0), vec3(0.0));
    addPunctualLights(punctual, true, Receiver(s.position, s.normal, s.geometricNormal, toEye, vec2(0.0)),
                      s.brdf);
    light += punctual.specular + punctual.irradiance * s.brdf.diffuse / kPi;
#endif
    if (s.brdf.alpha >= kNarrowLobe)
        light += reflectedRects(s.brdf, s.position, s.normal, s.geometricNormal, toEye, xi);
    return light;
}

// The path leaves a surface by its reflection: by its gloss, or by what it scatters back.
void reflectPath(inout GlassPath path, GlassSurface s, vec2 xi, inout uint random) {
    vec3 toEye = -path.direction;
    float gloss = brightness(s.brdf.albedo), matte = brightness(s.brdf.diffuse);
    float share = gloss / max(gloss + matte, 1e-6);
    bool glossy = randomNext(random) < share;
    vec3 weight;
    vec3 direction = lobeDirection(s.brdf, s.normal, toEye, xi, weight);
    weight /= max(share, 1e-6);
    if (!glossy) {
        direction = cosineDirection(s.normal, xi);
        weight = s.brdf.diffuse / max(1.0 - share, 1e-6);
    }
    // A bent normal can mirror into the surface: keep to the side of the triangle.
    direction -= 2.0 * min(dot(direction, s.geometricNormal), 0.0) * s.geometricNormal;
    path.direction = normalize(direction);
    path.throughput *= weight;
    path.narrow = glossy && s.brdf.alpha < kNarrowLobe;
    path.alpha = glossy ? sqrt(path.alpha * path.alpha + s.brdf.alpha * s.brdf.alpha) : 0.5;
    path.bent = true;
}

// At the inner side of a solid: back into it, or out of it. Returns whether it goes out.
bool leaveSolid(inout GlassPath path, GlassSurface s, vec3 h, float choice) {
    vec3 toEye = -path.direction;
    float VoH = clamp(dot(toEye, h), 0.0, 1.0);
    vec3 reflected = facetFresnel(s, VoH, 1.0 / s.ior);
    float back = brightness(reflected);
    if (choice >= back) {
        passThrough(path, s, h);
        path.throughput /= max(1.0 - back, 1e-6);
        return dot(path.direction, s.geometricNormal) < 0.0;
    }
    path.direction = normalize(2.0 * VoH * h - toEye);
    path.direction -= 2.0 * min(dot(path.direction, s.geometricNormal), 0.0) * s.geometricNormal;
    path.throughput *= reflected / max(back, 1e-6);
    path.narrow = path.bent = true;
    return false;
}

// The ray of the path's last stretch, up to glass in its way at `end`, metres.
Ray stretchOf(GlassPath path, float end, bool open) {
    float pixelAngle = 2.0 * length(frame.viewUp) / float(frame.height);
    rayCone = RayCone(path.alpha <= kTriangleAlpha ? 0.0 : -1.0, pixelAngle + path.alpha);
    return Ray(gridFromWorld(path.origin), path.direction, open ? 1e9 : end * glassPass.inverseVoxelSize,
               vec3(0.0));
}

// Light along it.
vec3 pathRadiance(GlassPath path, float end, bool open, inout uint random) {
    Ray ray = stretchOf(path, end, open);
    pathStartsNarrow = path.narrow;
    PathSettings settings = PathSettings(-1.0, int(glassPass.reflections), path.alpha, glassPass.fireflyClamp,
                                         max(path.alpha, rayCone.growth));
    VoxelHit hit;
    return traceRadiance(ray, settings, random, hit);
}

// What comes along one path. `kind` 0: the first surface reflects it; 1: it lets it through.
vec3 glassLight(GlassHit hit, GlassSight sight, uint kind, uint pixelSeed, vec3 behind) {
    GlassPath path = GlassPath(frame.eye, sight.direction, vec3(1.0), vec3(0.0), 0.0, false, false);
    uint number = glassPass.firstPass + glassPass.pass;
    uint random = randomHash(pixelSeed ^ randomHash(2u * number + kind));
    vec2 choices = sequencePoint(pixelSeed + 2u + kind, number);  // at the second and third surface
    vec3 light = vec3(0.0);
    float left = sight.end;  // up to what the picture shows
    int met = 0;
    bool goesOn, open = false, ended = false;
    do {
        GlassSurface s = glassSurface(path.origin, path.direction, hit);
        path.throughput *= exp(-path.absorption * hit.t);
        left -= hit.t;
        vec2 xi =
            met == 0 ? sequencePoint(pixelSeed + kind, number) : vec2(randomNext(random), randomNext(random));
        float choice = met == 1 ? choices.x : (met == 2 ? choices.y : randomNext(random));
        bool shines = glassPass.direct != 0u && (met > 0 || kind == 0u);
        light +=
            shines ? path.throughput * (s.emission + glassHighlights(s, -path.direction, xi.x)) : vec3(0.0);
        vec3 h = glassFacet(s, -path.direction, xi);
        bool below;  // the path goes through
        if (s.back && s.solid) {
            below = leaveSolid(path, s, h, choice);
        } else {
            float reflects = brightness(s.brdf.albedo + s.brdf.diffuse);
            float share = clamp(reflects / max(reflects + brightness(s.through), 1e-6), 0.1, 0.9);
            below = met == 0 ? kind == 1u : choice >= share;
            if (below)
                passThrough(path, s, h);
            else
                reflectPath(path, s, xi, random);
            if (met > 0) path.throughput /= below ? 1.0 - share : share;
        }
        if (s.solid) path.absorption = below != s.back ? s.absorption : vec3(0.0);
        // What is bent is of rays alone.
        if (path.bent && glassPass.specular == 0u) path.throughput = vec3(0.0);
        int on = hit.triangle;
        path.origin = glassStep(s.position, below ? -s.geometricNormal : s.geometricNormal);
        goesOn = path.throughput.r + path.throughput.g + path.throughput.b > 1e-4;
        float reach = path.bent ? 1e9 : left;
        hit = nearestGlass(path.origin, path.direction, goesOn ? reach : -1.0, on, !path.bent);
        open = hit.triangle < 0;
        bool found = open;
        // What is in the way is shaded once, behind the loop.
        if (path.bent && goesOn && !open) found = traceVoxels(stretchOf(path, hit.t, open)).face >= 0;
        ended = goesOn && found;
        goesOn = goesOn && !found;
    } while (goesOn && ++met < kMostGlass);
    vec3 arrives = behind;
    if (ended && path.bent) arrives = pathRadiance(path, hit.t, open, random);
    return ended ? light + path.throughput * arrives : light;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(picture)))) return;
    GlassSight sight = glassSight(pixel);
    GlassHit first = nearestGlass(frame.eye, sight.direction, sight.end, -1, true);
    if (first.triangle < 0) return;
    vec4 behind = imageLoad(picture, pixel);
    uint seed = randomHash(uint(pixel.x) | uint(pixel.y) << 16) ^ 0x2545f491u;
    vec3 light = vec3(0.0);
    uint kind = 0u;
    do {
        light += glassLight(first, sight, kind, seed, behind.rgb);
    } while (++kind < 2u);
    if (glassPass.pass > 0u) light += imageLoad(sums, pixel).rgb;
    if (glassPass.pass + 1u < glassPass.passes) {
        imageStore(sums, pixel, vec4(light, 1.0));
        return;
    }
    light /= float(glassPass.passes);
    imageStore(picture, pixel, vec4(light, 1.0));
}
