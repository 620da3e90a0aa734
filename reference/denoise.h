// SPDX-License-Identifier: MIT
// Takes the noise out of a path-traced picture: PathTracedPicture with features -> the same, filtered. For
// pictures that have to be ready soon; biased, so never for the truth that others are measured against.
//
// Method, after Rousselle, Manzi and Zwicker 2013, "Robust Denoising using Feature and Color Information", and
// Bitterli et al. 2016, "Nonlinearly Weighted First-order Regression for Denoising Monte Carlo Renderings":
// direct, diffuse and specular light are parted from albedo and gloss. Each is fitted, per pixel, by a plane
// over position, normal and albedo, through neighbours that look alike. Three candidates (unfiltered; by
// features and colours; by features alone) are mixed by the error that the halves show for each.
// docs/theory/7_truth.md.
//
// Each half is filtered on its own. Which neighbours look alike is read from the half itself; both are read for
// the variance and the choice of the candidate alone.
#pragma once

#include "reference/path_tracer.h"

namespace conelight::reference {

// Oidn: Open Image Denoise (RT filter, HDR), on the same signals; where the build found it (hasOidn).
enum class Denoiser { None, Own, Oidn };
bool hasOidn();

struct DenoiseSettings {
    Denoiser by = Denoiser::Own;  // None: the picture as it is
    int threads = 0;              // 0: all cores; the same bits for any number
};

// full, direct, indirect, diffuse, specular and the halves come filtered; bounces and features as they are.
// `noise` is the estimated relRMSE of what is left, bias included:
//   noise^2 = mean of ((A'-B)^2 + (B'-A)^2) / 2 - (A-B)^2 / 2 - (A'-B')^2 / 4, over the mean light,
// A and B the halves as they came, A' and B' filtered; 0 where chance makes it negative. CPU and wall time are
// added. Values that are not finite count as black. Throws Error(Usage) when the picture has no features
// (PathTracerSettings::features) or sizes differ, or the build has no Open Image Denoise; Error(Runtime) when that
// fails. Thread-safe.
PathTracedPicture denoise(const PathTracedPicture& noisy, const DenoiseSettings& settings = {});

}  // namespace conelight::reference
