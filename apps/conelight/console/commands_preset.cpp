// SPDX-License-Identifier: MIT
// Settings in bundles: the qualities of mode traced, and presets in files.
#include <fmt/core.h>

#include "conelight/error.h"
#include "conelight/quality.h"
#include "console/console.h"
#include "session/usage.h"

namespace conelight::program {
namespace {

void quality(const CommandContext& context) {
    if (context.count() > 0) {
        context.session.setSetting("traced.quality", context.words[0]);
        if (context.session.mode() != "traced")
            context.print("quality " + context.words[0] + ": shows in mode traced");
        return;
    }
    context.print("quality: " + getSetting(context.session.settings(), "traced.quality"));
    for (const QualityInfo& info : qualityInfos())
        context.print(fmt::format("  {:<12} {}", info.name, qualityText(info)));
}

void preset(const CommandContext& context) {
    Session& session = context.session;
    const std::string& word = context.words[0];
    if (word == "list") {
        if (context.count() > 2) usage("preset list: takes a folder; preset list [FOLDER] would be right");
        const std::string folder = context.count() > 1 ? context.words[1] : ".";
        const std::vector<std::string> names = presetsIn(folder);
        if (names.empty()) context.print("no presets in " + folder);
        for (const std::string& name : names) context.print(name);
        return;
    }
    if (context.count() < 2)
        usage(fmt::format("preset {}: has no file; preset {} FILE would be right", word, word));
    const std::string& file = context.words[1];
    if (word == "load") {
        if (context.count() > 2) usage("preset load: takes one file; preset load FILE would be right");
        return session.applyPreset(readPreset(file), "preset load " + file);
    }
    const bool overwrite = context.count() > 2;
    if (context.count() > 3 || (overwrite && context.words[2] != "overwrite" && context.words[2] != "force"))
        usage("preset save: preset save FILE [overwrite] would be right");
    writePreset(file, session.preset(), overwrite);
    context.print("saved " + file);
}

}  // namespace

Command qualityCommand() {
    return command("quality",
                   {{"NAME", ArgumentKind::Choice, true, false, "", 0, 0, settingChoices("traced.quality")}},
                   "work of mode traced, as --quality takes it", quality,
                   "Without NAME it is printed, with what each costs; errors are in "
                   "docs/measurements/modes_vs_reference.md.");
}

Command presetCommand() {
    return command("preset",
                   {{"WORD", ArgumentKind::Choice, false, false, "", 0, 0, {"save", "load", "list"}},
                    {"VALUE", ArgumentKind::Text, true, true}},
                   "settings and mode as a file: save, load, list", preset,
                   "preset save FILE [overwrite]   what differs from what a scene starts with, as JSON\n"
                   "preset load FILE               what the file does not name is as the scene starts\n"
                   "preset list [FOLDER]           the presets in a folder");
}

}  // namespace conelight::program
