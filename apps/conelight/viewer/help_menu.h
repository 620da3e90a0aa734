// SPDX-License-Identifier: MIT
// The menu Help: the guide in the desktop's own program, the list of keys, what the program and its driver are.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "platform/window.h"
#include "viewer/key_list.h"
#include "viewer/viewer_console.h"

namespace conelight::program {

class HelpMenu {
  public:
    HelpMenu(const platform::Window& window, ViewerConsole& console, KeyList& keys)
        : window_(window), console_(console), keys_(keys) {}

    void showItems();  // into the menu that is open
    void showAbout();  // when it is asked for
    void openGuide();
    void openAbout() { wantsAbout_ = true; }

  private:
    const platform::Window& window_;
    ViewerConsole& console_;
    KeyList& keys_;
    bool wantsAbout_ = false;
};

// The guide's page of the viewer: installed beside the program, or in the checkout that it was built in.
std::optional<std::string> guideFile();

}  // namespace conelight::program
