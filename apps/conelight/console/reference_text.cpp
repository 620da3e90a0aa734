// SPDX-License-Identifier: MIT
// The tables of docs/reference/console.md and what `conelight commands` prints.
#include <fmt/core.h>

#include "console/command_table.h"

namespace conelight::program {
namespace {

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '|') out += '\\';
        out += c;
    }
    return out;
}

std::string namesOf(const Command& command) {
    std::string names = "`" + command.usage() + "`";
    for (const std::string& alias : command.aliases) names += ", `" + alias + "`";
    return names;
}

std::string rangesOf(const Command& command) {
    std::string text;
    for (const Argument& argument : command.arguments) {
        std::string one;
        if (argument.low < argument.high)
            one = fmt::format("{} {:g} to {:g}", argument.name, argument.low, argument.high);
        if (!argument.unit.empty()) one += (one.empty() ? argument.name + " " : " ") + argument.unit;
        if (!one.empty()) text += (text.empty() ? "" : "; ") + one;
    }
    return text;
}

}  // namespace

std::string commandsMarkdown() {
    std::string out;
    for (const CommandGroup& group : commandGroups()) {
        out += fmt::format("### {}\n\n| command | what it does | range |\n|---|---|---|\n", group.title);
        for (const Command& command : group.commands)
            out +=
                fmt::format("| {} | {} | {} |\n", namesOf(command), escaped(command.help), rangesOf(command));
        out += "\n";
    }
    return out;
}

std::string originalCommandsMarkdown() {
    std::string out = "| command, aliases | what it does | here |\n|---|---|---|\n";
    for (const CommandGroup& group : commandGroups())
        for (const Command& command : group.commands)
            if (!command.original.empty())
                out += fmt::format("| {} | {} | {} |\n", namesOf(command), escaped(command.help),
                                   escaped(command.original));
    return out;
}

std::string commandsText() {
    std::string out;
    for (const CommandGroup& group : commandGroups()) {
        out += group.title + "\n";
        for (const Command& command : group.commands)
            out += fmt::format("  {:<38} {}\n", command.usage(), command.help);
    }
    return out;
}

}  // namespace conelight::program
