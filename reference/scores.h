// SPDX-License-Identifier: MIT
// Faults that one picture does not show: light that leaks, pictures that depend on where the grid lies, that
// flicker, that settle slowly. Pictures in, numbers out; formulas with their reasons: docs/guide/scores.md.
#pragma once

#include <span>
#include <vector>

#include "conelight/renderer.h"
#include "conelight/scene.h"

namespace conelight::reference {

// Pixels that are not finite are left out everywhere. Means are over pixels and the three channels.

// Light where there should be none.
struct LeakScore {
    std::size_t darkPixels = 0;  // of `dark`, that its reference says are black
    double darkMean = 0;         // radiance there
    double litMean = 0;          // radiance of `lit`
    double ratio = 0;            // darkMean / litMean; 0 when both are
};
// A pixel counts as black below `blackLevel` times the mean of the lit picture's reference. Throws
// Error(BadInput) when sizes differ or no pixel is black.
LeakScore leakScore(const Image& dark, const Image& darkReference, const Image& lit,
                    const Image& litReference, double blackLevel = 1e-4);

// Root mean square of a - b over the mean of b. 0 when both are black; infinite when only b is.
double relativeDifference(const Image& a, const Image& b);
// Over `mean` instead.
double relativeDifference(const Image& a, const Image& b, double mean);
// Mean over pixels and components that are finite.
double meanRadiance(const Image& image);

// A frame of a path: the picture, two independent halves of its reference, view depth of each pixel in m (0:
// background) and the camera that saw them. Frames that no error is asked of have no halves.
struct FlickerFrame {
    Image test, halfA, halfB, depth;
    Camera camera;
};
struct FlickerScore {
    double flicker = 0;        // see below; the reference's noise is not in it
    double floor = 0;          // what noise alone can show: the flicker of one standard error of the mean h^2
    double mean = 0;           // radiance of the reference over all frames
    double pixelsUsed = 0;     // part of all pixels of the inner frames that had both neighbours
    std::vector<double> each;  // per inner frame
};
// Error that comes and goes while one looks at the same spot. With e = test - reference, a pixel of frame t
// sees a point that frames t - 1 and t + 1 see at other places (found by depth and cameras, error read
// bilinearly, left out where something else is seen there):
//     h = e_t - (e_{t-1} + e_{t+1}) / 2        flicker = sqrt(2/3 mean h^2) / mean reference
// A steady error gives 0, so does one that changes evenly; errors that are independent from frame to frame
// give their relRMSE (the variance of h is 3/2 of theirs). h^2 is taken as the product of h against half A
// and h against half B, whose noise is independent. `middles`: the inner frames t that count, which have halves, as their
// neighbours have; none named: all. Throws Error(BadInput) for fewer than three frames.
FlickerScore flickerScore(std::span<const FlickerFrame> frames, std::span<const std::size_t> middles = {});

// The same of the pictures themselves, e = test, per inner frame and over the mean of all pictures; needs no halves. What
// a walk shows of even surfaces is steady, so a frame far above the others is a jump of the light.
std::vector<double> unsteadiness(std::span<const FlickerFrame> frames);

// The step between two frames that stands out most among those about it: what unsteadiness() says of both over the median of
// eight on either side. A step raises both frames; a bright edge that is followed wrongly, one. So the smaller counts.
struct Jump {
    double ratio = 1;       // 1: none
    std::size_t frame = 1;  // the second of the two
};
Jump jumpOf(std::span<const double> unsteadiness);

// The first frame, counted from 1, from which on every error is at most `fraction`; 0: never.
int settledAt(std::span<const double> errors, double fraction);

}  // namespace conelight::reference
