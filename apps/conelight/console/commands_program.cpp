// SPDX-License-Identifier: MIT
// Commands that write pictures and scenes, run scripts, explain and end.
#include <fmt/core.h>

#include "conelight/error.h"
#include "console/console.h"
#include "io/files.h"
#include "io/image_file.h"

#include <algorithm>

namespace conelight::program {
namespace {

void printWrapped(const CommandContext& context, const std::string& text, const std::string& indent) {
    for (std::size_t from = 0; from < text.size();) {
        const std::size_t end = std::min(text.find('\n', from), text.size());
        context.print(indent + text.substr(from, end - from));
        from = end + 1;
    }
}

std::string valuesOf(const Argument& argument) {
    std::string text;
    if (argument.low < argument.high) text = fmt::format("{:g} to {:g}", argument.low, argument.high);
    if (!argument.unit.empty()) text += (text.empty() ? "" : " ") + argument.unit;
    for (const std::string& choice : argument.choices) text += (text.empty() ? "" : ", ") + choice;
    return text;
}

void helpFor(const CommandContext& context, const std::string& word) {
    const std::vector<const Command*> found = commandsNamed(word);
    if (found.empty()) {
        if (const SettingInfo* info = findSetting(word))
            return context.print(fmt::format("setting {}: {}; {}{}{}, default {}", info->key, info->help,
                                             rangeText(*info), info->unit.empty() ? "" : " ", info->unit,
                                             info->defaultValue));
        const std::string near = nearest(word, commandWords());
        throw Error(ErrorKind::Usage,
                    fmt::format("help: there is no command '{}'{}", word,
                                near.empty() ? "; `help` lists all" : "; " + near + " would be right"));
    }
    for (const Command* command : found) {
        std::string also;
        for (const std::string& alias : command->aliases) also += (also.empty() ? "" : ", ") + alias;
        context.print(command->usage() + (also.empty() ? "" : "   (also: " + also + ")"));
        context.print("  " + command->help);
        for (const Argument& argument : command->arguments)
            if (const std::string values = valuesOf(argument); !values.empty())
                context.print(fmt::format("  {}: {}", argument.name, values));
        printWrapped(context, command->details, "  ");
    }
}

void help(const CommandContext& context) {
    if (context.count() > 0) return helpFor(context, context.words[0]);
    for (const CommandGroup& group : commandGroups()) {
        context.print(group.title);
        for (const Command& command : group.commands)
            context.print(fmt::format("  {:<34} {}", command.usage(), command.help));
    }
    context.print("`help COMMAND` says more; commands are parted by `;`, `#` begins a comment");
}

void screenshot(const CommandContext& context) {
    io::imageFormatOf(context.words[0]);
    io::checkWritable(context.words[0]);
    context.session.request({RequestKind::Screenshot, context.words[0]});
}

void record(const CommandContext& context) {
    Request request{RequestKind::Record, context.words[0], static_cast<int>(context.number(1))};
    request.turntable = context.count() > 2 && context.words[2] == "turntable";
    request.alongPath = context.count() > 2 && context.words[2] == "path";
    if (request.alongPath && context.session.cameraPath().empty())
        throw Error(ErrorKind::Usage,
                    "record: the camera path has no keys; `path add` or `path load` would be right");
    if (!isVideoName(request.file))
        throw Error(ErrorKind::Usage,
                    fmt::format("record: {}: a name ending in .mp4, or numbered pictures as in frame%04d.png "
                                "would be right",
                                request.file));
    context.session.request(std::move(request));
}

void open(const CommandContext& context) {
    if (context.count() > 1) context.session.takeUpAxis(context.words[0], *upAxisOf(context.words[1]));
    context.session.request({RequestKind::Load, context.words[0]});
}

void wait(const CommandContext& context) { context.console.waitFor(static_cast<int>(context.number(0))); }

void echo(const CommandContext& context) {
    std::string text;
    for (const std::string& word : context.words) text += (text.empty() ? "" : " ") + word;
    context.print(text);
}

void source(const CommandContext& context) { context.console.source(context.words[0]); }

void history(const CommandContext& context) {
    for (const std::string& line : context.console.history().lines()) context.print(line);
}

void quit(const CommandContext& context) {
    Request request{RequestKind::Quit};
    request.status = context.count() > 0 ? static_cast<int>(context.number(0)) : 0;
    context.session.request(request);
}

}  // namespace

bool isVideoName(const std::string& file) {
    const std::size_t percent = file.find('%');
    if (percent == std::string::npos) {
        for (const char* extension : {".mp4", ".mkv", ".webm", ".mov", ".gif"})
            if (file.size() > 4 &&
                file.compare(file.size() - std::string(extension).size(), std::string::npos, extension) == 0)
                return true;
        return false;
    }
    // %d or %04d, once.
    std::size_t at = percent + 1;
    while (at < file.size() && file[at] >= '0' && file[at] <= '9') ++at;
    if (at >= file.size() || file[at] != 'd' || at - percent > 3) return false;
    if (file.find('%', at) != std::string::npos) return false;
    try {
        io::imageFormatOf(file);
    } catch (const Error&) {
        return false;
    }
    return true;
}

CommandGroup programCommands() {
    Command leave = command("quit", {{"STATUS", ArgumentKind::Whole, true, false, "", 0, 125, {}}},
                            "end the program, with an exit status", quit);
    leave.aliases = {"exit", "q"};
    leave.original = "may have a status";
    leave.branches = 1;
    return {
        "Program",
        {
            command("help", {{"COMMAND", ArgumentKind::CommandName, true}},
                    "all commands, or one of them in full", help),
            command("screenshot", {{"FILE", ArgumentKind::File}},
                    "write the picture: .png .jpg (tone-mapped), .exr .hdr (linear radiance)", screenshot),
            command("record",
                    {{"FILE", ArgumentKind::File},
                     {"FRAMES", ArgumentKind::Whole, false, false, "frames", 1, 100000, {}},
                     {"PATH", ArgumentKind::Choice, true, false, "", 0, 0, {"turntable", "path"}}},
                    "write frames as a film, or as numbered pictures", record,
                    "FILE ends in .mp4 (through ffmpeg, 30 frames a second), or is a pattern like "
                    "frame%04d.png.\nturntable: the camera goes once round its target. path: along its keys "
                    "(`help path`)."),
            command(
                "open",
                {{"SCENE", ArgumentKind::SceneFile},
                 {"UP", ArgumentKind::Choice, true, false, "", 0, 0, {"x", "y", "z", "auto"}}},
                "another scene, with its own camera and settings", open,
                "UP: the axis of the file that points up, as `--up`; it holds until that file is opened with "
                "another."),
            command("wait", {{"FRAMES", ArgumentKind::Whole, false, false, "frames", 1, 100000, {}}},
                    "draw so many frames before the next command", wait),
            whyCommand(),
            command("echo", {{"TEXT", ArgumentKind::Text, true, true}}, "print a line", echo),
            command("source", {{"FILE", ArgumentKind::File}}, "run the commands of a file", source),
            command("history", {}, "the lines typed so far", history),
            leave,
        }};
}

}  // namespace conelight::program
