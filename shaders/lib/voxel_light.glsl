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
    bool glossy = isGlossyDielectric(lobe);
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

// Less steeply a surface is met as at this cosine.
const float kLeastFootprintCosine = 0.1;

// So many pixels' rays the filter between pixels brings together: those of 3x3 weighted 1 2 1, where a surface is even.
const float kPixelsTogether = 7.0;

// The cone that is a ray's share of all that are averaged, and what the lobes that it meets are widened by.
struct Footprint {
    float angle;   // rad; 0: unknown
    float radius;  // voxels, where the ray starts
    float alpha2;  // added to the square of the alpha of lobes
};

// What a lobe does to the middle of a footprint it must do to all of it: over it the normal turns by the curvature, rad per
// voxel, and the ray itself does (docs/theory/4f_glossy.md, (4.64)). Afterwards the footprint is that of the mirrored cone.
void meetSurface(inout Footprint footprint, Ray ray, float t, vec3 normal, float curvature) {
    if (footprint.angle <= 0.0) return;
    footprint.radius += max(t, 0.0) * footprint.angle;
    // Met aslant it is an ellipse: a disk of its area counts.
    float cosine = max(abs(dot(ray.direction, normal)), kLeastFootprintCosine);
    float slope = 0.5 * footprint.angle + curvature * footprint.radius * inversesqrt(cosine);
    footprint.alpha2 = min(0.5 * slope * slope, 1.0);
    footprint.angle = 2.0 * slope;
}

#include "lib/cached_part.glsl"
#include "lib/triangle_surface.glsl"

// Outgoing radiance at a hit as if all metals were diffuse; the sky for a miss, over an angle of `width`.
// In: the shading of the face that was hit. Out: its irradiance at the point, and the shading normal there.
// `footprint`: of the ray; out: as it is mirrored.
vec3 hitRadiance(Ray ray, VoxelHit hit, float width, inout Footprint footprint, inout FaceShading s,
                 out vec3 shadingNormal) {
    int face = max(hit.face, 0);
    CACHED_SHARE(0.0);
#if EXECUTION_GPU
    if (hit.face < 0) {
        shadingNormal = vec3(0.0, 0.0, 1.0);
        return skyRadiance(ray.direction, width);
    }
#endif
    vec3 normal = faceNormalOf(face);
    shadingNormal = normal;
#if TRIANGLE_HITS
    if (hit.triangle >= 0) return triangleRadiance(ray, hit, footprint, s, shadingNormal);
#endif
#if EXACT_DIRECT || SMOOTH_HITS
    vec3 point = ray.origin + (hit.face >= 0 ? hit.t : 0.0) * ray.direction;
#endif
#if SMOOTH_HITS
    // Interpolate the cache and the normal
    NormalSum bent;
    vec4 cached = cachedIrradiance(point, normal, hit.face >= 0, bent);
    shadingNormal = bent.weights > 0.0 ? normalize(bent.sum) : normal;
    meetSurface(footprint, ray, hit.t, normal, curvatureOf(bent) / faceEdge(face));
    s.irradiance = cached.a > 0.0 ? cached.rgb : s.irradiance;
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
        reflectedPunctual(s.albedo, lobe, footprint.alpha2,
                          Receiver(worldFromGrid(point), shadingNormal, normal, -ray.direction, lift));
    vec3 radiance = unpackRgb9e5(texelFetch(cachedDirect, face).x) + direct + s.albedo * s.irradiance;
#else
    vec3 radiance = s.directRadiance + s.albedo * s.irradiance;
#endif
    CACHED_SHARE(hit.face >= 0
                     ? min(brightness(s.albedo * s.irradiance) / max(brightness(radiance), 1e-12), 1.0)
                     : 0.0);
    return hit.face >= 0 ? radiance : skyRadiance(ray.direction, width);
}

#if NEAR_TRIANGLES
// ---- Turns ----------------------------------------------------------------------------------------------

// The face of a voxel holds all that looks its way: the side of a gap between boards, and the roof above them; the insides
// of a double wall, and its outside. Where a near triangle does not lie in its face's plane, the face's light is that of
// something else, and the path goes on instead (docs/theory/4b_rays.md, "Near the start").
const float kNearLike = 0.8;    // cosine of the normals from which on they are alike
const float kNearApart = 0.25;  // voxels from the plane up to which they are one
const int kNearTurns = 3;

vec3 cosineDirection(vec3 n, vec2 xi);

bool turnsAt(Ray ray, VoxelHit hit, int turns) {
    uvec4 r = texelFetch(voxelFaces, max(hit.face, 0));
#if NESTED_GRIDS
    vec4 voxel = voxelPlace(r.w);
#else
    vec4 voxel = vec4(unpackVoxel(r.w), 1.0);
#endif
    vec3 normal = octDecode(unpackSnorm2x16(r.x));
    vec3 fromCenter = (ray.origin + hit.t * ray.direction - voxel.xyz) / voxel.w - 0.5;
    bool alike = dot(hit.normal, normal) >= kNearLike &&
                 abs(dot(fromCenter, normal) - unpackOffset(r.y)) <= kNearApart;
    return turns < kNearTurns && ray.tMax > 0.0 && hit.face >= 0 && hit.near && !alike;
}

// Of what a face shows, what it sends but for cached light, which the path looks for itself.
vec3 withoutCached(vec3 radiance, FaceShading s) {
    return max(radiance - s.albedo * s.irradiance, vec3(0.0));
}

Ray turnedRay(Ray ray, VoxelHit hit, inout uint random) {
    vec2 xi = vec2(randomNext(random), randomNext(random));
    vec3 origin = rayOrigin(ray.origin + hit.t * ray.direction, hit.normal);
    return Ray(origin, cosineDirection(hit.normal, xi), 1e9, hit.normal);
}
#endif

// ---- Radiance along a path ------------------------------------------------------------------------------

struct PathSettings {
    float targetDistance;  // light-sampled ray: distance of the point it was aimed at, voxels; else negative
    int maxBounces;        // reflections on metals
    float alpha;           // width of the distribution that the ray was drawn from, as a GGX alpha
    float fireflyClamp;    // bound of radiance by reflection, over the diffuse radiance of the first hit
    float skyWidth;        // a ray that hits nothing sees the sky over this angle, rad
    float footprint;  // radius of the cone that is a ray's share of all that are averaged, rad; 0: unknown
};

#include "lib/glossy_bounce.glsl"

// The cosine lobe's width as a GGX alpha.
const float kCosineAlpha = 0.5;
// Reflected rays see the sky over this share of the alpha of all lobes on their way: a few find a small sun.
const float kSkyBlur = 0.5;
// Where footprints are unknown: variance of a lobe's width grows by this share of that of the lobes before it, over
// PathSettings' fireflyClamp: features that few rays would find in a narrow lobe, many rays see blurred.
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
    Footprint footprint;
    bool fromNarrowLobe;
    int turns;
};

struct PathVertex {
    vec3 radiance;  // outgoing, as if the surface were diffuse
    bool metal;     // the path is reflected here
    bool turns;     // it goes on by the cosine; `next` holds what the surface sends beside
    bool goesOn;    // either
    GlossyBounce next;
    vec3 lobeIrradiance;  // cached light that the lobe reflects as if diffuse, where the path ends here
};

// Evaluates the surface at a hit and samples its lobe.
PathVertex pathVertex(Ray ray, VoxelHit hit, PathSettings path, inout PathState state, inout uint random) {
    // Evaluate the hit as if it were diffuse
    PathVertex vertex;
    FaceShading s = faceShading(max(hit.face, 0));
    vec3 shadingNormal;
    float skyWidth = state.bounce == 0 ? path.skyWidth : kSkyBlur * sqrt(state.alpha2);
    state.footprint.alpha2 = state.alpha2 * kLobeWidening / path.fireflyClamp;
    vertex.radiance = hitRadiance(ray, hit, skyWidth, state.footprint, s, shadingNormal);

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
    vertex.turns = vertex.goesOn = false;
    vec2 xi = vec2(randomNext(random), randomNext(random));
#if EXECUTION_GPU
    if (!vertex.metal && !surface.shines) {  // the path ends here, by its radiance alone
        vertex.next = GlossyBounce(vec3(0.0), ray, vec3(0.0), 0.0, 0.0, 0.0, vec3(0.0));
        vertex.lobeIrradiance = vec3(0.0);
        return vertex;
    }
#endif
    vertex.next = sampleGlossyBounce(
        ray, hit, s, surface, GlossySample(state.footprint.alpha2, vertex.radiance, shadingNormal, xi));
    vertex.lobeIrradiance = vertex.next.specularShare * s.albedo * s.irradiance;
#if SMOOTH_HITS
    if (surface.shines) vertex.radiance = max(vertex.radiance + vertex.next.lampGloss, vec3(0.0));
#endif
#if NEAR_TRIANGLES
    vertex.turns = !vertex.metal && path.targetDistance < 0.0 && turnsAt(ray, hit, state.turns);
    if (vertex.turns) {
        vec3 sent = withoutCached(vertex.radiance, s);
        vertex.next =
            GlossyBounce(sent, turnedRay(ray, hit, random), s.albedo, kCosineAlpha, 1.0, 0.0, vec3(0.0));
    }
#endif
    vertex.goesOn = vertex.metal || vertex.turns;
    return vertex;
}
#endif

#if NEAR_TRIANGLES && !LOBES
// As traceRadiance, of a path that only turns. What each later hit adds is clamped.
vec3 turningRadiance(Ray ray, PathSettings path, inout uint random, out VoxelHit firstHit) {
    vec3 sum = vec3(0.0), throughput = vec3(1.0);
    float most = 0.0;
    Footprint footprint =
        Footprint(path.footprint, 0.0, path.alpha * path.alpha * kLobeWidening / path.fireflyClamp);
    int turns = 0;
    bool goesOn;
    do {
        VoxelHit hit = traceVoxels(ray);
        FaceShading s = faceShading(max(hit.face, 0));
        vec3 shadingNormal;
        vec3 radiance = hitRadiance(ray, hit, path.skyWidth, footprint, s, shadingNormal);
        goesOn = path.targetDistance < 0.0 && turnsAt(ray, hit, turns);
        if (turns == 0) {
            firstHit = hit;
            most = path.fireflyClamp * brightness(radiance);
        }
        if (goesOn) radiance = withoutCached(radiance, s);
        radiance *= throughput;
        sum += radiance * (turns == 0 ? 1.0 : min(1.0, most / max(brightness(radiance), 1e-12)));
        throughput *= s.albedo;
        if (goesOn) ray = turnedRay(ray, hit, random);
        ++turns;
    } while (goesOn);
    return sum;
}
#endif

#if LOBES
// Rays of which one must not stand out: those of a pixel's mean, and of the pixels that the filter adds to it.
float raysTogether(PathSettings path) {
    return path.fireflyClamp * (path.footprint > 0.0 ? kPixelsTogether : 1.0);
}

// Updates the throughput and the width of the path's lobe.
void bounce(inout PathState state, GlossyBounce next, PathSettings path) {
    state.throughput *= next.weight;
    state.alpha2 += next.alpha * next.alpha;
    float angle = state.footprint.angle;
    float drawn = 1.0 / (kGatherPi * raysTogether(path) * max(next.pdf, 1e-6));
    state.footprint.angle = angle > 0.0 ? sqrt(angle * angle + drawn) : 0.0;
    state.fromNarrowLobe = next.alpha < kNarrowLobe;
    ++state.bounce;
}
#endif

// Radiance along a ray (hitRadiance), and its first hit. With LOBES the path is reflected by metals, up to
// maxBounces times. At its end a metal reflects lights in its lobe, and all other light as if diffuse.
//
// Noise of long paths is bounded in two ways: lobes are widened from bounce to bounce (path space
// regularization, Kaplanyan and Dachsbacher 2013), and a firefly clamp bounds reflected radiance. Both biases
// vanish as fireflyClamp, which grows with the number of samples, goes to infinity.
vec3 traceRadiance(Ray ray, PathSettings path, inout uint random, out VoxelHit firstHit) {
#if !LOBES && NEAR_TRIANGLES
    return turningRadiance(ray, path, random, firstHit);
#elif !LOBES
    firstHit = traceVoxels(ray);
    FaceShading s = faceShading(max(firstHit.face, 0));
    vec3 shadingNormal;
    Footprint footprint =
        Footprint(path.footprint, 0.0, path.alpha * path.alpha * kLobeWidening / path.fireflyClamp);
    return hitRadiance(ray, firstHit, path.skyWidth, footprint, s, shadingNormal);
#else
    vec3 firstRadiance = vec3(0.0);
    vec3 reflectedRadiance = vec3(0.0);
    float maxReflected = 0.0;
    PathState state = PathState(0, vec3(1.0), path.alpha * path.alpha, Footprint(path.footprint, 0.0, 0.0),
                                pathStartsNarrow, 0);
    bool continues;
    do {
        // Intersect the voxels: here alone, as a kernel that has this twice is half as large again
        VoxelHit hit = traceVoxels(ray);
        bool first = state.bounce == 0;
        if (first) firstHit = hit;
#if CACHED_PART
        float shareOfFirst = cachedShare;
#endif

        // Evaluate the surface and sample its lobe
        PathVertex vertex = pathVertex(ray, hit, path, state, random);
        GlossyBounce next = vertex.next;
        continues = vertex.turns || (vertex.metal && state.bounce < path.maxBounces);
#if CACHED_PART
        cachedShare = !first ? shareOfFirst : vertex.metal ? 0.0 : cachedShare;
#endif

        // Add the contribution; the last metal reflects the cached light as if diffuse
        if (!continues) next.radiance += vertex.lobeIrradiance;
        vec3 contribution = state.throughput * (vertex.goesOn ? next.radiance : vertex.radiance);
        firstRadiance += first ? contribution : vec3(0.0);
        reflectedRadiance += first ? vec3(0.0) : contribution;
        maxReflected = first ? raysTogether(path) * brightness(vertex.radiance) : maxReflected;

        bounce(state, next, path);
        continues = continues && state.throughput.r + state.throughput.g + state.throughput.b > 0.0;
#if TRIANGLE_HITS
        bool sharp = rayCone.width >= 0.0 && state.alpha2 <= kTriangleAlpha * kTriangleAlpha;
        rayCone.width = sharp ? rayCone.width + hit.t * rayCone.growth : -1.0;
        rayCone.growth += next.alpha;
#endif

        ray = next.ray;
        state.turns += vertex.turns ? 1 : 0;
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

#include "lib/irradiance_estimator.glsl"
