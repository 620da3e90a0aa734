// SPDX-License-Identifier: MIT
// How wrong a picture is: a test image against a reference image of the same size, in numbers and as maps.
//
// All numbers but PSNR, SSIM and FLIP are taken on linear radiance. N is the number of compared values: 3
// channels of every pixel in which both images are finite. x is the test image, r the reference.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "conelight/renderer.h"

namespace conelight::reference {

struct Metrics {
    std::size_t pixels = 0;     // compared
    std::size_t badPixels = 0;  // not finite in either image: left out of every number below, and reported
    double mean = 0;            // of the test image
    double referenceMean = 0;   // of the reference
    double bias = 0;            // mean / referenceMean - 1
    double mae = 0;             // sum |x - r| / N
    double mse = 0;      // sum (x - r)^2 / N; with two halves a, b of the reference: sum (x-a)(x-b) / N,
                         // which does not count the reference's own noise and may be negative
    double rmse = 0;     // sqrt(max(mse, 0))
    double relRmse = 0;  // rmse / referenceMean: "the error in parts of the mean light"
    double relMse = 0;   // sum (x - r)^2 / (r^2 + 0.01) / N (Rousselle et al. 2011, eq. 6)
    double psnr = 0;     // 10 log10(1 / mse) of the display images (see MetricOptions), dB
    double ssim = 0;     // Wang et al. 2004: mean over 11x11 Gaussian windows (sigma 1.5) of luma
    double flip = 0;     // mean LDR-FLIP of the display images (Andersson et al. 2020), [0,1]
    double hdrFlip = 0;  // mean HDR-FLIP of the linear images (Andersson et al. 2021), [0,1]
};

struct MetricOptions {
    float exposure = 0;              // stops, for the display images
    float pixelsPerDegree = 67.02f;  // FLIP: 0.7 m from a 0.7 m wide display of 3840 pixels (its default)
    bool flip = true;                // FLIP costs more than all others together
};

// The two halves are independent estimates of the reference whose mean is the reference.
struct Halves {
    const Image* a = nullptr;
    const Image* b = nullptr;
};

// Throws Error(BadInput) when the sizes differ or there is no pixel.
Metrics compareImages(const Image& test, const Image& reference, const MetricOptions& options = {},
                      std::optional<Halves> halves = {});

enum class ErrorMap { Signed, Absolute, RelativeSquared, Flip, HdrFlip };
// Per pixel: signed: (x - r) luminance / referenceMean; absolute: its magnitude; the others as in Metrics.
std::vector<float> errorValues(const Image& test, const Image& reference, ErrorMap map,
                               const MetricOptions& options = {});

// Colour scale of error maps, sRGB-encoded: magnitudes 0..1 run black-violet-orange-yellow (Magma of
// matplotlib, CC0); signed values -1..1 run blue-white-red. Not finite: green.
void colorOfError(float value, bool isSigned, std::uint8_t rgb[3]);

}  // namespace conelight::reference
