// SPDX-License-Identifier: MIT
// Matrices of a camera, and what shaders know of it. Computed in double, given in float.
#pragma once

#include "conelight/scene.h"
#include "shared/frame.h"

namespace conelight::view {

// Throws Error(Usage) for one that sees nothing: numbers that are not finite, no angle, no depth.
void requireUsable(const Camera& camera);

glm::mat4 viewFromWorld(const Camera& camera);
glm::mat4 clipFromView(const Camera& camera, int width, int height);  // GL clip space, z in [-1,1]

// GL's minimum for GL_MAX_TEXTURE_SIZE in 4.5: pictures are no larger.
constexpr int kMaxEdge = 16384;

// A view of a picture: through points beside the pixels' centres, for a part of their area.
struct PixelPart {
    glm::dvec2 offset{0};    // from the centres, pixels, y up
    float footprint = 1.0f;  // FrameConstants::footprint
    float blending = -1.0f;  // FrameConstants::blending
    glm::dvec2 lens{0};      // through which point of the lens, unit disc, y up
};
// The views whose mean is a picture through a box filter of one pixel: one in each row and each column of
// count x count cells of the pixel, so that also edges along the axes have as many steps (a rank-1 lattice).
PixelPart pixelPart(int index, int count);
// The same for a lens: points that are even over its disc. The mean of `count` views is out of focus as it is.
glm::dvec2 lensPoint(int index);
// Views without an end, any number of which in a row are even over the pixel and the lens (Roberts 2018): the first
// is through the pixels' centres and the middle of the lens.
PixelPart pixelPartOfFrame(int frame);
// The centres, for what the views of an anti-aliased still are to find of blended surfaces.
PixelPart centersOfStill();

gpu::FrameConstants frameConstants(const Camera& camera, int width, int height, const PixelPart& part = {});

}  // namespace conelight::view
