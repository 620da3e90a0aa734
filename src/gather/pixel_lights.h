// SPDX-License-Identifier: MIT
// The variant of shaders that light what pixels see: directional lights have maps about the eye where there are any.
#pragma once

#include "light/lights.h"
#include "view/surfaces.h"

namespace conelight::gather {

inline light::LightKey lightsOfPixels(const light::Lights& lights, const view::Surfaces& surfaces) {
    light::LightKey key = lights.key();
    key.cascades = key.shadows && key.directional > 0 && surfaces.haveCascades();
    return key;
}

}  // namespace conelight::gather
