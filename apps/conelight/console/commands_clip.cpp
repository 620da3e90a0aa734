// SPDX-License-Identifier: MIT
// `clip` and its words: what moves in a glTF file.
#include <fmt/core.h>

#include "conelight/error.h"
#include "console/console.h"
#include "io/animation.h"
#include "session/usage.h"

namespace conelight::program {
namespace {

void listClips(const CommandContext& context) {
    const Session& session = context.session;
    const ClipState& state = session.clipState();
    if (session.clips().empty()) return context.print("nothing moves in this scene");
    for (std::size_t i = 0; i < session.clips().size(); ++i) {
        const bool shown = state.posed && state.clip == i;
        context.print(fmt::format(
            "{:3} {}: {:g} s{}", i, session.clips()[i].name, session.clips()[i].duration,
            shown ? fmt::format(", at {:.3f} s{}", state.seconds, state.playing ? ", playing" : "") : ""));
    }
}

// The clip of the second word, or the one that is shown.
std::size_t named(const CommandContext& context) {
    if (context.count() < 2) return context.session.clipState().clip;
    try {
        return io::clipNumber(context.session.animation(), context.words[1]);
    } catch (const Error& error) {
        usage(std::string("clip: ") + error.what());
    }
}

double seconds(const CommandContext& context) {
    const double value = numberFrom("clip at", context.words[1]);
    if (value >= 0 && value <= 1e6) return value;
    usage(fmt::format("clip at: '{}' is not usable; a number from 0 to 1e+06 s would be right",
                      context.words[1]));
}

void clip(const CommandContext& context) {
    Session& session = context.session;
    const std::string word = context.count() > 0 ? context.words[0] : "list";
    if (word == "list") return listClips(context);
    if (word == "play") return session.playClip(named(context));
    if (word == "stop") return session.stopClip();
    if (word == "rest") return session.restClip();
    if (word == "show") return session.poseClip(named(context), 0);
    if (context.count() < 2)
        usage(fmt::format("clip {}: a value is missing; clip {} would be right", word,
                          word == "at" ? "at SECONDS" : "loop on|off"));
    if (word == "at") return session.poseClip(session.clipState().clip, seconds(context));
    if (context.words[1] != "on" && context.words[1] != "off")
        usage(fmt::format("clip loop: '{}' is not usable; on or off would be right", context.words[1]));
    session.setClipLoops(context.words[1] == "on");
}

}  // namespace

Command clipCommand() {
    return command("clip",
                   {{"WORD",
                     ArgumentKind::Choice,
                     true,
                     false,
                     "",
                     0,
                     0,
                     {"list", "show", "at", "play", "stop", "loop", "rest"}},
                    {"VALUE", ArgumentKind::Text, true, true}},
                   "what moves in a glTF file: list, show, at, play, stop", clip,
                   "clip list            the clips, with their numbers\n"
                   "clip show CLIP       its first pose, by name or number\n"
                   "clip at SECONDS      a pose of the clip that is shown, or of the first\n"
                   "clip play [CLIP]     play it in a window\n"
                   "clip stop            hold the pose\n"
                   "clip loop on|off     begin again at the end, or stay there; on at first\n"
                   "clip rest            as the scene was opened\n"
                   "`render --animate CLIP` writes the film.");
}

}  // namespace conelight::program
