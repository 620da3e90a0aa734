// SPDX-License-Identifier: MIT
// Ray-triangle intersection within a voxel (TRIANGLE_HITS or NEAR_TRIANGLES 1; otherwise the file is empty).
// The voxelizer's chain of fragments (voxels/surface_clip.comp.glsl) lists the triangles; its table holds their corners in
// grid coordinates. Test: Moeller and Trumbore 1997, "Fast, Minimum Storage Ray/Triangle Intersection".
// Method: docs/theory/4f_glossy.md, "Mirrors that show triangles".
//
// BLOCKING_TRIANGLES 1: of shadow rays. Both sides of triangles count, of instances that cast shadows alone.
// VEILS 1: nor do blended ones, which lib/glass_tree.glsl looks at.
//
// Includers that set one of them include before: lib/scene_tables.glsl, lib/surface_array.glsl. Before the
// call: SurfaceVoxels::bindTriangles, GpuScene::bind.
#include "lib/dot.glsl"
#ifndef BLOCKING_TRIANGLES
#define BLOCKING_TRIANGLES 0
#endif
#ifndef VEILS
#define VEILS 0
#endif
#if TRIANGLE_HITS || NEAR_TRIANGLES
uniform usamplerBuffer voxelChains;
uniform usamplerBuffer voxelFragments;
uniform usamplerBuffer voxelPairs;
uniform samplerBuffer voxelTriangles;
layout(std430) readonly buffer VertexTable { Vertex vertices[]; };
layout(std430) readonly buffer IndexTable { uint indices[]; };

// Footprint of a ray, voxels: its width at the start, and growth per voxel. A negative width: the ray hits
// plane pieces.
struct RayCone {
    float width;
    float growth;
};
RayCone rayCone = RayCone(-1.0, 0.0);

const float kTriangleEdge = 1e-5;  // barycentric overlap of neighbours, so that no ray passes between them
#if NEAR_TRIANGLES
const float kTriangleStart = 0.0;  // nearest crossing that counts, voxels
#else
const float kTriangleStart = kRayStart;
#endif
const float kTriangleSide = 1e-3;    // overlap of cells, voxels
const float kTriangleLeast = 1e-20;  // smaller determinants: the triangle is seen edge-on

// A triangle of the voxelizer's table, in grid coordinates.
struct TriangleCorners {
    vec3 origin;
    vec3 edge1;
    vec3 edge2;
    uint instance;
    bool twoSided;
};

// Its instance, and flags above it.
uint triangleBits(int triangle) { return floatBitsToUint(texelFetch(voxelTriangles, 3 * triangle).w); }
uint triangleInstance(int triangle) { return triangleBits(triangle) & 0xffffffu; }

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

vec2 triangleUv(uvec3 v, vec3 barycentric) {
    return barycentric.x * vec2(vertices[v.x].u, vertices[v.x].v) +
           barycentric.y * vec2(vertices[v.y].u, vertices[v.y].v) +
           barycentric.z * vec2(vertices[v.z].u, vertices[v.z].v);
}

// Texture `layer` of the use-th kind (order of Material::uvRow); white where there is none.
vec4 triangleTexel(uint material, int layer, int use, vec2 uv, float footprint) {
    vec3 row0 = materials[material].uvRow[2 * use].xyz;
    vec3 row1 = materials[material].uvRow[2 * use + 1].xyz;
    vec2 transformed = vec2(dot(row0.xy, uv) + row0.z, dot(row1.xy, uv) + row1.z);
    float scale = sqrt(abs(row0.x * row1.y - row0.y * row1.x));
    vec4 texel = sampleSurfaceArray(max(layer, 0), transformed, footprint * scale);
    return layer >= 0 ? texel : vec4(1.0);
}

// Alpha test of a masked material; a blended one is there from one half on, as for the eye and shadow maps.
bool triangleCovers(int triangle, uint instance, vec3 barycentric) {
    uint material = instances[instance].material;
    uint alpha = materials[material].flags & (MATERIAL_ALPHA_MASK | MATERIAL_ALPHA_BLEND);
    if (alpha == 0u) return true;
    float cutoff = alpha == MATERIAL_ALPHA_BLEND ? 0.5 : materials[material].alphaCutoff;
    uvec3 v = triangleVertices(triangle, instance);
    uint wide = instances[instance].flags;
    float opacity = dot(
        barycentric, vec3(vertexColor(vertices[v.x].color, wide).a, vertexColor(vertices[v.y].color, wide).a,
                          vertexColor(vertices[v.z].color, wide).a));
    vec4 texel = triangleTexel(material, materials[material].layers.x, 0, triangleUv(v, barycentric), 0.0);
    return opacity * texel.a * materials[material].baseColor.a >= cutoff;
}

// A crossing of a ray and a triangle.
struct TriangleCrossing {
    int triangle;  // -1: none
    float t;
    vec2 barycentric;
    vec3 normal;  // against the ray, not normalized
    bool turned;  // the other side of a two-sided triangle
    int record;   // of the voxel
};

TriangleCrossing noCrossing(Ray ray) {
    return TriangleCrossing(-1, ray.tMax, vec2(0.0), vec3(0.0), false, 0);
}

// By tables: a ray passes where a texture leaves a hole; a shadow ray also through instances that cast none.
bool leavesHole(TriangleCrossing c, uint instance) {
    vec3 barycentric = vec3(1.0 - c.barycentric.x - c.barycentric.y, c.barycentric);
    bool covers = triangleCovers(c.triangle, instance, barycentric);
#if BLOCKING_TRIANGLES
    const uint asked = INSTANCE_CASTS_SHADOW | (VEILS == 1 ? INSTANCE_VEIL : 0u);
    covers = covers && (instances[instance].flags & asked) == INSTANCE_CASTS_SHADOW;
#endif
    return !covers;
}

bool isHole(TriangleCrossing c) {
    uint bits = triangleBits(max(c.triangle, 0));
    bool asks = c.triangle >= 0 && (bits & VOXEL_TRIANGLE_PASSABLE) != 0u;
#if EXECUTION_GPU
    return asks && leavesHole(c, bits & 0xffffffu);
#else
    // A loop, as a software driver skips no branch, and reads tables lane by lane.
    bool hole = false;
    while (asks) {
        hole = leavesHole(c, bits & 0xffffffu);
        asks = false;
    }
    return hole;
#endif
}

// The face of a record that holds most of a surface with this normal; its light stands for the triangle's.
int faceOfNormal(uint record, vec3 normal) {
    uint directions = faceDirections(record);
    uint facing = (normal.x > 0.0 ? 1u : 2u) | (normal.y > 0.0 ? 4u : 8u) | (normal.z > 0.0 ? 16u : 32u);
    uint usable = (directions & facing) != 0u ? directions & facing : directions;
    vec3 share =
        mix(vec3(-1.0), abs(normal), bvec3((usable & 3u) != 0u, (usable & 12u) != 0u, (usable & 48u) != 0u));
    uint axis = share.x >= max(share.y, share.z) ? 3u : (share.y >= share.z ? 12u : 48u);
    uint chosen = usable & axis;
    chosen &= 0u - chosen;
    return int(faceBase(record)) + bitCount(directions & (chosen - 1u));
}

#if NEAR_TRIANGLES
// The same among the faces that hold mostly that side of their triangles: where a sheet is folded, a face may
// hold more of the sheet's other side, and its light. If there is none, whichever holds most.
int faceOfSide(uint record, vec3 normal, bool turned) {
    uint directions = faceDirections(record);
    int best = -1;
    float most = -1.0;
    int axis = 0;
    do {
        float along = axis == 0 ? normal.x : (axis == 1 ? normal.y : normal.z);
        int direction = 2 * axis + (along > 0.0 ? 0 : 1);
        bool has = (directions >> direction & 1u) != 0u;
        int face = int(faceBase(record)) + bitCount(directions & ((1u << direction) - 1u));
        bool reverse = (texelFetch(voxelFaces, has ? face : 0).z & FACE_REVERSE) != 0u;
        bool better = has && reverse == turned && abs(along) > most;
        best = better ? face : best;
        most = better ? abs(along) : most;
    } while (++axis < 3);
    return best >= 0 ? best : faceOfNormal(record, normal);
}
#endif

// The triangles of a voxel that are still to be tested.
struct TriangleChain {
    uint link;  // 0: none
    int record;
    vec3 toCenter;  // from the ray's origin to the voxel's centre
};

TriangleChain triangleChain(ivec3 voxel, Ray ray, bool wanted) {
    uvec4 word = imageLoad(voxelBrickImage, STORED_BRICK(voxel >> 2));
    bool present = wanted && brickHas(word.xy, bitOfVoxel(voxel));
    int record = present ? int(voxelRecordIndex(word, bitOfVoxel(voxel))) : 0;
    COUNT_LOOKUP(wanted ? 2 : 0);
    return TriangleChain(present ? texelFetch(voxelChains, record).x : 0u, record,
                         vec3(voxel) + 0.5 - ray.origin);
}

// Intersects the first triangle of a chain; keeps the nearest crossing within the voxel but for that of `passed`, a hole,
// and those before it. Moves on to the next.
void testTriangle(inout TriangleChain chain, Ray ray, TriangleCrossing passed,
                  inout TriangleCrossing nearest) {
    COUNT_LOOKUP(chain.link != 0u ? 5 : 0);
    bool valid = chain.link != 0u;
    int slot = max(int(chain.link), 1) - 1;
    uint next = texelFetch(voxelFragments, 2 * slot).x;
    int triangle = int(texelFetch(voxelPairs, slot).x);
    TriangleCorners c = triangleCorners(triangle);
#if NESTED_GRIDS
    c.origin = levelFromGrid(c.origin, levelOfRay);
    c.edge1 /= levelOfRay.w;
    c.edge2 /= levelOfRay.w;
#endif
    vec3 p = cross(ray.direction, c.edge2);
    float determinant = dot(c.edge1, p);
    float inverse = 1.0 / (abs(determinant) > kTriangleLeast ? determinant : kTriangleLeast);
    vec3 fromCorner = ray.origin - c.origin;
    vec3 q = cross(fromCorner, c.edge1);
    vec2 barycentric = vec2(dot(fromCorner, p), dot(ray.direction, q)) * inverse;
    float t = dot(c.edge2, q) * inverse;
#if BLOCKING_TRIANGLES
    bool faces = abs(determinant) > kTriangleLeast;
    // Where it is crossed does not matter: so a piece too small for a voxel counts in the next one.
    bool here = true;
#else
    vec3 offset = abs(t * ray.direction - chain.toCenter);
    bool here = max(offset.x, max(offset.y, offset.z)) <= 0.5 + kTriangleSide;
    bool faces = determinant > kTriangleLeast || (c.twoSided && determinant < -kTriangleLeast);
#endif
    bool behind = passed.triangle < 0 || t > passed.t || (t == passed.t && triangle > passed.triangle);
    bool hit = valid && faces && here && behind && min(barycentric.x, barycentric.y) >= -kTriangleEdge &&
               barycentric.x + barycentric.y <= 1.0 + kTriangleEdge && t > kTriangleStart &&
               (t < nearest.t || (t == nearest.t && triangle < nearest.triangle));
    nearest.t = hit ? t : nearest.t;
    nearest.triangle = hit ? triangle : nearest.triangle;
    nearest.barycentric = hit ? barycentric : nearest.barycentric;
    nearest.normal = hit ? cross(c.edge1, c.edge2) * sign(determinant) : nearest.normal;
    nearest.turned = hit ? determinant < 0.0 : nearest.turned;
    nearest.record = hit ? chain.record : nearest.record;
    chain.link = valid ? next : 0u;
}

#if BLOCKING_TRIANGLES
// A triangle of the voxel that is in the ray's way is kept in `blocker`.
void findBlocker(ivec3 voxel, Ray ray, bool wanted, inout int blocker) {
    TriangleChain chain = triangleChain(voxel, ray, wanted);
#if EXECUTION_GPU
    if (chain.link == 0u) return;
#endif
    do {
        TriangleCrossing met = noCrossing(ray);
        do testTriangle(chain, ray, noCrossing(ray), met);
        while (met.triangle < 0 && chain.link != 0u);
        if (met.triangle >= 0 && !isHole(met)) blocker = met.triangle;
    } while (blocker < 0 && chain.link != 0u);
}
#endif

// The nearest crossing of a ray with the triangles of a voxel, where `wanted`, is kept in `nearest`, holes among them but for
// that of `passed`. Among equally near ones the first of the scene wins, whatever the order of the chain.
void nearestTriangle(ivec3 voxel, Ray ray, bool wanted, TriangleCrossing passed,
                     inout TriangleCrossing nearest) {
    TriangleChain chain = triangleChain(voxel, ray, wanted);
#if EXECUTION_GPU
    if (chain.link == 0u) return;
#endif
    do testTriangle(chain, ray, passed, nearest);
    while (chain.link != 0u);
}

VoxelHit hitOf(TriangleCrossing c) {
    uint record = texelFetch(voxelRecords, c.record).x;
#if NEAR_TRIANGLES
    return VoxelHit(faceOfSide(record, c.normal, c.turned), c.t, true, normalize(c.normal));
#else
    return VoxelHit(faceOfNormal(record, c.normal), c.t, c.triangle, c.barycentric);
#endif
}
#endif
