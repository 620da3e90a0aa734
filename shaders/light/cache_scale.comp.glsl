#version 450 core
// SPDX-License-Identifier: MIT
// After a change of light that is for the most part a factor of all of it: each face whose light is nearer to the new one
// with that factor takes it (docs/theory/4d_cache.md, "Light that is scaled"). Before cache_commit.
layout(local_size_x = 64) in;
#include "light/cache_edits.glsl"

void main() {
    uint face = linearIndex();
    if (face >= grid.faceCount) return;
    FaceCache state = states[face];
    if ((state.counts & CACHE_SHARES) != 0u) return;
    vec3 position = facePosition(face);
    if (!isBetterScaled(position, state.irradiance)) return;
    states[face].irradiance = cache.lightScale * state.irradiance;
    states[face].counts = state.counts | CACHE_SCALED;
}
