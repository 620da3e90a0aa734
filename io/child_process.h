// SPDX-License-Identifier: MIT
// Runs a function in a forked child and hands its bytes back, so that a crash, a hang or a memory bomb in
// code we do not control ends as one line of text. POSIX; elsewhere the function runs in this process.
#pragma once

#include <functional>
#include <string>

#include "io/files.h"

namespace conelight::io {

struct ChildLimits {
    double cpuSeconds = 0.0;             // 0 = none
    std::uint64_t extraMemoryBytes = 0;  // address space beyond today's; 0 = none
    // Asked ten times a second, in this process; false ends the child. Must not throw.
    std::function<bool()> goesOn;
};

struct ChildResult {
    Bytes bytes;           // what `work` returned; empty when it failed
    std::string failure;   // "" or why there are no bytes: the exception's text, or how the child died
    bool stopped = false;  // by ChildLimits::goesOn
};

// `work` runs in the child: it sees a copy of everything and leaves no trace but its bytes. It must not touch
// GL or wait for threads, since the child has only the calling one. Its prints go nowhere.
ChildResult runInChild(const std::function<Bytes()>& work, const ChildLimits& limits);

}  // namespace conelight::io
