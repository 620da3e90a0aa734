// SPDX-License-Identifier: MIT
#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>

#include "viewer/panels.h"
#include "viewer/widget_places.h"

namespace conelight::program {
namespace {

void passTable(const FrameStats& stats) {
    const bool bars = ImGui::GetContentRegionAvail().x > 17 * ImGui::GetFontSize();  // there is room for them
    if (!ImGui::BeginTable("passes", bars ? 3 : 2, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp))
        return;
    ImGui::TableSetupColumn("pass", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("ms", ImGuiTableColumnFlags_WidthFixed, 4 * ImGui::GetFontSize());
    if (bars) ImGui::TableSetupColumn("share", ImGuiTableColumnFlags_WidthFixed, 5 * ImGui::GetFontSize());
    ImGui::TableHeadersRow();
    double longest = 1e-3;
    for (const PassStats& pass : stats.passes)
        longest = std::max(longest, pass.gpuMs >= 0 ? pass.gpuMs : pass.cpuMs);
    for (const PassStats& pass : stats.passes) {
        const double ms = pass.gpuMs >= 0 ? pass.gpuMs : pass.cpuMs;
        ImGui::TableNextRow();
        ImGui::TableSetColumnIndex(0);
        ImGui::TextUnformatted(pass.name.c_str());
        notePlace("pass:" + pass.name);
        ImGui::TableSetColumnIndex(1);
        ImGui::TextUnformatted(fmt::format("{:.2f}", ms).c_str());
        if (!bars) continue;
        ImGui::TableSetColumnIndex(2);
        ImGui::ProgressBar(static_cast<float>(ms / longest), {-1, 0.7f * ImGui::GetFontSize()}, "");
    }
    ImGui::EndTable();
}

void memoryTable(const FrameStats& stats) {
    std::size_t total = 0;
    for (const MemoryStats& object : stats.memory) total += object.bytes;
    const bool open =
        ImGui::TreeNode(fmt::format("Memory: {:.1f} MB###memory", static_cast<double>(total) * 1e-6).c_str());
    notePlace("memory");
    if (!open) return;
    if (ImGui::BeginTable("memory", 2, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp)) {
        for (const MemoryStats& object : stats.memory) {
            ImGui::TableNextRow();
            ImGui::TableSetColumnIndex(0);
            ImGui::TextUnformatted(object.label.c_str());
            notePlace("memory:" + object.label);
            ImGui::TableSetColumnIndex(1);
            ImGui::TextUnformatted(
                fmt::format("{:.2f} MB", static_cast<double>(object.bytes) * 1e-6).c_str());
        }
        ImGui::EndTable();
    }
    ImGui::TreePop();
}

// Bars from zero, one a frame, newest on the right: one frame is seen too.
void frameGraph(const FrameTimes& times) {
    const std::deque<double>& all = times.all();
    std::vector<float> ms(all.size());
    std::transform(all.begin(), all.end(), ms.begin(), [](double one) { return static_cast<float>(one); });
    const float longest = *std::max_element(ms.begin(), ms.end());
    ImGui::PlotHistogram("##frames", ms.data(), static_cast<int>(ms.size()), 0, nullptr, 0, 1.1f * longest,
                         {ImGui::GetContentRegionAvail().x, 3.5f * ImGui::GetFontSize()});
    notePlace("frame graph");
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("times of the last %zu frames, 0 to %.0f ms", all.size(),
                          static_cast<double>(1.1f * longest));
}

}  // namespace

void statsPanel(const FrameStats& stats, const FrameTimes& times, double guiMs) {
    if (!times.all().empty()) {
        const double last = times.all().back();
        ImGui::TextUnformatted(
            fmt::format("{:.1f} ms, {:.1f} frames/s", last, 1e3 / std::max(last, 1e-3)).c_str());
        frameGraph(times);
    }
    ImGui::PushTextWrapPos(0);
    ImGui::TextDisabled("%s", stats.device.c_str());
    ImGui::PopTextWrapPos();
    passTable(stats);
    ImGui::TextDisabled("GUI %.2f ms", guiMs);
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("CPU time of this thread for the panels of a frame, median");
    memoryTable(stats);
}

}  // namespace conelight::program
