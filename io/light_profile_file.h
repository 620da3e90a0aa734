// SPDX-License-Identifier: MIT
// Profiles of lamps from IES files (IES LM-63-1986, -1995, -2002, -2019; photometry of type C): text -> factors by
// direction. Candela are value times multiplier times both ballast factors. What stands between the angles of the
// file is linear, what lies beyond its vertical ones dark.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "conelight/scene.h"

namespace conelight::io {

// Throws Error(BadInput) "FILE: line N: what is wrong".
std::shared_ptr<const LightProfile> readLightProfile(const std::string& path);
std::shared_ptr<const LightProfile> parseLightProfile(const std::string& file, std::string_view text);

// Gives the profile to a point or spot light, white and as strong as it was measured: 683 lm/W.
void setLightProfile(Light& light, std::shared_ptr<const LightProfile> profile);

}  // namespace conelight::io
