// SPDX-License-Identifier: MIT
// `render --animate`: what a clip moves, frame by frame.
#pragma once

#include <functional>
#include <string>

#include "session/session.h"

namespace conelight::program {

struct ClipFilm {
    int frames = 1;  // of the whole clip
    std::function<void(Session&, int frame)> beforeFrame;
};

// `rest`: the scene as a session holds it. Throws Error(Usage) for a clip that `file` does not have.
ClipFilm clipFilm(const std::string& file, const Scene& rest, const std::string& clip, float framesPerSecond,
                  bool allowOutside);

}  // namespace conelight::program
