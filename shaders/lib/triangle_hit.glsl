// SPDX-License-Identifier: MIT
// The triangles of a voxel as rays meet them, where plane pieces are not enough (TRIANGLE_HITS 1; else
// nothing): the voxelizer's chain of fragments names them (voxels/surface_clip.comp.glsl), its table has
// their corners in grid coordinates. Test of ray and triangle: Moeller and Trumbore 1997, "Fast, Minimum
// Storage Ray/Triangle Intersection". Method and figures: docs/theory/4_gather.md, "Mirrors that show
// triangles".
//
// Includers that set TRIANGLE_HITS include before: lib/scene_tables.glsl, lib/surface_array.glsl. Before the
// call: SurfaceVoxels::bindTriangles, GpuScene::bind.
#if TRIANGLE_HITS
uniform usamplerBuffer voxelChains;
uniform usamplerBuffer voxelFragments;
uniform usamplerBuffer voxelPairs;
uniform samplerBuffer voxelTriangles;
layout(std430) readonly buffer VertexTable { Vertex vertices[]; };
layout(std430) readonly buffer IndexTable { uint indices[]; };

// Width of what a ray stands for, voxels: at its start, and growth per voxel. A negative width: the ray meets
// plane pieces.
struct RayCone {
    float width;
    float growth;
};
RayCone rayCone = RayCone(-1.0, 0.0);

const float kTriangleEdge = 1e-5;    // barycentric: neighbours overlap by this, so that no ray goes between
const float kTriangleSide = 1e-3;    // voxels: so do cells
const float kTriangleLeast = 1e-20;  // less is seen from its edge

// A triangle of the voxelizer's table: corners, and the vertices that belong to them.
struct TriangleCorners {
    vec3 origin;
    vec3 edge1;
    vec3 edge2;
    uint instance;
    bool twoSided;
};

TriangleCorners triangleCorners(int triangle) {
    vec4 first = texelFetch(voxelTriangles, 3 * triangle);
    uint flags = floatBitsToUint(first.w);
    return TriangleCorners(first.xyz, texelFetch(voxelTriangles, 3 * triangle + 1).xyz - first.xyz,
                           texelFetch(voxelTriangles, 3 * triangle + 2).xyz - first.xyz, flags & 0xffffffu,
                           (flags & VOXEL_TRIANGLE_TWO_SIDED) != 0u);
}

uvec3 triangleVertices(int triangle, uint instance) {
    uint first = instances[instance].firstIndex + 3u * (uint(triangle) - instances[instance].firstTriangle);
    // In the order in which corners are stored.
    uvec2 order = (instances[instance].flags & INSTANCE_FLIPPED) != 0u ? uvec2(2u, 1u) : uvec2(1u, 2u);
    return instances[instance].firstVertex +
           uvec3(indices[first], indices[first + order.x], indices[first + order.y]);
}

vec2 triangleUv(uvec3 v, vec3 at) {
    return at.x * vec2(vertices[v.x].u, vertices[v.x].v) + at.y * vec2(vertices[v.y].u, vertices[v.y].v) +
           at.z * vec2(vertices[v.z].u, vertices[v.z].v);
}

// Texture `layer` of the use-th kind (order of Material::uvRow); white where there is none.
vec4 triangleTexel(uint material, int layer, int use, vec2 uv, float footprint) {
    vec3 row0 = materials[material].uvRow[2 * use].xyz;
    vec3 row1 = materials[material].uvRow[2 * use + 1].xyz;
    vec2 at = vec2(dot(row0.xy, uv) + row0.z, dot(row1.xy, uv) + row1.z);
    float scale = sqrt(abs(row0.x * row1.y - row0.y * row1.x));
    vec4 texel = sampleSurfaceArray(max(layer, 0), at, footprint * scale);
    return layer >= 0 ? texel : vec4(1.0);
}

// Whether a masked surface is there at barycentric coordinates `at`.
bool triangleCovers(int triangle, uint instance, vec3 at) {
    uint material = instances[instance].material;
    if ((materials[material].flags & MATERIAL_ALPHA_MASK) == 0u) return true;
    uvec3 v = triangleVertices(triangle, instance);
    uint wide = instances[instance].flags;
    float opacity =
        dot(at, vec3(vertexColor(vertices[v.x].color, wide).a, vertexColor(vertices[v.y].color, wide).a,
                     vertexColor(vertices[v.z].color, wide).a));
    vec4 texel = triangleTexel(material, materials[material].layers.x, 0, triangleUv(v, at), 0.0);
    return opacity * texel.a * materials[material].baseColor.a >= materials[material].alphaCutoff;
}

// The nearest triangle within a voxel; of equally near ones the first of the scene, whatever the chain's
// order. The face is the one that holds most of it: there is the light that voxels keep.
void testVoxelTriangles(ivec3 voxel, vec3 origin, vec3 direction, bool wanted, float tMax,
                        inout VoxelHit hit) {
    uvec4 word = imageLoad(voxelBrickImage, voxel >> 2);
    bool there = wanted && brickHas(word.xy, bitOfVoxel(voxel));
    int index = there ? int(voxelRecordIndex(word, bitOfVoxel(voxel))) : 0;
    uint link = there ? texelFetch(voxelChains, index).x : 0u;
    COUNT_LOOKUP(wanted ? 2 : 0);
    vec3 toCenter = vec3(voxel) + 0.5 - origin;
    float nearest = tMax;
    int best = -1;
    vec2 bestAt = vec2(0.0);
    vec3 bestNormal = vec3(0.0);
    do {
        COUNT_LOOKUP(link != 0u ? 5 : 0);
        int slot = max(int(link), 1) - 1;
        uint next = texelFetch(voxelFragments, 2 * slot).x;
        int triangle = int(texelFetch(voxelPairs, slot).x);
        TriangleCorners c = triangleCorners(triangle);
        vec3 p = cross(direction, c.edge2);
        float towards = dot(c.edge1, p);
        float inverse = 1.0 / (abs(towards) > kTriangleLeast ? towards : kTriangleLeast);
        vec3 from = origin - c.origin;
        vec3 q = cross(from, c.edge1);
        vec2 at = vec2(dot(from, p), dot(direction, q)) * inverse;
        float t = dot(c.edge2, q) * inverse;
        vec3 off = abs(t * direction - toCenter);
        bool met = link != 0u && (towards > kTriangleLeast || (c.twoSided && towards < -kTriangleLeast)) &&
                   min(at.x, at.y) >= -kTriangleEdge && at.x + at.y <= 1.0 + kTriangleEdge && t > kRayStart &&
                   max(off.x, max(off.y, off.z)) <= 0.5 + kTriangleSide &&
                   (t < nearest || (t == nearest && triangle < best));
        if (met) met = triangleCovers(triangle, c.instance, vec3(1.0 - at.x - at.y, at));
        nearest = met ? t : nearest;
        best = met ? triangle : best;
        bestAt = met ? at : bestAt;
        bestNormal = met ? cross(c.edge1, c.edge2) * sign(towards) : bestNormal;
        link = link != 0u ? next : 0u;
    } while (link != 0u);
    if (best < 0) return;
    uint record = texelFetch(voxelRecords, index).x;
    uint directions = faceDirections(record);
    uint facing =
        (bestNormal.x > 0.0 ? 1u : 2u) | (bestNormal.y > 0.0 ? 4u : 8u) | (bestNormal.z > 0.0 ? 16u : 32u);
    uint usable = (directions & facing) != 0u ? directions & facing : directions;
    vec3 share = mix(vec3(-1.0), abs(bestNormal),
                     bvec3((usable & 3u) != 0u, (usable & 12u) != 0u, (usable & 48u) != 0u));
    uint axis = share.x >= max(share.y, share.z) ? 3u : (share.y >= share.z ? 12u : 48u);
    uint chosen = usable & axis;
    chosen &= 0u - chosen;
    hit = VoxelHit(int(faceBase(record)) + bitCount(directions & (chosen - 1u)), nearest, best, bestAt);
}
#endif
