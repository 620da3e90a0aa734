// SPDX-License-Identifier: MIT
#include "viewer/window_commands.h"

#include <fmt/core.h>

#include <cstdlib>
#include <functional>
#include <map>
#include <utility>

#include "conelight/error.h"
#include "interrupt.h"
#include "io/image_file.h"
#include "viewer/focus.h"
#include "viewer/standard_views.h"

namespace conelight::program {
namespace {

using Words = std::vector<std::string>;

float number(const std::string& word) { return std::strtof(word.c_str(), nullptr); }

bool switched(const Words& words, bool now) { return words.size() > 1 ? words[1] == "on" : !now; }

}  // namespace

void WindowCommands::carryOut(const Request& request) {
    const std::map<std::string, std::function<void(const Words&)>> commands = {
        {"split", [&](const Words& words) { split(words); }},
        {"error", [&](const Words& words) { error(words); }},
        {"guides", [&](const Words& words) { guides(words); }},
        {"headlight",
         [&](const Words& words) {
             float& light = in_.view.headlight;
             light = words.size() > 1 ? number(words[1])
                     : light > 0      ? 0
                                      : headlightFor(in_.session.settings().image);
         }},
        {"turntable", [&](const Words& words) { turntable(words); }},
        {"fullscreen",
         [&](const Words& words) { in_.window.setFullscreen(switched(words, in_.window.fullscreen())); }},
        {"panels", [&](const Words& words) { in_.panels.showAll(switched(words, in_.panels.showSide)); }},
        {"light_shapes",
         [&](const Words& words) { in_.view.lights.shown = switched(words, in_.view.lights.shown); }},
        {"view_from", [&](const Words& words) { viewFrom(in_.session, words[1], in_.view.pictureSize()); }},
        {"focus", [&](const Words&) { focusOnSelection(in_.session, in_.view.pictureSize()); }},
        {"pick", [&](const Words& words) { pick(words); }},
        {"resolution", [&](const Words& words) { resolution(words); }},
        {"ui_scale",
         [&](const Words& words) {
             if (words.size() > 1) in_.gui.setScale(number(words[1]));
         }},
        {"theme", [&](const Words& words) { in_.gui.setLight(words[1] == "light"); }},
        {"settle", [&](const Words&) { in_.work.settle(); }},
        {"stop", [&](const Words&) { in_.work.stop(); }},
        {"status", [&](const Words& words) { status(words); }},
        {"screenshot_window", [&](const Words& words) { windowShot_ = words[1]; }},
        {"keep", [&](const Words& words) { keep(words); }},
        {"flip", [&](const Words& words) { flip(words); }},
        {"scopes", [&](const Words& words) { in_.view.scopes.open = switched(words, in_.view.scopes.open); }},
        {"histogram", [&](const Words&) { histogram(); }},
        {"where", [&](const Words& words) { where(words); }},
    };
    const auto command = commands.find(request.words.front());
    if (command != commands.end()) command->second(request.words);
}

void WindowCommands::pick(const Words& words) {
    if (words.size() == 2)
        throw Error(ErrorKind::Usage, "pick: Y is missing; X and Y, or neither, would be right");
    if (words.size() == 1)
        in_.probe.clear();
    else
        in_.probe.inspect({{number(words[1]), number(words[2])}});
}

void WindowCommands::keep(const Words& words) {
    KeptPicture& kept = in_.view.kept;
    if (words.size() > 1) {
        kept.open(words[1], words.size() > 2 ? words[2] : "");
    } else {
        PictureSlot& slot = in_.view.slot(false);
        if (slot.linear().pixels.empty())
            throw Error(ErrorKind::Usage, "keep: there is no picture yet; `settle` first would be right");
        kept.keep(slot.linear(), slot.label());
    }
    in_.console.say("kept " + kept.text());
}

void WindowCommands::requireKept(const char* command) const {
    if (!in_.view.kept.any())
        throw Error(ErrorKind::Usage,
                    std::string(command) + ": nothing is kept; `keep`, or key K, first would be right");
}

void WindowCommands::flip(const Words& words) {
    requireKept("flip");
    in_.view.kept.shown = switched(words, in_.view.kept.shown);
}

void WindowCommands::histogram() {
    const Scopes& scopes = in_.view.scopes.follow(in_.view.shownPicture(), in_.session.settings().image);
    in_.console.say("histogram: " + scopesText(scopes));
    constexpr int kBins = Scopes::kBinsPerStop;
    for (int stop = Scopes::kDarkest; stop < Scopes::kBrightest; ++stop) {
        std::uint32_t count = 0;
        for (int i = 0; i < kBins; ++i)
            count += scopes.luminance[static_cast<std::size_t>((stop - Scopes::kDarkest) * kBins + i)];
        if (count > 0)
            in_.console.say(
                fmt::format("  {:+3} to {:+3} stops  {:.3f} %", stop, stop + 1, 100 * scopes.part(count)));
    }
}

void WindowCommands::split(const Words& words) {
    Split& split = in_.view.split;
    if (words.size() == 1) {
        split.on = !split.on;
        return;
    }
    if (words[1] == "kept") requireKept("split");
    split.on = words[1] != "off";
    if (split.on) split.mode = words[1];
    if (words.size() > 2) split.position = number(words[2]);
}

void WindowCommands::error(const Words& words) {
    Split& split = in_.view.split;
    split.errors = switched(words, split.errors);
    if (split.errors) split.on = true;
    if (words.size() > 2) split.errorScale = number(words[2]);
}

void WindowCommands::guides(const Words& words) {
    ViewGuides& guides = in_.view.guides;
    const std::string which = words.size() > 1 ? words[1] : "all";
    const bool now = which == "grid"    ? guides.grid
                     : which == "axes"  ? guides.axes
                     : which == "scale" ? guides.scale
                                        : guides.any();
    const bool on = words.size() > 2 ? words[2] == "on" : !now;
    if (which == "all") return guides.setAll(on);
    (which == "grid" ? guides.grid : which == "axes" ? guides.axes : guides.scale) = on;
}

void WindowCommands::turntable(const Words& words) {
    const float seconds = words.size() > 1 ? number(words[1]) : Turntable::kSeconds;
    if (seconds <= 0 || (words.size() == 1 && in_.view.turntable.turns())) return in_.view.turntable.stop();
    in_.view.turntable.start(in_.session, seconds);
}

void WindowCommands::resolution(const Words& words) {
    if (words.size() > 1) in_.view.resolutionScale = number(words[1]);
    in_.console.say(fmt::format("resolution: {:g}", in_.view.resolutionScale));
}

void WindowCommands::status(const Words& words) {
    const StatusInputs inputs{in_.session, in_.window, in_.gui,    in_.view,   in_.console,
                              in_.probe,   in_.hint,   in_.panels, in_.timings};
    for (const auto& [name, text] : statusLines(inputs))
        if (words.size() == 1 || words[1] == name) in_.console.say("status " + name + ": " + text);
    if (words.size() > 1 && words[1] == "pauses") in_.timings.forgetPauses();
}

void WindowCommands::where(const Words& words) {
    std::string widget = words[1];
    for (std::size_t i = 2; i < words.size(); ++i) widget += " " + words[i];
    in_.places.ask(widget);
}

void WindowCommands::writeWindow() {
    if (windowShot_.empty()) return;
    const std::string file = std::exchange(windowShot_, {});
    in_.console.attempt([&] {
        const glm::ivec2 size = in_.window.framebufferSize();
        const io::ByteImage image{size.x, size.y, 3, in_.window.pixels()};
        const WritingScope writing;
        if (io::imageFormatOf(file) == io::ImageFormat::Png)
            io::writePng(file, image);
        else
            io::writeJpg(file, image);
        in_.console.say(fmt::format("written {} ({} x {})", file, size.x, size.y));
    });
}

}  // namespace conelight::program
