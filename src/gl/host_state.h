// SPDX-License-Identifier: MIT
// Leaves the host's GL state as it was found: saves it, sets what the passes of this library rely on, and
// restores it. Every public call that draws, uploads or reads back stands under one.
//
// Saved and restored, and set to GL's defaults in between (exceptions in brackets):
//   objects       program, vertex array, draw and read framebuffer, active texture unit
//   textures      units 0-31: 2D, 2D array, 3D, cube, cube array, buffer, and the sampler (left bound)
//   images        units 0-7 (left bound)
//   buffers       uniform 0-7 and storage 0-15 with their ranges and the two generic points (left bound);
//                 pixel pack and unpack, draw and dispatch indirect
//   viewports     16 viewports, depth ranges, scissor boxes and tests
//   per target    8 times: blend switch, functions and equations, colour mask; blend colour
//   depth         test, mask, function, clamp
//   polygons      cull switch and face, front face, mode, offset switches, factor and units, line width,
//                 provoking vertex, clip origin and depth mode, clip distances, point size by program
//   switches      colour logic operation, dither (off), sRGB framebuffer, multisample, sample shading, mask
//                 and coverage, alpha to coverage and to one, stencil test, line and polygon smooth,
//                 primitive restart and its index, rasterizer discard, seamless cubes (on)
//   pixel store   pack and unpack: alignment, row length, image height, skips, byte and bit order
//
// Untouched by this library, hence not saved: everything else (renderbuffers, other texture targets and
// units, queries, transform feedback, debug callback, clear values, stencil functions ...). The host ends
// conditional rendering, transform feedback and queries before it calls.
#pragma once

#include <memory>

namespace conelight::gl {

class HostStateGuard {
  public:
    // The context must be current, and the same one in both. Costs 0.01 ms of CPU on llvmpipe (the test
    // measures it). Throws Error(NoGl) where none is current.
    HostStateGuard();
    ~HostStateGuard();
    HostStateGuard(const HostStateGuard&) = delete;
    HostStateGuard& operator=(const HostStateGuard&) = delete;

  private:
    struct State;
    std::unique_ptr<State> saved_;
};

}  // namespace conelight::gl
