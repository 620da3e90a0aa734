// SPDX-License-Identifier: MIT
// `conelight compare SCENE --equal-time`: every mode's still against the path tracer, plain and denoised, that is
// given the same process CPU time. Each picture is drawn by a process of its own, so that starting, loading,
// voxelizing and the bake count. Shaders come from the driver's cache, as from the second start on.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

#include "child_picture.h"
#include "reference_file.h"
#include "scene_comparison.h"
#include "variants.h"

namespace conelight::program {

struct EqualTimePicture {
    ChildPicture drawn;
    int samplesPerPixel = 0;  // 0: not path-traced
    reference::Metrics metrics;
};

struct EqualTimeVariant {
    Variant variant;
    EqualTimePicture mode, plain, denoised;

    double ratio(const EqualTimePicture& picture) const {
        return picture.drawn.cpuSeconds / mode.drawn.cpuSeconds;
    }
    // The least relMSE of the two that are path-traced over that of the mode: above 1, the mode has less error.
    double factor() const;
};

struct EqualTimeScene {
    std::string scene;
    Size size;
    ReferencePicture reference;
    bool withHalves = false;
    std::vector<EqualTimeVariant> variants;
};

// `viewWords`: options of `render` that say what is seen. Throws as compareVariants, and Error(Usage) for mode
// `reference` among the variants.
EqualTimeScene compareAtEqualTime(const Scene& scene, const std::string& name,
                                  const SceneComparisonRequest& request,
                                  const std::vector<std::string>& viewWords, Progress& progress);

void printEqualTime(const EqualTimeScene& result, bool withFlip);
// As comparisonJson; each variant has "equal_time": {"cpu_seconds","command","path_tracer":{..},"denoised":{..},
// "least_relmse","factor"} in place of "frame", "lookups_per_pixel" and "memory_bytes".
nlohmann::ordered_json equalTimeJson(const EqualTimeScene& result, bool withFlip);

}  // namespace conelight::program
