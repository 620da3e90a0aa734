#version 450 core
// SPDX-License-Identifier: MIT
// G-buffer -> list of the pixels that need rays into their lobe (lib/lobe_list.glsl), and the arguments of an
// indirect dispatch over it. Branches do not spare software drivers work, and stores into images cost them
// word by word: so pixels are sorted out here, and pictures of lobes hold nothing at the others. Runs over
// the rectangle in which such pixels can be.
layout(local_size_x = 8, local_size_y = 8) in;
#define LOBE_LIST_ACCESS
#include "lib/brdf.glsl"
#include "lib/gbuffer.glsl"
#include "lib/lobe_list.glsl"
layout(std140) uniform PixelRayBlock { PixelRayConstants pixelRays; };

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy) + ivec2(pixelRays.lowestX, pixelRays.lowestY);
    ivec2 size = textureSize(gbufferGeometry, 0);
    Surface s;
    bool seen = fetchSurface(min(pixel, size - 1), s);
    bool listed = all(lessThan(pixel, size)) && hasLobe(s, seen, pixelRays.specularLimit);
    if (listed) {
        uint at = atomicAdd(lobeList.count, 1u);
        lobeList.pixels[at] = uint(pixel.x) | uint(pixel.y) << 16;
        atomicMax(lobeList.groups.y, at / (64u * LOBE_GROUPS_X) + 1u);
    }
}
