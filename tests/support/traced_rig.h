// SPDX-License-Identifier: MIT
// What tests of mode `traced` share: pictures of 48 x 48 with settings small enough for a processor, and
// measures of their noise.
#pragma once

#include <array>
#include <functional>

#include "conelight/renderer.h"
#include "reference/path_tracer.h"
#include "support/gl_fixture.h"
#include "support/truth_rig.h"

namespace conelight::test {

constexpr int kTracedPixels = 48;

// Mode traced at a quality, with 32 voxels, and no more rays and passes than a test can wait for.
Settings tracedSettings(Quality quality, Component component = Component::Full);

// relRMSE of indirect light, the truth's own noise left out by its halves.
double indirectError(const Image& image, const reference::PathTracedPicture& truth);

// Pixels that `isDot(own, sorted 3x3)` says so of, by their red.
int dotsIn(const Image& image, const std::function<bool(float, const std::array<float, 9>&)>& isDot);

// Draws through the first camera of a scene.
class TracedModeTest : public GlTest {
  protected:
    static Image draw(Renderer& renderer, const Scene& scene, const Settings& settings);
    static Image draw(const Scene& scene, const Settings& settings);
};

}  // namespace conelight::test
