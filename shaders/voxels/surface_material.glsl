// SPDX-License-Identifier: MIT
// What a material shows within one clipped polygon: base colour x texture x vertex colour, emission,
// coverage. Textures come from the surface array at the level whose texel is as large as the polygon. All
// that is reflected counts as colour, whichever way it goes (evenAlbedo); with SURFACE_LOBES it is also said
// how metallic and how rough metals are. Without, textures of metalness and roughness are not looked at.
// Unlit: black. Included by surface_clip.comp.glsl, which defines struct Surface.
#include "lib/brdf.glsl"
#include "lib/surface_array.glsl"
#include "lib/vertex_color.glsl"
layout(std430) readonly buffer VertexTable { Vertex vertices[]; };
layout(std430) readonly buffer IndexTable { uint indices[]; };
layout(std430) readonly buffer InstanceTable { Instance instances[]; };
layout(std430) readonly buffer MaterialTable { Material materials[]; };

// Barycentric coordinates of a point of the triangle's plane; cr = n * (2 area).
vec3 barycentric(vec3 p, vec3 q0, vec3 q1, vec3 q2, vec3 n, float twiceArea) {
    float b1 = dot(n, cross(p - q0, q2 - q0)) / twiceArea;
    float b2 = dot(n, cross(q1 - q0, p - q0)) / twiceArea;
    return vec3(1.0 - b1 - b2, b1, b2);
}

// Linear colour -> sRGB (IEC 61966-2-1).
vec3 encodeSrgb(vec3 c) {
    return mix(1.055 * pow(max(c, 0.0), vec3(1.0 / 2.4)) - 0.055, 12.92 * c, lessThan(c, vec3(0.0031308)));
}

// Texture coordinates of one use of a texture (row pair of Material.uvRow), and what an area ratio becomes.
vec2 transformedUv(vec2 uv, vec4 row0, vec4 row1) {
    return vec2(dot(row0.xy, uv) + row0.z, dot(row1.xy, uv) + row1.z);
}
float transformedScale(vec4 row0, vec4 row1) { return abs(row0.x * row1.y - row0.y * row1.x); }

Surface evaluateSurface(uint triangle, uint instance, vec3 q0, vec3 q1, vec3 q2, vec3 n, float twiceArea,
                        ClippedPolygon polygon) {
    // Vertices in the order in which surface_setup stored their positions.
    uint firstIndex = instances[instance].firstIndex + 3u * (triangle - instances[instance].firstTriangle);
    uint firstVertex = instances[instance].firstVertex;
    bool flipped = (instances[instance].flags & INSTANCE_FLIPPED) != 0u;
    uint m = instances[instance].material;
    uint i0 = firstVertex + indices[firstIndex];
    uint i1 = firstVertex + indices[firstIndex + (flipped ? 2u : 1u)];
    uint i2 = firstVertex + indices[firstIndex + (flipped ? 1u : 2u)];
    vec2 uv0 = vec2(vertices[i0].u, vertices[i0].v);
    vec2 uv1 = vec2(vertices[i1].u, vertices[i1].v);
    vec2 uv2 = vec2(vertices[i2].u, vertices[i2].v);
    uint flags = materials[m].flags;
    ivec4 layers = materials[m].layers;
    vec4 baseRow0 = materials[m].uvRow[0];
    vec4 baseRow1 = materials[m].uvRow[1];

    // Colour at the centroid. Rounding may put it a little outside.
    vec3 b = clamp(barycentric(polygon.center, q0, q1, q2, n, twiceArea), 0.0, 1.0);
    uint instanceFlags = instances[instance].flags;
    vec4 color = vertexColor(vertices[i0].color, instanceFlags) * b.x +
                 vertexColor(vertices[i1].color, instanceFlags) * b.y +
                 vertexColor(vertices[i2].color, instanceFlags) * b.z;
    vec2 uv = uv0 * b.x + uv1 * b.y + uv2 * b.z;
    // Edge of a square in texture space of the polygon's area.
    vec2 du = uv1 - uv0;
    vec2 dv = uv2 - uv0;
    float footprint = sqrt(abs(du.x * dv.y - du.y * dv.x) / twiceArea * polygon.area);
    color *= materials[m].baseColor;
    float baseFootprint = footprint * sqrt(transformedScale(baseRow0, baseRow1));
    vec4 texel = sampleSurfaceArray(max(layers.x, 0), transformedUv(uv, baseRow0, baseRow1), baseFootprint);
    texel = layers.x >= 0 ? texel : vec4(1.0);
    float coverage = (flags & MATERIAL_ALPHA_BLEND) != 0u ? color.a * texel.a : 1.0;

#if SURFACE_DETAIL == 2
    // Alpha test: points of a 4 x 4 lattice over the polygon's bounds, as far as they lie in the triangle.
    // Where a point stands for more than a texel, alpha there is already an average: then it is the coverage
    // itself (that of a mask which is mostly 0 or 1), because a threshold would make it all or nothing.
    float texels = 0.25 * baseFootprint * float(textureSize(surfaceArray, 0).x);
    float averaged = layers.x >= 0 ? clamp(log2(max(texels, 1.0)), 0.0, 1.0) : 0.0;
    int axis = dominantAxis(n);
    vec3 normal = toDominant(n, axis);
    vec3 low = toDominant(polygon.lower, axis);
    vec3 high = toDominant(polygon.upper, axis);
    vec3 through = toDominant(polygon.center, axis);
    vec4 sum = vec4(0.0);
    float inside = 0.0;
    int i = 0;
    do {
        vec2 at = mix(low.xy, high.xy, (vec2(i & 3, i >> 2) + 0.5) / 4.0);
        float height = through.z - dot(normal.xy, at - through.xy) / normal.z;
        vec3 w = barycentric(fromDominant(vec3(at, height), axis), q0, q1, q2, n, twiceArea);
        vec2 where = uv0 * w.x + uv1 * w.y + uv2 * w.z;
        vec4 one = sampleSurfaceArray(max(layers.x, 0), transformedUv(where, baseRow0, baseRow1),
                                      0.25 * baseFootprint);
        one = layers.x >= 0 ? one : vec4(1.0);
        float counts = min(min(w.x, w.y), w.z) >= 0.0 ? 1.0 : 0.0;
        float alpha = color.a * one.a;
        float passes = counts * mix(alpha >= materials[m].alphaCutoff ? 1.0 : 0.0, min(alpha, 1.0), averaged);
        inside += counts;
        sum += vec4(one.rgb * passes, passes);
        ++i;
    } while (i < 16);
    bool masked = (flags & MATERIAL_ALPHA_MASK) != 0u;
    // A sliver may miss all lattice points: then the centroid speaks for it.
    float single = color.a * texel.a >= materials[m].alphaCutoff ? 1.0 : 0.0;
    coverage = masked ? (inside > 0.0 ? sum.a / inside : single) : coverage;
    texel.rgb = masked && sum.a > 0.0 ? sum.rgb / sum.a : texel.rgb;
#endif

    vec4 emissiveRow0 = materials[m].uvRow[6];
    vec4 emissiveRow1 = materials[m].uvRow[7];
    vec3 glow = sampleSurfaceArray(max(layers.w, 0), transformedUv(uv, emissiveRow0, emissiveRow1),
                                   footprint * sqrt(transformedScale(emissiveRow0, emissiveRow1)))
                    .rgb;
    vec3 emission = materials[m].emission * (layers.w >= 0 ? glow : vec3(1.0));
    bool unlit = (flags & MATERIAL_UNLIT) != 0u;
    uint lobe = 0u;
    float metallic = materials[m].metallic;
    float roughness = materials[m].roughness;
#if SURFACE_LOBES
    vec4 lobeRow0 = materials[m].uvRow[2];
    vec4 lobeRow1 = materials[m].uvRow[3];
    vec3 metalRough = sampleSurfaceArray(max(layers.y, 0), transformedUv(uv, lobeRow0, lobeRow1),
                                         footprint * sqrt(transformedScale(lobeRow0, lobeRow1)))
                          .rgb;
    // The array decodes what it holds from sRGB, which these numbers are not.
    metalRough = layers.y >= 0 ? encodeSrgb(metalRough) : vec3(1.0);
    metallic *= metalRough.b;
    roughness *= metalRough.g;
    lobe = unlit ? 0u : packLobe(metallic, roughness);
#endif
    vec3 albedo = evenAlbedo(color.rgb * texel.rgb, metallic, roughness, materials[m].specularF0);
    return Surface(unlit ? vec3(0.0) : albedo, unlit ? vec3(0.0) : emission, coverage, lobe);
}
