// SPDX-License-Identifier: MIT
// What a command writes, checked before its work: that no output is written over what it reads, over another
// output, or over a file of another kind, and that each can be written.
#pragma once

#include <string>
#include <vector>

namespace conelight::program {

enum class OutputKind {
    Picture,  // and films and scenes: whatever its name says
    Json,
    Page,  // our own HTML page
};

struct Output {
    std::string option;  // "--json", for the message
    std::string file;    // empty: not asked for
    OutputKind kind = OutputKind::Picture;
};

// `inputs`: files that the command reads; empty names and builtin:NAME are left out. Throws Error(Usage) or
// Error(Runtime), one line.
void checkOutputs(const std::vector<Output>& outputs, const std::vector<std::string>& inputs);

}  // namespace conelight::program
