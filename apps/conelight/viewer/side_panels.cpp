// SPDX-License-Identifier: MIT
#include "viewer/side_panels.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>

#include "viewer/panels.h"
#include "viewer/widget_places.h"

namespace conelight::program {

std::vector<LeftPanel::Stage> LeftPanel::stagesOf(const std::string& mode) {
    return {{"Scene", {}},
            {"Voxels", {"voxels.size", "view.voxel", "voxels."}},
            {"Light", {"light.", "view.light"}},
            {"Gather", {mode + "."}},
            {"Image", {"image.", "view.wireframe"}}};
}

void LeftPanel::show(const Layout& layout) {
    beginPanel("##left", {0, layout.top}, {layout.left, layout.display.y - layout.top});
    const std::vector<Stage> stages = stagesOf(conelight::getSetting(session_.settings(), "mode"));
    showTabs(stages);
    const Stage& stage = stages[stage_];
    ImGui::SetNextItemWidth(-1);
    ImGui::InputTextWithHint("##filter", "filter", &filter_);
    ImGui::BeginChild(stage.name);
    if (stage.prefixes.empty())
        tree_.show(session_, filter_);
    else
        settings_.show(session_.settings(), session_.revisions().settings, stage.prefixes, filter_,
                       [this](const std::string& key, const std::string& value, bool done) {
                           if (!value.empty())
                               console_.attempt([&] { session_.setSetting(key, value, key); });
                           if (done) session_.seal();
                       });
    ImGui::EndChild();
    ImGui::End();
}

// Whole names on as many lines as they take: ImGui's own tabs cut them in narrow windows.
void LeftPanel::showTabs(const std::vector<Stage>& stages) {
    const float room = ImGui::GetContentRegionAvail().x, gap = 0.2f * ImGui::GetFontSize();
    float used = 0;
    for (std::size_t i = 0; i < stages.size(); ++i) {
        const float width =
            ImGui::CalcTextSize(stages[i].name).x + 2 * ImGui::GetStyle().FramePadding.x + gap;
        if (i > 0 && used + width <= room + gap)
            ImGui::SameLine(0, gap);
        else
            used = 0;
        used += width;
        const bool shown = i == stage_;
        ImGui::PushStyleColor(ImGuiCol_Button,
                              ImGui::GetStyleColorVec4(shown ? ImGuiCol_ButtonActive : ImGuiCol_Tab));
        if (ImGui::Button(stages[i].name)) stage_ = i;
        ImGui::PopStyleColor();
        notePlace(std::string("tab:") + stages[i].name);
    }
}

void RightPanel::show(const Layout& layout) {
    beginPanel("##right", {layout.display.x - layout.right, layout.top},
               {layout.right, layout.display.y - layout.top});
    if (ImGui::CollapsingHeader("Selection", ImGuiTreeNodeFlags_DefaultOpen))
        selection_.show(in_.session, [this](const std::string& line) { in_.console.run(line); });
    if (ImGui::CollapsingHeader("Pixel", ImGuiTreeNodeFlags_DefaultOpen)) in_.probe.showPanel();
    if (!in_.session.clips().empty()) {
        if (ImGui::CollapsingHeader("Clips", ImGuiTreeNodeFlags_DefaultOpen)) clipEditor(in_.session);
    }
    const bool camera = ImGui::CollapsingHeader("Camera");
    notePlace("header:Camera");
    if (camera) showCamera();
    if (ImGui::CollapsingHeader("Frame", ImGuiTreeNodeFlags_DefaultOpen)) showFrame();
    ImGui::End();
}

void RightPanel::showCamera() {
    cameraEditor(in_.session);
    pathEditor(
        in_.session, strip_, {in_.film.frames, in_.film.traced.samplesPerPixel},
        [this](const std::string& line) { in_.console.run(line); },
        [this](FilePurpose purpose) { in_.document.ask(purpose); });
}

void RightPanel::showFrame() {
    const float em = ImGui::GetFontSize();
    ImGui::SetNextItemWidth(std::min(8 * em, ImGui::GetContentRegionAvail().x - 5.5f * em));
    ImGui::SliderFloat("resolution", &in_.view.resolutionScale, 0.25f, 1.0f, "%.2f");
    notePlace("resolution");
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("pixels of the picture, as a part of those of the window, along each edge");
    if (const FrameStats* stats = in_.view.slot(false).stats())
        statsPanel(*stats, in_.session.frameTimes(), in_.timings.gui().median());
}

}  // namespace conelight::program
