// SPDX-License-Identifier: MIT
// The menu of what is selected, at the mouse: on a row of the scene's tree and in the picture. What it does is done
// by the console's commands.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "session/session.h"
#include "viewer/picture_view.h"
#include "viewer/viewer_console.h"

namespace conelight::program {

class SelectionMenu {
  public:
    struct Inputs {
        Session& session;
        PictureView& view;
        ViewerConsole& console;
    };
    explicit SelectionMenu(const Inputs& inputs) : in_(inputs) {}

    void open(const glm::vec2& at) { asked_ = at; }  // from the next show() on
    void show();                                     // once a frame, outside of other windows

  private:
    void items();
    void nameField();
    void objectItems();
    void materialItems();
    void item(const char* text, const char* keys, const std::string& line, bool enabled = true);

    Inputs in_;
    std::optional<glm::vec2> asked_;
    std::string name_;  // as it is typed
};

}  // namespace conelight::program
