#version 450 core
// SPDX-License-Identifier: MIT
// Irradiance / pi of mode hybrid (rgb). Where light was baked: that, and the difference that what moves makes to what
// cones gather, which is that of all less that of what does not move; elsewhere what cones gather of all.
//   MOVES  0: nothing moves, there are no cones
#ifndef MOVES
#error MOVES must be 0 or 1
#endif
#include "lib/gbuffer_pack.glsl"
#include "lib/picture_pass.glsl"
#include "lib/scene_tables.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba16f) writeonly uniform image2D result;
uniform usampler2D gbufferGeometry;
uniform sampler2D bakedIrradiance;
#if MOVES
uniform sampler2D allIrradiance;
uniform sampler2D staticIrradiance;
#endif

// Baked irradiance / pi of a pixel of an instance (a above 0); where its mesh missed the pixel, the mean of the
// nearest ones of that instance.
vec4 bakedAt(ivec2 pixel, uint instance) {
    vec4 own = texelFetch(bakedIrradiance, pixel, 0);
    if (own.a > 0.0) return own;
    ivec2 last = imageSize(result) - 1;
    vec4 sum = vec4(0.0);
    for (int reach = 1; reach <= 2 && sum.a == 0.0; ++reach)
        for (int i = 0; i < (2 * reach + 1) * (2 * reach + 1); ++i) {
            ivec2 at = pixel + ivec2(i % (2 * reach + 1), i / (2 * reach + 1)) - reach;
            bool inside = all(greaterThanEqual(at, ivec2(0))) && all(lessThanEqual(at, last));
            at = clamp(at, ivec2(0), last);
            bool same = inside && instanceOfWord(texelFetch(gbufferGeometry, at, 0).w) == instance;
            sum += same ? texelFetch(bakedIrradiance, at, 0) : vec4(0.0);
        }
    return sum.a > 0.0 ? sum / sum.a : vec4(0.0);
}

void main() {
    ivec2 pixel = passPixel();
    if (any(greaterThanEqual(pixel, imageSize(result)))) return;
    uvec4 geometry = texelFetch(gbufferGeometry, pixel, 0);
    uint instance = instanceOfWord(geometry.w);
    bool isBaked = geometry.x != 0u && (instances[instance].flags & INSTANCE_BAKED) != 0u;
    vec4 baked = isBaked ? bakedAt(pixel, instance) : vec4(0.0);
    vec3 irradiance = baked.rgb;
#if MOVES
    vec4 all = texelFetch(allIrradiance, pixel, 0);
    vec3 difference = all.rgb - texelFetch(staticIrradiance, pixel, 0).rgb;
    irradiance = baked.a > 0.0 ? max(baked.rgb + difference, 0.0) : all.rgb;
#endif
    imageStore(result, pixel, vec4(irradiance, 1.0));
}
