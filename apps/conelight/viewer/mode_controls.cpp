// SPDX-License-Identifier: MIT
#include <imgui.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "viewer/menus.h"
#include "viewer/widget_places.h"

namespace conelight::program {
namespace {

using Names = std::function<std::vector<std::string>()>;

// The names are asked for only while the list is open. Returns what was chosen.
std::optional<std::string> combo(const char* id, const std::string& value, const Names& namesOf) {
    std::optional<std::string> chosen;
    ImGui::SetNextItemWidth(7 * ImGui::GetFontSize());
    if (!ImGui::BeginCombo(id, value.c_str())) return chosen;
    for (const std::string& name : namesOf()) {
        if (ImGui::Selectable(name.c_str(), name == value)) chosen = name;
        notePlace("choice:" + name);
        if (const char* text = aboutMode(name); *text != 0 && ImGui::IsItemHovered())
            ImGui::SetTooltip("%s", text);
    }
    ImGui::EndCombo();
    return chosen;
}

void splitControls(Split& split) {
    ImGui::Checkbox("split", &split.on);
    notePlace("split on");
    if (!split.on) return;
    ImGui::SameLine();
    const auto names = [] {
        std::vector<std::string> modes = sessionModes();
        modes.emplace_back("kept");
        return modes;
    };
    if (const auto mode = combo("##right", split.mode, names)) split.mode = *mode;
    notePlace("split mode");
    ImGui::SameLine();
    ImGui::Checkbox("error", &split.errors);
    notePlace("error");
    if (!split.errors) return;
    ImGui::SameLine();
    ImGui::SetNextItemWidth(6 * ImGui::GetFontSize());
    ImGui::SliderFloat("##errorscale", &split.errorScale, 0.05f, 4.0f, "x %.2f",
                       ImGuiSliderFlags_Logarithmic);
}

}  // namespace

void modeControls(Session& session, Split& split, ViewerConsole& console) {
    ImGui::SameLine(0, 2 * ImGui::GetFontSize());
    if (const auto mode = combo("##mode", session.mode(), sessionModes))
        console.attempt([&] { session.setMode(*mode); });
    notePlace("mode");
    ImGui::SameLine();
    const std::string component = conelight::getSetting(session.settings(), "component");
    if (const auto name = combo("##component", component, [] { return settingChoices("component"); }))
        console.attempt([&] { session.setSetting("component", *name); });
    notePlace("component");
    ImGui::SameLine();
    splitControls(split);
}

}  // namespace conelight::program
