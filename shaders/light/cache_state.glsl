// SPDX-License-Identifier: MIT
// A face's state in the irradiance cache, from its texel; of faces that share another's, from that one's.
#include "shared/irradiance.h"

int stateOwner(int face, uvec4 texel) { return (texel.w & CACHE_SHARES) != 0u ? int(texel.x) : face; }
FaceCache unpackState(uvec4 texel) { return FaceCache(uintBitsToFloat(texel.xyz), texel.w); }

// Whether more than a quarter of the rays so far have met a surface from behind first.
bool looksInterior(FaceCache state) { return 4u * (state.counts >> 24) > ((state.counts >> 16) & 0xffu); }

bool isInterior(FaceCache state) {
    return ((state.counts >> 16) & 0xffu) >= IRRADIANCE_INTERIOR_RAYS && looksInterior(state);
}
