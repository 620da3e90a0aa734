// SPDX-License-Identifier: MIT
// Why a picture is black: the usual reasons, looked for in scene, settings and camera with a few hundred
// rays.
#pragma once

#include <string>
#include <vector>

#include "conelight/renderer.h"
#include "session/picker.h"

namespace conelight::program {

// Whether all but 2 % of the picture is not told from black on a screen (8 bits, at most 2 of 255 after
// exposure and tone map), or its mean is below 1 of 255: where nothing is lit, voxels still let a spark
// through here and there.
bool isBlack(const Image& image, const ImageSettings& settings);

// Reasons, the likeliest first, each "what is; what would help"; empty when none is found. `image`: the
// linear picture if there is one, else its brightness is estimated from direct light.
std::vector<std::string> whyBlack(const Session& session, Picker& picker, const Image* image = nullptr);

}  // namespace conelight::program
