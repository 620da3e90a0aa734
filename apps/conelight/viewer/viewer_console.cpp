// SPDX-License-Identifier: MIT
#include "viewer/viewer_console.h"

#include <cstdio>
#include <utility>

#include <unistd.h>

#include "platform/window.h"

namespace conelight::program {

ViewerConsole::ViewerConsole(Session& session, StateFiles& state, AtOnce atOnce)
    : commands_(session, [this](const ConsoleLine& line) { print(line); }),
      panel_(
          commands_.history(),
          [this, &state](const std::string& line) {
              state.typed(line);
              typed(line);
          },
          [this](const std::string& line) { return completed(line); }),
      atOnce_(std::move(atOnce)) {
    for (const std::string& line : state.lines()) commands_.history().add(line);
}

void ViewerConsole::print(const ConsoleLine& line) {
    panel_.say(line.text, line.isError);
    std::fprintf(line.isError ? stderr : stdout, "%s\n", line.text.c_str());
    std::fflush(line.isError ? stderr : stdout);
}

void ViewerConsole::run(const std::string& line) {
    panel_.say("> " + line);
    commands_.submitWidget(line);
}

void ViewerConsole::typed(const std::string& line) {
    const std::vector<Statement> statements = parseStatements(line);
    if (statements.size() == 1 && atOnce_(statements.front().words))
        commands_.history().add(line);
    else
        commands_.submit(line);
}

std::vector<std::string> ViewerConsole::completed(const std::string& line) const {
    const Completion completion = commands_.complete(line, line.size());
    std::vector<std::string> lines;
    for (const std::string& candidate : completion.candidates)
        lines.push_back(line.substr(0, completion.begin) + candidate);
    return lines;
}

void ViewerConsole::readStandardInput() { input_ = std::make_unique<LineReader>(0, platform::Window::wake); }

void ViewerConsole::takeStandardInput() {
    std::string line;
    // What comes through a pipe is a script: it means the same at any speed.
    static const bool byHand = isatty(STDIN_FILENO) != 0;
    while (input_ && input_->take(line)) byHand ? typed(line) : commands_.submit(line);
}

}  // namespace conelight::program
