// SPDX-License-Identifier: MIT
#include "interrupt.h"

#include <unistd.h>

#include <csignal>

namespace conelight::program {
namespace {

// Nesting depths, and whether a signal is waiting for the end of a file or of stoppable work. Only the main
// thread changes the depths; the handler may run on any.
volatile std::sig_atomic_t writers = 0;
volatile std::sig_atomic_t stoppable = 0;
volatile std::sig_atomic_t pendingExit = 0;
volatile std::sig_atomic_t stopRequested = 0;

[[noreturn]] void exitNow() {
    constexpr char message[] = "\nconelight: interrupted\n";
    const int skip = isatty(STDERR_FILENO) != 0 ? 0 : 1;
    [[maybe_unused]] const ssize_t ignored =
        write(STDERR_FILENO, message + skip, sizeof message - 1 - static_cast<std::size_t>(skip));
    _exit(130);
}

void onSignal(int) {
    if (stoppable != 0 && stopRequested == 0) {
        stopRequested = 1;
        return;
    }
    if (writers != 0 && pendingExit == 0) {
        pendingExit = 1;
        return;
    }
    exitNow();
}

}  // namespace

void installInterruptHandler() {
    std::signal(SIGINT, onSignal);
    std::signal(SIGTERM, onSignal);
}

WritingScope::WritingScope() { writers = writers + 1; }
WritingScope::~WritingScope() {
    writers = writers - 1;
    if (writers == 0 && pendingExit != 0) exitNow();
}

StoppableScope::StoppableScope() { stoppable = stoppable + 1; }
StoppableScope::~StoppableScope() { stoppable = stoppable - 1; }
bool interrupted() { return stopRequested != 0; }

}  // namespace conelight::program
