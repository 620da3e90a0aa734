// SPDX-License-Identifier: MIT
// A level of a chain of halved pictures, seen by the pixels of the next finer one: a tent over 3 x 3 texels (Jimenez
// 2014), so that no squares show. Texels beyond the edge are those at the edge.
vec3 bloomTent(sampler2D chain, int level, ivec2 pixel) {
    vec2 size = vec2(textureSize(chain, level));
    vec2 at = 0.5 * (vec2(pixel) + 0.5);
    vec3 sum = vec3(0.0);
    for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i)
            sum += 0.0625 * float((2 - abs(i)) * (2 - abs(j))) *
                   textureLod(chain, (at + vec2(i, j)) / size, float(level)).rgb;
    return sum;
}
