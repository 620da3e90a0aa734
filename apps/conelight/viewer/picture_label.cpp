// SPDX-License-Identifier: MIT
#include "viewer/picture_label.h"

#include <fmt/core.h>

#include "traced_picture.h"

namespace conelight::program {
namespace {

std::string insteadText(bool preview) { return preview ? "; until then the view without it" : ""; }

}  // namespace

std::string referenceLabel(const ReferenceStatus& status, bool preview) {
    if (!status.error.empty()) return "reference: " + status.error;
    if (status.samplesPerPixel == 0) return "reference: tracing the first samples" + insteadText(preview);
    return fmt::format("reference  {} spp  noise {:.1f} %{}", status.samplesPerPixel, 100 * status.noise,
                       status.running ? "" : "  done");
}

std::string beamsLabel(const ReferenceStatus& status, bool preview) {
    if (!status.error.empty()) return status.error;
    return status.samplesPerPixel == 0 ? "beams: tracing" + insteadText(preview) : "beams  done";
}

std::string radiosityLabel(const BakeStatus& status, bool preview) {
    if (!status.error.empty()) return "radiosity: " + status.error;
    if (!status.running) return "radiosity";
    const std::string left = status.secondsLeft >= 0 ? ", " + timeText(status.secondsLeft) + " left" : "";
    if (status.refining)
        return fmt::format("radiosity: a draft; baking in full, {:.0f} %{}", 100 * status.done, left);
    return fmt::format("radiosity: baking, {:.0f} %{}{}", 100 * status.done, left,
                       preview ? insteadText(true) : "; light as it was before the change");
}

std::string hybridLabel(const BakeStatus& status, bool baked) {
    if (!status.error.empty()) return "hybrid: " + status.error;
    if (!status.running) return "hybrid";
    return fmt::format("hybrid: baking, {:.0f} %; until then {}", 100 * status.done,
                       baked ? "light as it was, or a draft of it" : "all light by cones");
}

std::string workLabel(const PictureWork& work) {
    if (work.done == 0) return work.name;
    return work.total == 0 ? fmt::format("{}, {}", work.name, work.done)
                           : fmt::format("{}, {} of {}", work.name, work.done, work.total);
}

std::string passesLabel(const std::string& mode, const PicturePasses& passes, int left,
                        const std::optional<double>& noise) {
    const bool hasLight = mode == "traced";
    const std::string noisy = hasLight && noise ? fmt::format("  noise {:.1f} %", 100 * *noise) : "";
    if (left == 0) return mode + (hasLight ? noisy + "  done" : "");
    return mode + "  " + passes.text(left) + noisy;
}

}  // namespace conelight::program
