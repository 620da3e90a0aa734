// SPDX-License-Identifier: MIT
// `render --animate`: what a clip moves, frame by frame: instances, lights, cameras, and vertices of meshes.
#pragma once

#include <functional>
#include <string>

#include "io/animation.h"
#include "session/session.h"

namespace conelight::program {

struct ClipFilm {
    int frames = 1;  // of the whole clip
    std::function<void(Session&, int frame)> beforeFrame;
};

// Of a session with this movement. Throws Error(Usage), starting with `file`, for a clip that is not there.
ClipFilm clipFilm(const std::string& file, const io::SceneAnimation& animation, const std::string& clip,
                  float framesPerSecond);

}  // namespace conelight::program
