// SPDX-License-Identifier: MIT
#include "viewer/settings_panel.h"

#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>

#include "session/session.h"
#include "viewer/widget_places.h"

namespace conelight::program {
namespace {

// Panels narrower than this, in heights of text, have no room for names beside values; by eye.
constexpr float kTableEm = 17;

// "thesis.diffuse.aperture" -> "diffuse aperture": the panel's heading has said the rest.
std::string labelOf(const std::string& key) {
    const std::size_t dot = key.find('.');
    std::string label = dot == std::string::npos ? key : key.substr(dot + 1);
    std::replace(label.begin(), label.end(), '.', ' ');
    std::replace(label.begin(), label.end(), '_', ' ');
    return label;
}

// Ranges over more than three decades get a logarithmic slider.
bool isLogarithmic(double low, double high) { return low > 0 && high / low > 1000; }

void tooltip(const SettingInfo& info) {
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(26 * ImGui::GetFontSize());
    ImGui::TextUnformatted(info.help.c_str());
    ImGui::TextDisabled("%s", fmt::format("{}\nrange {}{}{}\ndefault {}", info.key, rangeText(info),
                                          info.unit.empty() ? "" : " ", info.unit, info.defaultValue)
                                  .c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

}  // namespace

void SettingsPanel::showNumber(const Row& row, const SettingEdit& edit) {
    const SettingInfo& info = *row.info;
    const double low = info.low, high = info.high;
    const bool whole = info.kind == SettingKind::Int;
    float number = std::strtof(row.value.c_str(), nullptr);
    bool changed;
    if (whole) {
        int count = static_cast<int>(number);
        // A slider over thousands of numbers cannot be set to one of them.
        changed = high - low <= 512
                      ? ImGui::SliderInt("##v", &count, static_cast<int>(low), static_cast<int>(high))
                      : ImGui::InputInt("##v", &count, 1, 16);
        if (changed)
            edit(info.key, std::to_string(std::clamp(count, static_cast<int>(low), static_cast<int>(high))),
                 false);
    } else {
        ImGuiSliderFlags flags = ImGuiSliderFlags_AlwaysClamp;
        if (isLogarithmic(low, high)) flags |= ImGuiSliderFlags_Logarithmic;
        const float span = static_cast<float>(high - low);
        changed =
            high <= 1000 || info.unit == "K"
                ? ImGui::SliderFloat("##v", &number, static_cast<float>(low), static_cast<float>(high),
                                     "%.4g", flags)
                : ImGui::DragFloat("##v", &number, std::min(0.01f, 0.001f * span), static_cast<float>(low),
                                   static_cast<float>(high), "%.4g", ImGuiSliderFlags_AlwaysClamp);
        if (changed) edit(info.key, fmt::format("{}", number), false);
    }
    if (ImGui::IsItemDeactivatedAfterEdit()) edit(info.key, "", true);
}

void SettingsPanel::showValue(const Row& row, const SettingEdit& edit) {
    const SettingInfo& info = *row.info;
    const std::string& value = row.value;
    if (info.kind == SettingKind::Bool) {
        bool on = value == "true";
        if (ImGui::Checkbox("##v", &on)) edit(info.key, on ? "true" : "false", true);
    } else if (info.kind == SettingKind::Choice) {
        if (ImGui::BeginCombo("##v", value.c_str())) {
            for (const std::string& name : info.choices)
                if (ImGui::Selectable(name.c_str(), name == value)) edit(info.key, name, true);
            ImGui::EndCombo();
        }
    } else if (!info.word.empty()) {
        bool isWord = value == info.word;
        if (ImGui::Checkbox("##word", &isWord)) edit(info.key, isWord ? info.word : "1", true);
        if (ImGui::IsItemHovered())
            ImGui::SetTooltip("%s", info.word == "auto" ? "chosen by the program" : info.word.c_str());
        ImGui::SameLine();
        if (isWord)
            ImGui::TextDisabled("%s", info.word.c_str());
        else {
            ImGui::SetNextItemWidth(-1);
            showNumber(row, edit);
        }
    } else {
        showNumber(row, edit);
    }
}

// In a table name, value, unit, reset beside each other; else the name above the value, the unit in the tool
// tip.
void SettingsPanel::showRow(const Row& row, bool inTable, const SettingEdit& edit) {
    const SettingInfo& info = *row.info;
    ImGui::PushID(info.key.c_str());
    const float em = ImGui::GetFontSize();
    if (inTable) {
        ImGui::TableNextRow();
        ImGui::TableSetColumnIndex(0);
    }
    if (inTable || info.kind == SettingKind::Bool) ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(row.label.c_str());
    if (ImGui::IsItemHovered()) tooltip(info);
    if (inTable)
        ImGui::TableSetColumnIndex(1);
    else if (info.kind == SettingKind::Bool)
        ImGui::SameLine(std::max(ImGui::GetContentRegionAvail().x - 3.2f * em, 1.0f));
    ImGui::SetNextItemWidth(inTable ? -1 : -1.8f * em);
    showValue(row, edit);
    notePlace(info.key);
    if (ImGui::IsItemHovered() && !ImGui::IsItemActive()) tooltip(info);
    if (inTable) {
        ImGui::TableSetColumnIndex(2);
        if (!info.unit.empty()) {
            ImGui::AlignTextToFramePadding();
            ImGui::TextDisabled("%s", info.unit.c_str());
        }
        ImGui::TableSetColumnIndex(3);
    }
    if (row.value != info.defaultValue) {
        if (!inTable) ImGui::SameLine();
        if (ImGui::SmallButton("x")) edit(info.key, info.defaultValue, true);
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("back to %s", info.defaultValue.c_str());
    }
    ImGui::PopID();
}

void SettingsPanel::gather(const Settings& settings) {
    rows_.clear();
    std::vector<const SettingInfo*> left = listedSettings();
    for (const std::string& prefix : prefixes_) {
        const auto ours = std::stable_partition(left.begin(), left.end(), [&](const SettingInfo* info) {
            return info->key.compare(0, prefix.size(), prefix) != 0;
        });
        for (auto at = ours; at != left.end(); ++at)
            if ((*at)->key.find(filter_) != std::string::npos)
                rows_.push_back({*at, labelOf((*at)->key), getSetting(settings, (*at)->key)});
        left.erase(ours, left.end());
    }
}

void SettingsPanel::show(const Settings& settings, std::uint64_t revision,
                         const std::vector<std::string>& prefixes, const std::string& filter,
                         const SettingEdit& edit) {
    if (revision_ != revision || prefixes_ != prefixes || filter_ != filter) {
        revision_ = revision;
        prefixes_ = prefixes;
        filter_ = filter;
        gather(settings);
    }
    const float em = ImGui::GetFontSize();
    if (ImGui::GetContentRegionAvail().x < kTableEm * em) {
        for (const Row& row : rows_) showRow(row, false, edit);
        return;
    }
    if (!ImGui::BeginTable("settings", 4, ImGuiTableFlags_SizingStretchProp)) return;
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch, 0.44f);
    ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 0.56f);
    ImGui::TableSetupColumn("unit", ImGuiTableColumnFlags_WidthFixed, 3.2f * em);
    ImGui::TableSetupColumn("reset", ImGuiTableColumnFlags_WidthFixed, 1.2f * em);
    for (const Row& row : rows_) showRow(row, true, edit);
    ImGui::EndTable();
}

}  // namespace conelight::program
