// SPDX-License-Identifier: MIT
#include "viewer/picture_passes.h"

#include <fmt/core.h>

#include <algorithm>

namespace conelight::program {
namespace {

// A mode that gathers light over frames is drawn this often after a change before the window rests: means run
// over 16 frames, after some in which light settles.
constexpr int kSettlingFrames = 24;
// Smooth edges are the mean of so many pictures of a view at rest (by eye: later ones hardly change it). In mode
// traced they share what was gathered and cost little.
constexpr int kSmoothingViews = 8, kTracedViews = 16;
// Those of `conelight render` for what is out of focus.
constexpr int kLensViews = 64;

bool showsLight(Component component) {
    return component == Component::Full || component == Component::Direct ||
           component == Component::Indirect || component == Component::Diffuse ||
           component == Component::Specular;
}

// 0: the picture is one of the pixels' centres.
int viewsAtRest(const std::string& mode, const Settings& settings, const Camera& camera) {
    const bool off = settings.image.temporal == Toggle::Off;
    if (!showsLight(settings.component) || (off && mode != "traced")) return 0;
    if (settings.image.antialiasing > 0) return settings.image.antialiasing;
    if (camera.hasLens()) return kLensViews;
    if (off) return 0;
    return mode == "traced" ? kTracedViews : kSmoothingViews;
}

}  // namespace

int PicturePasses::all() const { return std::max(light + views, 1); }

std::string PicturePasses::text(int left) const {
    const int done = all() - left;
    return done < light ? fmt::format("pass {} of {}", done, light)
                        : fmt::format("edges: view {} of {}", done - light, all() - light);
}

PicturePasses passesOf(const std::string& mode, const Settings& settings, const Camera& camera) {
    return {mode == "traced" ? kSettlingFrames : 0, viewsAtRest(mode, settings, camera)};
}

// Unless asked for not in mode traced: its light settles over frames, and a mean over them would keep what is not settled.
bool smoothsEdges(const std::string& mode, const Settings& settings) {
    const bool wanted = settings.image.temporal == Toggle::On ||
                        (settings.image.temporal == Toggle::Auto && mode != "traced");
    return wanted && showsLight(settings.component);
}

}  // namespace conelight::program
