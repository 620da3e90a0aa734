// SPDX-License-Identifier: MIT
// The pixels that need rays into their lobe, found by step 1 of gather/ray_specular.comp.glsl. Passes over
// them are indirect dispatches of LOBE_GROUPS_X groups of 8 x 8 in x. Define LOBE_LIST_ACCESS as readonly
// where nothing is added; include after the layout of the group.
#include "lib/linear_index.glsl"
#include "shared/pixel_rays.h"
layout(std430, binding = PIXEL_LOBE_LIST) LOBE_LIST_ACCESS buffer LobeList {
    uvec3 groups;
    uint count;
    uint pixels[];  // x | y << 16
}
lobeList;

// The pixel of this invocation; `none` beyond the end of the list.
ivec2 listedPixel(ivec2 none) {
    uint index = linearIndex();
    bool listed = index < lobeList.count;
    uint place = lobeList.pixels[listed ? index : 0u];
    return listed ? ivec2(place & 0xffffu, place >> 16) : none;
}
