// SPDX-License-Identifier: MIT
// Tasks of a batch carried out: each by a `conelight render` of its own, so that one that crashes or runs out
// of memory takes no other with it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "batch/folder.h"

namespace conelight::program {

struct BatchOutcome {
    std::size_t done = 0;               // made by this call
    std::size_t found = 0;              // made earlier
    std::vector<std::string> failures;  // one line each, starting with the task's first file
};

// Carries out the tasks that are not done, `jobs` at a time, in their order; one line on standard output for
// each. Throws InterruptedError after a signal, with nothing half-written in the folder.
BatchOutcome carryOut(const std::vector<BatchTask>& tasks, BatchFolder& folder, int jobs);

// The program's own file, for calls of it.
std::string ownProgram();
// Of the log of a call of the program, without its name: as in "mode: there is no ...".
std::string lastLine(const std::filesystem::path& log);

}  // namespace conelight::program
