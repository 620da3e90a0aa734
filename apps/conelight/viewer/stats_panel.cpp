// SPDX-License-Identifier: MIT
#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>

#include "viewer/panels.h"

namespace conelight::program {
namespace {

void passTable(const FrameStats& stats) {
    if (!ImGui::BeginTable("passes", 3, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp)) return;
    ImGui::TableSetupColumn("pass", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("ms", ImGuiTableColumnFlags_WidthFixed, 4 * ImGui::GetFontSize());
    ImGui::TableSetupColumn("share", ImGuiTableColumnFlags_WidthFixed, 5 * ImGui::GetFontSize());
    ImGui::TableHeadersRow();
    double longest = 1e-3;
    for (const PassStats& pass : stats.passes)
        longest = std::max(longest, pass.gpuMs >= 0 ? pass.gpuMs : pass.cpuMs);
    for (const PassStats& pass : stats.passes) {
        const double ms = pass.gpuMs >= 0 ? pass.gpuMs : pass.cpuMs;
        ImGui::TableNextRow();
        ImGui::TableSetColumnIndex(0);
        ImGui::TextUnformatted(pass.name.c_str());
        ImGui::TableSetColumnIndex(1);
        ImGui::TextUnformatted(fmt::format("{:.2f}", ms).c_str());
        ImGui::TableSetColumnIndex(2);
        ImGui::ProgressBar(static_cast<float>(ms / longest), {-1, 0.7f * ImGui::GetFontSize()}, "");
    }
    ImGui::EndTable();
}

void memoryTable(const FrameStats& stats) {
    std::size_t total = 0;
    for (const MemoryStats& object : stats.memory) total += object.bytes;
    if (!ImGui::TreeNode(
            fmt::format("Memory: {:.1f} MB###memory", static_cast<double>(total) * 1e-6).c_str()))
        return;
    if (ImGui::BeginTable("memory", 2, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp)) {
        for (const MemoryStats& object : stats.memory) {
            ImGui::TableNextRow();
            ImGui::TableSetColumnIndex(0);
            ImGui::TextUnformatted(object.label.c_str());
            ImGui::TableSetColumnIndex(1);
            ImGui::TextUnformatted(
                fmt::format("{:.2f} MB", static_cast<double>(object.bytes) * 1e-6).c_str());
        }
        ImGui::EndTable();
    }
    ImGui::TreePop();
}

}  // namespace

void statsPanel(const FrameStats& stats, const FrameTimes& times) {
    std::vector<float> ms(times.all().begin(), times.all().end());
    if (!ms.empty()) {
        const float longest = *std::max_element(ms.begin(), ms.end());
        ImGui::PlotLines("##frames", ms.data(), static_cast<int>(ms.size()), 0,
                         fmt::format("{:.1f} ms", ms.back()).c_str(), 0, 1.1f * longest,
                         {-1, 3.5f * ImGui::GetFontSize()});
    }
    ImGui::TextDisabled("%s", stats.device.c_str());
    passTable(stats);
    memoryTable(stats);
}

}  // namespace conelight::program
