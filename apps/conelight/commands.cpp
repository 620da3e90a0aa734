// SPDX-License-Identifier: MIT
// `conelight commands`: the commands of the console (--exec, --script, the viewer).
#include <fmt/core.h>

#include "command.h"
#include "console/command_table.h"

namespace conelight::program {

void addCommands(CLI::App& app) {
    auto markdown = std::make_shared<bool>(false);
    auto original = std::make_shared<bool>(false);
    CLI::App* command = app.add_subcommand("commands", "every command of the console");
    command->add_flag("--original", *original, "those of the thesis's program, and what they do here");
    command->add_flag("--markdown", *markdown, "as the tables of docs/reference/console.md");
    command->callback([markdown, original] {
        const std::string text = *original   ? originalCommandsMarkdown()
                                 : *markdown ? commandsMarkdown()
                                             : commandsText();
        fmt::print("{}", text);
    });
}

}  // namespace conelight::program
