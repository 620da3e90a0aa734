// SPDX-License-Identifier: MIT
// Commands of the thesis's program for its cones: they change the settings `thesis.*`, which mode thesis
// shows.
#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "conelight/error.h"

#include "conelight/thesis/settings.h"
#include "console/console.h"
#include "thesis/console/commands.h"

namespace conelight::thesis {

using namespace program;

namespace {

// In other modes these settings change nothing that can be seen: say so rather than leave somebody wondering.
void hint(const CommandContext& context) {
    if (context.session.shownMode() != "thesis")
        context.print(fmt::format("(seen in mode thesis; this is mode {})", context.session.shownMode()));
}

struct Toggle {
    const char* name;
    const char* alias;
    const char* label;
    const char* key;
    const char* help;
};
constexpr Toggle kToggles[] = {
    {"phong", "", "VXCT Phong", "thesis.phong", "direct light"},
    {"phong_ambient", "", "VXCT Phong Ambient", "thesis.phong_ambient", "its ambient part"},
    {"phong_diffuse", "", "VXCT Phong Diffuse", "thesis.phong_diffuse", "its diffuse part"},
    {"phong_specular", "", "VXCT Phong Specular", "thesis.phong_specular", "its gloss"},
    {"front_cone", "", "VXCT Front Cone", "thesis.front_cone", "the diffuse cone along the normal"},
    {"side_cones", "", "VXCT Side Cones", "thesis.side_cones", "four diffuse cones along the surface"},
    {"intermediate_cones", "", "VXCT Intermediate Cones", "thesis.intermediate_cones",
     "four diffuse cones between"},
    {"vox_diffuse", "vdiff", "VXCT Diffuse Component", "thesis.vox_diffuse", "indirect diffuse light"},
    {"vox_specular", "vspec", "VXCT Specular Component", "thesis.vox_specular", "reflections"},
    {"vox_shadows", "vshad", "VXCT Occlusion Component", "thesis.vox_shadows", "occlusion of direct light"},
};

Command toggleCommand(const Toggle& row) {
    Command command;
    command.name = row.name;
    if (*row.alias != '\0') command.aliases = {row.alias};
    command.help = fmt::format("{}, on or off ({})", row.help, row.key);
    command.run = [row](const CommandContext& context) {
        const bool on = getSetting(context.session.settings(), row.key) != "true";
        context.session.setSetting(row.key, on ? "true" : "false");
        context.print(fmt::format("{}: {}", row.label, on ? "ON" : "OFF"));
        hint(context);
    };
    command.original = "as there";
    command.branches = 1;
    return command;
}

// Which of phong, diffuse, occlusion, specular a command switches on; the rest it switches off.
Command onlyCommand(const char* name, const std::array<bool, 4>& on, const char* help) {
    static constexpr const char* kKeys[] = {"thesis.phong", "thesis.vox_diffuse", "thesis.vox_shadows",
                                            "thesis.vox_specular"};
    Command command;
    command.name = name;
    command.help = help;
    command.run = [on, name](const CommandContext& context) {
        Settings settings = context.session.settings();
        for (std::size_t i = 0; i < on.size(); ++i) setSetting(settings, kKeys[i], on[i] ? "true" : "false");
        context.session.setSettings(settings, name);
        hint(context);
    };
    command.original = "as there";
    command.branches = 1;
    return command;
}

struct Number {
    const char* name;
    const char* alias;
    const char* label;
    const char* key;
    int branches;
    const char* original;
};
constexpr Number kNumbers[] = {
    {"diffuse_dist_factor", "ddf", "Diffuse Distance Factor", "thesis.diffuse.dist_factor", 1,
     "can be printed; 0 is refused"},
    {"occlusion_dist_factor", "odf", "Occlusion Distance Factor", "thesis.occlusion.dist_factor", 1,
     "can be printed; 0 is refused (hung)"},
    {"specular_dist_factor", "sdf", "Specular Distance Factor", "thesis.specular.dist_factor", 1,
     "can be printed; 0 is refused (hung)"},
    {"diffuse_offset", "do", "Diffuse Offset", "thesis.diffuse.offset", 2, "0 is refused (hung)"},
    {"diffuse_origin_offset", "doo", "Diffuse Origin Offset", "thesis.diffuse.origin_offset", 1,
     "can be printed; without effect unless thesis.defects.fixed_offsets is on"},
    {"occlusion_offset", "oo", "Occlusion Offset", "thesis.occlusion.offset", 2, "0 is refused (hung)"},
    {"specular_offset", "so", "Specular Offset", "thesis.specular.offset", 2, "0 is refused (hung)"},
    {"diffuse_aperture", "da", "Diffuse Aperture", "thesis.diffuse.aperture", 1,
     "can be printed; 0 is refused (hung)"},
    {"occlusion_aperture", "oa", "Occlusion Aperture", "thesis.occlusion.aperture", 1, "can be printed"},
    {"specular_aperture", "sa", "Specular Aperture", "thesis.specular.aperture", 1, "can be printed"},
    {"shadow_str", "ss", "Shadow Strength", "thesis.occlusion.shadow_str", 1, "can be printed"},
    {"shininess_falloff", "sf", "Shininess Falloff", "thesis.specular.shininess_falloff", 1,
     "can be printed"},
};

Command numberCommand(const Number& row) {
    Command command;
    command.name = row.name;
    command.aliases = {row.alias};
    const SettingInfo& setting = *findSetting(row.key);
    Argument value{"VALUE", ArgumentKind::Text, true, false, setting.unit, 0, 0, {}};
    command.arguments = {value};
    command.help = fmt::format("{}, {}{}{} ({})", setting.help, rangeText(setting),
                               setting.unit.empty() ? "" : " ", setting.unit, row.key);
    command.details = "Without VALUE it is printed.";
    command.run = [row](const CommandContext& context) {
        if (context.count() == 0)
            return context.print(
                fmt::format("{} : {}", row.label, getSetting(context.session.settings(), row.key)));
        const bool automatic = context.words[0] == "auto";
        std::string text = context.words[0];
        if (!automatic) text = fmt::format("{:.9g}", numberFrom(row.name, text));
        context.session.setSetting(row.key, text);
        hint(context);
    };
    command.original = row.original;
    command.branches = row.branches;
    return command;
}

Command levelCommand() {
    Command command;
    command.name = "lod";
    command.arguments = {{"LEVEL", ArgumentKind::Whole, true, false, "", 0, 8, {}}};
    command.help =
        "level of the volume that `voxs` and `loclod` show (thesis.voxel_level, cones.voxel_level)";
    command.details = "Without LEVEL it is printed.";
    command.run = [](const CommandContext& context) {
        Settings settings = context.session.settings();
        if (context.count() == 0)
            return context.print(
                fmt::format("LOD: {}", settings.groups.of<thesis::ThesisSettings>().voxelLevel));
        const int level = static_cast<int>(context.number(0));
        settings.groups.of<thesis::ThesisSettings>().voxelLevel = level;
        settings.cones.voxelLevel = std::min(level, 6);  // that mode's range ends there
        context.session.setSettings(settings, "lod");
    };
    command.original = "whole numbers in range only; shown at once";
    command.branches = 1;
    return command;
}

}  // namespace

CommandGroup coneCommands() {
    CommandGroup group{"The thesis's program: cones (mode thesis)", {}};
    for (const Toggle& row : kToggles) group.commands.push_back(toggleCommand(row));
    group.commands.push_back(
        onlyCommand("phong_only", {true, false, false, false}, "direct light only, without occlusion"));
    group.commands.push_back(
        onlyCommand("shadows_only", {false, false, true, false}, "occlusion of the lights only"));
    group.commands.push_back(onlyCommand("specular_only", {false, false, false, true}, "reflections only"));
    group.commands.push_back(
        onlyCommand("diffuse_only", {false, true, false, false}, "indirect diffuse light only"));
    group.commands.push_back(
        onlyCommand("all", {true, true, true, true}, "direct light, diffuse, occlusion and reflections"));
    for (const Number& row : kNumbers) group.commands.push_back(numberCommand(row));
    group.commands.push_back(levelCommand());
    return group;
}

}  // namespace conelight::thesis
