#version 450 core
// SPDX-License-Identifier: MIT
// G-buffer -> radiance in the specular lobe over the lobe's directional albedo, by rays along visible normals
// of GGX (Heitz 2018, "Sampling the GGX Distribution of Visible Normals"), averaged with the passes and
// frames before. What a ray meets shows its interpolated cached light, so that mirrors show no voxels.
#include "lib/brdf.glsl"
#include "lib/cache_lookup.glsl"
#include "lib/temporal.glsl"
#include "lib/voxel_light.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba32ui, binding = 0) writeonly uniform uimage2D result;

// A microfacet normal seen from `toEye`; both in the frame whose z is the surface's normal.
vec3 visibleNormal(vec3 toEye, float alpha, vec2 xi) {
    vec3 v = normalize(vec3(alpha * toEye.xy, toEye.z));
    float l2 = dot(v.xy, v.xy);
    vec3 t1 = l2 > 1e-12 ? vec3(-v.y, v.x, 0.0) * inversesqrt(l2) : vec3(1.0, 0.0, 0.0);
    vec3 t2 = cross(v, t1);
    float r = sqrt(xi.x);
    float phi = 2.0 * kPi * xi.y;
    float a = r * cos(phi);
    float s = 0.5 * (1.0 + v.z);
    float b = mix(sqrt(max(1.0 - a * a, 0.0)), r * sin(phi), s);
    vec3 n = a * t1 + b * t2 + sqrt(max(1.0 - a * a - b * b, 0.0)) * v;
    return normalize(vec3(alpha * n.xy, max(n.z, 1e-6)));
}

// Smith's Lambda of GGX for a direction of height z.
float smithLambda(float alpha, float z) {
    float z2 = z * z;
    return 0.5 * (sqrt(1.0 + alpha * alpha * (1.0 - z2) / max(z2, 1e-8)) - 1.0);
}

// hitRadiance with the irradiance interpolated over the voxels about the hit.
vec3 smoothHitRadiance(VoxelHit hit, vec3 origin, vec3 direction) {
    int face = max(hit.face, 0);
    FaceShade shade = faceShade(face);
    vec3 normal = octDecode(unpackSnorm2x16(texelFetch(voxelFaces, 2 * face).x));
    vec4 smooth4 = cachedIrradiance(origin + hit.t * direction, normal, hit.face >= 0);
    vec3 change = smooth4.a > 0.0 ? shade.albedo * (smooth4.rgb - shade.irradiance) : vec3(0.0);
    return max(hitRadiance(hit, origin, direction) + (hit.face >= 0 ? change : vec3(0.0)), vec3(0.0));
}

void main() {
    ivec2 pixel = INVOCATION_PIXEL;
    Surface s;
    bool seen = fetchSurface(min(pixel, imageSize(result) - 1), s);
    Brdf b = makeBrdf(s.albedo, s.metallic, s.roughness, s.dielectricF0, dot(s.normal, s.toEye));
    bool glossy = seen && !s.unlit && s.roughness <= pixelRays.specularLimit && b.f90.r > 0.0;
    vec3 u, v;
    tangentFrame(s.normal, u, v);
    vec3 toEye = normalize(vec3(dot(s.toEye, u), dot(s.toEye, v), b.nov));
    float lambdaEye = smithLambda(b.alpha, toEye.z);
    vec3 origin = rayOrigin(gridFromWorld(s.position), s.geometricNormal);
    uint seed = randomHash(uint(pixel.x) | uint(pixel.y) << 16) ^ 0x5bd1e995u;
    vec3 sum = vec3(0.0);
    int i = 0;
    do {
        vec2 xi = sequencePoint(seed, pixelRays.pass * pixelRays.rays + uint(i));
        vec3 h = visibleNormal(toEye, b.alpha, xi);
        float voh = max(dot(toEye, h), 0.0);
        vec3 l = 2.0 * voh * h - toEye;
        float shadowing = (1.0 + lambdaEye) / (1.0 + lambdaEye + smithLambda(b.alpha, l.z));
        vec3 weight = l.z > 0.0 ? fresnel(b.f0, b.f90, voh) * b.compensation * shadowing : vec3(0.0);
        vec3 direction = l.x * u + l.y * v + l.z * s.normal;
        // A bent normal can mirror into the surface: keep to the side of the triangle.
        direction -= 2.0 * min(dot(direction, s.geometricNormal), 0.0) * s.geometricNormal;
        VoxelHit hit = traceVoxels(origin, direction, glossy && l.z > 0.0 ? 1e9 : -1.0);
        vec3 radiance = smoothHitRadiance(hit, origin, direction);
        sum += weight * radiance;
        if (glossy)
            RECORD_RAY(PATH_SPECULAR_RAY, origin, direction, hit, 1.0,
                       weight / (float(pixelRays.rays) * max(b.albedo, 1e-6)), radiance, glossy && l.z > 0.0);
    } while (++i < int(pixelRays.rays));
    vec3 value = glossy ? sum / (float(pixelRays.rays) * max(b.albedo, 1e-6)) : vec3(0.0);
#ifdef RECORD_STEPS
    RECORD_SURFACE(seen, s);
    // The first pass takes the place of the irradiance.
    if (glossy && recording() && pixelRays.pass == 0u) record.parts[PART_SPECULAR].value = vec3(0.0);
    if (glossy) RECORD_PART(PART_SPECULAR, value, b.albedo);
    return;
#endif
    if (any(greaterThanEqual(pixel, imageSize(result)))) return;
#if TEMPORAL == 2
    // What a smooth surface shows moves otherwise than the surface: means are short there.
    float longest = mix(1.0, pixelRays.longestMean, smoothstep(0.1, 0.5, s.roughness));
#else
    float longest = pixelRays.longestMean;
#endif
    imageStore(result, pixel, withPass(pixel, s, seen, value, longest));
}
