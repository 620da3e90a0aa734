// SPDX-License-Identifier: MIT
// The pixels that need rays into their lobe, found by gather/lobe_select.comp.glsl. Passes over them are
// indirect dispatches of LOBE_GROUPS_X groups of 8 x 8 in x. Define LOBE_LIST_ACCESS as readonly where
// nothing is added; include after the layout of the group.
#include "lib/linear_index.glsl"
#include "lib/surface.glsl"
#include "shared/pixel_rays.h"
layout(std430) LOBE_LIST_ACCESS buffer LobeList {
    uvec3 groups;
    uint count;
    uint firstRow;  // of groups, of the dispatch
    uint pixels[];  // x | y << 16
}
lobeList;

// The pixel of this invocation; `none` beyond the end of the list.
ivec2 listedPixel(ivec2 none) {
    uint index = lobeList.firstRow * LOBE_GROUPS_X * 64u + linearIndex();
    bool listed = index < lobeList.count;
    uint place = lobeList.pixels[listed ? index : 0u];
    return listed ? ivec2(place & 0xffffu, place >> 16) : none;
}

// Whether the surface that a pixel shows, if `seen`, is smooth enough for rays, and reflects.
bool hasLobe(Surface s, bool seen, float roughest) {
    vec3 f0 = mix(s.dielectricF0, s.albedo, s.metallic);
    return seen && !s.unlit && s.roughness <= roughest && max(f0.r, max(f0.g, f0.b)) > 0.0;
}
