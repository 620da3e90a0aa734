// SPDX-License-Identifier: MIT
// What shells and manuals are told of the command line, from the options themselves: `conelight completion
// SHELL` and `conelight manual`.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace conelight::program {

// A command of the program, "" itself, "score leak" one in another.
struct CommandWords {
    std::string path;
    const CLI::App* app = nullptr;
    std::vector<const CLI::App*> commands;    // in it
    std::vector<const CLI::Option*> options;  // those with a name; positionals have none
};
std::vector<CommandWords> commandWords(const CLI::App& app);

// "--mode" and, where there is one, "-o".
std::vector<std::string> namesOf(const CLI::Option& option);
// Words that an option takes; empty: others. Settings as KEY=.
std::vector<std::string> valuesOf(const CLI::Option& option);
// The first sentence of its help, in one line.
std::string shortHelp(const std::string& help);

// A script that completes commands, options and words; `shell`: bash, zsh or fish.
std::string completionScript(const CLI::App& app, const std::string& shell);
// The manual page, roff with the macros of man(7).
std::string manualPage(const CLI::App& app);

void addCompletion(CLI::App& app);
void addManual(CLI::App& app);

// `conelight FILE` as `conelight view FILE`: a first word that names a scene and no command gets `view` before
// it.
std::vector<std::string> withCommand(const CLI::App& app, std::vector<std::string> words);

}  // namespace conelight::program
