// SPDX-License-Identifier: MIT
// The passes of a picture in the window, from its first to its last: light that settles, then views of it within the
// pixel and on the lens. Settings and camera -> how many of each.
#pragma once

#include <string>

#include "conelight/scene.h"
#include "conelight/settings.h"

namespace conelight::program {

struct PicturePasses {
    int light = 0, views = 0;

    int all() const;
    // With so many passes to come: the next one adds a view of light that has settled.
    bool areViews(int left) const { return light > 0 && left <= views; }
    std::string text(int left) const;  // "pass 7 of 24", "edges: view 3 of 16"
};

// `mode`: one of the renderer's.
PicturePasses passesOf(const std::string& mode, const Settings& settings, const Camera& camera);

// Whether pictures on the way add up over frames.
bool smoothsEdges(const std::string& mode, const Settings& settings);

}  // namespace conelight::program
