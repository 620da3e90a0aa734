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

// The opacity of a texel in which surface of area `area` is seen as `plus` and `minus` along the axes, by the side that
// it faces: as much as is seen from one of the six sides. Of a wall that is its area. The sides of a body hide each
// other; a small lamp would count three times, a small box six times. Areas come in steps of 1/255.
float seenOpacity(float area, vec3 plus, vec3 minus) {
    vec3 most = max(plus, minus);
    return clamp(max(max(most.x, most.y), most.z) + 1.0 / 255.0, area / 6.0, min(area, 1.0));
}

// `plus`, `minus`: areas of the texel that is made.
vec4 mipTexel(vec4 sum, vec4 plus, vec4 minus) {
#if VOLUME_MIPS
    return mipTexel(sum);
#else
    float area = 0.25 * sum.a;
    return sum * (0.25 * seenOpacity(area, plus.xyz, minus.xyz) / max(area, 1e-12));
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
