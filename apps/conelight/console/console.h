// SPDX-License-Identifier: MIT
// Commands, queued and run between frames. The box in the window, standard input, --exec and script files all
// submit text here; the main loop runs it. A command that asks for work of the main loop (a picture, a scene,
// frames to wait for) holds those behind it until that is done, so a script means the same at any speed.
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "conelight/error.h"
#include "console/command_table.h"
#include "console/history.h"
#include "console/statements.h"
#include "session/picker.h"

namespace conelight::program {

struct ConsoleLine {
    bool isError = false;
    std::string text;
};
using ConsoleOutput = std::function<void(const ConsoleLine&)>;

// What may stand in place of text[begin, end).
struct Completion {
    std::size_t begin = 0, end = 0;
    std::vector<std::string> candidates;  // quoted where need be, sorted by how they are listed
    std::string common;                   // what all begin with
};

class Console {
  public:
    Console(Session& session, ConsoleOutput output);

    // `origin` starts error lines ("--exec", a file's name); empty: typed by hand, errors name the command
    // only.
    void submit(const std::string& text, const std::string& origin = {});
    // Of a hand, by a widget or a key: runWidgets() runs it, whatever the queue waits for.
    void submitWidget(const std::string& text);
    void runWidgets();
    // Puts the lines of a script in front of what is queued. Throws Error(BadInput) for a file that cannot be
    // read, Error(Usage) for scripts that call each other too deep.
    void source(const std::string& file);
    // Runs commands until one asks for work of the main loop or all are done. An error is one line; with
    // stopOnError what is queued behind it is dropped. Returns whether any ran.
    bool runQueued();
    bool idle() const {
        return queue_.empty() && ofWidgets_.empty() && waitFrames_ == 0 && !session_.playing();
    }
    void setStopOnError(bool stop) { stopOnError_ = stop; }
    // The first error since construction.
    const std::optional<Error>& firstError() const { return firstError_; }

    // The main loop tells how requests went.
    void frameDone();  // a frame was drawn: `wait` counts it
    void waitFor(int frames) { waitFrames_ += frames; }
    int framesToWait() const { return waitFrames_; }
    void endWait() { waitFrames_ = 0; }
    void print(const std::string& line);
    void fail(const Error& error);  // of a request: as if its command had failed

    // The last mode that was not phong; empty when there was none.
    std::string litMode() const { return litMode_; }
    void keepLitMode();

    Completion complete(const std::string& text, std::size_t cursor) const;
    History& history() { return history_; }
    Picker& picker() { return picker_; }

  private:
    struct Queued {
        Statement statement;
        std::string origin;
        int depth = 0;
    };
    void run(const Queued& queued);
    void report(const Error& error, const Queued& queued);

    Session& session_;
    ConsoleOutput output_;
    std::deque<Queued> queue_, ofWidgets_;
    Queued current_;
    int waitFrames_ = 0;
    bool stopOnError_ = false;
    std::optional<Error> firstError_;
    std::string litMode_;
    History history_;
    Picker picker_;
};

}  // namespace conelight::program
