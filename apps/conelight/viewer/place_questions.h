// SPDX-License-Identifier: MIT
// `where WIDGET`: places of widgets, asked for by scripts that drive the window, answered when a frame of the
// GUI has recorded them (widget_places.h).
#pragma once

#include <fmt/core.h>

#include <string>
#include <utility>
#include <vector>

#include "viewer/viewer_console.h"
#include "viewer/widget_places.h"

namespace conelight::program {

class PlaceQuestions {
  public:
    void ask(const std::string& widget) {
        wanted_.push_back(widget);
        askForPlaces();
        asked_ = true;
    }
    bool open() const { return !wanted_.empty(); }
    void beginGui() {
        beginPlaces();
        recorded_ = std::exchange(asked_, false);
    }
    void answer(ViewerConsole& console) {
        if (!std::exchange(recorded_, false)) return;
        for (const std::string& name : std::exchange(wanted_, {}))
            if (const std::optional<WidgetPlace> place = placeOf(name)) {
                const glm::vec2 size = place->high - place->low;
                console.say(fmt::format("where {}: {:.0f} {:.0f} {:.0f} {:.0f}", name, place->low.x,
                                        place->low.y, size.x, size.y));
            } else {
                console.fail(fmt::format("where: '{}' is not on the screen", name));
            }
    }

  private:
    std::vector<std::string> wanted_;
    bool asked_ = false, recorded_ = false;
};

}  // namespace conelight::program
