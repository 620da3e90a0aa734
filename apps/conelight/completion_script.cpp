// SPDX-License-Identifier: MIT
// Completion for bash, zsh and fish. All three know the command by the words before the cursor, then offer the
// words of the option before it, else commands and options, else files.
#include <fmt/core.h>

#include <algorithm>
#include <set>

#include "shell_words.h"

namespace conelight::program {
namespace {

std::string joined(const std::vector<std::string>& words) {
    std::string all;
    for (const std::string& word : words) all += (all.empty() ? "" : " ") + word;
    return all;
}

std::vector<std::string> allNames(const CommandWords& command) {
    std::vector<std::string> words;
    for (const CLI::App* one : command.commands) words.push_back(one->get_name());
    for (const CLI::Option* option : command.options)
        for (const std::string& name : namesOf(*option)) words.push_back(name);
    return words;
}

// For '...' of a shell.
std::string unquoted(const std::string& text) {
    std::string safe;
    for (const char c : text) safe += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return safe;
}

// "    '--mode') words='phong cones' ;;": each option with words once; it means the same everywhere.
std::string valueCases(const std::vector<CommandWords>& commands, const char* assignment) {
    std::set<std::string> seen;
    std::string cases;
    for (const CommandWords& command : commands)
        for (const CLI::Option* option : command.options)
            for (const std::string& name : namesOf(*option)) {
                const std::vector<std::string> values = valuesOf(*option);
                if (values.empty() || !seen.insert(name).second) continue;
                cases += fmt::format("        {}) {}'{}' ;;\n", name, assignment, joined(values));
            }
    return cases;
}

// The command that the words before the cursor name.
std::string commandCases(const std::vector<CommandWords>& commands) {
    std::string cases;
    for (const CommandWords& command : commands)
        if (!command.path.empty()) {
            const std::size_t space = command.path.rfind(' ');
            const std::string parent = space == std::string::npos ? "" : command.path.substr(0, space);
            cases += fmt::format("            '{}:{}') command='{}' ;;\n", parent,
                                 command.path.substr(space + 1), command.path);
        }
    return cases;
}

std::string bashScript(const std::vector<CommandWords>& commands) {
    std::string lists;
    for (const CommandWords& command : commands)
        lists += fmt::format("        '{}') words='{}' ;;\n", command.path, joined(allNames(command)));
    return "# Completion of conelight for bash, as `conelight completion bash` prints it.\n"
           "_conelight() {\n"
           "    local current=\"${COMP_WORDS[COMP_CWORD]}\" previous=\"${COMP_WORDS[COMP_CWORD-1]}\"\n"
           "    local command= word words=\n"
           "    for word in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do\n"
           "        case \"$command:$word\" in\n" +
           commandCases(commands) +
           "        esac\n"
           "    done\n"
           "    COMPREPLY=()\n"
           "    case \"$previous\" in\n" +
           valueCases(commands, "words=") +
           "    esac\n"
           "    if [[ -n $words ]]; then\n"
           "        COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
           "        [[ ${COMPREPLY[0]} == *= ]] && compopt -o nospace 2>/dev/null\n"
           "        return 0\n"
           "    fi\n"
           "    case \"$command\" in\n" +
           lists +
           "    esac\n"
           "    if [[ $current == -* || -z $command || $command == score ]]; then\n"
           "        COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
           "    fi\n"
           "    if [[ $current != -* ]]; then COMPREPLY+=($(compgen -f -- \"$current\")); fi\n"
           "    return 0\n"
           "}\n"
           "complete -o filenames -F _conelight conelight\n";
}

std::string zshScript(const std::vector<CommandWords>& commands) {
    // NAME:HELP of _describe; a colon in the name is none of ours.
    const auto entry = [](const std::string& name, const std::string& help) {
        return fmt::format(" '{}:{}'", name, unquoted(shortHelp(help)));
    };
    std::string lists;
    for (const CommandWords& command : commands) {
        std::string names, options;
        for (const CLI::App* one : command.commands) names += entry(one->get_name(), one->get_description());
        for (const CLI::Option* option : command.options)
            for (const std::string& name : namesOf(*option))
                options += entry(name, option->get_description());
        lists += fmt::format("        '{}') commands=({}) options=({}) ;;\n", command.path, names, options);
    }
    return "#compdef conelight\n"
           "# Completion of conelight for zsh, as `conelight completion zsh` prints it.\n"
           "_conelight() {\n"
           "    local command= word values=\n"
           "    local -a commands options\n"
           "    for word in ${words[2,CURRENT-1]}; do\n"
           "        case \"$command:$word\" in\n" +
           commandCases(commands) +
           "        esac\n"
           "    done\n"
           "    case \"${words[CURRENT-1]}\" in\n" +
           valueCases(commands, "values=") +
           "    esac\n"
           "    if [[ -n $values ]]; then compadd -S '' -- ${=values}; return; fi\n"
           "    case \"$command\" in\n" +
           lists +
           "    esac\n"
           "    if [[ $PREFIX == -* ]]; then _describe option options; return; fi\n"
           "    (( $#commands )) && _describe command commands\n"
           "    _files\n"
           "}\n"
           "_conelight \"$@\"\n";
}

std::string fishScript(const std::vector<CommandWords>& commands) {
    std::string script = "# Completion of conelight for fish, as `conelight completion fish` prints it.\n";
    for (const CommandWords& command : commands) {
        std::string condition = "__fish_use_subcommand";
        if (!command.path.empty()) {
            condition.clear();
            std::size_t from = 0;
            for (std::size_t end; from <= command.path.size(); from = end + 1) {
                end = std::min(command.path.find(' ', from), command.path.size());
                condition += (condition.empty() ? "" : "; and ") +
                             std::string("__fish_seen_subcommand_from ") +
                             command.path.substr(from, end - from);
            }
        }
        for (const CLI::App* one : command.commands)
            script += fmt::format("complete -c conelight -n '{}' -a {} -d '{}'\n", condition, one->get_name(),
                                  unquoted(shortHelp(one->get_description())));
        for (const CLI::Option* option : command.options) {
            std::string line = fmt::format("complete -c conelight -n '{}'", condition);
            for (const std::string& name : option->get_lnames()) line += " -l " + name;
            for (const std::string& name : option->get_snames()) line += " -s " + name;
            const std::vector<std::string> values = valuesOf(*option);
            if (!values.empty())
                line += fmt::format(" -x -a '{}'", joined(values));
            else if (option->get_items_expected_min() > 0)
                line += " -r";
            script += line + fmt::format(" -d '{}'\n", unquoted(shortHelp(option->get_description())));
        }
    }
    return script;
}

}  // namespace

std::string completionScript(const CLI::App& app, const std::string& shell) {
    const std::vector<CommandWords> commands = commandWords(app);
    if (shell == "zsh") return zshScript(commands);
    return shell == "fish" ? fishScript(commands) : bashScript(commands);
}

void addCompletion(CLI::App& app) {
    auto shell = std::make_shared<std::string>();
    CLI::App* command =
        app.add_subcommand("completion", "print a script with which a shell completes commands and options");
    command->add_option("shell", *shell, "bash, zsh or fish")
        ->required()
        ->check(CLI::IsMember({"bash", "zsh", "fish"}));
    command->callback([shell, &app] { fmt::print("{}", completionScript(app, *shell)); });
}

}  // namespace conelight::program
