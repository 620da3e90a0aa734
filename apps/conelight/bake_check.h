// SPDX-License-Identifier: MIT
// How wrong a picture is that baked light lights: the path tracer's beside it, by every kind of data that was baked.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "command.h"
#include "conelight/scene.h"
#include "reference/baked_picture.h"

namespace conelight::program {

struct BakeCheck {
    std::string size = "128x96", picture, bounces = "all";
    int samples = 512;
    std::uint32_t seed = 1;
    ViewOptions view;
};

struct BakedKind {
    std::string name;
    std::function<reference::BakedPicture(const Camera&, const reference::PathTracedPicture&)> draw;
};

// Throws Error(Usage), before anything is written.
void validateCheck(const BakeCheck& check);

// Prints a table with a row for each kind; the same is returned. The picture of the last kind goes into the file that
// was asked for. Throws InterruptedError.
nlohmann::ordered_json checkBake(const Scene& scene, const BakeCheck& check, const std::string& title,
                                 const std::vector<BakedKind>& kinds, Progress& progress);

}  // namespace conelight::program
