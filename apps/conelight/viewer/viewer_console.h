// SPDX-License-Identifier: MIT
// What is said to the viewer and by it: commands with their history, the panel that shows them, the terminal,
// and the pipe behind standard input. Everything goes to the terminal as well, so that a pipe can be
// answered.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "conelight/error.h"
#include "console/console.h"
#include "console/line_reader.h"
#include "session/state_files.h"
#include "viewer/console_panel.h"

namespace conelight::program {

class ViewerConsole {
  public:
    // Whether a command that was typed by itself was carried out at once, in front of what is queued.
    using AtOnce = std::function<bool(const std::vector<std::string>& words)>;
    // `state` has the lines that were typed in earlier runs.
    ViewerConsole(Session& session, StateFiles& state, AtOnce atOnce);

    void say(const std::string& line) { print({false, line}); }
    void fail(const std::string& line) { print({true, line}); }
    // What a widget asks for may be refused (a number out of range): a line of the log, nothing else.
    template <class Edit>
    void attempt(const Edit& edit);
    void run(const std::string& line);  // a widget or a key asks for it
    void readStandardInput();           // from then on
    void takeStandardInput();           // queues the lines that came

    Console& commands() { return commands_; }
    const Console& commands() const { return commands_; }
    ConsolePanel& panel() { return panel_; }
    const ConsolePanel& panel() const { return panel_; }

  private:
    void print(const ConsoleLine& line);
    void typed(const std::string& line);
    std::vector<std::string> completed(const std::string& line) const;

    Console commands_;
    ConsolePanel panel_;
    std::unique_ptr<LineReader> input_;
    AtOnce atOnce_;
};

template <class Edit>
void ViewerConsole::attempt(const Edit& edit) {
    try {
        edit();
    } catch (const Error& error) {
        fail(error.what());
    }
}

}  // namespace conelight::program
