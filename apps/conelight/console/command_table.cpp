// SPDX-License-Identifier: MIT
#include "console/command_table.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "conelight/error.h"
#include "console/console.h"
#include "console/names.h"
#include "console/statements.h"
#include "session/usage.h"

namespace conelight::program {
namespace {

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i)
        text += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + words[i];
    return text;
}

void checkNumber(const Command& command, const Argument& argument, const std::string& word) {
    const std::string what = command.name + ": " + argument.name;
    const double value = numberFrom(what, word);
    const bool whole = argument.kind == ArgumentKind::Whole;
    const bool outside = argument.low < argument.high && (value < argument.low || value > argument.high);
    if (!outside && (!whole || value == std::floor(value))) return;
    usage(fmt::format("{}: '{}' is not usable; a {}number from {:g} to {:g}{} would be right", what, word,
                      whole ? "whole " : "", argument.low, argument.high,
                      argument.unit.empty() ? "" : " " + argument.unit));
}

std::vector<CommandGroup (*)()>& groupMakers() {
    static std::vector<CommandGroup (*)()> makers = {settingCommands, cameraCommands,  sceneCommands,
                                                     inspectCommands, programCommands, windowCommands};
    return makers;
}

}  // namespace

double CommandContext::number(std::size_t i) const { return numberFrom("argument", words.at(i)); }
void CommandContext::print(const std::string& line) const { console.print(line); }

std::size_t Command::fewestWords() const {
    return static_cast<std::size_t>(
        std::count_if(arguments.begin(), arguments.end(), [](const Argument& one) { return !one.optional; }));
}

bool Command::takes(std::size_t words) const {
    const bool open = !arguments.empty() && arguments.back().repeated;
    return words >= fewestWords() && (open || words <= arguments.size());
}

std::string Command::usage() const {
    std::string text = name;
    for (const Argument& argument : arguments) {
        const std::string word = argument.name + (argument.repeated ? "..." : "");
        text += argument.optional ? " [" + word + "]" : " " + word;
    }
    return text;
}

const std::vector<CommandGroup>& commandGroups() {
    static const std::vector<CommandGroup> kGroups = [] {
        std::vector<CommandGroup> groups;
        for (const auto& group : groupMakers()) groups.push_back(group());
        return groups;
    }();
    return kGroups;
}

void registerCommands(CommandGroup (*group)()) {
    auto& makers = groupMakers();
    if (std::find(makers.begin(), makers.end(), group) == makers.end()) makers.push_back(group);
}

std::vector<const Command*> commandsNamed(const std::string& word) {
    std::vector<const Command*> found, byAlias;
    for (const CommandGroup& group : commandGroups()) {
        for (const Command& command : group.commands) {
            if (command.name == word) found.push_back(&command);
            if (std::find(command.aliases.begin(), command.aliases.end(), word) != command.aliases.end())
                byAlias.push_back(&command);
        }
    }
    found.insert(found.end(), byAlias.begin(), byAlias.end());
    return found;
}

std::vector<std::string> commandWords() {
    std::vector<std::string> words;
    for (const CommandGroup& group : commandGroups()) {
        for (const Command& command : group.commands) {
            words.push_back(command.name);
            words.insert(words.end(), command.aliases.begin(), command.aliases.end());
        }
    }
    std::sort(words.begin(), words.end());
    words.erase(std::unique(words.begin(), words.end()), words.end());
    return words;
}

Command command(const char* name, std::vector<Argument> arguments, const char* help,
                void (*run)(const CommandContext&), const char* details) {
    Command made;
    made.name = name;
    made.arguments = std::move(arguments);
    made.help = help;
    made.run = run;
    made.details = details;
    return made;
}

double numberFrom(const std::string& what, const std::string& text) {
    const char* first = text.data();
    const char* last = first + text.size();
    if (first != last && *first == '+') ++first;
    if (last - first > 1 && (last[-1] == 'f' || last[-1] == 'F')) --last;
    double value = 0;
    const auto [end, fault] = std::from_chars(first, last, value);
    if (first == last || fault != std::errc{} || end != last || !std::isfinite(value))
        usage(fmt::format("{}: '{}' is not a number", what, text));
    return value;
}

void checkArgument(const Session& session, const Command& command, const Argument& argument,
                   const std::string& word) {
    switch (argument.kind) {
        case ArgumentKind::Number:
        case ArgumentKind::Whole:
            return checkNumber(command, argument, word);
        case ArgumentKind::Choice:
            if (std::find(argument.choices.begin(), argument.choices.end(), word) == argument.choices.end())
                usage(fmt::format("{}: {}: '{}' is not usable; {} would be right", command.name,
                                  argument.name, word, joined(argument.choices)));
            return;
        case ArgumentKind::Object:
            requireName(command.name, "object", objectNames(session), word);
            return;
        default:
            return;  // checked where it is used
    }
}

std::vector<std::string> wordsOf(const Session& session, const Argument& argument) {
    switch (argument.kind) {
        case ArgumentKind::Choice:
            return argument.choices;
        case ArgumentKind::Mode:
            return sessionModes();
        case ArgumentKind::Setting: {
            std::vector<std::string> keys;
            for (const SettingInfo* info : listedSettings()) keys.push_back(info->key);
            return keys;
        }
        case ArgumentKind::Object:
            return objectNames(session);
        case ArgumentKind::Material:
            return materialNames(session);
        case ArgumentKind::Light:
            return lightNames(session);
        case ArgumentKind::Camera:
            return cameraNames(session);
        case ArgumentKind::Selectable: {
            std::vector<std::string> names = objectNames(session);
            for (const auto& more : {lightNames(session), materialNames(session)})
                names.insert(names.end(), more.begin(), more.end());
            for (const char* word : {"none", "all", "invert"}) names.emplace_back(word);
            return names;
        }
        case ArgumentKind::CommandName:
            return commandWords();
        default:
            return {};
    }
}

}  // namespace conelight::program
