// SPDX-License-Identifier: MIT
// What tests of views share (edges, shadow maps, voxels): pictures of 64 x 64 by one renderer, a red cube,
// and measures of pictures.
#pragma once

#include <memory>

#include "conelight/renderer.h"
#include "support/gl_fixture.h"
#include "support/scenes.h"

namespace conelight::test {

constexpr int kViewPixels = 64;

// The colour of a pixel, row 0 at the top.
glm::vec3 colorAt(const Image& image, int x, int y);

// Part of the picture that is covered.
double covered(const Image& image);

// Part of the pixels whose colours are further apart than 1e-3.
double differing(const Image& a, const Image& b);

// 32 voxels, small shadow maps, few rays.
Settings viewSettings(Mode mode, Component component);

// A red cube of edge 1 about the origin, in front of nothing, seen from +z and a little above and beside.
Scene redCube();

class ViewsTest : public GlTest {
  protected:
    void TearDown() override;
    // One renderer for all pictures of a test: programs are built once.
    Image draw(const Scene& scene, const Settings& settings);
    // The scene of the last draw.
    Image again(const Scene& scene, const Settings& settings);

  private:
    std::unique_ptr<Renderer> renderer_;
};

}  // namespace conelight::test
