// SPDX-License-Identifier: MIT
#include "equal_time.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "conelight/error.h"
#include "truth_options.h"

namespace conelight::program {
namespace {

// The path tracer as a process: CPU time = start + samples times a slope, both learnt from its runs.
class TimedTracer {
  public:
    TimedTracer(std::vector<std::string> words, const ScratchFolder& folder)
        : words_(std::move(words)), folder_(folder) {}

    // The picture whose CPU time comes nearest to `seconds` among a few tries.
    EqualTimePicture draw(double seconds) {
        constexpr double kNearEnough = 0.03;
        constexpr int kTries = 3;
        if (runs_.empty())
            for (const int samples : {2, 16}) run(samples);
        EqualTimePicture best;
        for (int tries = 0; tries < kTries;) {
            // Short runs are mostly start, and a slope between them mostly noise: no step is larger than fourfold.
            const int wanted = samplesFor(seconds), samples = std::min(wanted, 4 * mostSamples());
            if (samples == best.samplesPerPixel) break;
            if (samples == wanted) ++tries;
            EqualTimePicture next = run(samples);
            const auto off = [&](const EqualTimePicture& picture) {
                return std::abs(picture.drawn.cpuSeconds / seconds - 1);
            };
            if (best.samplesPerPixel == 0 || off(next) < off(best)) best = std::move(next);
            if (off(best) <= kNearEnough) break;
        }
        return best;
    }

  private:
    struct Run {
        int samples;
        double seconds;
    };

    EqualTimePicture run(int samples) {
        std::vector<std::string> words = words_;
        words.insert(words.end(), {"--spp", std::to_string(samples)});
        EqualTimePicture picture{drawInChild(words, folder_), samples, {}};
        runs_.push_back({samples, picture.drawn.cpuSeconds});
        return picture;
    }

    static bool hasLess(const Run& a, const Run& b) { return a.samples < b.samples; }
    int mostSamples() const { return std::max_element(runs_.begin(), runs_.end(), hasLess)->samples; }

    // From the run nearest in time, along the line through those of fewest and most samples.
    int samplesFor(double seconds) const {
        const Run fewest = *std::min_element(runs_.begin(), runs_.end(), hasLess);
        const Run most = *std::max_element(runs_.begin(), runs_.end(), hasLess);
        const double slope =
            std::max((most.seconds - fewest.seconds) / (most.samples - fewest.samples), 1e-6);
        const Run nearest = *std::min_element(runs_.begin(), runs_.end(), [&](const Run& a, const Run& b) {
            return std::abs(a.seconds - seconds) < std::abs(b.seconds - seconds);
        });
        const double samples = nearest.samples + (seconds - nearest.seconds) / slope;
        constexpr double kMost = 1 << 20;
        return 2 * static_cast<int>(std::lround(0.5 * std::clamp(samples, 2.0, kMost)));
    }

    std::vector<std::string> words_;
    const ScratchFolder& folder_;
    std::vector<Run> runs_;
};

std::string sizeText(const Size& size) { return fmt::format("{}x{}", size.width, size.height); }

std::vector<std::string> joined(std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

// Words of a mode's still.
std::vector<std::string> stillWords(const Variant& variant, const SceneComparisonRequest& request,
                                    std::vector<std::string> words) {
    const bool box = request.picture.reference.filter == reference::PixelFilter::Box;
    words.insert(words.end(), {"--mode", variant.mode});
    if (variant.mode == "beams")
        words.insert(words.end(), {"--filter", box ? "box" : "center"});
    else
        words.insert(words.end(), {"--aa", box ? std::to_string(kStillViews) : "0"});
    for (const auto& [key, value] : variant.values) words.insert(words.end(), {"--set", key + "=" + value});
    return words;
}

// The truth as compareVariants has it; drawn here, since all that is timed runs elsewhere.
ReferencePicture truthOf(const Scene& scene, const std::string& name, const SceneComparisonRequest& request,
                         Progress& progress) {
    if (!request.referenceFile.empty()) return readReference(request.referenceFile);
    PictureSource source(request.view);
    source.setScene(scene);
    PictureRequest base = request.picture;
    base.settings = Variant{"cones", {}}.settingsFor(scene, request.view);
    base.camera = cameraFor(scene, request.view);
    return referenceFor(source, scene, base, request.cache, "reference-" + fileStem(name), &progress);
}

}  // namespace

double EqualTimeVariant::factor() const {
    return std::min(plain.metrics.relMse, denoised.metrics.relMse) / mode.metrics.relMse;
}

EqualTimeScene compareAtEqualTime(const Scene& scene, const std::string& name,
                                  const SceneComparisonRequest& request,
                                  const std::vector<std::string>& viewWords, Progress& progress) {
    EqualTimeScene result;
    result.scene = name;
    result.size = request.picture.size;
    result.reference = truthOf(scene, name, request, progress);
    const Image& truth = result.reference.full;
    if (truth.width != result.size.width || truth.height != result.size.height)
        throw Error(ErrorKind::BadInput,
                    fmt::format("{}: has {} x {} pixels; --size {}x{} would be right", request.referenceFile,
                                truth.width, truth.height, truth.width, truth.height));
    std::optional<reference::Halves> halves;
    if (result.reference.hasHalves())
        halves = reference::Halves{&result.reference.halfA, &result.reference.halfB};
    result.withHalves = halves.has_value();
    const auto measure = [&](EqualTimePicture& picture) {
        picture.metrics = reference::compareImages(picture.drawn.image, truth, request.metrics, halves);
    };

    const ScratchFolder folder;
    const std::vector<std::string> seen = joined({name}, viewWords);
    const std::vector<std::string> sized = joined(seen, {"--size", sizeText(result.size)});
    const bool box = request.picture.reference.filter == reference::PixelFilter::Box;
    // Other numbers than the truth's, which has them from its own seed on.
    const std::vector<std::string> traced =
        joined(sized, {"--mode", "reference", "--filter", box ? "box" : "center", "--seed",
                       std::to_string(request.picture.reference.seed + 1)});
    TimedTracer plain(traced, folder), denoised(joined(traced, {"--denoise"}), folder);
    for (const Variant& variant : request.variants) {
        const std::string label = name + ": " + variant.label();
        progress.show(label);
        EqualTimeVariant row;
        row.variant = variant;
        // A small picture first, so that the driver's cache has the shaders.
        if (isRendererMode(variant.mode))
            drawInChild(stillWords(variant, request, joined(seen, {"--size", "16x16"})), folder);
        row.mode.drawn = drawInChild(stillWords(variant, request, sized), folder);
        progress.show(label + ": path tracer");
        row.plain = plain.draw(row.mode.drawn.cpuSeconds);
        progress.show(label + ": path tracer, denoised");
        row.denoised = denoised.draw(row.mode.drawn.cpuSeconds);
        progress.show(label + ": measuring");
        for (EqualTimePicture* picture : {&row.mode, &row.plain, &row.denoised}) measure(*picture);
        result.variants.push_back(std::move(row));
    }
    return result;
}

}  // namespace conelight::program
