// SPDX-License-Identifier: MIT
// A texture's mean over the part of it that a pixel covers: gradients -> texel. Anisotropic, without help of the
// driver, so that every driver shows the same.
//
// The pixel, a square, covers a parallelogram of the texture. Its principal axes come from the singular values of
// its edges (Heckbert 1989, "Fundamentals of Texture Mapping and Image Warping", section 3.5). Taps lie along the
// longer axis, each as wide as the shorter one, by mip level (McCormack et al. 1999, "Feline").
// docs/theory/5_image.md, "Textures".
#include "lib/dot.glsl"

// Taps at most. Beyond a ratio of so much texels are averaged across the shorter axis, too.
const float kMostTaps = 16.0;

// What a pixel covers of a texture.
struct TexelFootprint {
    vec2 axis;     // the longer one, uv units
    float longer;  // its length, texels
    float width;   // of a tap, texels
};

// Of the parallelogram of edges `across` and `up`, uv units.
TexelFootprint texelFootprint(sampler2D map, vec2 across, vec2 up) {
    vec2 size = vec2(textureSize(map, 0));
    vec2 a = across * size, b = up * size;
    // Singular values of the matrix with columns a and b, and the direction of the longer one
    float xx = a.x * a.x + b.x * b.x, yy = a.y * a.y + b.y * b.y, xy = a.x * a.y + b.x * b.y;
    float longer = sqrt(0.5 * (xx + yy) + length(vec2(0.5 * (xx - yy), xy)));
    float shorter = abs(a.x * b.y - a.y * b.x) / max(longer, 1e-20);
    float angle = 0.5 * atan(2.0 * xy, xx - yy);
    return TexelFootprint(longer * vec2(cos(angle), sin(angle)) / size, longer,
                          max(max(shorter, 1.0), longer / kMostTaps));
}

// The mean of `map` over a footprint about `at`.
vec4 filteredTexel(sampler2D map, vec2 at, TexelFootprint footprint) {
    int taps = int(clamp(ceil(footprint.longer / footprint.width), 1.0, kMostTaps));
    float level = log2(footprint.width);
    vec4 sum = vec4(0.0);
    int i = 0;
    do {
        float along = (float(i) + 0.5) / float(taps) - 0.5;
        sum += textureLod(map, at + along * footprint.axis, level);
    } while (++i < taps);
    return sum / float(taps);
}
