// SPDX-License-Identifier: MIT
// Reflection of a path by a metal: hit -> direct specular light, and the ray that samples the GGX lobe. Part
// of lib/voxel_light.glsl (LOBES 1; otherwise the file is empty).
#include "lib/dot.glsl"

// Lobes at least this wide (GGX alpha) reflect rectangular lights analytically, without a ray. In narrower
// lobes rays must hit the light: few miss it then, and shadows on it are sharp. Chosen by eye.
const float kNarrowLobe = 0.015;

#if LOBES

// The lobe of the surface at a hit.
struct GlossySurface {
    vec3 normal;  // geometric
    float metallic;
    float roughness;
    bool reflects;   // a metal, which has a lobe
    bool shines;     // a dielectric, whose lobe shows rectangular lights
    bool areaLight;  // its emission is that of a rectangular light
};

GlossySurface glossySurface(VoxelHit hit, FaceShading s) {
    int face = max(hit.face, 0);
    uint bits = texelFetch(litFaces, face).w;
    vec2 lobe = litLobe(bits);
    vec3 normal = faceNormalOf(face);
#if TRIANGLE_HITS
    lobe = hit.triangle >= 0 ? hitTriangle.lobe : lobe;
    normal = hit.triangle >= 0 ? hitTriangle.geometricNormal : normal;
#endif
    bool areaLight = (bits & FACE_AREA_LIGHT) != 0u;
    bool reflects = hit.face >= 0 && lobe.x > 0.0 && s.cached && !areaLight;
#if SMOOTH_HITS
    bool shines = hit.face >= 0 && isGlossyDielectric(lobe) && !areaLight;
#else
    const bool shines = false;  // where light is gathered, it is even
#endif
    return GlossySurface(normal, lobe.x, lobe.y, reflects, shines, areaLight);
}

// Specular reflection of all rectangular lights: each analytically as a whole (lib/rect_light.glsl), times
// the visibility of one sample point, which is drawn by its share of the lobe.
vec3 reflectedRects(Brdf b, vec3 position, vec3 shadingNormal, vec3 geometricNormal, vec3 toEye, float xi) {
    vec3 reflected = vec3(0.0);
    uint i = lighting.lightEnds.z;
    if (i < lighting.lightEnds.w) {
        RectLobe lobe = rectLobe(shadingNormal, toEye, b.alpha, b.NoV);
        do {
            Light light = lightOfTable(i);
            uint k = rectPointInLobe(light, position, lobe, xi);
            vec3 point = rectSamplePoint(light, k);
            reflected += light.intensity * rectSpecularQuick(light, position, lobe, b) *
                         shadowVisibilityRect(light, k, point, position, geometricNormal);
        } while (++i < lighting.lightEnds.w);
    }
    return reflected;
}

struct GlossyBounce {
    vec3 radiance;        // diffuse part, and specular reflection of the lights that rays do not hit
    Ray ray;              // drawn from the lobe
    vec3 weight;          // BRDF times cosine over density
    float alpha;          // width of the lobe
    float pdf;            // density per steradian
    float specularShare;  // share of the surface's albedo that is its lobe's
    vec3 lampGloss;  // what a dielectric's lobe adds to light of rectangles that it reflects as if diffuse
};

struct GlossySample {
    float widening;        // added to alpha^2
    vec3 diffuseRadiance;  // of the hit, as if it were diffuse
    vec3 shadingNormal;
    vec2 xi;
};

GlossyBounce sampleGlossyBounce(Ray ray, VoxelHit hit, FaceShading s, GlossySurface surface, GlossySample g) {
    // Widen the lobe
    float alpha = max(surface.roughness, kMinRoughness) * max(surface.roughness, kMinRoughness);
    alpha = min(sqrt(alpha * alpha + g.widening), 1.0);
    vec3 base = s.albedo;
#if SMOOTH_HITS
    if (surface.shines) base = baseOfEvenAlbedo(s.albedo, surface.roughness);
#endif
    Brdf b = makeBrdf(base, surface.metallic, sqrt(alpha), vec3(0.04), -dot(g.shadingNormal, ray.direction));

    // Sample it; reflections that a shading normal turns into the surface are mirrored out of it
    GlossyBounce next;
    next.alpha = alpha;
    vec3 direction = lobeDirection(b, g.shadingNormal, -ray.direction, g.xi, next.weight);
    next.pdf = lobePdf(b, g.shadingNormal, -ray.direction, direction);
    direction -= 2.0 * min(dot(direction, surface.normal), 0.0) * surface.normal;
    vec3 point = ray.origin + hit.t * ray.direction;
    next.ray = Ray(rayOrigin(point, surface.normal), direction, 1e9, surface.normal);

    // Add emission and the diffuse part; the record reflects by its whole albedo
    int face = max(hit.face, 0);
    float diffuseShare = dot(b.diffuse, vec3(1.0)) / max(dot(s.albedo, vec3(1.0)), 1e-4);
    next.specularShare = 1.0 - diffuseShare;
    vec3 emission = unpackEmission(texelFetch(voxelFaceMaterials, face));
    next.radiance = emission + diffuseShare * max(g.diffuseRadiance - emission, vec3(0.0));

    // Add the specular reflection of the lights
    vec3 frontOffset = faceFrontOffset(texelFetch(voxelFaces, face), faceNormalOf(face));
#if TRIANGLE_HITS
    frontOffset = hit.triangle >= 0 ? vec3(0.0) : frontOffset;
#endif
    vec3 position = worldFromGrid(point + faceEdge(face) * frontOffset);
    vec3 rects = vec3(0.0);
    if (alpha >= kNarrowLobe || surface.shines)
        rects = reflectedRects(b, position, g.shadingNormal, surface.normal, -ray.direction,
                               fract(7.0 * g.xi.x + g.xi.y));
    next.radiance += rects;
    vec3 even = max(unpackRgb9e5(texelFetch(cachedDirect, face).x) - emission, vec3(0.0));
    next.lampGloss = rects - (1.0 - diffuseShare) * even;
#if EXACT_DIRECT
#if GLASS
    veilNear = kVeilNearVoxels * faceEdge(face) * grid.voxelSize;
#endif
    DirectLight light = DirectLight(vec3(0.0), vec3(0.0));
    addPunctualLights(light, true,
                      Receiver(position, g.shadingNormal, surface.normal, -ray.direction, kShadowVoxelLift),
                      b);
    next.radiance += light.specular;
#else
    next.radiance += (1.0 - diffuseShare) *
                     max(s.directRadiance - unpackRgb9e5(texelFetch(cachedDirect, face).x), vec3(0.0));
#endif
    return next;
}
#endif
