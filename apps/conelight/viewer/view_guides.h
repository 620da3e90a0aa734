// SPDX-License-Identifier: MIT
// What is laid over the picture for measure and direction, each on demand: a grid on the ground, the world's axes in
// a corner, whose ends are buttons for the views along them, and a scale bar.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "viewer/ground_grid.h"

namespace conelight::program {

class ViewGuides {
  public:
    bool grid = false, axes = false, scale = false;

    bool any() const { return grid || axes || scale; }
    void setAll(bool on) { grid = axes = scale = on; }
    // Before the picture's own button, which lies below the ends of the axes. Returns the view of one that was
    // clicked: front, back, right, left, top, bottom.
    std::optional<std::string> takeClick(const Camera& camera, const glm::vec2& at, const glm::vec2& size);
    // Into the current ImGui window, over the picture at `at`.
    void draw(const Session& session, Picker& picker, const glm::vec2& at, const glm::vec2& size,
              bool edited);
    // What they measure, as "grid 10 cm, axes, scale 20 cm"; off: none is shown.
    std::string text(const Camera& camera, const glm::vec2& size) const;

  private:
    // An end of an axis, on the screen.
    struct End {
        int axis = 0;
        bool positive = true;
        glm::vec2 at{0};
        float depth = 0;  // towards the eye
    };
    static std::vector<End> endsOf(const Camera& camera, const glm::vec2& at, const glm::vec2& size);
    void drawAxes(const Camera& camera, const glm::vec2& at, const glm::vec2& size);
    void drawScale(const Camera& camera, const glm::vec2& at, const glm::vec2& size) const;

    GroundGrid ground_;
    std::optional<int> hot_;  // the end under the cursor: its axis, 3 more where negative
};

}  // namespace conelight::program
