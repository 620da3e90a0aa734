// SPDX-License-Identifier: MIT
// The shadow map being drawn (light/shadow_maps.cpp).
#include "shared/shadow_map.h"
layout(std140) uniform ShadowMapBlock { ShadowMapConstants shadowMap; };
