// SPDX-License-Identifier: MIT
// The light of voxel faces as rays see it, and the estimator of irradiance that the cache's update and the
// pixels share: docs/theory/4_gather.md, "Rays to bright faces".
//
// EXACT_DIRECT 1: light of point, spot and directional lights is looked up at the exact hit point by shadow
// map, not taken from the face; rectangles and emission stay the face's. light::hitLightDefines says for a
// scene. FIND_BACKS 1: rays by the cosine are followed back as well, to see whether they met a surface from
// behind.
// LOBES 1: where a ray meets metal it goes on in its lobe (rayRadiance). 0: metals shine as if matt.
// TRIANGLE_HITS 1: rays into smooth lobes meet triangles (lib/triangle_hit.glsl); needs SMOOTH_HITS 1.
// SMOOTH_HITS 1: what is met shows irradiance and normal interpolated over the voxels about it, not those of
// its face.
//
// Before the call: SurfaceVoxels::bind, OctantWords::bind, IrradianceCache::bind, the frame block;
// EXACT_DIRECT also the scene's tables and the shadow maps.
#ifndef EXACT_DIRECT
#define EXACT_DIRECT 0
#endif
#ifndef FIND_BACKS
#define FIND_BACKS 0
#endif
#ifndef LOBES
#define LOBES 0
#endif
#ifndef SMOOTH_HITS
#define SMOOTH_HITS 0
#endif
// Not within an #if: what arrives in one that is not taken is lost to those after it.
#include "lib/ggx_sample.glsl"
#include "lib/light_table.glsl"
#include "lib/random.glsl"
#include "lib/ray_query.glsl"
#include "lib/record_face.glsl"
#include "lib/rect_light.glsl"
#include "lib/shadow.glsl"
#include "lib/tangent_frame.glsl"
#include "shared/irradiance.h"
#if EXACT_DIRECT
#if LIGHTS_RECT
#error rectangles are not looked up at hits: LIGHTS_RECT must be 0
#endif
#include "lib/lights.glsl"
#endif
#if LOBES || TRIANGLE_HITS
uniform usamplerBuffer voxelFaceSources;
#endif
#if SMOOTH_HITS
#define CACHE_NORMALS 1
#include "lib/cache_lookup.glsl"
#endif
uniform usamplerBuffer steadyLight;
uniform usamplerBuffer brightFaces;

const float kGatherPi = 3.14159265358979;

struct FaceShade {
    vec3 albedo;
    vec3 radiance;    // emission and reflected direct light, W/(sr m^2)
    vec3 irradiance;  // cached indirect irradiance / pi
    bool usable;      // false: never updated, or inside a closed object
};

FaceShade faceShade(int face) {
    uvec4 r = texelFetch(voxelFaces, 2 * face + 1);
    vec2 high = unpackHalf2x16(r.w);
    return FaceShade(unpackAlbedo(r.x), unpackRgb9e5(r.y), vec3(unpackHalf2x16(r.z), high.x),
                     (r.w & (FACE_LIT | FACE_DEAD)) == FACE_LIT);
}

// What a face shows: emission, reflected direct light, reflected cached light.
vec3 faceRadiance(int face) {
    FaceShade s = faceShade(face);
    return s.radiance + s.albedo * s.irradiance;
}

// How bright a face is when rays to bright faces are dealt out. The plain mean: blue light counts as much.
float faceBrightness(vec3 radiance) { return dot(radiance, vec3(1.0 / 3.0)); }

vec3 faceNormalOf(int face) { return octDecode(unpackSnorm2x16(texelFetch(voxelFaces, 2 * face).x)); }

#include "lib/triangle_surface.glsl"

// Radiance at a hit, all surfaces matt; the sky where nothing was met. `s`: of the face that was hit; its
// irradiance becomes that of the point, where it is looked up. `bent`: the normal there, in the same way.
vec3 hitRadiance(VoxelHit hit, vec3 origin, vec3 direction, inout FaceShade s, out vec3 bent) {
    int face = max(hit.face, 0);
    vec3 normal = faceNormalOf(face);
    bent = normal;
#if TRIANGLE_HITS
    if (hit.triangle >= 0) return triangleRadiance(hit, origin, direction, s, bent);
#endif
#if EXACT_DIRECT || SMOOTH_HITS
    vec3 point = origin + (hit.face >= 0 ? hit.t : 0.0) * direction;
#endif
#if SMOOTH_HITS
    vec4 around = cachedIrradiance(point, normal, hit.face >= 0, bent);
    bent = dot(bent, bent) > 0.0 ? normalize(bent) : normal;
    s.irradiance = around.a > 0.0 ? around.rgb : s.irradiance;
#endif
#if EXACT_DIRECT
    float rise = dot(faceRise(texelFetch(voxelFaces, 2 * face), normal), normal) * grid.voxelSize;
    vec3 direct = directIrradiance(worldFromGrid(point), bent, normal, rise) * (1.0 / kGatherPi);
    vec3 radiance = unpackRgb9e5(texelFetch(steadyLight, face).x) + s.albedo * (direct + s.irradiance);
#else
    vec3 radiance = s.radiance + s.albedo * s.irradiance;
#endif
    return hit.face >= 0 ? radiance : lighting.sky;
}

#if LOBES
// Metals rougher than this shine as if matt: their lobe is nearly as wide, and rays cost the same.
const float kRoughestLobe = 0.75;
// A lobe at least this wide (GGX's alpha) reflects rectangles of light as a whole, without a ray; in one that
// is narrower a ray must meet them, which then few do not, and shadows on them are sharp. By eye.
const float kNarrowLobe = 0.015;

// What rectangles of light show in the lobe of b: their reflection as a whole (lib/rect_light.glsl) where one
// of their sample points is seen, drawn by its share of the lobe.
vec3 reflectedRects(Brdf b, vec3 position, vec3 normal, vec3 geometricNormal, vec3 toEye, float xi) {
    vec3 reflected = vec3(0.0);
    uint i = lighting.lightEnds.z;
    if (i < lighting.lightEnds.w) {
        RectLobe lobe = rectLobe(normal, toEye, b.alpha, b.nov);
        do {
            Light light = lights[i];
            uint k = rectPointInLobe(light, position, lobe, xi);
            vec3 point = rectSamplePoint(light, k);
            reflected += light.intensity * rectSpecularQuick(light, position, lobe, b) *
                         shadowVisibilityRect(light, k, point, position, geometricNormal);
        } while (++i < lighting.lightEnds.w);
    }
    return reflected;
}

// A ray that meets metal: what it shows besides what its lobe reflects of other surfaces, and how the ray
// goes on in the lobe. Lights, which no ray can meet or few, are reflected here, matt where they were not
// looked up.
struct LobeStep {
    vec3 radiance;
    vec3 weight;
    vec3 origin;
    vec3 leaves;
    vec3 direction;
    float alpha;
    float glossy;  // share of its colour that the lobe has
};

// `widening`: added to the square of the lobe's width. `bent`: the normal that the lobe is about.
LobeStep reflectRay(VoxelHit hit, FaceShade s, vec2 lobe, float widening, vec3 matt, vec3 point, vec3 bent,
                    vec3 direction, vec2 xi) {
    int face = max(hit.face, 0);
    vec3 normal = faceNormalOf(face);
#if TRIANGLE_HITS
    normal = hit.triangle >= 0 ? metTriangle.geometricNormal : normal;
#endif
    float alpha = max(lobe.y, kMinRoughness) * max(lobe.y, kMinRoughness);
    alpha = min(sqrt(alpha * alpha + widening), 1.0);
    Brdf b = makeBrdf(s.albedo, lobe.x, sqrt(alpha), vec3(0.04), -dot(bent, direction));
    LobeStep next;
    next.alpha = alpha;
    next.direction = lobeDirection(b, bent, -direction, xi, next.weight);
    // A bent normal can mirror into the surface.
    next.direction -= 2.0 * min(dot(next.direction, normal), 0.0) * normal;
    next.origin = rayOrigin(point, normal);
    next.leaves = normal;
    // The record reflects by all of its colour; its matt part is only this much of it.
    float share = dot(b.diffuse, vec3(1.0)) / max(dot(s.albedo, vec3(1.0)), 1e-4);
    next.glossy = 1.0 - share;
    vec3 emission = unpackEmission(texelFetch(voxelFaceSources, face).xy);
    next.radiance = emission + share * max(matt - emission, vec3(0.0));
    vec3 rise = faceRise(texelFetch(voxelFaces, 2 * face), normal);
#if TRIANGLE_HITS
    rise = hit.triangle >= 0 ? vec3(0.0) : rise;
#endif
    vec3 position = worldFromGrid(point + rise);
    if (alpha >= kNarrowLobe)
        next.radiance += reflectedRects(b, position, bent, normal, -direction, fract(7.0 * xi.x + xi.y));
#if EXACT_DIRECT
    DirectLight light = DirectLight(vec3(0.0), vec3(0.0));
    addPunctualLights(light, true, Receiver(position, bent, normal, -direction, kShadowVoxelLift), b);
    next.radiance += light.specular;
#else
    next.radiance +=
        (1.0 - share) * max(s.radiance - unpackRgb9e5(texelFetch(steadyLight, face).x), vec3(0.0));
#endif
    return next;
}
#endif

// Where a ray comes from: how wide its direction was drawn, as a GGX alpha.
const float kCosineSpread = 0.5;
// A second lobe is widened by so much of the square of the first, over the number of rays of the mean: what
// few of the rays would find, a lamp or a bright wall in a narrow lobe, many see blurred instead.
const float kLobeWidening = 12.0;

// Radiance that a ray brings (hitRadiance), and what it met first. With LOBES it goes on where it meets
// metal, up to `reflections` times; after that metals reflect lights in their lobe and all else as if matt.
// `leaves`: normal of the surface that the ray starts from. `spread`: of the directions that this ray was
// drawn from. `limit`: number of rays of the mean. Lobes are widened by both (path space regularization:
// Kaplanyan and Dachsbacher 2013), and what comes by reflections is not brighter than `limit` times what the
// metal would show if matt. Both vanish with the number of rays, so that the mean tends to what is there.
// `aim`: a ray that is over where its first hit is not at this distance; negative: none.
vec3 rayRadiance(vec3 origin, vec3 leaves, vec3 direction, float reach, float aim, int reflections,
                 float spread, float limit, inout uint random, out VoxelHit first) {
    first = traceVoxels(origin, direction, reach, leaves);
#if !LOBES
    FaceShade s = faceShade(max(first.face, 0));
    vec3 bent;
    return hitRadiance(first, origin, direction, s, bent);
#else
    VoxelHit hit = first;
    vec3 shown = vec3(0.0);    // by what was met first
    vec3 brought = vec3(0.0);  // by reflections
    vec3 throughput = vec3(1.0);
    float most = 0.0;
    float spread2 = spread * spread;
    bool narrow = false;  // the lobe that the ray comes from
    int count = 0;
    bool going;
    do {
        int face = max(hit.face, 0);
        FaceShade s = faceShade(face);
        uint bits = texelFetch(voxelFaces, 2 * face + 1).w;
        vec2 lobe = unpackLobe(bits >> 16);
        vec3 bent;
        vec3 radiance = hitRadiance(hit, origin, direction, s, bent);
#if TRIANGLE_HITS
        lobe = hit.triangle >= 0 ? metTriangle.lobe : lobe;
#endif
        bool lamp = (bits & FACE_AREA_LIGHT) != 0u;
        bool arrived = count > 0 || aim < 0.0 || abs(hit.t - aim) < 0.3;
        bool metal = hit.face >= 0 && lobe.x > 0.0 && lobe.y <= kRoughestLobe && s.usable && !lamp && arrived;
        if (narrow && hit.face >= 0 && lamp)
            radiance += unpackEmission(texelFetch(voxelFaceSources, face).xy);
        vec2 xi = vec2(randomNext(random), randomNext(random));
        LobeStep next = reflectRay(hit, s, lobe, spread2 * kLobeWidening / limit, radiance,
                                   origin + hit.t * direction, bent, direction, xi);
        going = metal && count < reflections;
        // The lobe's part of what surfaces about it show; matt metal has it in its colour.
        if (!going) next.radiance += next.glossy * s.albedo * s.irradiance;
        vec3 light = throughput * (metal ? next.radiance : radiance);
        shown += count == 0 ? light : vec3(0.0);
        brought += count == 0 ? vec3(0.0) : light;
        most = count == 0 ? limit * faceBrightness(radiance) : most;
        throughput *= next.weight;
        spread2 += next.alpha * next.alpha;
        narrow = next.alpha < kNarrowLobe;
        going = going && throughput.r + throughput.g + throughput.b > 0.0;
#if TRIANGLE_HITS
        bool sharp = rayCone.width >= 0.0 && spread2 <= kTriangleAlpha * kTriangleAlpha;
        rayCone.width = sharp ? rayCone.width + hit.t * rayCone.growth : -1.0;
        rayCone.growth += next.alpha;
#endif
        if (going) {
            origin = next.origin;
            direction = next.direction;
            hit = traceVoxels(origin, direction, 1e9, next.leaves);
        }
        ++count;
    } while (going);
    return shown + brought * min(1.0, most / max(faceBrightness(brought), 1e-12));
#endif
}

// Direction with density cos / pi about n (Malley's method).
vec3 cosineDirection(vec3 n, vec2 xi) {
    vec3 u, v;
    tangentFrame(n, u, v);
    float r = sqrt(xi.x);
    float phi = 2.0 * kGatherPi * xi.y;
    return r * cos(phi) * u + r * sin(phi) * v + sqrt(max(1.0 - xi.x, 0.0)) * n;
}

// One in so many entries of the pool is aimed at with its bounds moved the other way (aimBounds). Were there
// none, rays by the cosine alone would find the edge of a lamp that ends where a voxel does: far from it
// white dots, for one such ray brings as much as a hundred that are aimed. More of them lose more rays.
const int kAimAside = 16;

// A random point on a random bright face, in grid coordinates: face by its flux (faceFlux), point uniform in
// its bounds as rays meet them (aimBounds), seen along its direction k, moved along k onto the plane: density
// (4.11). Returns the face; -1 where that point is not in the bounds. xi.x chooses the face: the pool is
// ordered as voxels are but for close neighbours, so evenly spread numbers are spread over the scene.
int sampleBrightFace(vec3 xi, vec3 origin, out vec3 point, out vec3 normal) {
    uint header = texelFetch(brightFaces, 0).x;
    int entry = int(xi.x * float(BRIGHT_FACE_COUNT));
    int face = int(texelFetch(brightFaces, 1 + entry).x);
    uvec4 r = texelFetch(voxelFaces, 2 * face);
    int axis = int(r.w >> 30);
    normal = octDecode(unpackSnorm2x16(r.x));
    vec3 lower, upper;
    aimBounds(r, normal, origin, entry % kAimAside == 0 ? -1.0 : 1.0, lower, upper);
    vec3 k = vec3(axis == 0, axis == 1, axis == 2);
    vec3 in01 = axis == 0 ? vec3(0.5, xi.yz) : (axis == 1 ? vec3(xi.z, 0.5, xi.y) : vec3(xi.yz, 0.5));
    vec3 p = mix(lower, upper, in01) * (1.0 - k) + 0.5 * k;
    float along = (unpackOffset(r.y) - dot(normal, p - 0.5)) / dot(normal, k);
    p += along * k;
    point = vec3(unpackVoxel(r.w)) + p;
    float height = dot(p, k);
    return header != 0u && height >= dot(lower, k) && height <= dot(upper, k) ? face : -1;
}

// The part of the density at a point of a face that sampleBrightFace has there; 0 where it never aims.
float aimedShare(uvec4 hitTexel, vec3 n, vec3 origin, vec3 at) {
    const float aside = 1.0 / float(kAimAside);
    vec3 lower, upper;
    aimBounds(hitTexel, n, origin, 1.0, lower, upper);
    bool there = all(greaterThanEqual(at, lower)) && all(lessThanEqual(at, upper));
    aimBounds(hitTexel, n, origin, -1.0, lower, upper);
    bool also = all(greaterThanEqual(at, lower)) && all(lessThanEqual(at, upper));
    return (there ? 1.0 - aside : 0.0) + (also ? aside : 0.0);
}

#if FIND_BACKS
// Whether a ray that found `hit` met a surface from behind on its way, beyond kRayBackNear. The way back
// meets from the front what the way there met from behind: one more ray, where asking for both at once costs
// two to three, for then nothing is known of how far empty space reaches.
bool metBackBefore(VoxelHit hit, vec3 origin, vec3 direction) {
    vec3 leave = (mix(vec3(0.0), vec3(gridSize()), greaterThanEqual(direction, vec3(0.0))) - origin) *
                 rayInverse(direction);
    float end = min(hit.t, min(min(leave.x, leave.y), leave.z) - kRayEnd);
    // Of what was met, the other side is not on the way.
    vec3 met = hit.face >= 0 ? faceNormalOf(hit.face) : vec3(0.0);
    return traceVoxels(origin + end * direction, -direction, end - kRayBackNear, met).face >= 0;
}
#endif

// Radiance of a white Lambert surface (irradiance / pi): `cosineRays` by the cosine about the shading normal,
// `lightRays` to bright faces, weighted by the balance heuristic (Veach and Guibas 1995). A miss is the sky.
// A ray to a bright face counts only where it meets that face: else directions with many bright faces
// behind an occluder would be counted twice. `index` numbers the calls with the same seed, 0, 1, 2 ...: their
// directions complement each other; so do those of calls with the same seed whose `shift`, in [0,1)^3, are
// evenly spread. backShare: share of cosine rays that met a surface from behind.
vec3 gatherIrradianceSequence(vec3 originGrid, vec3 geometricNormal, vec3 shadingNormal, int cosineRays,
                              int lightRays, int reflections, float limit, uint seed, vec3 shift, uint index,
                              out float backShare) {
    float inverseFlux = uintBitsToFloat(texelFetch(brightFaces, 0).x);
    uint state = randomHash(seed) ^ randomHash(index * 0x9e3779b9u + 0x85ebca6bu);
    vec3 sum = vec3(0.0);
    float backs = 0.0;
    int count = cosineRays + lightRays;
    int i = 0;
    do {
        bool toLight = i >= cosineRays;
        vec3 target, targetNormal;
        uint lightIndex = index * uint(lightRays) + uint(max(i - cosineRays, 0));
        int aimed = sampleBrightFace(fract(sequencePoint3(seed, lightIndex) + shift.zxy), originGrid, target,
                                     targetNormal);
        vec3 toTarget = target - originGrid;
        float distance = length(toTarget);
        vec2 xi = fract(sequencePoint(seed, index * uint(cosineRays) + uint(i)) + shift.xy);
        vec3 direction = toLight ? toTarget / max(distance, 1e-6) : cosineDirection(shadingNormal, xi);
        float cosine = dot(direction, shadingNormal);
        bool above = cosine > 0.0 && dot(direction, geometricNormal) > 0.0;
        above =
            above && (!toLight || (aimed >= 0 && dot(direction, targetNormal) < 0.0 && inverseFlux > 0.0));
        // What lies beyond the point is of no interest.
        float reach = toLight ? distance + 1.0 : 1e9;
        // Bright face: its pool entry and record. Hit: both halves of its record, steady light if asked for.
        COUNT_LOOKUP(toLight ? 2 : 0);
        VoxelHit hit;
        vec3 radiance = rayRadiance(originGrid, geometricNormal, direction, above ? reach : -1.0,
                                    toLight ? distance : -1.0, reflections, kCosineSpread, limit, state, hit);
        COUNT_LOOKUP(hit.face >= 0 ? 2 + EXACT_DIRECT : 0);
#if FIND_BACKS
        VoxelHit seen = hit;
        if (toLight) seen.t = -1.0;
        if (metBackBefore(seen, originGrid, direction)) {
            hit.face = -1;
            radiance = vec3(0.0);
            backs += toLight ? 0.0 : 1.0;
        }
#endif
        uvec4 met = texelFetch(voxelFaces, 2 * max(hit.face, 0));
        vec3 n = octDecode(unpackSnorm2x16(met.x));
        bool arrived = !toLight || (hit.face >= 0 && hit.face == aimed);
        float brightness = hit.face >= 0 ? faceBrightness(faceRadiance(max(hit.face, 0))) : 0.0;
        float turned = max(-dot(n, direction), 1e-3);
        float lightDensity = brightness * flowShare(n, met.w >> 30) * inverseFlux * hit.t * hit.t / turned;
        vec3 at = originGrid + hit.t * direction - vec3(unpackVoxel(met.w));
        lightDensity = hit.face >= 0 ? lightDensity * aimedShare(met, n, originGrid, at) : 0.0;
        float density = float(cosineRays) * cosine / kGatherPi + float(lightRays) * lightDensity;
        sum += above && arrived ? radiance * (cosine / kGatherPi / max(density, 1e-12)) : vec3(0.0);
        RECORD_RAY(toLight ? PATH_LIGHT_RAY : PATH_COSINE_RAY, originGrid, direction, hit, 1.0,
                   vec3(cosine / kGatherPi / max(density, 1e-12)), radiance, above && arrived);
    } while (++i < count);
    backShare = backs / float(max(cosineRays, 1));
    return sum;
}

vec3 gatherIrradiance(vec3 originGrid, vec3 geometricNormal, vec3 shadingNormal, int cosineRays,
                      int lightRays, uint seed, out float backShare) {
    return gatherIrradianceSequence(originGrid, geometricNormal, shadingNormal, cosineRays, lightRays, 0, 0.0,
                                    seed, vec3(0.0), 0u, backShare);
}
