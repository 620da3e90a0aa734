// SPDX-License-Identifier: MIT
// Commands that are the window's own (console/commands_window.cpp): what each does.
#pragma once

#include <string>

#include "session/request.h"
#include "viewer/long_work.h"
#include "viewer/place_questions.h"
#include "viewer/status_lines.h"

namespace conelight::program {

class WindowCommands {
  public:
    struct Inputs {
        Session& session;
        platform::Window& window;
        Gui& gui;
        PictureView& view;
        ViewerConsole& console;
        LongWork& work;
        PixelProbe& probe;
        PanelLayout& panels;
        PlaceQuestions& places;
        const std::optional<std::string>& hint;
        Timings& timings;
    };
    explicit WindowCommands(const Inputs& inputs) : in_(inputs) {}

    // A request of kind Window.
    void carryOut(const Request& request);
    // Writes the frame as it is when `screenshot_window` asked for it.
    void writeWindow();

  private:
    using Words = std::vector<std::string>;  // the command's name first
    void pick(const Words& words);
    void split(const Words& words);
    void error(const Words& words);
    void guides(const Words& words);
    void turntable(const Words& words);
    void resolution(const Words& words);
    void status(const Words& words);
    void where(const Words& words);
    void keep(const Words& words);
    void flip(const Words& words);
    void requireKept(const char* command) const;  // throws Error(Usage)
    void histogram();

    Inputs in_;
    std::string windowShot_;  // a file that gets the next frame
};

}  // namespace conelight::program
