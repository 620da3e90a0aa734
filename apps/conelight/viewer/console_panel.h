// SPDX-License-Identifier: MIT
// The console and the log at the bottom of the window: what was said, a line to type in, completion by Tab,
// history by the arrow keys.
#pragma once

#include <deque>
#include <functional>
#include <string>
#include <vector>

namespace conelight::program {

class ConsolePanel {
  public:
    using Complete = std::function<std::vector<std::string>(const std::string& line)>;
    using Enter = std::function<void(const std::string& line)>;
    ConsolePanel(Enter enter, Complete complete) : enter_(std::move(enter)), complete_(std::move(complete)) {}

    void say(const std::string& text);  // one line or several
    void show();

  private:
    static int edited(void* callbackData);
    void completeLine(void* callbackData);
    void recall(void* callbackData);

    Enter enter_;
    Complete complete_;
    std::deque<std::string> lines_;
    std::vector<std::string> history_;
    std::size_t recalled_ = 0;
    std::string line_;
    bool scrollDown_ = false;
};

}  // namespace conelight::program
