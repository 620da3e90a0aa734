// SPDX-License-Identifier: MIT
// What the files of the metrics share: which pixels count, display images, and the metrics that look at
// neighbourhoods. Use metrics.h from elsewhere.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "reference/metrics.h"

namespace conelight::reference {

// Linear colours, rows from the top.
struct Colors {
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> pixels;
};

// 1 where a pixel is chosen (MetricOptions::pixels) and finite in all images, else 0. Throws Error(BadInput) as
// compareImages does.
std::vector<std::uint8_t> usablePixels(const std::vector<const Image*>& images,
                                       const std::vector<std::uint8_t>& chosen);

// The image with black where it is not usable.
Colors usableColors(const Image& image, const std::vector<std::uint8_t>& usable);

// clamp(2^exposure c, 0, 1), still linear.
Colors displayColors(const Colors& colors, float exposure);

// sRGB transfer curve of one channel, [0,1] in and out.
float srgbOf(float linear);

// Rec.709 weights (ITU-R BT.709): luminance of linear colours, luma of encoded ones.
inline float luminanceOf(const glm::vec3& c) { return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b; }

// Mean SSIM of two luma planes in [0,1]; windows with an unusable pixel are left out. NaN when none is left.
double meanSsim(const std::vector<float>& test, const std::vector<float>& reference, int width, int height,
                const std::vector<std::uint8_t>& usable);

// FLIP per pixel. ldrFlip takes linear colours in [0,1]; hdrFlip any (negative values count as 0).
std::vector<float> ldrFlip(const Colors& test, const Colors& reference, float pixelsPerDegree);
std::vector<float> hdrFlip(const Colors& test, const Colors& reference, float pixelsPerDegree);

}  // namespace conelight::reference
