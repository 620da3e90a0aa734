// SPDX-License-Identifier: MIT
// Commands that act on the viewer's window. The window carries them out between frames, as any request.
#include "conelight/error.h"
#include "console/console.h"
#include "io/files.h"
#include "io/image_file.h"

namespace conelight::program {
namespace {

void askWindow(const CommandContext& context, const char* name) {
    Request request{RequestKind::Window};
    request.words = {name};
    request.words.insert(request.words.end(), context.words.begin(), context.words.end());
    context.session.request(std::move(request));
}

Argument onOff() {
    Argument argument{"ON", ArgumentKind::Choice, true};
    argument.choices = {"on", "off"};
    return argument;
}

Argument choice(const char* name, std::vector<std::string> choices) {
    Argument argument{name, ArgumentKind::Choice, true};
    argument.choices = std::move(choices);
    return argument;
}

Argument themeArgument() {
    Argument argument{"THEME", ArgumentKind::Choice};
    argument.choices = {"dark", "light"};
    return argument;
}

Argument statusKey() {
    return choice("KEY",
                  {"scene",     "window",    "picture", "mode",   "split",  "kept", "work",       "settled",
                   "selection", "pixel",     "camera",  "steps",  "path",   "log",  "hint",       "guides",
                   "headlight", "turntable", "frames",  "moving", "pauses", "gui",  "first_frame"});
}

Command splitCommand() {
    Argument mode = choice("MODE", sessionModes());
    mode.choices.emplace_back("kept");
    mode.choices.emplace_back("off");
    return command(
        "split", {mode, {"POSITION", ArgumentKind::Number, true, false, "", 0, 1, {}}},
        "another mode on the right side of the picture",
        [](const CommandContext& context) { askWindow(context, "split"); },
        "POSITION: where it begins, as a part of the width. kept: the picture of `keep`. Without MODE: on, "
        "or off "
        "again.");
}

Command keepCommand() {
    return command(
        "keep", {{"FILE", ArgumentKind::File, true}, {"LAYER", ArgumentKind::Text, true}},
        "keep the picture as A, beside the live one",
        [](const CommandContext& context) { askWindow(context, "keep"); },
        "With FILE: an .exr, .hdr, .png or .jpg picture; LAYER: one of an .exr.");
}

Command flipCommand() {
    return command(
        "flip", {onOff()}, "show the picture that was kept in place of the live one, or the live one",
        [](const CommandContext& context) { askWindow(context, "flip"); },
        "The wheel enlarges it, a drag moves it; large pixels have their numbers.");
}

Command scopesCommand() {
    return command("scopes", {onOff()},
                   "histograms of luminance and channels, and a waveform, over the picture",
                   [](const CommandContext& context) { askWindow(context, "scopes"); });
}

Command histogramCommand() {
    return command("histogram", {},
                   "luminance of the picture, per stop about middle grey, and what is clipped",
                   [](const CommandContext& context) { askWindow(context, "histogram"); });
}

Command errorCommand() {
    return command(
        "error", {onOff(), {"SCALE", ArgumentKind::Number, true, false, "", 0.05, 4, {}}},
        "the right side of a split shows the left one's error against it",
        [](const CommandContext& context) { askWindow(context, "error"); },
        "SCALE: the error that gets the strongest colour, in parts of the mean radiance.");
}

Command guidesCommand() {
    return command(
        "guides", {choice("WHICH", {"grid", "axes", "scale", "all"}), onOff()},
        "a grid on the ground, the world's axes, a scale bar, over the picture",
        [](const CommandContext& context) { askWindow(context, "guides"); },
        "Without ON: on, or off again. The ends of the axes are buttons for the views along them.");
}

Command headlightCommand() {
    return command(
        "headlight", {{"STRENGTH", ArgumentKind::Number, true, false, "W/m^2", 0, 1e6, {}}},
        "a light at the eye, for looking round in the dark",
        [](const CommandContext& context) { askWindow(context, "headlight"); },
        "It is no light of the scene: it goes with the camera, casts no shadow, bounces nowhere and is not "
        "saved. "
        "Modes reference and beams show none. 0: off. Without STRENGTH: on, or off again.");
}

Command turntableCommand() {
    return command(
        "turntable", {{"SECONDS", ArgumentKind::Number, true, false, "s", 0, 1e6, {}}},
        "turn the camera round its target until it is stopped",
        [](const CommandContext& context) { askWindow(context, "turntable"); },
        "SECONDS: of a turn; 0 stops it, as the key Escape does, and as every other movement of the camera. "
        "Without SECONDS: on, or off again. `settle` waits for its end.");
}

Command screenshotCommand() {
    return command("screenshot_window", {{"FILE", ArgumentKind::File}},
                   "write the window with its panels: .png or .jpg", [](const CommandContext& context) {
                       const io::ImageFormat format = io::imageFormatOf(context.words[0]);
                       if (format != io::ImageFormat::Png && format != io::ImageFormat::Jpg)
                           throw Error(ErrorKind::Usage,
                                       "screenshot_window: " + context.words[0] +
                                           ": a name ending in .png or .jpg would be right");
                       io::checkWritable(context.words[0]);
                       askWindow(context, "screenshot_window");
                   });
}

Command pickCommand() {
    return command(
        "pick",
        {{"X", ArgumentKind::Number, true, false, "", 0, 1, {}},
         {"Y", ArgumentKind::Number, true, false, "", 0, 1, {}}},
        "as a click into the picture: select and inspect what lies there",
        [](const CommandContext& context) { askWindow(context, "pick"); },
        "X and Y: parts of its width and height, from the upper left corner. Without them: takes "
        "what "
        "was found, and its cones or rays, off the picture, as the key Escape does.");
}

Command whereCommand() {
    return command(
        "where", {{"WIDGET", ArgumentKind::Text, false, true}},
        "the place of a widget in the window, to drive it from a script: x y width height",
        [](const CommandContext& context) { askWindow(context, "where"); },
        "WIDGET: picture, split, console, a setting's key, tab:Voxels, menu:File, object:NAME, "
        "edit:roughness");
}

}  // namespace

CommandGroup windowCommands() {
    Argument side{"SIDE", ArgumentKind::Choice};
    side.choices = {"front", "back", "right", "left", "top", "bottom"};
    return {
        "Window (conelight view)",
        {
            splitCommand(),
            errorCommand(),
            keepCommand(),
            flipCommand(),
            scopesCommand(),
            histogramCommand(),
            guidesCommand(),
            headlightCommand(),
            turntableCommand(),
            command("fullscreen", {onOff()}, "fill the screen, or not",
                    [](const CommandContext& context) { askWindow(context, "fullscreen"); }),
            command("panels", {onOff()}, "show panels and console beside the picture, or the picture alone",
                    [](const CommandContext& context) { askWindow(context, "panels"); }),
            command("light_shapes", {onOff()}, "show lights in the picture as icons and shapes, or not",
                    [](const CommandContext& context) { askWindow(context, "light_shapes"); }),
            command("focus", {}, "move the camera so that it sees all of the selection, or of the scene",
                    [](const CommandContext& context) { askWindow(context, "focus"); }),
            command(
                "view_from", {side}, "look along an axis of the world at the selection, or at the scene",
                [](const CommandContext& context) { askWindow(context, "view_from"); },
                "front: from +z; right: from +x; top: from +y"),
            pickCommand(),
            command(
                "settle", {}, "wait until the picture is as good as it gets",
                [](const CommandContext& context) { askWindow(context, "settle"); },
                "In mode reference, and beside it, until there is a first picture."),
            command(
                "stop", {},
                "end what commands wait for: a scene to open, a flight, a film, a bake, settle or wait",
                [](const CommandContext& context) { askWindow(context, "stop"); },
                "Typed by itself it is carried out at once, and the commands behind that go on. So is `path "
                "stop` during a flight, which the key Escape ends, too; and a scene that is read."),
            command(
                "resolution", {{"SCALE", ArgumentKind::Number, true, false, "", 0.25, 1, {}}},
                "pixels of the picture, as a part of those of the window, along each edge",
                [](const CommandContext& context) { askWindow(context, "resolution"); },
                "Without SCALE it is printed. While the camera moves there may be fewer."),
            command("ui_scale", {{"SCALE", ArgumentKind::Number, false, false, "", 0.5, 4, {}}},
                    "size of text and widgets, 1 on ordinary screens",
                    [](const CommandContext& context) { askWindow(context, "ui_scale"); }),
            command("theme", {themeArgument()}, "letters and grounds of the window's panels",
                    [](const CommandContext& context) { askWindow(context, "theme"); }),
            command("status", {statusKey()}, "what the window shows and what that costs",
                    [](const CommandContext& context) { askWindow(context, "status"); }),
            screenshotCommand(),
            whereCommand(),
        }};
}

}  // namespace conelight::program
