// SPDX-License-Identifier: MIT
// The thesis's volumes in an octree (shared/radiance_octree.h), as a sampler of a dense texture gives them: between
// two levels, texels at the edge repeated outside. Before it: ThesisGrid `grid`.
#include "lib/radiance_octree.glsl"

// Where two levels are sampled.
struct VolumePlace {
    uvec2 fineNode;
    uvec2 coarseNode;
    vec3 finePlace;
    vec3 coarsePlace;
    float between;  // 0: the finer alone
};

// q: 0..1 in the grid.
VolumePlace volumePlace(vec3 q, float level) {
    int fine = int(level);
    int coarse = min(fine + 1, int(grid.maxLevel));
    ivec3 size = ivec3(int(grid.size));
    VolumePlace p;
    p.fineNode = octreePlace(q, size >> fine, fine, p.finePlace);
    p.coarseNode = octreePlace(q, size >> coarse, coarse, p.coarsePlace);
    p.between = level - float(fine);
    return p;
}

vec4 sampleBricks(sampler3D bricks, VolumePlace p) {
    return mix(octreeFiltered(bricks, p.fineNode, 0, p.finePlace),
               octreeFiltered(bricks, p.coarseNode, 0, p.coarsePlace), p.between);
}

// What is left at q of a level's texels where the grid is bordered by nothing: a tent beyond the outermost centres.
float withinBorder(vec3 q, int level) {
    vec3 u = q * (grid.size / exp2(float(level))) - 0.5;
    vec3 within = clamp(1.0 - max(-u, u - (grid.size / exp2(float(level)) - 1.0)), 0.0, 1.0);
    return within.x * within.y * within.z;
}

// The same, of areas of surface: beyond the grid there is none.
void sampleBorderedBricks(sampler3D first, sampler3D second, vec3 q, float level, out vec3 a, out vec3 b) {
    VolumePlace p = volumePlace(q, level);
    int fine = int(level);
    vec2 share = vec2(1.0 - p.between, p.between) *
                 vec2(withinBorder(q, fine), withinBorder(q, min(fine + 1, int(grid.maxLevel))));
    a = share.x * octreeFiltered(first, p.fineNode, 0, p.finePlace).rgb +
        share.y * octreeFiltered(first, p.coarseNode, 0, p.coarsePlace).rgb;
    b = share.x * octreeFiltered(second, p.fineNode, 0, p.finePlace).rgb +
        share.y * octreeFiltered(second, p.coarseNode, 0, p.coarsePlace).rgb;
}
