#version 450 core
// SPDX-License-Identifier: MIT
// G-buffer -> radiance in the specular lobe over the lobe's directional albedo, by rays along visible normals
// of GGX (Heitz 2018, "Sampling the GGX Distribution of Visible Normals"), averaged with the passes and
// frames before. What a ray meets shows its interpolated cached light, so that mirrors show no voxels.
// TRIANGLE_HITS 1: rays into smooth lobes meet triangles, not plane pieces (lib/triangle_hit.glsl); below the least
// roughness of a lobe they go exactly the mirrored way.
// AIMED_RAYS 1: wide lobes aim as many rays again at voxels that send light, combined by the balance heuristic.
// COUNT_LOOKUPS 1: adds what rays look up to the counters, shadow maps at hits included.
//
// LOBE_LISTED 1: the listed pixels (gather/lobe_select.comp.glsl), by an indirect dispatch of LOBE_GROUPS_X
// groups in x; the others are the caller's to clear. 0: all pixels.
#ifndef LOBE_LISTED
#define LOBE_LISTED 0
#endif
#ifndef AIMED_RAYS
#define AIMED_RAYS 0
#endif
#define SMOOTH_HITS 1
layout(local_size_x = 8, local_size_y = 8) in;
#include "lib/dot.glsl"
#include "lib/frame_block.glsl"
#include "lib/ggx_sample.glsl"
#include "lib/loops.glsl"
#include "lib/surface_array.glsl"
#define LOBE_LIST_ACCESS readonly
#include "lib/lobe_list.glsl"
#include "lib/pixel_shift.glsl"
#include "lib/temporal.glsl"
#include "lib/voxel_light.glsl"
layout(rgba32ui) writeonly uniform uimage2D result;

// The radius of the solid angle that is a ray's among all that are averaged (Krivanek and Colbert 2008,
// "Real-time Shading with Filtered Importance Sampling"): at the rim of the lobe it is wide.
float rayFootprint(Brdf b, Surface s, vec3 direction) {
    float rays = float(pixelRays.rays) * pixelRays.longestMean;
    return inversesqrt(kPi * rays * max(lobePdf(b, s.normal, s.toEye, direction), 1e-6));
}

vec3 reflectedDirection(Brdf b, Surface s, vec2 xi, out vec3 weight) {
    vec3 direction = lobeDirection(b, s.normal, s.toEye, xi, weight);
#if TRIANGLE_HITS
    // An ideal mirror has no lobe; the surface keeps 16 bits of its roughness.
    if (s.roughness < kMinRoughness - 1e-5) direction = reflect(-s.toEye, s.normal);
#endif
    // A bent normal can mirror into the surface, which shows nothing (docs/theory/4f_glossy.md).
    if (dot(direction, s.geometricNormal) <= 0.0) weight = vec3(0.0);
    return direction;
}

// Of a distant eye, voxels: what a ray that meets plane pieces starts above them.
const float kStartMost = 0.05;

// Where a ray starts. One that meets triangles starts on its own line: moved off its surface by part of a voxel, flat
// water would mirror what stands as much higher. A step towards the eye keeps pixels in corners out of the other wall.
vec3 lobeRayOrigin(Surface s, Brdf b, vec3 direction) {
#if TRIANGLE_HITS
    if (b.alpha <= kTriangleAlpha) {
        float towards = dot(direction, s.geometricNormal);
        float most = kStartMost * grid.voxelSize / kStartDepth;
#if NESTED_GRIDS
        most *= voxelEdgeAt(gridFromWorld(s.position));
#endif
        float depth = min(s.depth, most);
        // In a corner as far towards the eye as along the ray, which else would start behind the other wall.
        float along = startOnLine(towards, depth);
        return gridFromWorld(s.position + (kStartDepth * depth + along) * s.toEye + along * direction);
    }
#endif
    return seenRayOrigin(gridFromWorld(s.position), s.geometricNormal, s.toEye);
}

// A ray drawn by one of the two techniques.
struct LobeRay {
    Ray ray;
    vec3 weight;    // BRDF times cosine over the density of the lobe
    int lightFace;  // a face of the voxel that it is aimed at; -1: none
};

// `shift`: of the sequence that all pixels share, so that neighbours complement each other. Within the 64th that it tells
// they are random, by 14 bits of it: lobes that show one small thing to all pixels do not show it 64 times.
LobeRay sampleLobe(Surface s, Brdf b, uint shift, uint number) {
    vec2 within = vec2((shift >> 12) & 127u, (shift >> 19) & 127u) / 8192.0;
    vec2 xi = fract(sequencePoint(kPixelSequence, number) + unpackShift(shift).xy + within);
    vec3 weight;
    vec3 direction = reflectedDirection(b, s, xi, weight);
    return LobeRay(Ray(lobeRayOrigin(s, b, direction), direction, 1e9, s.geometricNormal), weight, -1);
}

// ---- Rays aimed at voxels that send light ----------------------------------------------------------------------
// A lamp of few voxels is found by few rays of a wide lobe (docs/theory/4f_glossy.md). A voxel is chosen by the flux of
// its faces, and a direction evenly among those that meet the sphere about it. So whatever a lobe's ray meets in a voxel,
// an aimed one may meet.

// The cosine of half the angle of a voxel's sphere; 1: the ray starts within it.
float sphereCosine(float distance, float edge) {
    float sine = min(0.8660254 * edge / max(distance, 1e-6), 1.0);
    return sine < 1.0 ? sqrt(1.0 - sine * sine) : 1.0;
}

// Place and edge of a face's voxel, the middle in grid coordinates.
vec4 faceCube(uvec4 hitTexel) {
#if NESTED_GRIDS
    vec4 place = voxelPlace(hitTexel.w);
    return vec4(place.xyz + 0.5 * place.w, place.w);
#else
    return vec4(vec3(unpackVoxel(hitTexel.w)) + 0.5, 1.0);
#endif
}

// Whether two places of the table are faces of one voxel.
bool shareVoxel(int a, int b) {
    int last = textureSize(voxelFaces) - 1;
    uint bits = texelFetch(voxelFaces, clamp(a, 0, last)).w ^ texelFetch(voxelFaces, clamp(b, 0, last)).w;
    return min(a, b) >= 0 && max(a, b) <= last && (bits & 0x3fffffffu) == 0u;
}

// Density per steradian with which aimed rays that meet this voxel have this direction.
float aimedPdf(vec3 origin, int face, float inverseFlux) {
    vec4 cube = faceCube(texelFetch(voxelFaces, max(face, 0)));
    float cosine = sphereCosine(length(cube.xyz - origin), cube.w);
    float flux = 0.0;
    int other = face - 5;
    do {
        int one = clamp(other, 0, textureSize(voxelFaces) - 1);
        float of = faceFlux(texelFetch(voxelFaces, one), outgoingRadiance(one));
        flux += shareVoxel(other, face) ? of : 0.0;
    } while (++other <= face + 5);
    return cosine < 1.0 ? flux * inverseFlux / (2.0 * kGatherPi * (1.0 - cosine)) : 0.0;
}

LobeRay aimAtVoxel(Surface s, Brdf b, uint seed, uint number) {
    vec3 xiLight = sequencePoint3(seed, number);
    int face = int(drawLightFace(xiLight.x, LIGHT_PLACE_OF_ALL) & ~LIGHT_MOVED);
    vec4 cube = faceCube(texelFetch(voxelFaces, face));
    vec3 origin = seenRayOrigin(gridFromWorld(s.position), s.geometricNormal, s.toEye);
    vec3 towards = cube.xyz - origin;
    float distance = length(towards);
    float cosine = sphereCosine(distance, cube.w);
    float z = mix(1.0, cosine, xiLight.y);
    float r = sqrt(max(1.0 - z * z, 0.0));
    vec3 u, v;
    tangentFrame(towards / max(distance, 1e-6), u, v);
    float angle = 2.0 * kGatherPi * xiLight.z;
    vec3 direction = normalize(r * cos(angle) * u + r * sin(angle) * v + z * towards / max(distance, 1e-6));
    bool valid = cosine < 1.0 && dot(direction, s.geometricNormal) > 0.0;
    vec3 halfway = normalize(s.toEye + direction);
    vec3 weight = lobeWeight(b, dot(s.normal, direction), max(dot(s.toEye, halfway), 0.0));
    Ray ray = Ray(lobeRayOrigin(s, b, direction), direction, distance + cube.w, s.geometricNormal);
    return LobeRay(ray, valid ? weight : vec3(0.0), face);
}

// The weight of a ray's technique by the balance heuristic, both having as many rays.
float techniqueShare(Surface s, Brdf b, LobeRay drawn, VoxelHit hit, float inverseFlux) {
    bool reached = drawn.lightFace < 0 || (hit.face >= 0 && shareVoxel(drawn.lightFace, hit.face));
    vec3 origin = seenRayOrigin(gridFromWorld(s.position), s.geometricNormal, s.toEye);
    float pdf = lobePdf(b, s.normal, s.toEye, drawn.ray.direction);
    float aimed = hit.face >= 0 ? aimedPdf(origin, hit.face, inverseFlux) : 0.0;
    return reached ? pdf / max(pdf + aimed, 1e-12) : 0.0;
}

// Of rays that are aimed at voxels: one over the flux of all faces. 0: the pixel has none.
float aimedInverseFlux(Brdf b, bool glossy) {
#if AIMED_RAYS
    return glossy && b.alpha >= kNarrowLobe ? uintBitsToFloat(texelFetch(lightSamples, 0).x) : 0.0;
#else
    return 0.0;
#endif
}

// What the pixel would show if it were diffuse and white; 0 where the cache knows nothing.
float diffuseBrightness(Surface s, bool wanted) {
    return brightness(cachedIrradiance(gridFromWorld(s.position), s.geometricNormal, wanted).rgb);
}

// Of what a ray of a wide lobe brings, the part by which it moves the mean no more than all light that the surface gets
// would (light/firefly_clamp.h). Where a lobe and the aimed rays both are thin, one ray in thousands brings a lamp's rim, or
// a lamp's highlight in other metal.
float clampedShare(Brdf b, Surface s, LobeRay drawn, vec3 brought, float ofDiffuse) {
    float gain = max(kPi * lobePdf(b, s.normal, s.toEye, drawn.ray.direction), 1.0);
    float most = pixelRays.fireflyClamp * gain * ofDiffuse;
    return ofDiffuse > 0.0 ? min(1.0, most / max(brightness(brought), 1e-12)) : 1.0;
}

// Ray `i` of a pixel: first those of the lobe, then aimed ones.
LobeRay drawRay(Surface s, Brdf b, uint seed, uint shift, int i) {
    int rays = int(pixelRays.rays);
    uint first = pixelRays.pass * pixelRays.rays;
    LobeRay drawn;
#if AIMED_RAYS
    if (i >= rays)
        drawn = aimAtVoxel(s, b, seed, first + uint(i - rays));
    else
#endif
        drawn = sampleLobe(s, b, shift, first + uint(i));
    return drawn;
}

// The width of a pixel's rays, where they meet triangles.
void setRayCone(Surface s, Brdf b) {
#if TRIANGLE_HITS
    float pixelAngle = 2.0 * length(frame.viewUp) / float(frame.height);
    // Parallel rays are as wide everywhere.
    float width = pixelAngle * mix(s.depth, 1.0, frame.parallel);
    rayCone = RayCone(b.alpha <= kTriangleAlpha ? width * pixelRays.inverseVoxelSize : -1.0,
                      pixelAngle * (1.0 - frame.parallel) + b.alpha);
#endif
}

// How many passes are averaged. What a smooth surface shows moves otherwise than the surface: means are short where it or
// the eye moves.
float longestMean(ivec2 pixel, Surface s, Brdf b, float light) {
    vec3 axis = 2.0 * dot(s.normal, s.toEye) * s.normal - s.toEye;
    float ofLobe =
        reflectsTheSame(pixel, s) ? longestLobeMean(s.position, axis, max(2.0 * b.alpha, 0.02), light) : 1.0;
    return mix(ofLobe, longestMeanAt(s.position, light), smoothstep(0.1, 0.5, s.roughness));
}

void main() {
#if LOBE_LISTED
    ivec2 pixel = listedPixel(imageSize(result));
#else
    ivec2 pixel = INVOCATION_PIXEL;
#endif
    Surface s;
    bool seen = fetchSurface(min(pixel, imageSize(result) - 1), s);
    Brdf b = makeBrdf(s.albedo, s.metallic, s.roughness, s.dielectricF0, dot(s.normal, s.toEye));
    bool glossy = hasLobe(s, seen, pixelRays.specularLimit);
    uint seed = randomHash(uint(pixel.x) | uint(pixel.y) << 16) ^ 0x5bd1e995u;
    uint random = randomHash(seed) ^ randomHash(pixelRays.pass * 0x9e3779b9u + 0x85ebca6bu);
    uint shift = pixelShift(uvec2(pixel), seed);
    float inverseFlux = aimedInverseFlux(b, glossy);
    bool aims = inverseFlux > 0.0;
    int count = int(pixelRays.rays) * (aims ? 2 : 1);
    vec3 sum = vec3(0.0);
    int i = 0;
    do {
        // Draw a ray
        LobeRay drawn = drawRay(s, b, seed, shift, i);
        bool counts = glossy && drawn.weight.r + drawn.weight.g + drawn.weight.b > 0.0;
        drawn.ray.tMax = counts ? drawn.ray.tMax : -1.0;
        setRayCone(s, b);

        // Follow it
        VoxelHit hit;
        float footprint = rayFootprint(b, s, drawn.ray.direction);
        PathSettings path =
            PathSettings(-1.0, counts ? int(pixelRays.reflections) : 0, b.alpha, pixelRays.fireflyClamp,
                         footprint, footprint * inversesqrt(kPixelsTogether));
        vec3 radiance = throughGlass(traceRadiance(drawn.ray, path, random, hit), drawn.ray, hit);

        vec3 weight = drawn.weight * (aims ? techniqueShare(s, b, drawn, hit, inverseFlux) : 1.0);
        // Behind the walk, whose registers it can have.
        float ofDiffuse = diffuseBrightness(s, counts && b.alpha >= kNarrowLobe);
        weight *= clampedShare(b, s, drawn, weight * radiance, ofDiffuse);
        sum += weight * radiance;
        COUNT_LOOKUP(hit.face >= 0 ? 2 + EXACT_DIRECT : 0);
        if (glossy)
            RECORD_RAY(PATH_SPECULAR_RAY, drawn.ray, hit, 1.0,
                       weight / (float(pixelRays.rays) * max(b.albedo, 1e-6)), radiance, counts);
    } while (++i < count);
    vec3 value = glossy ? sum / (float(pixelRays.rays) * max(b.albedo, 1e-6)) : vec3(0.0);
#if COUNT_LOOKUPS
    addLookups(LOOKUPS_SPECULAR, glossy);
#endif
#ifdef RECORD_STEPS
    RECORD_SURFACE(seen, s);
    // The first pass takes the place of the irradiance.
    if (glossy && recording() && pixelRays.pass == 0u) record.parts[PART_SPECULAR].value = vec3(0.0);
    if (glossy) RECORD_PART(PART_SPECULAR, value, b.albedo);
    return;
#endif
    if (any(greaterThanEqual(pixel, imageSize(result)))) return;
    SoFar soFar = valueSoFar(pixel, s);
    float longest = longestMean(pixel, s, b, scaledToNow(soFar, s.position));
    imageStore(result, pixel, withPass(soFar, s, seen, value, longest));
}
