// SPDX-License-Identifier: MIT
// What a picture of the window depends on, and how often it is drawn until it rests.
#pragma once

#include <cstdint>
#include <string>

#include "session/session.h"

namespace conelight::program {

// A mode that gathers light over frames is drawn this often after a change before the window rests: means run
// over 16 frames, after some in which light settles.
inline constexpr int kSettlingFrames = 24;
// Smooth edges are the mean of so many pictures of a view at rest (by eye: later ones hardly change it).
inline constexpr int kSmoothingFrames = 8;

// Unless asked for not in mode traced: its light settles over frames, and a mean over them would keep what is not settled.
inline bool smoothsEdges(const std::string& mode, const Settings& settings) {
    const Component component = settings.component;
    const bool ofLight = component == Component::Full || component == Component::Direct ||
                         component == Component::Indirect || component == Component::Diffuse ||
                         component == Component::Specular;
    const bool wanted = settings.image.temporal == Toggle::On ||
                        (settings.image.temporal == Toggle::Auto && mode != "traced");
    return wanted && ofLight;
}

inline int settlingFrames(const std::string& mode, const Settings& settings) {
    return mode == "traced" ? kSettlingFrames : smoothsEdges(mode, settings) ? kSmoothingFrames : 1;
}

// What the picture depends on; selection and the list of cameras are not part of it.
struct PictureKey {
    std::uint64_t tables = 0, settings = 0, camera = 0, flags = 0;
    bool operator==(const PictureKey&) const = default;
};
inline PictureKey keyOf(const Revisions& r) { return {r.sceneTables(), r.settings, r.camera, r.flags}; }

// Whether two settings give the same linear picture: all but exposure, bloom, tone map and encoding.
inline bool sameButLook(Settings a, const Settings& b) {
    const ImageSettings own = a.image;
    a.image = b.image;
    return a == b && own.antialiasing == b.image.antialiasing && own.temporal == b.image.temporal;
}

}  // namespace conelight::program
