// SPDX-License-Identifier: MIT
// What the viewer's window looks like, kept from one run to the next: a line for each, `name value`.
#pragma once

#include <string>

namespace conelight::program {

struct Preferences {
    float uiScale = 0;                  // of text and widgets; 0: the screen's
    bool light = false;                 // dark letters on light grey
    float sideEm = 24, consoleEm = 10;  // sizes of panels, in heights of text
    bool side = true, console = true;   // whether they are shown
    int width = 0, height = 0;          // of the window, screen units; 0: not chosen
    bool operator==(const Preferences&) const = default;
};

std::string textOf(const Preferences& preferences);
// Names that it does not know are a later version's, and are passed over. Throws Error(BadInput) with the number of
// the line that is not usable.
Preferences preferencesOf(const std::string& text);

}  // namespace conelight::program
