#version 450 core
// SPDX-License-Identifier: MIT
// Pixels per bin of luminance -> exposure: the mean of log luminance, the darkest and the brightest pixels
// left out, becomes middle grey. One group, an invocation per bin.
#include "shared/image.h"
layout(local_size_x = EXPOSURE_BINS) in;
layout(std430) readonly buffer BinCounts { uint counts[]; };
layout(std430) writeonly buffer ExposureTable { Exposure exposure; };
shared uint below[EXPOSURE_BINS];  // pixels up to and with this bin
shared float weights[EXPOSURE_BINS];

void main() {
    uint bin = gl_LocalInvocationIndex;
    uint count = counts[bin];
    below[bin] = count;
    barrier();
    for (uint step = 1u; step < EXPOSURE_BINS; step *= 2u) {
        uint before = bin >= step ? below[bin - step] : 0u;
        barrier();
        below[bin] += before;
        barrier();
    }
    uint total = below[EXPOSURE_BINS - 1u];
    uint first = total / EXPOSURE_DARKEST, end = total - total / EXPOSURE_BRIGHTEST;
    uint from = max(below[bin] - count, first), to = min(below[bin], end);
    uint kept = to > from ? to - from : 0u;
    weights[bin] = float(kept) / float(max(end - first, 1u)) * float(bin);
    barrier();
    for (uint step = EXPOSURE_BINS / 2u; step > 0u; step /= 2u) {
        if (bin < step) weights[bin] += weights[bin + step];
        barrier();
    }
    if (bin != 0u) return;
    // Nothing to see: as it is.
    float stops = log2(EXPOSURE_GREY) + 32.0 - 0.25 * (weights[0] + 0.5);
    exposure.scale = exp2(total == 0u ? 0.0 : clamp(stops, -EXPOSURE_LIMIT, EXPOSURE_LIMIT));
}
