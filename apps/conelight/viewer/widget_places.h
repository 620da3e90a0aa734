// SPDX-License-Identifier: MIT
// Where widgets are in the window, for scripts that drive it (console: `where`). Recorded for one frame at a
// time, when somebody asked.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>

namespace conelight::program {

struct WidgetPlace {
    glm::vec2 low{0}, high{0};  // window units
};

void askForPlaces();                      // from the next beginPlaces() until the one after
void beginPlaces();                       // a frame of the GUI starts
void notePlace(const std::string& name);  // of the last ImGui item
void notePlace(const std::string& name, const glm::vec2& low, const glm::vec2& high);
// Of the frame that was recorded; nothing: not drawn in it.
std::optional<WidgetPlace> placeOf(const std::string& name);

}  // namespace conelight::program
