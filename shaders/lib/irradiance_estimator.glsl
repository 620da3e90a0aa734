// SPDX-License-Identifier: MIT
// The irradiance estimator that the cache and the pixels share: SurfacePoint -> estimateIrradiance, irradiance / pi by
// multiple importance sampling. Part of lib/voxel_light.glsl. Method: docs/theory/4c_estimator.md.
// PIXEL_SHIFTS 1: shifts are those of pixels, packed (lib/pixel_shift.glsl).
#ifndef PIXEL_SHIFTS
#define PIXEL_SHIFTS 0
#endif
#include "lib/cached_part.glsl"
#include "lib/dot.glsl"
#include "lib/light_sample.glsl"
#include "lib/sky_guide.glsl"
#if PIXEL_SHIFTS
#include "lib/pixel_shift.glsl"
#endif
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
#if PIXEL_SHIFTS
    uint shift;  // of lib/pixel_shift.glsl
#else
    vec3 shift;  // in [0,1)^3
#endif
    uint ofBounces;  // seed of the random numbers after the first hit
};

vec3 shiftOf(SequenceState sequence) {
#if PIXEL_SHIFTS
    return unpackShift(sequence.shift);
#else
    return sequence.shift;
#endif
}

struct EstimatorSettings {
    int cosineSamples;
    int lightSamples;
    int maxBounces;
    float fireflyClamp;
};

const int kTowardsSky = -2;

// Light-sampled rays that go to the surroundings, not to faces.
struct SkySamples {
    float share;  // of light-sampled rays
    int row;      // of the guide
};

SkySamples skySamplesAt(SurfacePoint point, LightRow lights) {
    SkySamples sky = SkySamples(0.0, 0);
#if ENVIRONMENT
    sky.share = kEnvironmentShare;
#elif GUIDED_RAYS
    sky.row = skyRowAt(point.origin, point.shadingNormal);
    sky.share = skyShareOfRow(sky.row);
#endif
    if (sky.share > 0.0 && lights.inverseFlux <= 0.0) sky.share = 1.0;
    return sky;
}

#if ENVIRONMENT || GUIDED_RAYS
#define SKY_SAMPLES 1
#else
#define SKY_SAMPLES 0
#endif

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
                     LightRow lights, SkySamples sky) {
    bool lightSampled = i >= settings.cosineSamples;

    // Sample a point on a light face
    uint lightIndex = sequence.index * uint(settings.lightSamples) + uint(max(i - settings.cosineSamples, 0));
    vec3 xiLight = fract(sequencePoint3(sequence.seed, lightIndex) + shiftOf(sequence).zxy);
#if SKY_SAMPLES
    bool towardsSky = lightSampled && xiLight.x < sky.share;
    vec3 xiSky = vec3(xiLight.x / max(sky.share, 1e-6), xiLight.yz);
#if ENVIRONMENT
    vec3 skyDirection = environmentDirection(xiSky.xy);
#else
    vec3 skyDirection = guidedDirection(sky.row, xiSky);
#endif
    xiLight.x = max(xiLight.x - sky.share, 0.0) / max(1.0 - sky.share, 1e-6);
#else
    const bool towardsSky = false;
#endif
    LightSample light = LightSample(-1, point.origin, vec3(0.0));
    if (EXECUTION_GPU == 0 || lightSampled) light = sampleLightFace(xiLight, point.origin, lights);
    vec3 toLight = light.point - point.origin;
    float lightDistance = length(toLight);

    // Sample the cosine lobe
    uint cosineIndex = sequence.index * uint(settings.cosineSamples) + uint(i);
    vec2 xi = fract(sequencePoint(sequence.seed, cosineIndex) + shiftOf(sequence).xy);
    vec3 direction =
        lightSampled ? toLight / max(lightDistance, 1e-6) : cosineDirection(point.shadingNormal, xi);

#if SKY_SAMPLES
    direction = towardsSky ? skyDirection : direction;
#endif

    // Reject directions below the surface, and light faces that are turned away
    float cosine = dot(direction, point.shadingNormal);
    bool valid = cosine > 0.0 && dot(direction, point.geometricNormal) > 0.0;
    valid = valid && (!lightSampled || towardsSky ||
                      (light.face >= 0 && dot(direction, light.normal) < 0.0 && lights.inverseFlux > 0.0));

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

// Density per steradian among light-sampled rays, given what the ray hit; `picturePdf`: of its direction among those
// that go by the picture of the surroundings.
float lightPdf(Ray ray, VoxelHit hit, LightRow lights, SkySamples sky, float picturePdf) {
    float pdf = (1.0 - sky.share) * lightFacePdf(ray, hit, lights);
#if ENVIRONMENT
    pdf = hit.face >= 0 ? pdf : sky.share * picturePdf;
#elif GUIDED_RAYS
    pdf = hit.face >= 0 ? pdf : sky.share * guidedPdf(sky.row, ray.direction);
#endif
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
    LightRow lights = lightRowAt(point.origin, point.shadingNormal);
    SkySamples sky = skySamplesAt(point, lights);
    uint random = randomHash(sequence.ofBounces) ^ randomHash(sequence.index * 0x9e3779b9u + 0x85ebca6bu);
    vec3 sum = vec3(0.0);
    BEGIN_CACHED();
    float backFaces = 0.0;
    int count = settings.cosineSamples + settings.lightSamples;
    int i = 0;
    do {
        // Draw a ray
        bool lightSampled = i >= settings.cosineSamples;
        SampledRay drawn = sampleRay(point, settings, sequence, i, lights, sky);
        COUNT_LOOKUP(lightSampled ? 3 : 0);  // its cluster, the light sample and its record

        // Intersect the voxels and follow glossy bounces
        VoxelHit hit;
        PathSettings path = PathSettings(drawn.targetDistance, settings.maxBounces, kCosineAlpha,
                                         settings.fireflyClamp, 0.0, 0.0);
        vec3 radiance = traceRadiance(drawn.ray, path, random, hit);
        COUNT_LOOKUP(hit.face >= 0 ? 2 + EXACT_DIRECT : 0);  // the record, and its cached direct light
        float picturePdf = 0.0;
#if ENVIRONMENT
        vec3 cell = environmentCell(drawn.ray.direction, picturePdf);
        radiance = hit.face >= 0 ? radiance : cell;
#endif
        radiance = throughGlass(radiance, drawn.ray, hit);
#if FIND_BACK_FACES
        // Count rays that passed a back face
        VoxelHit searched = hit;
        if (lightSampled) searched.t = -1.0;
        if (passedBackFace(drawn.ray, searched)) backFaces += 1.0;
#endif

        LEARN_SKY(drawn.valid && !lightSampled, hit, drawn.ray.direction, radiance);

        // Compute the MIS weight: both techniques' densities for this direction
        bool reached = !lightSampled || reachesItsLight(drawn, hit);
        float pdfSum = float(settings.cosineSamples) * drawn.cosine / kGatherPi +
                       float(settings.lightSamples) * lightPdf(drawn.ray, hit, lights, sky, picturePdf);
        float misWeight = drawn.cosine / kGatherPi / max(pdfSum, 1e-12);

        // Add the contribution
        vec3 contribution = drawn.valid && reached ? radiance * misWeight : vec3(0.0);
        sum += contribution;
        ADD_CACHED(contribution,
                   drawn.valid && !lightSampled ? radiance / float(settings.cosineSamples) : vec3(0.0));
        RECORD_RAY(lightSampled ? PATH_LIGHT_RAY : PATH_COSINE_RAY, drawn.ray, hit, 1.0, vec3(misWeight),
                   radiance, drawn.valid && reached);
    } while (++i < count);
    backFaceShare = backFaces / float(max(settings.cosineSamples, 1));
    return sum;
}
