// SPDX-License-Identifier: MIT
// A face's state in the irradiance cache, from its texel; of faces that share another's, from that one's.
#include "shared/irradiance.h"

int stateOwner(int face, uvec4 texel) { return (texel.w & CACHE_SHARES) != 0u ? int(texel.x) : face; }
FaceCache unpackState(uvec4 texel) { return FaceCache(uintBitsToFloat(texel.xyz), texel.w); }

bool isInterior(FaceCache state) {
    uint rays = (state.counts >> 16) & 0xffu;
    return rays >= IRRADIANCE_INTERIOR_RAYS && 4u * (state.counts >> 24) > rays;
}
