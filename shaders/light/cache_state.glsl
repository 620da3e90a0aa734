// SPDX-License-Identifier: MIT
// A face's state in the irradiance cache, from its texel.
#include "shared/irradiance.h"

FaceCache unpackState(uvec4 texel) { return FaceCache(uintBitsToFloat(texel.xyz), texel.w); }
