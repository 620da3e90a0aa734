// SPDX-License-Identifier: MIT
// Cones through the radiance volume (docs/theory/4a_cones.md; Crassin et al. 2011, section 5): apex, axis,
// aperture -> premultiplied radiance and opacity.
//
// The way is cut into stretches that are a fixed part of the footprint; each is sampled once, in its middle,
// in the level whose texels have the footprint's size. Stretches tile the way from the apex to the end
// without gap, so that a wall counts once wherever it lies between samples.
//
//   DIRECTIONAL  the volume has six blocks, of which a cone reads the three that look towards it
//   AREA         opacity: projected area of connected surface, which adds up until the cone is full; else fog
//   OCTREE       the volume lies in an octree
//   FRACTIONAL   1: samples lie between two levels
#ifndef FRACTIONAL
#define FRACTIONAL 0
#endif
#if !defined(DIRECTIONAL) || !defined(AREA) || !defined(OCTREE)
#error DIRECTIONAL, AREA and OCTREE must be 0 or 1
#endif
#include "lib/environment.glsl"
#include "lib/radiance_volume.glsl"
#include "lib/record_steps.glsl"
#include "shared/cones.h"
layout(std140) uniform ConeBlock { ConeConstants cones; };
#if OCTREE
#include "lib/radiance_bricks.glsl"
#else
uniform sampler3D radianceVolume;
#endif

#if DIRECTIONAL
const uint kFetchesPerSample = 3u * (1u + FRACTIONAL);
#else
const uint kFetchesPerSample = 1u + FRACTIONAL;
#endif

// A cone that is this full is taken for full. 1/128: half a step of an 8-bit picture.
const float kFullOpacity = 1.0 - 1.0 / 128.0;
// A march ends here whatever happens, below the 65,535 turns at which llvmpipe ends it silently. The longest
// one, 64 cones at step 0.1 in 512^3, takes 24,000.
const uint kMaxSamples = 60000u;

// One cone on its way.
struct March {
    vec3 origin;
    vec3 direction;  // unit
    float tanHalf;
    float t;        // how far it got, m
    float end;      // m
    float fade;     // 1/m: surfaces count less by this per metre; 0 for light
    vec4 gathered;  // premultiplied radiance, opacity
};

// Distance at which a ray leaves the volume and half a texel of the coarsest level about it, 0 when it never
// is inside. A wall at the volume's border is blurred over a texel; who stops at the border has crossed half
// of it.
float volumeExit(vec3 origin, vec3 direction) {
    float margin = 0.5 * volume.voxelSize * exp2(volume.maxLevel);
    // 1e-9 m per m: parallel to a side; keeps 0/0 out.
    vec3 d = mix(direction, vec3(1e-9), lessThan(abs(direction), vec3(1e-9)));
    vec3 a = (volume.origin - margin - origin) / d;
    vec3 b = (volume.origin + volume.extent + margin - origin) / d;
    vec3 near = min(a, b);
    vec3 far = max(a, b);
    float enter = max(max(near.x, near.y), max(near.z, 0.0));
    float leave = min(far.x, min(far.y, far.z));
    return leave > enter ? leave : 0.0;
}

March startMarch(vec3 origin, vec3 direction, float tanHalf, float maxDistance, float fade) {
    float end = min(volumeExit(origin, direction), maxDistance);
    return March(origin, direction, tanHalf, 0.0, end, fade, vec4(0.0));
}

// Level whose texels are nearest to the cone's diameter at distance t (eq. 4.1, 4.2). A whole number: samples
// of one cone lie at the same distances, and so in the same levels, for all pixels, and no ring shows where
// the level changes; and stretches that are a whole part of a texel add up to 1 across a wall, which filters
// between levels would not.
float levelAt(float tanHalf, float t) {
    float level = log2(2.0 * tanHalf * t * volume.inverseVoxelSize);
#if !FRACTIONAL
    level = round(level);
#endif
    return clamp(level, 0.0, volume.maxLevel);
}

// Premultiplied radiance and opacity of a stretch about p that is `part` of a texel of `level` long.
vec4 sampleStretch(vec3 p, vec3 direction, float level, float part) {
    vec3 q = (p - volume.origin) * volume.inverseExtent;
#if OCTREE
    vec3 place;
    uvec2 node = octreePlace(q, radianceSize() >> int(level), int(level), place);
#endif
#if DIRECTIONAL
    // A cone that goes towards +x meets faces that look towards -x.
    ivec3 block = ivec3(direction.x > 0.0 ? 1 : 0, direction.y > 0.0 ? 3 : 2, direction.z > 0.0 ? 5 : 4);
#if OCTREE
    vec4 x = octreeSample(node, block.x, place);
    vec4 y = octreeSample(node, block.y, place);
    vec4 z = octreeSample(node, block.z, place);
#else
    // Stay half a texel away from the neighbouring block, as clamping to the edge does at the other sides.
    float inset = exp2(level) * volume.halfTexelX;
    q.x = clamp(q.x, inset, 1.0 - inset);
    vec3 u = (q.x + vec3(block)) * (1.0 / 6.0);
    vec4 x = textureLod(radianceVolume, vec3(u.x, q.yz), level);
    vec4 y = textureLod(radianceVolume, vec3(u.y, q.yz), level);
    vec4 z = textureLod(radianceVolume, vec3(u.z, q.yz), level);
#endif
#if AREA
    // Coverage along axis k is area * n.k: the sum with |d.k| is area * |n.d|, what the cone sees of it.
    vec3 weight = abs(direction);
#else
    vec3 weight = direction * direction;
#endif
    vec4 s = x * weight.x + y * weight.y + z * weight.z;
#elif OCTREE
    vec4 s = octreeSample(node, 0, place);
#else
    vec4 s = textureLod(radianceVolume, q, level);
#endif
#if AREA
    return s * part;
#else
    // Beer's law (eq. 4.4): a texel's opacity is that of crossing the whole of it.
    float opacity = 1.0 - pow(1.0 - min(s.a, 0.9999), part);
    return s * (opacity / max(s.a, 1e-6));
#endif
}

// The same for a stretch of length `delta`, m. A level that is no whole number: between two.
vec4 sampleLevels(vec3 p, vec3 direction, float level, float delta) {
    vec2 levels = vec2(floor(level), ceil(level));
    vec2 parts = delta / (volume.voxelSize * exp2(levels));
    vec4 s = sampleStretch(p, direction, levels.x, parts.x);
#if FRACTIONAL
    s = mix(s, sampleStretch(p, direction, levels.y, parts.y), fract(level));
#endif
    return s;
}

// One more stretch.
void stepMarch(inout March m, float step) {
    float level = levelAt(m.tanHalf, m.t);
    float texel = volume.voxelSize * exp2(level);
    float delta = min(step * texel, max(m.end - m.t, 0.0));
    float middle = m.t + 0.5 * delta;
    vec4 s = sampleLevels(m.origin + middle * m.direction, m.direction, level, delta);
    s *= max(1.0 - middle * m.fade, 0.0);
    m.t += delta;
#if AREA
    vec4 added = s * min((1.0 - m.gathered.a) / max(s.a, 1e-6), 1.0);
#else
    vec4 added = s * (1.0 - m.gathered.a);  // eq. 4.3
#endif
    m.gathered += added;
    RECORD_STEP(STEP_SAMPLE, m.origin + middle * m.direction, middle, texel, level, added.rgb, added.a,
                m.gathered.a);
}

bool isFinished(March m) { return m.t >= m.end || m.gathered.a >= kFullOpacity; }

// What the cone sees in the end: a full one is all surface, another sees the sky behind.
vec3 marchedRadiance(March m) {
    if (m.gathered.a >= kFullOpacity) return m.gathered.rgb / m.gathered.a;
    return m.gathered.rgb + (1.0 - m.gathered.a) * skyRadiance(m.direction, 2.0 * atan(m.tanHalf));
}

// Orthonormal frame with the third axis n (Frisvad 2012, "Building an Orthonormal Basis from a 3D Unit Vector
// Without Normalization"), with its one singular direction turned to -y: downward surfaces are seen least.
mat3 frameAbout(vec3 n) {
    if (n.y < -0.9999) return mat3(vec3(1.0, 0.0, 0.0), vec3(0.0, 0.0, 1.0), n);
    float a = 1.0 / (1.0 + n.y);
    float b = -n.x * n.z * a;
    return mat3(vec3(1.0 - n.x * n.x * a, -n.x, b), vec3(b, -n.z, 1.0 - n.z * n.z * a), n);
}

// How far the cones of a set go.
struct ConeReach {
    float distance;  // m
    float fade;      // March::fade
};

// Irradiance / pi (rgb) at a surface by the set of cones of ConeBlock (eq. 4.5), and how much of the cosine-
// weighted hemisphere is open (a). `count` cones from the front of the table; 0: none, with little work done.
// One loop over all samples of all cones: nested loops would wait for the longest cone of eight pixels once
// per cone.
vec4 gatherCones(vec3 origin, vec3 normal, uint count, ConeReach reach, out uint samples) {
    mat3 frame = frameAbout(normal);
    vec4 sum = vec4(0.0);
    uint cone = 0u;
    samples = 0u;
    March m = startMarch(origin, frame * cones.cone[0].xyz, cones.aperture[0].x, reach.distance, reach.fade);
    if (count == 0u) return sum;
    do {
        stepMarch(m, cones.step);
        ++samples;
        if (isFinished(m)) {
            float open = m.gathered.a >= kFullOpacity ? 0.0 : 1.0 - m.gathered.a;
            sum += cones.cone[cone].w * vec4(marchedRadiance(m), open);
            RECORD_PATH(reach.fade > 0.0 ? PATH_OCCLUSION_CONE : PATH_DIFFUSE_CONE, origin, m.direction,
                        m.tanHalf, vec3(cones.cone[cone].w),
                        reach.fade > 0.0 ? vec3(open) : marchedRadiance(m), 1.0 - open, m.t,
                        open == 0.0 ? END_FULL : END_OPEN);
            ++cone;
            uint next = min(cone, MAX_CONES - 1u);
            m = startMarch(origin, frame * cones.cone[next].xyz, cones.aperture[next].x, reach.distance,
                           reach.fade);
        }
    } while (cone < count && samples < kMaxSamples);
    return sum;
}
