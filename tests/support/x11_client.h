// SPDX-License-Identifier: MIT
// What a window manager and a file manager do to a window: press its close button, drop files on it. Sent as
// they send it, by client messages (ICCCM 4.2.8, and version 5 of the drag-and-drop protocol XDND).
#pragma once

#include <string>
#include <vector>

namespace conelight::test {

// Why this cannot be done here (built without Xlib), or empty.
std::string x11Missing();
// `title`: the window's name ends with it. Throw std::runtime_error when there is none.
void pressCloseButton(const std::string& display, const std::string& title);
// What a desktop on such a screen says to programs that start from then on: resource Xft.dpi.
void setScreenDpi(const std::string& display, int dpi);
// `paths` are absolute. Returns whether the window took the drop.
bool dropFiles(const std::string& display, const std::string& title, const std::vector<std::string>& paths);

}  // namespace conelight::test
