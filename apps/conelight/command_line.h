// SPDX-License-Identifier: MIT
// The command line as it was typed, for reports that say how they were made.
#pragma once

#include <string>

namespace conelight::program {

void keepCommandLine(int argc, const char* const* argv);

// "conelight render builtin:cornell -o 'my picture.png'": words quoted where a POSIX shell needs it; the
// program by its name without folders. Empty before keepCommandLine.
const std::string& commandLine();

// One word, quoted for a POSIX shell if need be.
std::string shellWord(const std::string& word);

}  // namespace conelight::program
