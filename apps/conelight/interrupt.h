// SPDX-License-Identifier: MIT
// Ctrl-C (SIGINT) and SIGTERM. They end the program at once with status 130, with two exceptions: while a
// file is being written it is finished first; and work that can be stopped half-way with a useful result
// (path tracing, baking) is asked to stop, its result is written, and then the status is 130. A second
// signal ends that at once too.
#pragma once

#include <exception>

namespace conelight::program {

void installInterruptHandler();

// While one lives, files are finished before the program ends.
class WritingScope {
  public:
    WritingScope();
    ~WritingScope();
    WritingScope(const WritingScope&) = delete;
    WritingScope& operator=(const WritingScope&) = delete;
};

// While one lives, the first signal only sets interrupted().
class StoppableScope {
  public:
    StoppableScope();
    ~StoppableScope();
    StoppableScope(const StoppableScope&) = delete;
    StoppableScope& operator=(const StoppableScope&) = delete;
};
bool interrupted();  // a signal came while a StoppableScope lived

// Thrown by a command that has saved what there was after a signal: main() ends with status 130.
struct InterruptedError : std::exception {
    const char* what() const noexcept override { return "interrupted"; }
};

}  // namespace conelight::program
