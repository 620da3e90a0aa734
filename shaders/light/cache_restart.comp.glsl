#version 450 core
// SPDX-License-Identifier: MIT
// After a change of light: of how many updates the mean of each face counts as. What was there is replaced by the next
// updates, but is good until then. Behind cache_commit, which reads what faces share.
layout(local_size_x = 64) in;
#include "light/cache_edits.glsl"

// The updates that count of those that a face has had, after a change: 1 near it, where the next update replaces what was
// there.
uint updatesKept(FaceCache state, vec3 position) {
    float changed = cache.restartsNear != 0u ? 0.0 : 1.0;
    for (uint i = 0u; i < cache.placeCount; ++i) {
        uint at = editPlace(i);
        changed += changedPart(position, cache.places[at], cache.placeParts[at >> 2][at & 3u]);
    }
    changed += changedLight(position, state.irradiance, (state.counts & CACHE_SCALED) != 0u);
    uint updates = state.counts & CACHE_UPDATES_MASK;
    if (changed == 0.0) return updates;  // all light is scaled, and nothing else is another
    float weight = clamp(weightAfterChange(changed), IRRADIANCE_FAR_WEIGHT, 1.0);
    float window = 1.5 / weight - 1.5;  // as (4.13) weighs
    return min(updates, window < 1.0 ? 1u : uint(window) + IRRADIANCE_SETTLE);
}

void main() {
    uint face = linearIndex();
    if (face >= grid.faceCount) return;
    FaceCache state = states[face];
    if ((state.counts & CACHE_SHARES) != 0u) return;
    states[face].counts = (state.counts & 0xffff0000u) | updatesKept(state, facePosition(face));
}
