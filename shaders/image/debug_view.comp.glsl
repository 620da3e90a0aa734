#version 450 core
// SPDX-License-Identifier: MIT
// G-buffer -> picture of one of its parts (src/image/debug_view.h). One of VIEW_ALBEDO, VIEW_NORMAL,
// VIEW_DEPTH, VIEW_EMISSION is defined.
#if !defined(VIEW_ALBEDO) && !defined(VIEW_NORMAL) && !defined(VIEW_DEPTH) && !defined(VIEW_EMISSION)
#error one VIEW_ define is needed
#endif
layout(local_size_x = 8, local_size_y = 8) in;
#include "lib/frame_block.glsl"
#include "lib/gbuffer.glsl"
layout(rgba32f) uniform writeonly image2D outputImage;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (pixel.x >= int(frame.width) || pixel.y >= int(frame.height)) return;
    Surface surface;
    bool hit = fetchSurface(pixel, surface);
    vec3 shown;
#if defined(VIEW_ALBEDO)
    shown = surface.albedo;
#elif defined(VIEW_NORMAL)
    shown = 0.5 + 0.5 * surface.normal;
#elif defined(VIEW_DEPTH)
    shown = vec3(surface.depth);
#else
    shown = surface.emission;
#endif
    imageStore(outputImage, pixel, hit ? vec4(shown, 1.0) : vec4(0.0));
}
