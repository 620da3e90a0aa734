// SPDX-License-Identifier: MIT
#include "usage_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>

#include "console/statements.h"

namespace conelight::program {
namespace {

struct Unknown {
    const CLI::App* command = nullptr;  // it belongs to neither this nor those above it
    std::string word;
    bool isOption = false;
};

std::vector<const CLI::App*> commandsOf(const CLI::App& app) {
    return app.get_subcommands([](const CLI::App* one) { return !one->get_name().empty(); });
}

// "--mode" of "--mode=phong".
std::string optionName(const std::string& word) { return word.substr(0, word.find('=')); }

std::vector<std::string> optionsOf(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options())
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    return names;
}

// The first word that is no command where one must be, or no option of the command.
std::optional<Unknown> firstUnknown(const CLI::App& app, const std::vector<std::string>& words) {
    const CLI::App* command = &app;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::string& word = words[i];
        if (word == "--") return std::nullopt;
        if (word.rfind("--", 0) == 0) {
            const CLI::Option* option = command->get_option_no_throw(optionName(word));
            if (option == nullptr) return Unknown{command, optionName(word), true};
            // Its value, whatever it looks like.
            if (optionName(word) == word && option->get_items_expected_min() > 0) ++i;
            continue;
        }
        const std::vector<const CLI::App*> commands = commandsOf(*command);
        if (word.rfind('-', 0) == 0 || commands.empty()) continue;
        const auto found = std::find_if(commands.begin(), commands.end(),
                                        [&](const CLI::App* one) { return one->get_name() == word; });
        if (found == commands.end()) return Unknown{command, word, false};
        command = *found;
    }
    return std::nullopt;
}

}  // namespace

std::string usageText(const CLI::App& app, const CLI::ParseError& error,
                      const std::vector<std::string>& words) {
    const std::optional<Unknown> unknown = firstUnknown(app, words);
    const bool atTop = !unknown || unknown->command == &app;
    const std::string of = atTop ? "" : unknown->command->get_name();
    const std::string help = fmt::format("; `conelight {}--help` lists {}", of.empty() ? "" : of + " ",
                                         of.empty() ? "commands and options" : "what it takes");
    if (!unknown) return error.what() + help;
    std::vector<std::string> known;
    if (unknown->isOption)
        known = optionsOf(*unknown->command);
    else
        for (const CLI::App* one : commandsOf(*unknown->command)) known.push_back(one->get_name());
    const std::string near = nearest(unknown->word, known);
    return fmt::format("{}there is no {} '{}'{}", of.empty() ? "" : of + ": ",
                       unknown->isOption ? "option" : "command", unknown->word,
                       near.empty() ? help : "; " + near + " would be right");
}

}  // namespace conelight::program
