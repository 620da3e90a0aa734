// SPDX-License-Identifier: MIT
// The commands of the console as a table: name, aliases, arguments with unit and range, help, what they do.
// `help`, completion, the check of arguments and docs/reference/console.md all come from it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "session/session.h"

namespace conelight::program {

class Console;

enum class ArgumentKind {
    Number,
    Whole,
    Text,
    Choice,        // one of Argument::choices
    Mode,          // of the program
    Setting,       // a key
    SettingValue,  // of the key before
    Object,        // an instance's name
    Material,      // a material's name, or an object's
    Light,
    Camera,
    Selectable,  // an object, light or material, or none
    File,
    SceneFile,  // a file, or builtin:NAME
    CommandName
};

struct Argument {
    std::string name;
    ArgumentKind kind = ArgumentKind::Text;
    bool optional = false;
    bool repeated = false;  // the last one only: as many words as there are, at least one unless optional
    std::string unit;
    double low = 0, high = 0;  // Number and Whole: range; equal: any
    std::vector<std::string> choices;
};

struct CommandContext {
    Session& session;
    Console& console;
    const std::vector<std::string>& words;  // arguments; those of the table are checked

    std::size_t count() const { return words.size(); }
    double number(std::size_t i) const;
    void print(const std::string& line) const;
};

struct Command {
    std::string name;
    std::vector<std::string> aliases;
    std::vector<Argument> arguments;
    std::string help;  // one line
    std::function<void(const CommandContext&)> run;
    std::string details;   // further lines of `help NAME`
    std::string original;  // not empty: a command of the thesis's program; what differs here
    int branches = 0;      // how many (word count, first word) branches of that program it stands for

    std::size_t fewestWords() const;
    bool takes(std::size_t words) const;
    std::string usage() const;  // "translate NAME AXIS DISTANCE"
};

Command command(const char* name, std::vector<Argument> arguments, const char* help,
                void (*run)(const CommandContext&), const char* details = "");

struct CommandGroup {
    std::string title;
    std::vector<Command> commands;
};
const std::vector<CommandGroup>& commandGroups();
// Groups of modes with a folder of their own come last, in the order of registration. Call before the first
// use of commandGroups(), from one thread; the same function twice counts once.
void registerCommands(CommandGroup (*group)());

// All commands with this name or alias, those of the name first.
std::vector<const Command*> commandsNamed(const std::string& word);
std::vector<std::string> commandWords();  // all names and aliases, sorted

// A number in any locale; an `f` behind it is passed over, as the original did. Throws Error(Usage).
double numberFrom(const std::string& what, const std::string& text);
// Throws Error(Usage) that names the argument and what would be right.
void checkArgument(const Session& session, const Command& command, const Argument& argument,
                   const std::string& word);
// Words that an argument can be: names, choices, keys; empty for numbers, texts and files.
std::vector<std::string> wordsOf(const Session& session, const Argument& argument);

// Groups, by file.
CommandGroup settingCommands();  // commands_settings.cpp
CommandGroup cameraCommands();   // commands_camera.cpp
CommandGroup sceneCommands();    // commands_scene.cpp
CommandGroup inspectCommands();  // commands_inspect.cpp
CommandGroup programCommands();  // commands_program.cpp
CommandGroup windowCommands();   // commands_window.cpp

Command lightCommand();                   // commands_light.cpp
std::vector<Command> objectCommands();    // commands_objects.cpp
std::vector<Command> additionCommands();  // commands_addition.cpp
Command pathCommand();                    // commands_path.cpp
Command clipCommand();                    // commands_clip.cpp
Command presetCommand();                  // commands_preset.cpp
Command qualityCommand();                 // commands_preset.cpp
Command whyCommand();                     // commands_why.cpp
void printLights(const CommandContext& context);

// Whether `record` can write this: a film's extension, or a pattern of numbered pictures.
bool isVideoName(const std::string& file);

// docs/reference/console.md's tables; see `conelight commands`.
std::string commandsMarkdown();
std::string originalCommandsMarkdown();
std::string commandsText();

}  // namespace conelight::program
