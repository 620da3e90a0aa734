#version 450 core
// SPDX-License-Identifier: MIT
// Glass in front of a finished picture: its tint on what lies behind, highlights, and what it reflects and
// refracts. Smooth surfaces split a path, and both parts are followed: one after the other, each from the eye, as
// the bits of a number say (PathParts). Behind a rough surface chance chooses between them. Where a path leaves the
// line of sight, its rays meet the triangles, and what they meet is shaded as pixels are: by lights, the cache and
// caustics (lib/voxel_light.glsl). `sums` holds the passes' sum until the last one; pixels that chance plays no
// part in are done after the first. Pixels that see no glass stay as they are. Method: docs/theory/4h_glass.md.
layout(local_size_x = 8, local_size_y = 8) in;
#include "lib/dot.glsl"
#include "lib/frame_block.glsl"
#include "lib/glass_sight.glsl"
#include "lib/loops.glsl"
#include "lib/picture_pass.glsl"
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

// Surfaces that one path meets at most, each a bit of PathParts.
const int kMostGlass = 24;
// A part that brings less than this share of a pixel's light is followed by chance, and weighs as much then. Looked
// at: lamps are a hundred times as bright as the rest, and no specks of them are seen.
const float kLeastPart = 0.002;
// Paths of one pixel and pass at most. Parts above the least weight are no more than its inverse.
const int kMostPaths = 512;

// Which parts a path takes where it splits.
struct PathParts {
    uint taken;  // a bit per split: 0 goes through, 1 is reflected
    int known;   // so many are given; at the others it goes through
    int splits;  // met so far
};

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

// Whether lamps behind a surface are glassScatters', and no ray's.
bool scattersLamps(GlassSurface s) { return !s.solid && !passesStraight(s) && s.brdf.alpha >= kNarrowLobe; }

// Light of rectangles that a rough pane scatters towards the eye from behind: the mirror image of what a lobe of that
// width reflects.
vec3 glassScatters(GlassSurface s, vec3 toEye, float xi) {
    if (!scattersLamps(s)) return vec3(0.0);
    Brdf b = s.brdf;
    b.albedo = s.through;
    vec3 mirrored = toEye - 2.0 * dot(toEye, s.normal) * s.normal;
    return reflectedRects(b, s.position, -s.normal, -s.geometricNormal, mirrored, xi);
}

// The path leaves a surface by its reflection: by its gloss, or by what it scatters back.
void reflectPath(inout GlassPath path, GlassSurface s, vec2 xi, inout uint random) {
    vec3 toEye = -path.direction;
    float gloss = brightness(s.brdf.albedo), matte = brightness(s.brdf.diffuse);
    float share = gloss / max(gloss + matte, 1e-6);
    bool glossy = randomNext(random) < share;
    vec3 weight = s.brdf.albedo;
    vec3 direction = reflect(path.direction, s.normal);
    if (!isSmooth(s)) direction = lobeDirection(s.brdf, s.normal, toEye, xi, weight);
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
    float alpha = isSmooth(s) ? 0.0 : s.brdf.alpha;
    path.alpha = glossy ? sqrt(path.alpha * path.alpha + alpha * alpha) : 0.5;
    path.bent = true;
}

// At the inner side of a solid, back into it by the facet's normal `h`.
void mirrorWithin(inout GlassPath path, GlassSurface s, vec3 h) {
    vec3 toEye = -path.direction;
    float VoH = clamp(dot(toEye, h), 0.0, 1.0);
    path.throughput *= facetFresnel(s, VoH, 1.0 / s.ior);
    path.direction = normalize(2.0 * VoH * h - toEye);
    // A smooth surface's bent normal can mirror out of it.
    if (isSmooth(s))
        path.direction -= 2.0 * min(dot(path.direction, s.geometricNormal), 0.0) * s.geometricNormal;
    path.narrow = path.bent = true;
}

// Shares of light that a facet lets through (x) and reflects (y).
vec2 partsOf(GlassSurface s, vec3 toEye, vec3 h) {
    if (!(s.back && s.solid)) return vec2(brightness(s.through), brightness(s.brdf.albedo + s.brdf.diffuse));
    vec3 reflected = facetFresnel(s, clamp(dot(toEye, h), 0.0, 1.0), 1.0 / s.ior);
    return vec2(brightness(s.tint * (1.0 - reflected)), brightness(reflected));
}

// Whether the path goes through where it meets a surface; chance says so by `xi`.
bool drawsThrough(inout GlassPath path, vec2 parts, float xi) {
    if (parts.x <= 0.0 || parts.y <= 0.0) return parts.x > 0.0;
    float share = clamp(parts.x / (parts.x + parts.y), 0.1, 0.9);
    bool through = xi < share;
    path.throughput /= through ? share : 1.0 - share;
    return through;
}

// The same where both parts are followed. `random` is that of the part from here on.
bool followsThrough(inout GlassPath path, inout PathParts pathParts, vec2 parts, inout uint random) {
    if (parts.x <= 0.0 || parts.y <= 0.0) return parts.x > 0.0;
    uint bit = 1u << pathParts.splits;
    bool through = pathParts.splits >= pathParts.known || (pathParts.taken & bit) == 0u;
    random = randomHash(random ^ (through ? bit : 3u * bit));
    ++pathParts.splits;
    float survives = min(brightness(path.throughput) * (through ? parts.x : parts.y) / kLeastPart, 1.0);
    path.throughput *= randomNext(random) < survives ? 1.0 / max(survives, 1e-6) : 0.0;
    return through;
}

// The next part that was passed by: through where the last path was, up to the last split at which it was; there it is
// reflected. None is left: known is kNoParts.
const int kNoParts = -1;
void nextBranch(inout PathParts pathParts) {
    uint given = pathParts.taken & ((1u << pathParts.known) - 1u);
    int last = findMSB(~given & ((1u << pathParts.splits) - 1u));
    uint bit = 1u << max(last, 0);
    pathParts = PathParts((given & (bit - 1u)) | bit, last < 0 ? kNoParts : last + 1, 0);
}

// The ray of the path's last stretch, up to glass in its way at `end`, metres.
Ray stretchOf(GlassPath path, float end, bool open) {
    float pixelAngle = 2.0 * length(frame.viewUp) / float(frame.height);
    // Parallel rays are as wide everywhere.
    rayCone = RayCone(frame.parallel * pixelAngle * glassPass.inverseVoxelSize,
                      pixelAngle * (1.0 - frame.parallel) + path.alpha);
    return Ray(gridFromWorld(path.origin), path.direction, open ? 1e9 : end * glassPass.inverseVoxelSize,
               vec3(0.0));
}

// The last stretch of a path that a ray is to look along.
struct GlassEnd {
    GlassPath path;
    float end;  // m, where glass is in its way; or one of these
    uint random;
};
const float kOpen = -1.0, kNoRay = -2.0;
GlassEnd noStretch() {
    vec3 zero = vec3(0.0);
    return GlassEnd(GlassPath(zero, zero, zero, zero, 0.0, false, false), kNoRay, 0u);
}

// Light that it brings to the eye.
vec3 lastStretch(GlassEnd last, inout bool sure) {
    GlassPath path = last.path;
    uint random = last.random;
    Ray ray = stretchOf(path, last.end, last.end == kOpen);
    pathStartsNarrow = path.narrow;
    allRectPoints = path.alpha == 0.0;
    PathSettings settings = PathSettings(-1.0, int(glassPass.reflections), path.alpha, glassPass.fireflyClamp,
                                         max(path.alpha, rayCone.growth), 0.0);
    VoxelHit hit;
    vec3 radiance = traceRadiance(ray, settings, random, hit);
    // Metals reflect by chance
    uint bits = texelFetch(litFaces, max(hit.face, 0)).w;
    sure = sure && (hit.face < 0 || litLobe(bits).x <= 0.0);
    return path.throughput * radiance;
}

// Sends a path through the surface, or back from it. h: the facet's normal.
void turnPath(inout GlassPath path, GlassSurface s, bool below, vec3 h, vec2 xi, inout uint random) {
    if (below) {
        passThrough(path, s, h);
        path.narrow = path.narrow && !scattersLamps(s);
    } else if (s.back && s.solid) {
        mirrorWithin(path, s, h);
    } else {
        reflectPath(path, s, xi, random);
    }
    // Rough facets that turn a path to the wrong side bring nothing, as in the path tracer
    float above = dot(path.direction, s.geometricNormal);
    if (s.back && s.solid && !isSmooth(s) && (below ? above >= 0.0 : above <= 0.0))
        path.throughput = vec3(0.0);
    if (s.solid) path.absorption = below != s.back ? s.absorption : vec3(0.0);
}

// What all paths of a pixel begin with.
struct GlassPixel {
    GlassSight sight;
    GlassHit hit;
    vec3 behind;  // what the picture shows without glass
    uint seed;
};

// Follows a path. Returns the light that comes along it, less what paths before it have met on the same way and what a
// ray is to bring from its `last` stretch. `sure`: chance has no part in it.
vec3 followGlass(GlassPixel start, inout PathParts pathParts, inout bool sure, inout GlassEnd last) {
    GlassSight sight = start.sight;
    GlassHit hit = start.hit;
    uint pixelSeed = start.seed;
    GlassPath path = GlassPath(sight.origin, sight.direction, vec3(1.0), vec3(0.0), 0.0, false, false);
    uint number = glassPass.firstPass + glassPass.pass;
    uint random = randomHash(pixelSeed ^ randomHash(number));
    vec2 choices = sequencePoint(pixelSeed + 2u, number);  // at the second and third surface
    vec3 light = vec3(0.0);
    float left = sight.end;  // up to what the picture shows
    int met = 0;
    bool goesOn, open = false, ended = false;
    do {
        GlassSurface s = glassSurface(path.origin, path.direction, hit);
        path.throughput *= exp(-path.absorption * hit.t);
        left -= hit.t;
        // Not s.position: Mesa's software driver (22.3) takes it from the next hit, where a path ends.
        vec3 position = path.origin + hit.t * path.direction;
        vec2 xi = vec2(randomNext(random), randomNext(random));
        xi = met == 0 ? sequencePoint(pixelSeed, number) : xi;
        float choice = randomNext(random);
        choice = met == 1 ? choices.x : (met == 2 ? choices.y : choice);
        bool shines = glassPass.direct != 0u && pathParts.splits >= pathParts.known;
        vec3 lobes = shines
                         ? glassHighlights(s, -path.direction, xi.x) + glassScatters(s, -path.direction, xi.y)
                         : vec3(0.0);
        light += shines ? path.throughput * (s.emission + lobes) : vec3(0.0);

        // Go through, or be reflected
        bool smoothHere = isSmooth(s);
        vec3 h = smoothHere ? s.normal : glassFacet(s, -path.direction, xi);
        sure = sure && smoothHere && brightness(s.brdf.diffuse) <= 0.0;
        vec2 parts = partsOf(s, -path.direction, h);
        bool below;
        if (met == 0 || path.alpha == 0.0)
            below = followsThrough(path, pathParts, parts, random);
        else
            below = drawsThrough(path, parts, choice);
        turnPath(path, s, below, h, xi, random);
        // What is bent is of rays alone.
        if (path.bent && glassPass.specular == 0u) path.throughput = vec3(0.0);

        // On to the next surface of glass
        int on = hit.triangle;
        path.origin = glassStep(position, below ? -s.geometricNormal : s.geometricNormal);
        goesOn = path.throughput.r + path.throughput.g + path.throughput.b > 1e-5;
        hit = nearestGlass(path.origin, path.direction, goesOn ? (path.bent ? 1e9 : left) : -1.0, on,
                           !path.bent);
        open = hit.triangle < 0;
        bool found = open;
        // What is in the way is shaded once, behind the loop.
        if (path.bent && goesOn && !open) found = traceVoxels(stretchOf(path, hit.t, open)).face >= 0;
        ended = goesOn && found;
        goesOn = goesOn && !found;
    } while (goesOn && ++met < kMostGlass);
    if (ended && path.bent) last = GlassEnd(path, hit.triangle < 0 ? kOpen : hit.t, random);
    return ended && !path.bent ? light + path.throughput * start.behind : light;
}

void main() {
    ivec2 pixel = passPixel();
    if (any(greaterThanEqual(pixel, imageSize(picture)))) return;
    vec4 before = glassPass.pass > 0u ? imageLoad(sums, pixel) : vec4(0.0);
    if (before.a > 0.0) return;  // the first pass was sure of it
    GlassSight sight = glassSight(pixel);
    GlassHit first = nearestGlass(sight.origin, sight.direction, sight.end, -1, true);
    if (first.triangle < 0) return;
    uint seed = randomHash(uint(pixel.x) | uint(pixel.y) << 16) ^ 0x2545f491u;
    GlassPixel start = GlassPixel(sight, first, imageLoad(picture, pixel).rgb, seed);
    vec3 light = before.rgb;
    bool sure = true;
    PathParts pathParts = PathParts(0u, 0, 0);
    int paths = 0;
    do {
        // Paths up to one that needs a ray: it costs much, and is asked for in one place
        GlassEnd last = noStretch();
        do {
            light += followGlass(start, pathParts, sure, last);
            nextBranch(pathParts);
        } while (pathParts.known != kNoParts && ++paths < kMostPaths && last.end == kNoRay);
        if (last.end != kNoRay) light += lastStretch(last, sure);
    } while (pathParts.known != kNoParts && paths < kMostPaths);
    sure = sure && glassPass.pass == 0u;
    if (!sure && glassPass.pass + 1u < glassPass.passes) {
        imageStore(sums, pixel, vec4(light, 0.0));
        return;
    }
    if (sure) imageStore(sums, pixel, vec4(light, 1.0));
    imageStore(picture, pixel, vec4(sure ? light : light / float(glassPass.passes), 1.0));
}
