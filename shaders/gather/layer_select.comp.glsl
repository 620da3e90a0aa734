#version 450 core
// SPDX-License-Identifier: MIT
// Layers of surfaces (lib/layers.glsl) -> list of the pixels that have any (lib/lobe_list.glsl), and the arguments of an
// indirect dispatch over it. Runs over the rectangle in which such pixels can be.
layout(local_size_x = 8, local_size_y = 8) in;
#define LOBE_LIST_ACCESS
#include "lib/layers.glsl"
#include "lib/lobe_list.glsl"
layout(std140) uniform PixelRayBlock { PixelRayConstants pixelRays; };
uniform usampler2D surfaceLayers;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy) + ivec2(pixelRays.lowestX, pixelRays.lowestY);
    ivec2 size = textureSize(surfaceLayers, 0);
    uvec4 bits = texelFetch(surfaceLayers, min(pixel, size - 1), 0);
    if (all(lessThan(pixel, size)) && hasLayers(bits)) {
        uint at = atomicAdd(lobeList.count, 1u);
        lobeList.pixels[at] = uint(pixel.x) | uint(pixel.y) << 16;
        atomicMax(lobeList.groups.y, at / (64u * LOBE_GROUPS_X) + 1u);
    }
}
