// SPDX-License-Identifier: MIT
// The manual page: every command with its help and options, the exit status, files.
#include <fmt/core.h>

#include "conelight/version.h"
#include "shell_words.h"

namespace conelight::program {
namespace {

// Text as roff shows it: no line of it is a request, hyphens stay hyphens of options.
std::string roff(const std::string& text) {
    std::string safe;
    for (const char c : text) {
        if ((c == '.' || c == '\'') && (safe.empty() || safe.back() == '\n')) safe += "\\&";
        if (c == '\n')
            safe += "\n.br\n";
        else
            safe += c == '\\' ? std::string("\\e") : c == '-' ? std::string("\\-") : std::string(1, c);
    }
    return safe;
}

std::string optionText(const CLI::Option& option) {
    std::string names;
    for (const std::string& name : namesOf(option))
        names += (names.empty() ? "" : ", ") + fmt::format("\\fB{}\\fR", roff(name));
    const std::string type = option.get_items_expected_min() > 0 ? option.get_type_name() : "";
    if (!type.empty()) names += fmt::format(" \\fI{}\\fR", roff(type));
    const std::string start = option.get_default_str();
    return fmt::format(".TP\n{}\n{}{}\n", names, roff(option.get_description()),
                       start.empty() ? "" : fmt::format(" (default: {})", roff(start)));
}

std::string commandText(const CommandWords& command) {
    std::string page =
        fmt::format(".SS conelight {}\n{}.\n", roff(command.path), roff(command.app->get_description()));
    for (const CLI::Option* option : command.app->get_options())
        if (namesOf(*option).empty())
            page += fmt::format(".TP\n\\fI{}\\fR\n{}\n", roff(option->get_name()),
                                roff(option->get_description()));
    for (const CLI::Option* option : command.options) page += optionText(*option);
    return page;
}

}  // namespace

std::string manualPage(const CLI::App& app) {
    std::string page = fmt::format(".TH CONELIGHT 1 \"\" \"conelight {}\" \"User Commands\"\n",
                                   roff(CONELIGHT_VERSION_STRING));
    page +=
        ".SH NAME\nconelight \\- global illumination by tracing voxels\n"
        ".SH SYNOPSIS\n.B conelight\n.I SCENE\n.br\n.B conelight\n.I COMMAND\n[\\fIOPTION\\fR...]\n"
        ".SH DESCRIPTION\n" +
        roff(app.get_description()) +
        "\nA scene is a file, or builtin:NAME for a generated one. Without a command the scene is opened in "
        "a "
        "window, as by \\fBconelight view\\fR.\n.SH COMMANDS\n";
    for (const CommandWords& command : commandWords(app))
        if (!command.path.empty()) page += commandText(command);
    page +=
        ".SH EXIT STATUS\n0 done, 1 failed while running, 2 wrong usage, 3 bad input, 4 no usable OpenGL, "
        "130 "
        "interrupted.\n"
        ".SH FILES\n.TP\n\\fI$XDG_STATE_HOME/conelight\\fR\nscenes that were opened and lines that were "
        "typed in the "
        "window\n"
        ".TP\n\\fI$XDG_CACHE_HOME/conelight/programs\\fR\nlinked programs (\\fB--program-cache\\fR)\n";
    return page;
}

void addManual(CLI::App& app) {
    app.add_subcommand("manual", "print the manual page, for man(1)")->callback([&app] {
        fmt::print("{}", manualPage(app));
    });
}

}  // namespace conelight::program
