// SPDX-License-Identifier: MIT
// A grid on the ground, the plane through the scene's lowest point, with the world's x and z axes: lines that
// surfaces hide where they are in front. Session + size of the picture -> lines over it. Visible pieces are found by
// rays from the eye (Picker), so in every mode; they are found anew when the camera or the objects have changed.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "session/inspection_lines.h"
#include "session/picker.h"
#include "session/session.h"

namespace conelight::program {

class GroundGrid {
  public:
    // `edited`: a hand is changing the objects; the lines wait for its end.
    const std::vector<PictureLine>& lines(const Session& session, Picker& picker, float aspect, bool edited);

  private:
    std::vector<PictureLine> lines_;
    // What they were found for.
    Camera camera_;
    float aspect_ = 0;
    std::uint64_t objects_ = 0, scene_ = 0;
    bool found_ = false;
    float height_ = 0;  // of the ground, y
};

// Edge of a cell for a view from so far, m.
float gridCell(float distance);

}  // namespace conelight::program
