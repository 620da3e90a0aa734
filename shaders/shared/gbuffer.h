// SPDX-License-Identifier: MIT
// Depths of the G-buffer: those of surfaces end before that of the background (1), so that a pass over the
// picture may ask the depth test where a surface is. Drivers skip the other pixels, where a branch or a
// discard in a shader spares a software driver nothing.
#pragma once

#define GBUFFER_FARTHEST 0.9999847f  // 1 - 2^-16: far above rounding, and depths keep their order
#define GBUFFER_BEHIND 0.9999924f    // 1 - 2^-17: behind all surfaces, before the background
