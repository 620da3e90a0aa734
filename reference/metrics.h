// SPDX-License-Identifier: MIT
// How wrong a picture is: a test image against a reference image of the same size, in numbers and as maps.
//
// x is the test image, r the reference, both linear Rec.709 radiance. N is the number of compared values: 3
// channels of every pixel in which all images are finite. Other pixels are counted in badPixels and left out
// of everything else: they stand as black in both images where a metric looks at neighbours (FLIP), and
// windows that hold one are left out (SSIM). Pixels that are not chosen (MetricOptions::pixels) are left out likewise and
// not counted.
//
// PSNR, SSIM and LDR-FLIP compare what a display would show: d(c) = sRGB(clamp(2^exposure c, 0, 1)), with the
// transfer curve of IEC 61966-2-1, no tone curve, no rounding to 8 bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "conelight/renderer.h"

namespace conelight::reference {

struct Metrics {
    std::size_t pixels = 0;     // compared
    std::size_t badPixels = 0;  // not finite in an image: left out of every number below, and reported
    double mean = 0;            // sum x / N
    double referenceMean = 0;   // sum r / N
    double bias = 0;            // mean / referenceMean - 1; of a black reference: 0 or infinite
    double mae = 0;             // sum |x - r| / N
    double mse = 0;      // sum (x - r)^2 / N; with two halves a, b of the reference: sum (x-a)(x-b) / N,
                         // which does not count the reference's own noise and may be negative
    double rmse = 0;     // sqrt(max(mse, 0))
    double relRmse = 0;  // rmse / referenceMean: "the error in parts of the mean light"
    // With halves, where relRmse would lie without the reference's noise, 95 of 100 times: mse may be off by
    // two standard errors, 2 sqrt(sum over pixels of ((a-b).(x-r))^2) / N. Else relRmse twice.
    double relRmseLow = 0, relRmseHigh = 0;
    // The same of means of N x N pixels (MetricOptions::blockSize): what is left of the error where neighbours may be
    // exchanged. Blocks start at the top left, those at the right and lower border may be parts, and each counts by its
    // compared pixels; halves as in mse.
    double blockRelRmse = 0;
    int blockSize = 0;  // N
    double relMse = 0;  // sum (x - r)^2 / (r^2 + 0.01) / N (Rousselle et al. 2011, eq. 6); with halves
                        // (x-a)(x-b) above the line
    double psnr = 0;    // 10 log10(1 / mean (d(x) - d(r))^2), dB; infinite for equal images
    double ssim =
        0;  // Wang et al. 2004, eq. 13: mean over 11x11 Gaussian windows (sigma 1.5) that lie within
            // the picture, K1 = 0.01, K2 = 0.03, of Rec.709 luma of d; [-1,1], 1 for equal images
    double flip = 0;            // mean LDR-FLIP of d (Andersson et al. 2020), [0,1], 0 for equal images
    double hdrFlip = 0;         // mean HDR-FLIP of the linear images (Andersson et al. 2021), [0,1]
    double referenceNoise = 0;  // with halves: sqrt(sum (a-b)^2 / 4 / N) / referenceMean, the relRmse that
                                // the reference itself has left
};

struct MetricOptions {
    float exposure = 0;                // stops, for the display images
    float pixelsPerDegree = 67.02f;    // FLIP: 0.7 m from a 0.7 m wide display of 3840 pixels (its default)
    std::vector<std::uint8_t> pixels;  // 1 for those that are measured, rows from the top; empty: all
    int blockSize = 4;                 // pixels a side of the blocks of blockRelRmse, at least 1
    bool flip = true;                  // FLIP costs more than all others together; false leaves both at 0
};

// The two halves are independent estimates of the reference whose mean is the reference.
struct Halves {
    const Image* a = nullptr;
    const Image* b = nullptr;
};

// FLIP per pixel, as errorValues.
struct FlipMaps {
    std::vector<float> flip, hdrFlip;
};

// Throws Error(BadInput) when the sizes differ, there is no pixel, or none that is finite in all images.
// `maps` may be null; it receives what FLIP has to compute anyway, and stays empty without options.flip.
Metrics compareImages(const Image& test, const Image& reference, const MetricOptions& options = {},
                      std::optional<Halves> halves = {}, FlipMaps* maps = nullptr);

enum class ErrorMap { Signed, Absolute, RelativeSquared, Flip, HdrFlip };
// Per pixel, rows from the top: signed: (x - r) luminance / referenceMean; absolute: its magnitude; relative
// squared: mean of the channels' (x - r)^2 / (r^2 + 0.01); the others as in Metrics. NaN where a pixel is
// bad.
std::vector<float> errorValues(const Image& test, const Image& reference, ErrorMap map,
                               const MetricOptions& options = {});

// Names of the maps on the command line and in reports: signed, absolute, relative, flip, hdr-flip.
const char* nameOf(ErrorMap map);
std::optional<ErrorMap> errorMapOf(const std::string& name);

// Colour scale of error maps, sRGB-encoded: magnitudes 0..1 run black-violet-orange-yellow (Magma of
// matplotlib, CC0); signed values -1..1 run blue-white-red (RdBu of ColorBrewer). Beyond the ends: the end's
// colour. Not a number: green.
void colorOfError(float value, bool isSigned, std::uint8_t rgb[3]);

}  // namespace conelight::reference
