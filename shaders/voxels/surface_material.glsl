// SPDX-License-Identifier: MIT
// What a material shows within one clipped polygon: base colour x texture x vertex colour, emission,
// coverage. Textures come from the surface array at the level whose texel is as large as the polygon. All
// that is reflected counts as colour, whichever way it goes (evenAlbedo); with SURFACE_LOBES it is also said
// how metallic and how rough it is. Without, textures of metalness and roughness are not looked at.
// Unlit: black. Included by surface_clip.comp.glsl, which defines structs Surface and
// VoxelTriangle.
#include "lib/brdf.glsl"
#include "lib/dot.glsl"
#include "lib/surface_array.glsl"
#include "lib/vertex_color.glsl"
#include "voxels/surface_vertices.glsl"

// Barycentric coordinates of a point of the triangle's plane.
vec3 barycentric(vec3 p, VoxelTriangle t) {
    float b1 = dot(t.normal, cross(p - t.q0, t.q2 - t.q0)) / t.twiceArea;
    float b2 = dot(t.normal, cross(t.q1 - t.q0, p - t.q0)) / t.twiceArea;
    return vec3(1.0 - b1 - b2, b1, b2);
}

// Linear colour -> sRGB (IEC 61966-2-1).
vec3 encodeSrgb(vec3 c) {
    return mix(1.055 * pow(max(c, 0.0), vec3(1.0 / 2.4)) - 0.055, 12.92 * c, lessThan(c, vec3(0.0031308)));
}

// Uses of textures, in the order of Material.uvRow.
const int kUseBase = 0;
const int kUseMetalRough = 1;
const int kUseEmissive = 3;

// What a length in texture coordinates becomes for one use.
float uvScale(uint material, int use) {
    vec4 row0 = materials[material].uvRow[2 * use];
    vec4 row1 = materials[material].uvRow[2 * use + 1];
    return sqrt(abs(row0.x * row1.y - row0.y * row1.x));
}

// Texture `layer` for one use, averaged over `footprint`; white where there is none.
vec4 surfaceTexel(uint material, int layer, int use, vec2 uv, float footprint) {
    vec4 row0 = materials[material].uvRow[2 * use];
    vec4 row1 = materials[material].uvRow[2 * use + 1];
    vec2 at = vec2(dot(row0.xy, uv) + row0.z, dot(row1.xy, uv) + row1.z);
    vec4 texel = sampleSurfaceArray(max(layer, 0), at, footprint * uvScale(material, use));
    return layer >= 0 ? texel : vec4(1.0);
}

// Texture coordinates of a triangle's corners.
struct CornerUv {
    vec2 uv0, uv1, uv2;
};

CornerUv cornerUv(uvec3 v) {
    return CornerUv(vec2(vertices[v.x].u, vertices[v.x].v), vec2(vertices[v.y].u, vertices[v.y].v),
                    vec2(vertices[v.z].u, vertices[v.z].v));
}

vec2 uvAt(CornerUv c, vec3 b) { return c.uv0 * b.x + c.uv1 * b.y + c.uv2 * b.z; }

// Edge of a square in texture space of the polygon's area.
float footprintOf(CornerUv c, float twiceArea, float area) {
    vec2 du = c.uv1 - c.uv0;
    vec2 dv = c.uv2 - c.uv0;
    return sqrt(abs(du.x * dv.y - du.y * dv.x) / twiceArea * area);
}

#if SURFACE_DETAIL == 2
// The alpha test of a polygon: what passes (rgb: sum of colours, a: number of points), and points in all.
struct AlphaTest {
    vec4 passed;
    float points;
};

// Points of a 4 x 4 lattice over the polygon's bounds, as far as they lie in the triangle. `opacity`: of the
// colour. Where a point stands for more than a texel, alpha there is already an average: then it is the
// coverage itself (that of a mask which is mostly 0 or 1), because a threshold would make it all or nothing.
AlphaTest testAlpha(VoxelTriangle t, ClippedPolygon polygon, CornerUv corners, float opacity,
                    float footprint) {
    uint m = instances[t.instance].material;
    int layer = materials[m].layers.x;
    float texels = 0.25 * (footprint * uvScale(m, kUseBase)) * float(textureSize(surfaceArray, 0).x);
    float averaged = layer >= 0 ? clamp(log2(max(texels, 1.0)), 0.0, 1.0) : 0.0;
    int axis = dominantAxis(t.normal);
    vec3 normal = toDominant(t.normal, axis);
    vec3 low = toDominant(polygon.lower, axis);
    vec3 high = toDominant(polygon.upper, axis);
    vec3 through = toDominant(polygon.center, axis);
    AlphaTest test = AlphaTest(vec4(0.0), 0.0);
    int i = 0;
    do {
        vec2 at = mix(low.xy, high.xy, (vec2(i & 3, i >> 2) + 0.5) / 4.0);
        float height = through.z - dot(normal.xy, at - through.xy) / normal.z;
        vec3 w = barycentric(fromDominant(vec3(at, height), axis), t);
        vec4 one = surfaceTexel(m, layer, kUseBase, uvAt(corners, w), 0.25 * footprint);
        float counts = min(min(w.x, w.y), w.z) >= 0.0 ? 1.0 : 0.0;
        float alpha = opacity * one.a;
        float passes = counts * mix(alpha >= materials[m].alphaCutoff ? 1.0 : 0.0, min(alpha, 1.0), averaged);
        test.points += counts;
        test.passed += vec4(one.rgb * passes, passes);
        ++i;
    } while (i < 16);
    return test;
}
#endif

// Metalness and roughness at a point.
vec2 metalRoughAt(uint m, vec2 uv, float footprint) {
    vec2 lobe = vec2(materials[m].metallic, materials[m].roughness);
#if SURFACE_LOBES
    int layer = materials[m].layers.y;
    vec3 texel = surfaceTexel(m, layer, kUseMetalRough, uv, footprint).rgb;
    // The array decodes what it holds from sRGB, which these numbers are not.
    texel = layer >= 0 ? encodeSrgb(texel) : vec3(1.0);
    lobe *= texel.bg;
#endif
    return lobe;
}

Surface evaluateSurface(VoxelTriangle t, ClippedPolygon polygon) {
    uvec3 v = cornersOfTriangle(t.triangle, t.instance);
    uint m = instances[t.instance].material;
    uint flags = materials[m].flags;
    ivec4 layers = materials[m].layers;

    // Evaluate colour at the centroid. Rounding may put it a little outside.
    vec3 b = clamp(barycentric(polygon.center, t), 0.0, 1.0);
    uint instanceFlags = instances[t.instance].flags;
    vec4 color = vertexColor(vertices[v.x].color, instanceFlags) * b.x +
                 vertexColor(vertices[v.y].color, instanceFlags) * b.y +
                 vertexColor(vertices[v.z].color, instanceFlags) * b.z;
    color *= materials[m].baseColor;
    CornerUv corners = cornerUv(v);
    vec2 uv = uvAt(corners, b);
    float footprint = footprintOf(corners, t.twiceArea, polygon.area);
    vec4 texel = surfaceTexel(m, layers.x, kUseBase, uv, footprint);
    float coverage = (flags & MATERIAL_ALPHA_BLEND) != 0u ? color.a * texel.a : 1.0;

#if SURFACE_DETAIL == 2
    // Cut out what a mask leaves. A sliver may miss all lattice points: then the centroid speaks for it.
    bool masked = (flags & MATERIAL_ALPHA_MASK) != 0u;
    AlphaTest test = testAlpha(t, polygon, corners, color.a, footprint);
    float single = color.a * texel.a >= materials[m].alphaCutoff ? 1.0 : 0.0;
    coverage = masked ? (test.points > 0.0 ? test.passed.a / test.points : single) : coverage;
    texel.rgb = masked && test.passed.a > 0.0 ? test.passed.rgb / test.passed.a : texel.rgb;
#endif

    // Evaluate emission and lobe there; what is unlit stays black.
    vec3 emission = materials[m].emission * surfaceTexel(m, layers.w, kUseEmissive, uv, footprint).rgb;
    vec2 lobe = metalRoughAt(m, uv, footprint);
    vec3 base = color.rgb * texel.rgb;
    vec3 albedo = evenAlbedo(base, lobe.x, lobe.y, materials[m].specularF0);
    albedo = layeredAlbedo(albedo, materials[m].evenLayers);
    uint lobeBits = 0u;
#if SURFACE_LOBES
    vec2 told = toldLobe(base, lobe.x, lobe.y, materials[m].specularF0);
    lobeBits = packLobe(told.x, told.y);
#endif
    bool unlit = (flags & MATERIAL_UNLIT) != 0u;
    if (unlit) return Surface(vec3(0.0), vec3(0.0), coverage, 0u);
    return Surface(albedo, emission, coverage, lobeBits);
}
