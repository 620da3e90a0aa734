// SPDX-License-Identifier: MIT
// Rays against the triangles of glass (shared/glass.h), the surface where one is met, and what is left of light
// that passes them. World space, metres. GLASS 0: the scene has none, and the file is empty. Includers that
// set it include before: lib/scene_tables.glsl, lib/surface_array.glsl.
// Test: Moeller and Trumbore 1997, "Fast, Minimum Storage Ray/Triangle Intersection".
#include "lib/brdf.glsl"
#include "lib/caustic_map.glsl"
#include "lib/dot.glsl"
#include "lib/octahedral.glsl"
#include "shared/glass.h"
#ifndef GLASS
#define GLASS 0
#endif
#ifndef CONE_SHADOWS
#define CONE_SHADOWS 0
#endif
#if GLASS
// As textures of buffers: Mesa's software driver reads storage at constant places for its first lane alone, which
// a fragment may lack.
uniform usamplerBuffer glassNodes;
uniform usamplerBuffer glassTriangles;

GlassNode glassNode(uint index) {
    uvec4 a = texelFetch(glassNodes, 2 * int(index));
    uvec4 b = texelFetch(glassNodes, 2 * int(index) + 1);
    return GlassNode(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), b.w);
}

GlassTriangle glassTriangle(int index) {
    uvec4 a = texelFetch(glassTriangles, 5 * index), b = texelFetch(glassTriangles, 5 * index + 1);
    uvec4 c = texelFetch(glassTriangles, 5 * index + 2), d = texelFetch(glassTriangles, 5 * index + 3);
    uvec4 e = texelFetch(glassTriangles, 5 * index + 4);
    return GlassTriangle(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), b.w, uintBitsToFloat(c.xyz),
                         c.w, uintBitsToFloat(d.xy), uintBitsToFloat(d.zw), uintBitsToFloat(e.xy), e.z, e.w);
}

const float kGlassEdge = 1e-6;  // barycentric overlap of neighbours, so that no ray passes between them

// Parts of the largest coordinate: surfaces nearer than the first are the start's own, and rays go on the second
// behind what they have met.
const float kGlassNear = 1e-5;
const float kGlassStep = 4e-6;

// At least 1.
float largestCoordinate(vec3 position) {
    vec3 size = abs(position);
    return max(max(size.x, size.y), max(size.z, 1.0));
}

vec3 glassStep(vec3 position, vec3 normal) {
    return position + normal * (kGlassStep * largestCoordinate(position));
}

vec3 glassInverse(vec3 direction) {
    return 1.0 / mix(vec3(1e-12), direction, greaterThan(abs(direction), vec3(1e-12)));
}

struct GlassHit {
    int triangle;  // -1: a miss
    float t;       // m
    vec2 barycentric;
    bool back;  // seen from within
};

// Whether a ray enters a box before `end`.
bool meetsGlassBox(vec3 lower, vec3 upper, vec3 origin, vec3 inverse, float end) {
    vec3 a = (lower - origin) * inverse;
    vec3 b = (upper - origin) * inverse;
    vec3 near = min(a, b), far = max(a, b);
    float enter = max(max(near.x, near.y), max(near.z, 0.0));
    // Planes of flat boxes are met within rounding.
    return enter <= min(min(far.x, far.y), min(far.z, end)) * 1.0000005;
}

void testGlassTriangle(int index, vec3 origin, vec3 direction, bool cullsBacks, const bool veils,
                       inout GlassHit hit) {
    GlassTriangle g = glassTriangle(index);
    vec3 edge1 = g.corner1 - g.corner0, edge2 = g.corner2 - g.corner0;
    vec3 p = cross(direction, edge2);
    float determinant = dot(edge1, p);
    float inverse = abs(determinant) > 1e-30 ? 1.0 / determinant : 0.0;
    vec3 from = origin - g.corner0;
    vec3 q = cross(from, edge1);
    vec2 barycentric = vec2(dot(from, p), dot(direction, q)) * inverse;
    float t = dot(edge2, q) * inverse;
    bool back = determinant < 0.0;
    bool culled =
        cullsBacks && back && (materials[instances[g.instance].material].flags & MATERIAL_DOUBLE_SIDED) == 0u;
    bool met = inverse != 0.0 && !culled && min(barycentric.x, barycentric.y) >= -kGlassEdge &&
               barycentric.x + barycentric.y <= 1.0 + kGlassEdge && t > 0.0 && t < hit.t &&
               (veils || g.solid != GLASS_VEIL);
    if (met) hit = GlassHit(index, t, barycentric, back);
}

// A walk through the tree. Mesa's software driver gives invocations that have left a loop what others compute in it, but
// for variables that each turn of the loop reads: after these loops no others are used.
struct GlassWalk {
    uint node;         // the next one; GLASS_END: none is left
    uint first, last;  // triangles of the leaf that were not looked at
};

// On to the next leaf whose box the ray enters before `end`.
void toGlassLeaf(inout GlassWalk walk, vec3 origin, vec3 inverse, float end) {
    do {
        GlassNode n = glassNode(walk.node);
        bool met = meetsGlassBox(n.lower, n.upper, origin, inverse, end);
        bool leaf = n.triangles != 0u;
        walk.first = met && leaf ? n.triangles / GLASS_LEAF : walk.first;
        walk.last = met && leaf ? walk.first + n.triangles % GLASS_LEAF : walk.last;
        walk.node = met && !leaf ? walk.node + 1u : n.skip;
    } while (walk.first == walk.last && walk.node != GLASS_END);
}

// The nearest triangle of glass before `end` but for `except`, the one that the ray starts on. `cullsBacks`: those of
// single-sided materials are seen from their front alone.
GlassHit nearestGlass(vec3 origin, vec3 direction, float end, int except, bool cullsBacks) {
    vec3 inverse = glassInverse(direction);
    GlassHit hit = GlassHit(-1, end, vec2(0.0), false);
    GlassWalk walk = GlassWalk(0u, 0u, 0u);
    do {
        toGlassLeaf(walk, origin, inverse, hit.t);
        if (walk.first < walk.last) {
            do {
                if (int(walk.first) != except)
                    testGlassTriangle(int(walk.first), origin, direction, cullsBacks, false, hit);
            } while (++walk.first < walk.last);
        }
    } while (walk.node != GLASS_END);
    return hit;
}

// ---- Surfaces -------------------------------------------------------------------------------------------

struct GlassSurface {
    vec3 position;
    vec3 geometricNormal;  // unit, against the ray
    vec3 normal;           // interpolated, on the same side
    Brdf brdf;             // its diffuse part is what is left beside what goes through
    vec3 through;          // directional albedo of what goes through
    vec3 tint;             // of light that leaves a solid
    vec3 absorption;       // 1/m, in the solid
    vec3 emission;
    float ior;
    bool solid;
    uint number;  // of a solid (shared/glass.h)
    bool back;    // seen from within
};

vec4 glassTexel(int layer, vec3 row0, vec3 row1, vec2 uv) {
    vec2 at = vec2(dot(row0.xy, uv) + row0.z, dot(row1.xy, uv) + row1.z);
    vec4 texel = sampleSurfaceArray(max(layer, 0), at, 0.0);
    return layer >= 0 ? texel : vec4(1.0);
}

GlassSurface glassSurface(vec3 origin, vec3 direction, GlassHit hit) {
    GlassTriangle g = glassTriangle(hit.triangle);
    vec3 at = vec3(1.0 - hit.barycentric.x - hit.barycentric.y, hit.barycentric);
    GlassSurface s;
    s.position = at.x * g.corner0 + at.y * g.corner1 + at.z * g.corner2;
    s.geometricNormal = normalize(cross(g.corner1 - g.corner0, g.corner2 - g.corner0));
    s.geometricNormal = hit.back ? -s.geometricNormal : s.geometricNormal;
    s.normal = normalize(at.x * octDecode(unpackSnorm2x16(g.normal0)) +
                         at.y * octDecode(unpackSnorm2x16(g.normal1)) +
                         at.z * octDecode(unpackSnorm2x16(g.normal2)));
    s.normal = dot(s.normal, s.geometricNormal) < 0.0 ? -s.normal : s.normal;
    vec2 uv = at.x * g.uv0 + at.y * g.uv1 + at.z * g.uv2;

    uint index = instances[g.instance].material;
    Material m = materials[index];
    vec3 base = m.baseColor.rgb * glassTexel(m.layers.x, m.uvRow[0].xyz, m.uvRow[1].xyz, uv).rgb;
    vec4 metalRough = glassTexel(m.layers.y, m.uvRow[2].xyz, m.uvRow[3].xyz, uv);
    float share =
        m.transmission *
        glassTexel(m.transmissionLayer, m.transmissionUvRow[0].xyz, m.transmissionUvRow[1].xyz, uv).r;
    s.brdf = makeBrdf(base, m.metallic * metalRough.b, m.roughness * metalRough.g, m.specularF0,
                      -dot(s.normal, direction));
    s.brdf.ideal = s.brdf.ideal && !(share > 0.0);
    s.through = s.brdf.diffuse * share;
    s.brdf.diffuse *= 1.0 - share;
    s.tint = base * (share * (1.0 - m.metallic * metalRough.b));
    s.absorption = m.absorption;
    bool shines = !hit.back || (m.flags & MATERIAL_DOUBLE_SIDED) != 0u;
    s.emission =
        shines ? m.emission * glassTexel(m.layers.w, m.uvRow[6].xyz, m.uvRow[7].xyz, uv).rgb : vec3(0.0);
    s.ior = m.ior;
    s.solid = (m.flags & MATERIAL_SOLID) != 0u;
    s.number = g.solid;
    s.back = hit.back;
    return s;
}

// Of the least roughness that there is: its lobe is taken for one direction.
bool isSmooth(GlassSurface s) { return s.brdf.alpha <= kMinRoughness * kMinRoughness * 1.001; }

// Whether rays go straight through: a smooth pane.
bool passesStraight(GlassSurface s) { return !s.solid && isSmooth(s); }

// Whether light of lamps comes through a solid by its map alone.
bool turnsAllLight(uint solid) { return solid < caustics.count && (caustics.turnsAll >> solid & 1u) != 0u; }

// ---- Light that passes glass ----------------------------------------------------------------------------

// A surface is in its own way by no veil nearer than this to its plane: for exact positions, a part of the largest
// coordinate; veilNear in metres for those of voxels, set before lights are added.
const float kVeilNear = 1e-4;
float veilNear = 0.0;
const float kVeilNearVoxels = 0.25;  // of a voxel, within which its plane pieces keep to its triangles

// What a blended surface leaves of light.
float veilTransmittance(vec3 origin, vec3 direction, GlassHit hit) {
    GlassTriangle g = glassTriangle(hit.triangle);
    vec3 normal = normalize(cross(g.corner1 - g.corner0, g.corner2 - g.corner0));
    float height = abs(dot(normal, origin - g.corner0));
    vec2 uv = (1.0 - hit.barycentric.x - hit.barycentric.y) * g.uv0 + hit.barycentric.x * g.uv1 +
              hit.barycentric.y * g.uv2;
    Material m = materials[instances[g.instance].material];
    float opacity = m.baseColor.a * glassTexel(m.layers.x, m.uvRow[0].xyz, m.uvRow[1].xyz, uv).a;
    bool counts = height > max(veilNear, kVeilNear * largestCoordinate(origin));
    return counts ? 1.0 - clamp(opacity, 0.0, 1.0) : 1.0;
}

struct GlassRay {
    vec3 origin;
    vec3 direction;
    float near;  // m, between which it meets glass
    float end;
};

// The next triangle that it meets, in the order of the tree.
GlassHit nextGlass(inout GlassWalk walk, GlassRay ray, const bool veils) {
    vec3 inverse = glassInverse(ray.direction);
    GlassHit next = GlassHit(-1, ray.end, vec2(0.0), false);
    do {
        if (walk.first == walk.last) toGlassLeaf(walk, ray.origin, inverse, ray.end);
        if (walk.first < walk.last) {
            do {
                GlassHit hit = GlassHit(-1, ray.end, vec2(0.0), false);
                testGlassTriangle(int(walk.first), ray.origin, ray.direction, false, veils, hit);
                if (hit.triangle >= 0 && hit.t > ray.near) next = hit;
                ++walk.first;
            } while (next.triangle < 0 && walk.first < walk.last);
        }
    } while (next.triangle < 0 && walk.node != GLASS_END);
    return next;
}

// What is left of light that goes straight through all glass from `origin` to `end` metres. Where solids would
// bend it by more than `mostBend`, rad, to first order, it misses its aim, and nothing is left. `ofLamp`: the
// light that solids with maps of caustics send on arrives by these, and not here. It passes veils in part, which other
// rays meet in voxels, as cones for shadows do.
vec3 glassTransmittance(vec3 origin, vec3 direction, float end, float mostBend, const bool ofLamp) {
    const bool kVeils = ofLamp && CONE_SHADOWS == 0;
    vec3 left = vec3(1.0);
    vec3 opticalDepth = vec3(0.0);  // of ways within solids, each added where it ends
    vec3 bend = vec3(0.0);
    GlassRay ray = GlassRay(origin, direction, kGlassNear * largestCoordinate(origin), end);
    GlassWalk walk = GlassWalk(0u, 0u, 0u);
    do {
        GlassHit hit = nextGlass(walk, ray, kVeils);
        bool counts = hit.triangle >= 0;
        uint solid = counts && ofLamp ? glassTriangle(hit.triangle).solid : CAUSTIC_NO_SOLID;
        if (turnsAllLight(solid)) {
            left = vec3(0.0);
            walk = GlassWalk(GLASS_END, 0u, 0u);
        } else if (solid == GLASS_VEIL) {
            left *= veilTransmittance(origin, direction, hit);
        } else if (counts) {
            GlassSurface s = glassSurface(origin, direction, hit);
            left *= s.through;
            float cosine = max(-dot(s.normal, direction), 0.05);
            if (s.solid) {
                float side = hit.back ? 1.0 : -1.0;
                opticalDepth += side * hit.t * s.absorption;
                bend += side * (s.ior - 1.0) * (s.normal / cosine + direction);
            }
        }
    } while (walk.node != GLASS_END || walk.first < walk.last);
    float strays = smoothstep(0.5, 1.5, length(bend) / mostBend);
    return left * exp(-max(opticalDepth, vec3(0.0))) * (1.0 - strays);
}
const float kAnyBend = 1e9;

// Whether rays from `origin` to within `radius` of a point at `distance` may pass any glass: by boxes alone.
bool mayPassGlass(vec3 origin, vec3 direction, float distance, float radius) {
    vec3 inverse = glassInverse(direction);
    uint node = 0u;
    bool found = false;
    do {
        GlassNode n = glassNode(node);
        // As wide as the beam is where it leaves the box.
        vec3 farthest = max(abs(n.lower - origin), abs(n.upper - origin));
        float width = radius * min(length(farthest) / max(distance - radius, 1e-6), 1.0);
        bool met = meetsGlassBox(n.lower - width, n.upper + width, origin, inverse, distance);
        found = met && n.triangles != 0u;
        node = met && n.triangles == 0u ? node + 1u : n.skip;
    } while (node != GLASS_END && !found);
    return found;
}
#endif
