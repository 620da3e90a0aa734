#version 450 core
// SPDX-License-Identifier: MIT
// Glass in front of a finished picture, by cones: one that its first surface reflects and one that it lets
// through. Axes are found on the triangles of glass: by Snell's law into a solid and out of it, with total
// reflection within, absorption along the way. Apertures: as wide as neighbouring pixels' axes part (ray
// differentials: Igehy 1999, "Tracing Ray Differentials"), and as the facets' lobes (half of their energy, as in
// cone_specular.comp.glsl). What cones meet is read from the radiance volume, which has no glass. Smooth panes
// show the picture behind them. Pixels that see no glass stay as they are. Needs lib/cone_trace.glsl's defines.
// Method: docs/theory/4h_glass.md, "Cones".
layout(local_size_x = 8, local_size_y = 8) in;
#include "lib/dot.glsl"
#include "lib/frame_block.glsl"
#include "lib/picture_pass.glsl"
// For glass, before the others.
#include "lib/scene_tables.glsl"
#include "lib/surface_array.glsl"
// The others.
#include "lib/cone_trace.glsl"
#include "lib/glass_sight.glsl"
#include "lib/glass_tree.glsl"
#include "lib/lighting.glsl"
#include "lib/lights.glsl"
layout(std140) uniform GlassBlock { GlassConstants glassPass; };
layout(rgba32f) uniform image2D picture;

// Surfaces that one axis meets at most.
const int kMostGlass = 12;
// No cone is wider: the single cone of a diffuse surface, as in cone_specular.comp.glsl.
const float kWidestTan = 2.8284271;
// A lamp is seen before the voxels that it is in.
const float kLampVoxels = 2.0;

// The axis of what is let through, up to where it leaves glass for good.
struct GlassAxis {
    vec3 origin;
    vec3 direction;
    vec3 throughput;
    vec3 light;      // of lamps and of glass that glows, reflected on the way
    vec3 reflected;  // direction of what the first surface reflects
    float lobe2;     // square of the half angle of all lobes on the way
    uint history;    // of its surfaces; 0: no glass was met
    bool bent;
};

// Light of lamps that a surface reflects, and its own.
vec3 shineOf(GlassSurface s, vec3 direction) {
    if (glassPass.direct == 0u || (s.back && s.solid)) return vec3(0.0);
    Receiver receiver = Receiver(s.position, s.normal, s.geometricNormal, -direction, vec2(0.0));
    return directLight(receiver, s.brdf).specular + s.emission;
}

// Half of a lobe's facets lie within this angle of the normal; 0 for smooth surfaces.
float facetAngle(GlassSurface s) { return isSmooth(s) ? 0.0 : atan(s.brdf.alpha); }

// At a surface of a solid. Returns whether the axis goes through.
bool bendAt(inout GlassAxis way, GlassSurface s) {
    float eta = s.back ? 1.0 / s.ior : s.ior;
    float cosine = clamp(-dot(way.direction, s.normal), 0.0, 1.0);
    float cosine2 = 1.0 - (1.0 - cosine * cosine) / (eta * eta);
    bool through = cosine2 > 0.0;
    vec3 bent = way.direction / eta + (cosine / eta - sqrt(max(cosine2, 0.0))) * s.normal;
    vec3 mirrored = way.direction + 2.0 * cosine * s.normal;
    mirrored -= 2.0 * min(dot(mirrored, s.geometricNormal), 0.0) * s.geometricNormal;
    way.direction = normalize(through ? bent : mirrored);
    // What inner sides reflect in part goes on with the rest, so that no light is lost.
    way.throughput *= through ? (s.back ? s.tint : s.through) : vec3(1.0);
    // A facet that is turned by a small angle turns what it refracts by n - 1 times that, seen from outside.
    float lobe = facetAngle(s) * (through ? s.ior - 1.0 : 2.0 * s.ior);
    way.lobe2 += lobe * lobe;
    way.history = 4u * way.history + (through ? 1u : 2u);
    way.bent = true;
    return through;
}

GlassAxis glassWay(GlassSight sight, GlassHit hit, const bool shines) {
    GlassAxis way = GlassAxis(sight.origin, sight.direction, vec3(1.0), vec3(0.0), vec3(0.0), 0.0, 0u, false);
    vec3 absorption = vec3(0.0);
    float end = sight.end;
    int met = 0;
    bool goesOn = hit.triangle >= 0;
    if (goesOn) do {
            GlassSurface s = glassSurface(way.origin, way.direction, hit);
            way.throughput *= exp(-absorption * hit.t);
            end -= hit.t;
            // Not s.position: Mesa's software driver (22.3) takes it from the next hit, where a path ends.
            vec3 position = way.origin + hit.t * way.direction;
            if (shines) way.light += way.throughput * shineOf(s, way.direction);
            if (met == 0) way.reflected = reflect(way.direction, s.normal);
            bool through = true;
            if (s.solid) {
                through = bendAt(way, s);
            } else {
                way.throughput *= s.through;
                float lobe = 2.0 * facetAngle(s);
                way.lobe2 += lobe * lobe;
                way.history = 4u * way.history + 3u;
                way.bent = way.bent || !passesStraight(s);
            }
            bool inside = s.solid && through != s.back;
            absorption = inside ? s.absorption : vec3(0.0);
            way.origin = glassStep(position, through ? -s.geometricNormal : s.geometricNormal);
            goesOn = inside || !way.bent;
            hit = nearestGlass(way.origin, way.direction, goesOn ? (way.bent ? 1e9 : end) : -1.0,
                               hit.triangle, !way.bent);
            goesOn = goesOn && hit.triangle >= 0;
        } while (goesOn && ++met < kMostGlass);
    return way;
}

// A bundle of rays about an axis: how wide it is at its start, m, and by how much it widens per metre.
struct Bundle {
    float width;
    float spread;
};

// Between neighbouring pixels' axes; where these took another way, as wide as without a lens.
Bundle bundleOf(GlassAxis way, GlassAxis other, GlassSight sight, GlassSight beside, const bool mirrored) {
    float angle = length(beside.direction - sight.direction);
    float distance = length(way.origin - sight.origin);
    Bundle plain = Bundle(angle * distance + length(beside.origin - sight.origin), angle);
    if (mirrored)
        return Bundle(plain.width, other.history != 0u ? length(other.reflected - way.reflected) : angle);
    vec3 between = other.origin - way.origin;
    between -= dot(between, way.direction) * way.direction;
    bool same = other.history == way.history;
    return same ? Bundle(length(between), length(other.direction - way.direction)) : plain;
}

Bundle meanOf(Bundle a, Bundle b) { return Bundle(0.5 * (a.width + b.width), 0.5 * (a.spread + b.spread)); }

// The rectangle that shines into a cone: its distance, m, and the share of the cone's disc that it fills there.
struct RectShare {
    float distance;
    float share;
    vec3 radiance;
};

RectShare rectShare(vec3 origin, vec3 direction, float width, float tanHalf) {
    RectShare seen = RectShare(1e9, 0.0, vec3(0.0));
    uint i = lighting.lightEnds.z;
    if (i < lighting.lightEnds.w) do {
            Light light = lightOfTable(i);
            float facing = -dot(direction, light.direction);
            float t = dot(origin - light.position, light.direction) / max(facing, 1e-6);
            vec3 at = origin + t * direction - light.position;
            float u = length(light.halfU), v = length(light.halfV);
            vec2 along = vec2(dot(at, light.halfU) / u, dot(at, light.halfV) / v);
            vec2 inside = vec2(u, v) - abs(along);
            if (isSphere(light)) {
                facing = 1.0;
                t = dot(light.position - origin, direction);
                inside = vec2(u - length(origin + t * direction - light.position), 1e9);
            } else if (isRound(light)) {
                inside = vec2((1.0 - length(along / vec2(u, v))) * min(u, v), 1e9);
            }
            vec2 parts = clamp(0.5 + inside / max(width + 2.0 * tanHalf * t, 1e-4), 0.0, 1.0);
            float share = facing > 1e-6 && t > 0.0 ? parts.x * parts.y : 0.0;
            if (share > seen.share) seen = RectShare(t, share, light.intensity);
        } while (++i < lighting.lightEnds.w);
    return seen;
}

// What the neighbouring pixel sees whose place in the picture differs by so much: `step` is its share of viewRight or
// viewUp.
GlassSight besideSight(GlassSight sight, vec3 ray, vec3 step) {
    return GlassSight(sight.origin + frame.parallel * step, normalize(ray + (1.0 - frame.parallel) * step),
                      sight.end);
}

// Radiance that a cone about an axis brings. `showsLamps`: else highlights stand for them.
vec3 coneLight(vec3 origin, vec3 direction, Bundle bundle, float lobeTan, const bool showsLamps) {
    float tanHalf = min(max(0.5 * bundle.spread + lobeTan, 1e-4), kWidestTan);
    // Its apex lies where it would be a point.
    float start = 0.5 * bundle.width / tanHalf;
    RectShare lamp = RectShare(1e9, 0.0, vec3(0.0));
    if (showsLamps) lamp = rectShare(origin, direction, bundle.width, tanHalf);
    March m = startMarch(origin - start * direction, direction, tanHalf, start + cones.maxDistance, 0.0);
    m.t = start;
    float lampAt = start + max(lamp.distance - kLampVoxels * volume.voxelSize, 0.0);
    vec4 before = vec4(0.0);  // of the lamp
    uint samples = 0u;
    do {
        if (m.t <= lampAt) before = m.gathered;
        if (m.t < m.end) stepMarch(m, cones.step);
        ++samples;
    } while (!isFinished(m) && samples < kMaxSamples);
    if (m.t <= lampAt) before = m.gathered;
    vec3 whole = marchedRadiance(m);
    vec3 shown = before.rgb + lamp.share * (1.0 - before.a) * lamp.radiance +
                 (1.0 - lamp.share) * (whole - before.rgb);
    return lamp.share > 0.0 ? shown : whole;
}

void main() {
    ivec2 pixel = passPixel();
    if (any(greaterThanEqual(pixel, imageSize(picture)))) return;
    GlassSight sight = glassSight(pixel);
    GlassHit first = nearestGlass(sight.origin, sight.direction, sight.end, -1, true);
    if (first.triangle < 0) return;
    GlassAxis way = glassWay(sight, first, true);
    vec3 light = way.light;
    if (!way.bent) light += way.throughput * imageLoad(picture, pixel).rgb;
    if (glassPass.specular != 0u) {
        vec3 ray = pixelRay(pixel);
        GlassSight right = besideSight(sight, ray, frame.viewRight * (2.0 / float(frame.width)));
        GlassSight up = besideSight(sight, ray, frame.viewUp * (2.0 / float(frame.height)));
        GlassAxis wayRight =
            glassWay(right, nearestGlass(right.origin, right.direction, sight.end, -1, true), false);
        GlassAxis wayUp = glassWay(up, nearestGlass(up.origin, up.direction, sight.end, -1, true), false);
        GlassSurface s = glassSurface(sight.origin, sight.direction, first);
        if (way.bent) {
            Bundle bundle =
                meanOf(bundleOf(way, wayRight, sight, right, false), bundleOf(way, wayUp, sight, up, false));
            float lobeTan = tan(min(sqrt(way.lobe2), 1.2));
            light += way.throughput * coneLight(way.origin, way.direction, bundle, lobeTan, true);
        }
        if (!(s.back && s.solid)) {
            Bundle bundle =
                meanOf(bundleOf(way, wayRight, sight, right, true), bundleOf(way, wayUp, sight, up, true));
            float lobeTan = tan(min(2.0 * facetAngle(s), 1.2));
            vec3 origin = s.position + cones.offset * s.geometricNormal;
            light += s.brdf.albedo * coneLight(origin, way.reflected, bundle, lobeTan, false);
        }
    }
    imageStore(picture, pixel, vec4(light, 1.0));
}
