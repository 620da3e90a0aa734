// SPDX-License-Identifier: MIT
// Radiosity: the other pole of the thesis's comparison. Diffuse light between patches, solved once for the
// whole scene, looked at from anywhere. Methods and citations: radiosity.cpp.
//
// Result: a Scene of the same look whose vertices carry the light: vertex colours are the irradiance over pi
// of diffuse surfaces (times base colour and texture = radiance), materials are unlit, emitters show their
// radiance. Any GL mode draws it, `io` saves it (.glb), any glTF viewer opens it.
#pragma once

#include <functional>
#include <vector>

#include "conelight/renderer.h"
#include "conelight/scene.h"

namespace conelight::reference {

struct RadiositySettings {
    float patchSize = 0;     // longest edge of the coarsest patches, m; 0: a 24th of the scene's longest side
    int maxSubdivision = 4;  // further halvings where the light changes fast; 0..8
    float subdivideError = 0.03f;  // change of radiosity across a patch, relative to the mean, that splits it
    float residual = 0.002f;       // stop when the light still to be shot is below this part of all light
    int visibilityRays = 16;       // per pair of patches; 1..256
    int bounces = -1;              // -1: all
    std::uint32_t seed = 1;
    int threads = 0;  // 0: all cores
};

struct RadiosityStats {
    std::size_t patches = 0, elements = 0, vertices = 0;
    int iterations = 0;
    double residual = 0;
    std::uint64_t rays = 0;
    double cpuSeconds = 0, wallSeconds = 0;
};

struct RadiosityProgress {
    double residual = 1;
    double secondsLeft = -1;
};

// Bakes `scene`. `onProgress` returning false stops with what is there. Throws Error(BadInput) as
// Scene::validate.
Scene bakeRadiosity(const Scene& scene, const RadiositySettings& settings, RadiosityStats* stats = nullptr,
                    const std::function<bool(const RadiosityProgress&)>& onProgress = {});

}  // namespace conelight::reference
