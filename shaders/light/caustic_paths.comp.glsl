#version 450 core
// SPDX-License-Identifier: MIT
// Paths of light from one lamp through one solid of glass, or reflected by one pane:
// lights + tree of glass + voxels -> CausticEnds, where
// each path ends on a voxel, and what it brings. Starts: a grid over the directions, of equal solid angle, in
// which the lamp's points see the ball about the solid. One invocation per start and way (CAUSTIC_WAYS).
// Method: docs/theory/4h_glass.md, "Caustics"; stratified paths as in Shah and others 2007, "Caustics Mapping: An
// Image-Space Technique for Real-Time Caustics".
layout(local_size_x = 64) in;
#include "lib/dot.glsl"
#include "lib/linear_index.glsl"
// For glass, before the others.
#include "lib/scene_tables.glsl"
#include "lib/surface_array.glsl"
// The others.
#include "lib/glass_path.glsl"
#include "lib/lights.glsl"
#include "lib/ray_query.glsl"
layout(std140) uniform CausticPassBlock { CausticPass causticPass; };
layout(std430) writeonly buffer CausticEnds { CausticEnd ends[]; };

// Surfaces that one path meets at most.
const int kMostGlass = 12;

// Voxels: more than the distance below which crossings count as a ray's own surface.
const float kBeforeGlass = 2.0 * kRayNear;

// The ways, in the order of their numbers.
const uint kReflected = 0u, kPassed = 1u, kReflectedWithin = 2u;

// What a surface does to a path, as it stands in the history.
const uint kReflects = 1u, kTransmits = 2u, kReflectsAll = 3u;

// Square to disc, areas kept: Shirley and Chiu 1997, "A Low Distortion Map Between Disk and Square".
vec2 discPoint(vec2 square) {
    vec2 a = abs(square);
    float r = max(a.x, a.y);
    float turn = r > 0.0 ? (kPi / 4.0) * (min(a.x, a.y) / r) : 0.0;
    turn = a.x >= a.y ? turn : 0.5 * kPi - turn;
    return r * vec2(cos(turn), sin(turn)) * vec2(square.x < 0.0 ? -1.0 : 1.0, square.y < 0.0 ? -1.0 : 1.0);
}

struct CausticRay {
    vec3 origin;
    vec3 direction;
    vec3 normal;       // of the surface that it lies on; 0: none
    float solidAngle;  // of all paths of this point; of directional lights the area of their beam, m^2
};

// Where a path starts; `lampPoint` in [-1,1]^2 over the lamp, `square` in [-1,1]^2 over the directions.
CausticRay startOf(Light light, vec2 lampPoint, vec2 square) {
    CausticRay start;
    vec2 disc = discPoint(square);
    vec3 u, v;
    if (light.type == LIGHT_DIRECTIONAL) {
        tangentFrame(light.direction, u, v);
        start.origin = causticPass.middle + causticPass.radius * (disc.x * u + disc.y * v) -
                       causticPass.far * light.direction;
        start.direction = light.direction;
        start.normal = vec3(0.0);
        start.solidAngle = kPi * causticPass.radius * causticPass.radius;
        return start;
    }
    bool area = light.type == LIGHT_RECT;
    start.origin = light.position;
    if (isSphere(light)) {
        // On the disc that the ball sees.
        tangentFrame(normalize(causticPass.middle - light.position), u, v);
        light.halfU = length(light.halfU) * u;
        light.halfV = length(light.halfV) * v;
    }
    vec2 onLamp = isRound(light) ? discPoint(lampPoint) : lampPoint;
    if (area) start.origin += onLamp.x * light.halfU + onLamp.y * light.halfV;
    start.normal = area && !isSphere(light) ? light.direction : vec3(0.0);
    vec3 axis = causticPass.middle - start.origin;
    float distance = max(length(axis), 1e-6);
    axis /= distance;
    float sine = causticPass.radius / distance;
    // 1 - the cosine, exact for small ones; from within the ball: all directions.
    float height = sine < 1.0 ? sine * sine / (1.0 + sqrt(1.0 - sine * sine)) : 2.0;
    start.solidAngle = 2.0 * kPi * height;
    float r2 = dot(disc, disc);
    float h = min(r2, 1.0) * height;
    tangentFrame(axis, u, v);
    vec2 across = disc * inversesqrt(max(r2, 1e-20)) * sqrt(max(h * (2.0 - h), 0.0));
    start.direction = normalize(across.x * u + across.y * v + (1.0 - h) * axis);
    return start;
}

// W of a path whose first solid is `distance` m away.
vec3 fluxOf(Light light, CausticRay start, float distance) {
    vec3 flux = light.intensity * (start.solidAngle / float(causticPass.grid * causticPass.grid));
    if (light.type == LIGHT_RECT) {
        float area = rectArea(light) / float(causticPass.lampGrid * causticPass.lampGrid);
        return flux * (area * rectCosine(light, -start.direction));
    }
    if (light.type == LIGHT_DIRECTIONAL) return flux;
    float d2 = distance * distance;
    return flux * (d2 * distanceFalloff(light, d2) * spotFalloff(light, -start.direction));
}

// What a path has done at its surfaces.
struct CausticState {
    uint way;
    int met;       // surfaces of solids
    bool decided;  // whether the first inner side reflects it
    uint history;
    uint entry;
    bool rough;
    float lobe2;     // sum of the squares of rough surfaces' alpha
    float distance;  // to the first solid, m
    vec3 end;
};

// At a surface of a solid. Returns whether the path goes through.
bool turnAt(inout GlassPath path, inout CausticState turns, GlassSurface s, vec3 h) {
    vec3 toLight = -path.direction;
    float VoH = clamp(dot(toLight, h), 0.0, 1.0);
    vec3 reflected = facetFresnel(s, VoH, s.back ? 1.0 / s.ior : s.ior);
    bool all = s.back && min(reflected.r, min(reflected.g, reflected.b)) >= 1.0;
    bool partly = s.back && !all;
    bool decides = partly && !turns.decided && turns.way != kReflected;
    bool reflects =
        all || (turns.way == kReflected && turns.met == 0) || (decides && turns.way == kReflectedWithin);
    turns.history = 4u * turns.history + (all ? kReflectsAll : (reflects ? kReflects : kTransmits));
    if (reflects) {
        path.throughput *= s.back ? reflected : s.brdf.albedo;
        path.direction = normalize(2.0 * VoH * h - toLight);
        path.direction -= 2.0 * min(dot(path.direction, s.geometricNormal), 0.0) * s.geometricNormal;
    } else {
        passThrough(path, s, h);
        // What later inner sides reflect goes on with the rest, so that no light is lost.
        if (partly && !decides) path.throughput /= max(1.0 - reflected, vec3(0.02));
    }
    turns.decided = turns.decided || decides;
    ++turns.met;
    return !reflects;
}

// At a pane. The one that the paths start towards mirrors them; others let them through. Returns whether they go
// through.
bool turnAtPane(inout GlassPath path, inout CausticState turns, GlassSurface s) {
    bool mirrors = turns.met == 0 && s.number == causticPass.solid;
    path.throughput *= mirrors ? s.brdf.albedo : s.through;
    if (!mirrors) return true;
    turns.entry = packSnorm2x16(octEncode(s.geometricNormal));
    turns.history = kReflects;
    ++turns.met;
    path.direction = reflect(path.direction, s.normal);
    path.direction -= 2.0 * min(dot(path.direction, s.geometricNormal), 0.0) * s.geometricNormal;
    return false;
}

// The path up to the voxel on which it ends; returns whether it ends on one.
bool follow(inout GlassPath path, inout CausticState turns, bool shadowed, vec3 startNormal, uint seed) {
    int on = -1, passed = 0;
    bool goesOn, ended = false;
    do {
        GlassHit hit = nearestGlass(path.origin, path.direction, 1e9, on, false);
        bool open = hit.triangle < 0;
        bool unseen = turns.met == 0 && !shadowed;
        // Behind glass from a little before it: what touches it would be too near a ray's start.
        float before = on >= 0 ? kBeforeGlass : 0.0;
        vec3 origin = gridFromWorld(path.origin) + kRayOffset * startNormal - before * path.direction;
        float reach = unseen ? -1.0 : (open ? 1e9 : hit.t * grid.inverseVoxelSize + before);
        VoxelHit voxel = traceVoxels(Ray(origin, path.direction, reach, startNormal));
        startNormal = vec3(0.0);
        ended = voxel.face >= 0;
        turns.end = path.origin + (voxel.t - before) * grid.voxelSize * path.direction;
        goesOn = !open && !ended;
        if (goesOn) {
            GlassSurface s = glassSurface(path.origin, path.direction, hit);
            path.throughput *= exp(-path.absorption * hit.t);
            turns.distance += turns.met == 0 ? hit.t : 0.0;
            bool through = true;
            if (s.solid) {
                if (turns.met == 0) {
                    turns.entry = packSnorm2x16(octEncode(s.geometricNormal));
                    goesOn = s.number == causticPass.solid && !(s.back && turns.way == kReflected);
                }
                bool rough = !isSmooth(s);
                turns.rough = turns.rough || rough;
                turns.lobe2 += rough ? s.brdf.alpha * s.brdf.alpha : 0.0;
                vec3 h = s.normal;
                if (rough) h = glassFacet(s, -path.direction, sequencePoint(seed, uint(turns.met)));
                through = turnAt(path, turns, s, h);
                path.absorption = through != s.back ? s.absorption : vec3(0.0);
            } else {
                through = turnAtPane(path, turns, s);
                goesOn = through || turns.way == kReflected;
            }
            path.origin = glassStep(s.position, through ? -s.geometricNormal : s.geometricNormal);
            on = hit.triangle;
        }
    } while (goesOn && ++passed < kMostGlass);
    return ended && turns.met > 0 && !(turns.way == kReflectedWithin && !turns.decided);
}

void main() {
    uint index = linearIndex();
    uint starts = causticPass.grid * causticPass.grid * causticPass.lampGrid * causticPass.lampGrid;
    if (index >= CAUSTIC_WAYS * starts) return;
    Light light = lightOfTable(causticPass.light);
    uint i = index % starts;
    uvec2 cell = uvec2(i % causticPass.grid, i / causticPass.grid % causticPass.grid);
    uint k = i / (causticPass.grid * causticPass.grid);
    uvec2 lampCell = uvec2(k % causticPass.lampGrid, k / causticPass.lampGrid);
    CausticRay start = startOf(light, 2.0 * (vec2(lampCell) + 0.5) / float(causticPass.lampGrid) - 1.0,
                               2.0 * (vec2(cell) + 0.5) / float(causticPass.grid) - 1.0);
    GlassPath path = GlassPath(start.origin, start.direction, vec3(1.0), vec3(0.0), 0.0, false, false);
    CausticState turns = CausticState(index / starts, 0, false, 0u, 0u, false, 0.0, 0.0, vec3(0.0));
    bool ended = follow(path, turns, light.shadow >= 0, start.normal, randomHash(index));
    vec3 way = turns.end - causticPass.middle;
    float reached = max(length(way), 1e-6);
    vec3 flux = path.throughput * fluxOf(light, start, turns.distance);
    // Rough surfaces turn each path for itself.
    uint history = turns.rough ? CAUSTIC_ROUGH | index : turns.history;
    uint entry = turns.rough ? floatBitsToUint(sqrt(turns.lobe2)) : turns.entry;
    bool counts = ended && flux.r + flux.g + flux.b > 0.0;
    ends[index] = CausticEnd(causticPlace(way / reached), reached, counts ? history : 0u, flux, entry);
}
