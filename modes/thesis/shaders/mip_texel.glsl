// SPDX-License-Identifier: MIT
// Eight texels, added up -> the texel of twice the edge that they make. Colour stays premultiplied.
//
// It has four times the cross-section, so the covered areas of its eight children add up to a quarter: a plane keeps
// its opacity in every level. VOLUME_MIPS, as in the original: an eighth, the mean over the volume; a wall of one voxel
// then halves its opacity per level.
#include "thesis/shaders/defects.glsl"

vec4 mipTexel(vec4 sum) {
#if VOLUME_MIPS
    return sum * 0.125;
#else
    sum *= 0.25;
    return sum / max(sum.a, 1.0);
#endif
}

// Of areas along the axes, each for itself.
vec4 mipAreas(vec4 sum) {
#if VOLUME_MIPS
    return sum * 0.125;
#else
    return min(sum * 0.25, 1.0);
#endif
}
