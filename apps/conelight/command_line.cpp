// SPDX-License-Identifier: MIT
#include "command_line.h"

#include <algorithm>
#include <cctype>

namespace conelight::program {
namespace {

std::string kept;

bool needsNoQuotes(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) ||
           std::string_view("_-+=.,:/@%").find(c) != std::string_view::npos;
}

}  // namespace

std::string shellWord(const std::string& word) {
    if (!word.empty() && std::all_of(word.begin(), word.end(), needsNoQuotes)) return word;
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

void keepCommandLine(int argc, const char* const* argv) {
    kept = "conelight";
    for (int i = 1; i < argc; ++i) kept += " " + shellWord(argv[i]);
}

const std::string& commandLine() { return kept; }

}  // namespace conelight::program
