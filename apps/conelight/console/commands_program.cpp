// SPDX-License-Identifier: MIT
// Commands that write pictures and scenes, run scripts, explain and end.
#include <fmt/core.h>

#include "conelight/error.h"
#include "console/console.h"
#include "io/files.h"
#include "io/image_file.h"

#include <algorithm>
#include <cstdio>

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
    Request request{RequestKind::Screenshot, context.words[0]};
    io::imageFormatOf(request.file);
    for (std::size_t i = 1; i < context.count(); ++i)
        if (!takeFormatWord(request.format, context.words[i]))
            throw Error(ErrorKind::Usage, "screenshot: '" + context.words[i] +
                                              "': a size as 1920x1080, alpha or 16bit would be right");
    checkFormat(request.format, request.file);
    io::checkWritable(request.file);
    context.session.request(std::move(request));
}

// As 24fps. Returns whether it was that.
bool takeRate(Request& request, const std::string& word) {
    int rate = 0, end = 0;
    if (std::sscanf(word.c_str(), "%4dfps%n", &rate, &end) != 1 ||
        static_cast<std::size_t>(end) != word.size())
        return false;
    if (rate < 1 || rate > 240)
        throw Error(ErrorKind::Usage, "record: " + word + ": 1fps to 240fps would be right");
    request.framesPerSecond = rate;
    return true;
}

void checkMovement(const Session& session, const Request& request) {
    if (request.alongPath && session.cameraPath().empty())
        throw Error(ErrorKind::Usage,
                    "record: the camera path has no keys; `path add` or `path load` would be right");
    if (request.clip && (session.clips().empty() || !session.clipsFit()))
        throw Error(ErrorKind::Usage, "record: the scene has no clip that fits it; `list` says what it has");
}

void record(const CommandContext& context) {
    Request request{RequestKind::Record, context.words[0], static_cast<int>(context.number(1))};
    for (std::size_t i = 2; i < context.count(); ++i) {
        const std::string& word = context.words[i];
        if (word == "turntable" || word == "path" || word == "clip") {
            request.turntable = word == "turntable";
            request.alongPath = word == "path";
            request.clip = word == "clip";
        } else if (!takeRate(request, word) && !takeFormatWord(request.format, word)) {
            throw Error(ErrorKind::Usage,
                        "record: '" + word +
                            "': turntable, path, clip, a size as 1920x1080, a rate as 24fps, alpha or 16bit "
                            "would be right");
        }
    }
    checkMovement(context.session, request);
    if (!isVideoName(request.file))
        throw Error(ErrorKind::Usage,
                    fmt::format("record: {}: a name ending in .mp4, or numbered pictures as in frame%04d.png "
                                "would be right",
                                request.file));
    checkFormat(request.format, request.file);
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
        for (const char* extension : {".mp4", ".mkv", ".webm", ".mov", ".gif", ".webp"})
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
            command("screenshot",
                    {{"FILE", ArgumentKind::File},
                     {"HOW", ArgumentKind::Text, true, true, "", 0, 0, {"1920x1080", "alpha", "16bit"}}},
                    "write the picture: .png .jpg (tone-mapped), .exr .hdr (linear radiance)", screenshot,
                    "HOW: a size, else as large as it is shown; alpha: clear where only the surroundings are "
                    "seen\n(.png, .exr); 16bit: of a channel (.png)."),
            command(
                "record",
                {{"FILE", ArgumentKind::File},
                 {"FRAMES", ArgumentKind::Whole, false, false, "frames", 1, 100000, {}},
                 {"HOW",
                  ArgumentKind::Text,
                  true,
                  true,
                  "",
                  0,
                  0,
                  {"turntable", "path", "clip", "1920x1080", "24fps", "alpha", "16bit"}}},
                "write frames as a film, or as numbered pictures", record,
                "FILE ends in .mp4, .mkv, .webm, .mov, .gif or .webp (through ffmpeg), or is a pattern like "
                "frame%04d.png.\nturntable: the camera goes once round its target. path: along its keys "
                "(`help path`). clip: what moves in the file,\nfrom the start of the clip. A rate as "
                "24fps, else 30 frames a second. Size, alpha and 16bit as of `screenshot`;\nalpha in "
                "films: .mov."),
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
