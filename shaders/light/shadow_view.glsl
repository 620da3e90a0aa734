// SPDX-License-Identifier: MIT
// The map being drawn (light/shadow_maps.cpp).
#include "shared/bindings.h"
layout(std140) uniform ShadowViewBlock {
    mat4 clipFromWorld;
    vec2 slopeUnit;  // a slope of 1 is slopeUnit.x + slopeUnit.y * depth, per texel
    vec2 middle;     // of the map, in texels of the layer
    vec2 halfSize;   // texels
};
