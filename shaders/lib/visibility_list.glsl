// SPDX-License-Identifier: MIT
// Pixels of which shadow maps leave open whether they see some light (gather/visibility_maps.comp.glsl), for rays
// (gather/visibility_rays.comp.glsl), which are an indirect dispatch of VISIBILITY_GROUPS_X groups of 64 in x. Define
// VISIBILITY_LIST_ACCESS as readonly where nothing is added.
#include "shared/visibility_list.h"
layout(std430) VISIBILITY_LIST_ACCESS buffer VisibilityList {
    uvec3 groups;
    uint count;
    uint firstRow;   // of groups, of the dispatch
    uvec2 pixels[];  // x | y << 16; bit n: light n
}
visibilityList;
