// SPDX-License-Identifier: MIT
// Variants of one scene measured against one truth: what `conelight compare SCENE` computes. Its output:
// scene_comparison_output.h.
#pragma once

#include <string>
#include <vector>

#include "picture_source.h"
#include "reference/metrics.h"
#include "reference_file.h"
#include "variants.h"

namespace conelight::program {

struct ComponentResult {
    Component component = Component::Full;
    std::string name;  // "indirect"
    Image image;       // of the variant
    reference::Metrics metrics;
    bool withHalves = false;  // the reference's own noise is not in the MSE
};

struct VariantResult {
    Variant variant;
    Settings settings;
    std::vector<ComponentResult> components;
    FrameCost cost;
    std::optional<reference::RadiosityStats> baked;
    std::optional<reference::BeamStats> beams;
};

struct SceneComparison {
    std::string scene;
    std::string against;  // a mode, or a file
    Camera camera;
    Size size;
    ReferencePicture reference;
    std::string pixels;                  // what those that are measured show; empty: all are
    std::vector<std::uint8_t> measured;  // 1 for these; empty: all
    std::vector<VariantResult> variants;
};

struct SceneComparisonRequest {
    std::vector<Variant> variants;
    std::vector<Component> components;
    std::string against = "reference";
    std::string referenceFile;  // instead of rendering it
    std::string pixels;         // --pixels: those that are measured; empty: all
    std::string cache;          // folder for reference pictures; empty: none
    PictureRequest picture;     // size, path tracer's and radiosity's settings, frames
    reference::MetricOptions metrics;
    ViewOptions view;
};

// Throws what drawing and reading throw, Error(BadInput) when a reference file has another size or lacks
// what a component needs, InterruptedError after a signal.
SceneComparison compareVariants(const Scene& scene, const std::string& name,
                                const SceneComparisonRequest& request, Progress& progress,
                                PictureSource& source);

// "builtin:leak?angle=3" -> "builtin_leak_angle_3": a name for files.
std::string fileStem(const std::string& text);

}  // namespace conelight::program
