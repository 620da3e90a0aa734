// SPDX-License-Identifier: MIT
// Text typed or read from a script -> commands as words. Commands end at a line end or at `;`; words are
// parted by white space; '...' and "..." keep it (\" and \\ inside "..."); `#` at the start of a word begins
// a comment to the end of the line.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace conelight::program {

struct Statement {
    std::vector<std::string> words;  // the first is the command's name
    int line = 1;                    // from 1
    std::string error;               // not empty: a quote that is never closed
};

std::vector<Statement> parseStatements(std::string_view text);

// A word as parseStatements reads it back.
std::string quoted(const std::string& word);

// The candidate with the fewest edits from `word`, upper and lower case alike; empty when none is near (more
// than a third of the letters differ, and `word` begins none of them).
std::string nearest(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace conelight::program
