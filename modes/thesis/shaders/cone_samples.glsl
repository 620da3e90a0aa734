// SPDX-License-Identifier: MIT
// What the three kinds of cones share: samples of the lit volume, how opacity adds up along a cone, where a
// cone begins and ends. Before it: ThesisGrid `grid`, sampler3D `volume`, the frame block. OCTREE: `volume` holds
// the bricks of a tree.
#include "thesis/shaders/defects.glsl"
#include "thesis/shaders/march.glsl"

#ifndef OCTREE
#define OCTREE 0
#endif
#if OCTREE
#include "thesis/shaders/octree_volume.glsl"
#endif

vec4 sampleVolume(vec3 position, float size) {
    vec3 q = (position - grid.origin) / grid.edge;
    float level = sampleLevel(size, grid.voxelSize, grid.maxLevel);
#if OCTREE
    return sampleBricks(volume, volumePlace(q, level));
#else
    return textureLod(volume, q, level);
#endif
}

// Whether a cone has met what there is: half a sample past the border, so that the surfaces there count in full.
bool leftGrid(vec3 position, float size) {
    return any(greaterThan(abs(position - grid.origin - 0.5 * grid.edge), vec3(0.5 * (grid.edge + size))));
}

// One march (constants.h).
struct ThesisCone {
    float spread;
    float stepFactor;
    float start;
    float reach;
};
ThesisCone coneOf(vec4 v) { return ThesisCone(v.x, v.y, v.z, v.w); }

// What a cone has gathered.
struct Gathered {
    vec3 color;
    float opacity;
};

// Opacity that a step of length `length` through a sample of size `size` adds: its part of a surface that the
// sample holds. Pieces of one surface add up, they do not hide each other.
float stepOpacity(float opacity, float length, float size) {
#if NO_STEP_CORRECTION
    return opacity;
#else
    return min(opacity * (length / size), 1.0);
#endif
}

// Front to back. `texel` is premultiplied (mips average empty space in).
void accumulate(inout Gathered sum, vec4 texel, float added) {
#if NO_STEP_CORRECTION
    float seen = (1.0 - sum.opacity) * added;
#else
    float seen = min(added, 1.0 - sum.opacity);
#endif
#if DOUBLE_ALPHA
    vec3 color = seen * texel.rgb;
#else
    vec3 color = seen * texel.rgb / max(texel.a, 1e-6);
#endif
#if FORGET_NEAR_COLOR
    sum.color = sum.opacity * sum.color + color;
#else
    sum.color += color;
#endif
    sum.opacity += seen;
}

float stepLength(ThesisCone cone, float diameter, float size) {
#if FINE_STEPS
    return cone.stepFactor * diameter;
#else
    return cone.stepFactor * size;
#endif
}

// Where cones begin: the original at fixed distances in world units; here just clear of the own surface.
float originOffset(float fixedOffset) {
#if FIXED_OFFSETS
    return fixedOffset;
#else
    return kOriginOffset * grid.voxelSize;
#endif
}

// `size`: of the last sample.
bool coneEnded(float t, vec3 position, float size, float reach) {
#if SHORT_REACH
    return t >= reach;
#else
    return leftGrid(position, size);
#endif
}
