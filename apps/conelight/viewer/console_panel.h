// SPDX-License-Identifier: MIT
// The console and the log at the bottom of the window: what was said, a line to type in, completion by Tab,
// history by the arrow keys.
#pragma once

#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "console/history.h"

namespace conelight::program {

class ConsolePanel {
  public:
    using Complete = std::function<std::vector<std::string>(const std::string& line)>;
    using Enter = std::function<void(const std::string& line)>;
    // `history` is added to by whoever takes the lines.
    ConsolePanel(History& history, Enter enter, Complete complete)
        : history_(history), enter_(std::move(enter)), complete_(std::move(complete)) {}

    void say(const std::string& text, bool isError = false);  // one line or several
    void show();
    std::size_t lines() const { return lines_.size(); }
    std::size_t errors() const { return errors_; }  // since the start
    // A line was entered and its box does not have the keys again yet: what is typed until then would be
    // lost, so draw before looking at input.
    void focus() { framesToFocus_ = kFramesToFocus; }  // the line to type in gets the keys
    bool takesKeysSoon() const { return framesToFocus_ > 0; }

  private:
    static constexpr int kFramesToFocus = 4;  // it takes two
    static int edited(void* callbackData);
    void completeLine(void* callbackData);
    void recall(void* callbackData);

    History& history_;
    Enter enter_;
    Complete complete_;
    struct Line {
        std::string text;
        bool isError;
    };
    void wrap(float room);

    std::deque<Line> lines_;
    std::size_t errors_ = 0;
    // lines_ as they are shown: in pieces as wide as there is room; made anew when that or they change.
    std::vector<Line> shown_;
    float shownRoom_ = 0;
    bool saidMore_ = false;
    std::string line_;
    bool scrollDown_ = false;
    int framesToFocus_ = 0;
};

}  // namespace conelight::program
