// SPDX-License-Identifier: MIT
// Radiance along rays through the voxels, and the irradiance estimator that the cache and the pixels share.
//   Ray -> traceRadiance: radiance along the ray, with glossy bounces on metals
//   SurfacePoint -> estimateIrradiance: irradiance / pi by multiple importance sampling
// Method: docs/theory/4c_estimator.md; of metals: docs/theory/4f_glossy.md, "Metals that rays meet".
//
// EXACT_DIRECT 1: point, spot and directional lights are evaluated at the hit by shadow map, not taken from
// the face. Rectangles and emission always come from the face. light::hitLightDefines chooses for a scene.
// FIND_BACK_FACES 1: cosine-sampled rays are traced backwards as well, to find back faces.
// LOBES 1: rays are reflected by metals (traceRadiance). 0: metals reflect like diffuse surfaces.
// GLOSS 1, with EXACT_DIRECT: dielectrics reflect point, spot and directional lights in their lobe.
// CACHED_PART 1: estimateIrradiance() says how much cached light it gathers (`gatheredCached`, `returnedCached`).
// TRIANGLE_HITS 1: rays in smooth lobes hit triangles (lib/triangle_hit.glsl); needs SMOOTH_HITS 1.
// SMOOTH_HITS 1: irradiance and normal of a hit are interpolated over the voxels around it.
//
// Reads the voxels, octant words, irradiance cache, light samples and the frame block; with EXACT_DIRECT also
// the scene's tables and the shadow maps.
#ifndef EXACT_DIRECT
#define EXACT_DIRECT 0
#endif
#ifndef FIND_BACK_FACES
#define FIND_BACK_FACES 0
#endif
#ifndef LOBES
#define LOBES 0
#endif
#ifndef GLOSS
#define GLOSS 0
#endif
#ifndef SMOOTH_HITS
#define SMOOTH_HITS 0
#endif
#ifndef CACHED_PART
#define CACHED_PART 0
#endif
// Not within an #if: a file that is included in a branch not taken is lost to later includers.
// For glass, before the others.
#include "lib/dot.glsl"
#include "lib/scene_tables.glsl"
#include "lib/surface_array.glsl"
// The others.
#include "lib/environment.glsl"
#include "lib/execution.glsl"
#include "lib/ggx_sample.glsl"
#include "lib/glass_tree.glsl"
#include "lib/light_table.glsl"
#include "lib/lit_face.glsl"
#include "lib/random.glsl"
#include "lib/ray_query.glsl"
#include "lib/record_face.glsl"
#include "lib/rect_light.glsl"
#include "lib/rect_tint.glsl"
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
uniform usamplerBuffer voxelFaceMaterials;
#endif
#if SMOOTH_HITS
#define CACHE_NORMALS 1
#include "lib/cache_lookup.glsl"
#endif
uniform usamplerBuffer cachedDirect;
uniform usamplerBuffer lightSamples;

const float kGatherPi = 3.14159265358979;

#include "lib/face_shading.glsl"

// ---- Radiance at a hit ----------------------------------------------------------------------------------

#if EXACT_DIRECT
// Light of the punctual lights that a surface reflects to `r.toEye`. `lobe`: metalness and roughness. Only a
// dielectric has a lobe here, of F0 = 0.04, its alpha^2 wider by `widening`; a metal is as if diffuse.
vec3 reflectedPunctual(vec3 albedo, vec2 lobe, float widening, Receiver r) {
#if GLOSS
    bool glossy = lobe.x == 0.0 && lobe.y > 0.0 && lobe.y <= LOBE_MAX_ROUGHNESS;
    float alpha = max(lobe.y, kMinRoughness) * max(lobe.y, kMinRoughness);
    float roughness = sqrt(min(sqrt(alpha * alpha + 0.04 * widening), 1.0));
    vec3 base = baseOfEvenAlbedo(albedo, lobe.y);
    Brdf b = makeBrdf(base, 0.0, roughness, vec3(0.04), dot(r.normal, r.toEye));
    DirectLight light = DirectLight(vec3(0.0), vec3(0.0));
    addPunctualLights(light, true, r, b);
    vec3 diffuse = light.irradiance * (1.0 / kGatherPi);
    return glossy ? b.diffuse * diffuse + light.specular : albedo * diffuse;
#else
    return albedo *
           (directIrradiance(r.position, r.normal, r.geometricNormal, r.shadowLift) * (1.0 / kGatherPi));
#endif
}
#endif

#if CACHED_PART
vec3 cachedRadiance;  // what of the radiance of the last ray is cached light that its first hit reflects
vec3 gatheredCached;  // what of the last estimate is such light
// The same by cosine-sampled rays alone. They have no noise in common: all faces draw light samples from one pool.
vec3 returnedCached;
#endif
#include "lib/triangle_surface.glsl"

// Outgoing radiance at a hit as if all metals were diffuse; the sky for a miss, over an angle of `width`.
// In: the shading of the face that was hit. Out: its irradiance at the point, and the shading normal there.
// `widening`: of the lobes of dielectrics.
vec3 hitRadiance(Ray ray, VoxelHit hit, float width, float widening, inout FaceShading s,
                 out vec3 shadingNormal) {
    int face = max(hit.face, 0);
#if CACHED_PART
    cachedRadiance = vec3(0.0);
#endif
#if EXECUTION_GPU
    if (hit.face < 0) {
        shadingNormal = vec3(0.0, 0.0, 1.0);
        return skyRadiance(ray.direction, width);
    }
#endif
    vec3 normal = faceNormalOf(face);
    shadingNormal = normal;
#if TRIANGLE_HITS
    if (hit.triangle >= 0) return triangleRadiance(ray, hit, widening, s, shadingNormal);
#endif
#if EXACT_DIRECT || SMOOTH_HITS
    vec3 point = ray.origin + (hit.face >= 0 ? hit.t : 0.0) * ray.direction;
#endif
#if SMOOTH_HITS
    // Interpolate the cache and the normal
    vec4 cached = cachedIrradiance(point, normal, hit.face >= 0, shadingNormal);
    shadingNormal = dot(shadingNormal, shadingNormal) > 0.0 ? normalize(shadingNormal) : normal;
    s.irradiance = cached.a > 0.0 ? cached.rgb : s.irradiance;
#endif
#if CACHED_PART
    cachedRadiance = hit.face >= 0 ? s.albedo * s.irradiance : vec3(0.0);
#endif
#if EXACT_DIRECT
    // Evaluate the punctual lights at the point
    float frontHeight = dot(faceFrontOffset(texelFetch(voxelFaces, face), normal), normal) * grid.voxelSize;
#if NESTED_GRIDS
    frontHeight *= faceEdge(face);
#endif
#if NEAR_TRIANGLES
    // A triangle is where it is: it needs no lift, which might go through the next fold.
    if (hit.near) shadingNormal = normal = hit.normal;
    vec2 lift = hit.near ? vec2(0.0) : kShadowVoxelLift + vec2(0.0, frontHeight);
#else
    vec2 lift = kShadowVoxelLift + vec2(0.0, frontHeight);
#endif
    vec2 lobe = litLobe(texelFetch(litFaces, face).w);
#if GLASS
    veilNear = lift.x > 0.0 ? kVeilNearVoxels * faceEdge(face) * grid.voxelSize : 0.0;
#endif
    vec3 direct =
        reflectedPunctual(s.albedo, lobe, widening,
                          Receiver(worldFromGrid(point), shadingNormal, normal, -ray.direction, lift));
    vec3 radiance = unpackRgb9e5(texelFetch(cachedDirect, face).x) + direct + s.albedo * s.irradiance;
#else
    vec3 radiance = s.directRadiance + s.albedo * s.irradiance;
#endif
    return hit.face >= 0 ? radiance : skyRadiance(ray.direction, width);
}

// ---- Radiance along a path ------------------------------------------------------------------------------

struct PathSettings {
    float targetDistance;  // light-sampled ray: distance of the point it was aimed at, voxels; else negative
    int maxBounces;        // reflections on metals
    float alpha;           // width of the distribution that the ray was drawn from, as a GGX alpha
    float fireflyClamp;    // bound of radiance by reflection, over the diffuse radiance of the first hit
    float skyWidth;        // a ray that hits nothing sees the sky over this angle, rad
};

#include "lib/glossy_bounce.glsl"

// The cosine lobe's width as a GGX alpha.
const float kCosineAlpha = 0.5;
// Reflected rays see the sky over this share of the alpha of all lobes on their way: a few find a small sun.
const float kSkyBlur = 0.5;
// Variance of a lobe's width grows by this share of that of the lobes before it, over PathSettings'
// fireflyClamp: features that few rays would find in a narrow lobe, many rays see blurred.
const float kLobeWidening = 12.0;

// Whether rays come from a lobe that shows lamps by what rays hit (kNarrowLobe). Of all but glass: where a
// surface is seen, its highlights show them.
bool pathStartsNarrow = false;

#if LOBES
// What a path carries from one hit to the next.
struct PathState {
    int bounce;
    vec3 throughput;
    float alpha2;  // variance of all lobes on the way
    bool fromNarrowLobe;
};

struct PathVertex {
    vec3 radiance;  // outgoing, as if the surface were diffuse
    bool metal;     // the path is reflected here
    GlossyBounce next;
    vec3 lobeIrradiance;  // cached light that the lobe reflects as if diffuse, where the path ends here
};

// Evaluates the surface at a hit and samples its lobe.
PathVertex pathVertex(Ray ray, VoxelHit hit, PathSettings path, PathState state, inout uint random) {
    // Evaluate the hit as if it were diffuse
    PathVertex vertex;
    FaceShading s = faceShading(max(hit.face, 0));
    vec3 shadingNormal;
    float skyWidth = state.bounce == 0 ? path.skyWidth : kSkyBlur * sqrt(state.alpha2);
    float widening = state.alpha2 * kLobeWidening / path.fireflyClamp;
    vertex.radiance = hitRadiance(ray, hit, skyWidth, widening, s, shadingNormal);

    // Add the emission of area lights, which narrow lobes do not reflect analytically
    GlossySurface surface = glossySurface(hit, s);
    if (state.fromNarrowLobe && hit.face >= 0 && surface.areaLight) {
        vec3 lamp = unpackEmission(texelFetch(voxelFaceMaterials, max(hit.face, 0)));
#if TRIANGLE_HITS
        lamp = hit.triangle >= 0 ? hitTriangle.lampEmission : lamp;
#endif
        vertex.radiance += lamp;
    }

    // Sample the GGX lobe of a metal
    bool arrived = state.bounce > 0 || path.targetDistance < 0.0 ||
                   abs(hit.t - path.targetDistance) < 0.3 * faceEdge(max(hit.face, 0));
    vertex.metal = surface.reflects && arrived;
    vec2 xi = vec2(randomNext(random), randomNext(random));
#if EXECUTION_GPU
    if (!vertex.metal) {  // the path ends here, by its radiance alone
        vertex.next = GlossyBounce(vec3(0.0), ray, vec3(0.0), 0.0, 0.0);
        vertex.lobeIrradiance = vec3(0.0);
        return vertex;
    }
#endif
    vertex.next =
        sampleGlossyBounce(ray, hit, s, surface, GlossySample(widening, vertex.radiance, shadingNormal, xi));
    vertex.lobeIrradiance = vertex.next.specularShare * s.albedo * s.irradiance;
    return vertex;
}
#endif

// Radiance along a ray (hitRadiance), and its first hit. With LOBES the path is reflected by metals, up to
// maxBounces times. At its end a metal reflects lights in its lobe, and all other light as if diffuse.
//
// Noise of long paths is bounded in two ways: lobes are widened from bounce to bounce (path space
// regularization, Kaplanyan and Dachsbacher 2013), and a firefly clamp bounds reflected radiance. Both biases
// vanish as fireflyClamp, which grows with the number of samples, goes to infinity.
vec3 traceRadiance(Ray ray, PathSettings path, inout uint random, out VoxelHit firstHit) {
#if !LOBES
    firstHit = traceVoxels(ray);
    FaceShading s = faceShading(max(firstHit.face, 0));
    vec3 shadingNormal;
    float widening = path.alpha * path.alpha * kLobeWidening / path.fireflyClamp;
    return hitRadiance(ray, firstHit, path.skyWidth, widening, s, shadingNormal);
#else
    vec3 firstRadiance = vec3(0.0);
    vec3 reflectedRadiance = vec3(0.0);
    float maxReflected = 0.0;
    PathState state = PathState(0, vec3(1.0), path.alpha * path.alpha, pathStartsNarrow);
    bool continues;
    do {
        // Intersect the voxels: here alone, as a kernel that has this twice is half as large again
        VoxelHit hit = traceVoxels(ray);
        bool first = state.bounce == 0;
        if (first) firstHit = hit;
#if CACHED_PART
        vec3 cachedFirst = cachedRadiance;
#endif

        // Evaluate the surface and sample its lobe
        PathVertex vertex = pathVertex(ray, hit, path, state, random);
        GlossyBounce next = vertex.next;
        continues = vertex.metal && state.bounce < path.maxBounces;
#if CACHED_PART
        cachedRadiance = !first ? cachedFirst : vertex.metal ? vec3(0.0) : cachedRadiance;
#endif

        // Add the contribution; the last metal reflects the cached light as if diffuse
        if (!continues) next.radiance += vertex.lobeIrradiance;
        vec3 contribution = state.throughput * (vertex.metal ? next.radiance : vertex.radiance);
        firstRadiance += first ? contribution : vec3(0.0);
        reflectedRadiance += first ? vec3(0.0) : contribution;
        maxReflected = first ? path.fireflyClamp * brightness(vertex.radiance) : maxReflected;

        // Update the throughput and the width of the path's lobe
        state.throughput *= next.weight;
        state.alpha2 += next.alpha * next.alpha;
        state.fromNarrowLobe = next.alpha < kNarrowLobe;
        continues = continues && state.throughput.r + state.throughput.g + state.throughput.b > 0.0;
#if TRIANGLE_HITS
        bool sharp = rayCone.width >= 0.0 && state.alpha2 <= kTriangleAlpha * kTriangleAlpha;
        rayCone.width = sharp ? rayCone.width + hit.t * rayCone.growth : -1.0;
        rayCone.growth += next.alpha;
#endif

        ray = next.ray;
        ++state.bounce;
    } while (continues);

    // Clamp fireflies
    return firstRadiance +
           reflectedRadiance * min(1.0, maxReflected / max(brightness(reflectedRadiance), 1e-12));
#endif
}

// Radiance along a ray as glass leaves it; `hit` is where it ends.
vec3 throughGlass(vec3 radiance, Ray ray, VoxelHit hit) {
#if GLASS
    if (ray.tMax > 0.0 && radiance.r + radiance.g + radiance.b > 0.0)
        radiance *= glassTransmittance(worldFromGrid(ray.origin), ray.direction,
                                       (hit.face >= 0 ? hit.t : 1e9) * grid.voxelSize, kAnyBend, false);
#endif
    return radiance;
}

// ---- The irradiance estimator ---------------------------------------------------------------------------

#include "lib/light_sample.glsl"
#if ENVIRONMENT
#include "lib/environment_sample.glsl"
#endif

// Direction of density cos / pi about n (Malley's method).
vec3 cosineDirection(vec3 n, vec2 xi) {
    vec3 u, v;
    tangentFrame(n, u, v);
    float r = sqrt(xi.x);
    float phi = 2.0 * kGatherPi * xi.y;
    return r * cos(phi) * u + r * sin(phi) * v + sqrt(max(1.0 - xi.x, 0.0)) * n;
}

#if FIND_BACK_FACES
// Whether a ray that found `hit` passed a back face on its way, beyond kRayBackNear. Traced backwards, a ray
// meets those faces from the front. One more ray is cheaper than testing both sides at once, which costs two
// to three: then octant words cannot skip empty space.
bool passedBackFace(Ray ray, VoxelHit hit) {
#if NESTED_GRIDS
    float leave = levelSpan(ray, rayInverse(ray.direction), coarsestLevel()).y;
    float end = min(hit.t, leave - kRayEnd * levelPlace(coarsestLevel()).w);
    float near = kRayBackNear * voxelEdgeAt(ray.origin);
#else
    vec3 leave = (mix(vec3(0.0), vec3(gridSize()), greaterThanEqual(ray.direction, vec3(0.0))) - ray.origin) *
                 rayInverse(ray.direction);
    float end = min(hit.t, min(min(leave.x, leave.y), leave.z) - kRayEnd);
    const float near = kRayBackNear;
#endif
    // The other side of the surface that was hit does not count.
    vec3 hitNormal = hit.face >= 0 ? faceNormalOf(hit.face) : vec3(0.0);
    Ray backwards = Ray(ray.origin + end * ray.direction, -ray.direction, end - near, hitNormal);
    return traceVoxels(backwards).face >= 0;
}
#endif

// Where irradiance is estimated, in grid coordinates.
struct SurfacePoint {
    vec3 origin;  // of the rays
    vec3 geometricNormal;
    vec3 shadingNormal;
};

// Which part of the quasirandom sequences an estimate uses. Estimates with the same seed complement each
// other if their indices are 0, 1, 2 ..., or if their shifts (Cranley-Patterson rotations) are evenly spread.
struct SequenceState {
    uint seed;
    uint index;
    vec3 shift;  // in [0,1)^3
};

struct EstimatorSettings {
    int cosineSamples;
    int lightSamples;
    int maxBounces;
    float fireflyClamp;
};

const int kTowardsSky = -2;

// Share of the light-sampled rays that go to the surroundings, not to faces.
float skySampleShare(float inverseFlux) {
#if ENVIRONMENT
    return inverseFlux > 0.0 ? kEnvironmentShare : 1.0;
#else
    return 0.0;
#endif
}

// A ray drawn by one of the two techniques.
struct SampledRay {
    Ray ray;
    float cosine;          // about the shading normal
    bool valid;            // above the surface, and towards the front of a light face
    int lightFace;         // kTowardsSky: none, the surroundings
    float targetDistance;  // light-sampled ray: distance of its point; else negative
};

// Ray `i` of an estimate: cosine-sampled ones first, then light-sampled ones.
SampledRay sampleRay(SurfacePoint point, EstimatorSettings settings, SequenceState sequence, int i,
                     float inverseFlux) {
    bool lightSampled = i >= settings.cosineSamples;

    // Sample a point on a light face
    uint lightIndex = sequence.index * uint(settings.lightSamples) + uint(max(i - settings.cosineSamples, 0));
    vec3 xiLight = fract(sequencePoint3(sequence.seed, lightIndex) + sequence.shift.zxy);
#if ENVIRONMENT
    float skyShare = skySampleShare(inverseFlux);
    bool towardsSky = lightSampled && xiLight.x < skyShare;
    vec3 skyDirection = environmentDirection(vec2(xiLight.x / skyShare, xiLight.y));
    xiLight.x = max(xiLight.x - skyShare, 0.0) / max(1.0 - skyShare, 1e-6);
#else
    const bool towardsSky = false;
#endif
    LightSample light = LightSample(-1, point.origin, vec3(0.0));
    if (EXECUTION_GPU == 0 || lightSampled) light = sampleLightFace(xiLight, point.origin);
    vec3 toLight = light.point - point.origin;
    float lightDistance = length(toLight);

    // Sample the cosine lobe
    uint cosineIndex = sequence.index * uint(settings.cosineSamples) + uint(i);
    vec2 xi = fract(sequencePoint(sequence.seed, cosineIndex) + sequence.shift.xy);
    vec3 direction =
        lightSampled ? toLight / max(lightDistance, 1e-6) : cosineDirection(point.shadingNormal, xi);

#if ENVIRONMENT
    direction = towardsSky ? skyDirection : direction;
#endif

    // Reject directions below the surface, and light faces that are turned away
    float cosine = dot(direction, point.shadingNormal);
    bool valid = cosine > 0.0 && dot(direction, point.geometricNormal) > 0.0;
    valid = valid && (!lightSampled || towardsSky ||
                      (light.face >= 0 && dot(direction, light.normal) < 0.0 && inverseFlux > 0.0));

    // End a light-sampled ray behind its point
    bool ends = lightSampled && !towardsSky;
    float tMax = ends ? lightDistance + faceEdge(max(light.face, 0)) : 1e9;
    Ray ray = Ray(point.origin, direction, valid ? tMax : -1.0, point.geometricNormal);
    return SampledRay(ray, cosine, valid, towardsSky ? kTowardsSky : light.face,
                      lightSampled ? (towardsSky ? 1e9 : lightDistance) : -1.0);
}

// A light sample counts only if it reached its own face: others are occluded, or their density is that of
// another face. One towards the surroundings counts if it met nothing.
bool reachesItsLight(SampledRay drawn, VoxelHit hit) {
    bool reached = hit.face >= 0 ? hit.face == drawn.lightFace : drawn.lightFace == kTowardsSky;
#if NEAR_TRIANGLES
    // Light samples lie on plane pieces: near by, only cosine-sampled rays count.
    reached = reached && !hit.near;
#endif
    return reached;
}

// Density per steradian among light-sampled rays, given what the ray hit; `skyPdf`: of its direction among those
// that go to the surroundings.
float lightPdf(Ray ray, VoxelHit hit, float inverseFlux, float skyPdf) {
    float skyShare = skySampleShare(inverseFlux);
    float pdf = (1.0 - skyShare) * lightFacePdf(ray, hit, inverseFlux);
    pdf = hit.face >= 0 ? pdf : skyShare * skyPdf;
#if NEAR_TRIANGLES
    pdf = hit.near ? 0.0 : pdf;
#endif
    return pdf;
}

// Irradiance / pi at a point (4.12): cosine-sampled and light-sampled rays, combined by the balance heuristic
// (Veach and Guibas 1995). Light-sampled rays go to faces, and to the picture of the surroundings where there
// is one. A miss sees the sky. backFaceShare: share of cosine-sampled rays that passed a back face.
vec3 estimateIrradiance(SurfacePoint point, EstimatorSettings settings, SequenceState sequence,
                        out float backFaceShare) {
    float inverseFlux = uintBitsToFloat(texelFetch(lightSamples, 0).x);
    uint random = randomHash(sequence.seed) ^ randomHash(sequence.index * 0x9e3779b9u + 0x85ebca6bu);
    vec3 sum = vec3(0.0);
#if CACHED_PART
    gatheredCached = returnedCached = vec3(0.0);
#endif
    float backFaces = 0.0;
    int count = settings.cosineSamples + settings.lightSamples;
    int i = 0;
    do {
        // Draw a ray
        bool lightSampled = i >= settings.cosineSamples;
        SampledRay drawn = sampleRay(point, settings, sequence, i, inverseFlux);
        COUNT_LOOKUP(lightSampled ? 2 : 0);  // the light sample and its record

        // Intersect the voxels and follow glossy bounces
        VoxelHit hit;
        PathSettings path =
            PathSettings(drawn.targetDistance, settings.maxBounces, kCosineAlpha, settings.fireflyClamp, 0.0);
        vec3 radiance = traceRadiance(drawn.ray, path, random, hit);
        COUNT_LOOKUP(hit.face >= 0 ? 2 + EXACT_DIRECT : 0);  // the record, and its cached direct light
#if CACHED_PART
        vec3 cachedShare = min(cachedRadiance / max(radiance, 1e-12), 1.0);
#endif
        float skyPdf = 0.0;
#if ENVIRONMENT
        vec3 cell = environmentCell(drawn.ray.direction, skyPdf);
        radiance = hit.face >= 0 ? radiance : cell;
#endif
        radiance = throughGlass(radiance, drawn.ray, hit);
#if FIND_BACK_FACES
        // Discard rays that passed a back face
        VoxelHit searched = hit;
        if (lightSampled) searched.t = -1.0;
        if (passedBackFace(drawn.ray, searched)) {
            hit.face = -1;
            radiance = vec3(0.0);
            backFaces += lightSampled ? 0.0 : 1.0;
        }
#endif

        // Compute the MIS weight: both techniques' densities for this direction
        bool reached = !lightSampled || reachesItsLight(drawn, hit);
        float pdfSum = float(settings.cosineSamples) * drawn.cosine / kGatherPi +
                       float(settings.lightSamples) * lightPdf(drawn.ray, hit, inverseFlux, skyPdf);
        float misWeight = drawn.cosine / kGatherPi / max(pdfSum, 1e-12);

        // Add the contribution
        vec3 contribution = drawn.valid && reached ? radiance * misWeight : vec3(0.0);
        sum += contribution;
#if CACHED_PART
        gatheredCached += contribution * cachedShare;
        if (!lightSampled && drawn.valid)
            returnedCached += radiance * cachedShare / float(settings.cosineSamples);
#endif
        RECORD_RAY(lightSampled ? PATH_LIGHT_RAY : PATH_COSINE_RAY, drawn.ray, hit, 1.0, vec3(misWeight),
                   radiance, drawn.valid && reached);
    } while (++i < count);
    backFaceShare = backFaces / float(max(settings.cosineSamples, 1));
    return sum;
}
