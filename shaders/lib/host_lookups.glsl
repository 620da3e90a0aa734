// SPDX-License-Identifier: MIT
// Indirect light at any point and along any ray, for shaders of hosts. tools/make_lookups makes
// include/conelight/light_field.glsl of this file and of what it includes: it says what hosts have to know.
// Reads voxels::Voxels, light::LitVoxels and the sky of light::Lights. One text reads one grid and nested ones.
#define ENVIRONMENT 1
#define NESTED_GRIDS 1
#include "lib/cache_lookup.glsl"
#include "lib/dot.glsl"
#include "lib/environment.glsl"
#include "lib/lit_face.glsl"
#include "lib/tangent_frame.glsl"

// Edge of the voxels about a point, m.
float conelight_voxelSize(vec3 position) { return grid.voxelSize * voxelEdgeAt(gridFromWorld(position)); }

// What arrives from the surface that the ray meets, or from the surroundings, W/(sr m^2); `distance`: how far that
// is, m, -1 for the surroundings. Irradiance of what is met is interpolated, as in mirrors of mode traced.
vec3 conelight_trace(vec3 origin, vec3 direction, out float distance) {
    vec3 unit = normalize(direction);
    VoxelHit hit = traceVoxels(Ray(gridFromWorld(origin), unit, 1e9, vec3(0.0)));
    bool met = hit.face >= 0;
    int face = max(hit.face, 0);
    vec3 normal = octDecode(unpackSnorm2x16(texelFetch(voxelFaces, face).x));
    vec3 point = gridFromWorld(origin) + (met ? hit.t : 0.0) * unit;
    vec4 cached = cachedIrradiance(point, normal, met);
    uvec4 lit = texelFetch(litFaces, face);
    vec3 irradiance = cached.a > 0.0 ? cached.rgb : litIrradiance(lit);
    vec3 radiance = unpackRgb9e5(lit.y) + unpackAlbedo(lit.x) * irradiance;
    distance = met ? hit.t * grid.voxelSize : -1.0;
    return met ? radiance : skyRadiance(unit, 0.0);
}
vec3 conelight_trace(vec3 origin, vec3 direction) {
    float distance;
    return conelight_trace(origin, direction, distance);
}

// The turn from one point of a spiral to the next that is even on a disc and a sphere (Vogel 1979, "A Better Way to
// Construct the Sunflower Head").
const float kSpiralTurn = 2.39996323;
const int kOpenRays = 8;

// Mean radiance over the hemisphere about `normal`, by cosine; over all directions where it is zero.
vec3 openIrradiance(vec3 position, vec3 normal, bool sphere) {
    vec3 u, v;
    tangentFrame(normal, u, v);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < kOpenRays; ++i) {
        float share = (float(i) + 0.5) / float(kOpenRays);
        float height = sphere ? 1.0 - 2.0 * share : sqrt(1.0 - share);
        float radius = sqrt(max(1.0 - height * height, 0.0));
        float turn = kSpiralTurn * float(i);
        sum += conelight_trace(position, radius * (cos(turn) * u + sin(turn) * v) + height * normal);
    }
    return sum / float(kOpenRays);
}

// Indirect irradiance / pi, W/(sr m^2): times albedo it is radiance. On surfaces of the scene the cache says it; in the
// open, rays do. A `normal` of zero: the mean over all directions, for dust and fog.
vec3 conelight_irradiance(vec3 position, vec3 normal) {
    bool sphere = dot(normal, normal) < 1e-12;
    vec3 axis = sphere ? vec3(0.0, 1.0, 0.0) : normalize(normal);
    vec3 point = gridFromWorld(position);
    VoxelBounds bounds = voxelBounds();
    bool inGrid = all(greaterThanEqual(point, bounds.lowest)) && all(lessThanEqual(point, bounds.highest));
    vec4 cached = cachedIrradiance(point, axis, inGrid && !sphere);
    return cached.a > 0.0 ? cached.rgb : openIrradiance(position, axis, sphere);
}
