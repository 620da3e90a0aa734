// SPDX-License-Identifier: MIT
// Panels, and what is written over the picture.
#include <fmt/core.h>
#include <imgui.h>
#include <imgui_internal.h>  // ClosePopupToLevel
#include <imgui_stdlib.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "traced_picture.h"
#include "viewer/imgui_names.h"
#include "viewer/viewer_window.h"
#include "viewer/widget_places.h"

namespace conelight::program {
namespace {

std::vector<Stage> stagesOf(const std::string& mode) {
    return {{"Scene", {}},
            {"Voxels", {"voxels.", "view.voxel"}},
            {"Light", {"light.", "view.light"}},
            {"Gather", {mode + "."}},
            {"Image", {"image.", "view.wireframe"}}};
}

constexpr ImGuiWindowFlags kPanel = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoBringToFrontOnFocus;

// Menus and lists; dialogs answer the key themselves.
void closeMenusOnEscape() {
    if (escapePressed() && ImGui::GetCurrentContext()->OpenPopupStack.Size > 0 &&
        ImGui::GetTopMostPopupModal() == nullptr)
        ImGui::ClosePopupToLevel(0, true);
}

std::string nameOf(const std::string& file) { return std::filesystem::path(file).filename().string(); }

}  // namespace

// How far what runs in the background is, and the end of it, at the bottom of the picture.
void Viewer::jobStrips(const glm::vec2& at, const glm::vec2& size) {
    const float em = ImGui::GetFontSize();
    float y = at.y + size.y - 2.8f * em;
    const auto strip = [&](const char* name, std::string text, double done, double secondsLeft) {
        if (secondsLeft >= 0) text += ", " + timeText(secondsLeft) + " left";
        ImGui::SetNextWindowPos({at.x + 0.5f * em, y});
        ImGui::SetNextWindowSize({std::min(36 * em, size.x - em), 2.3f * em});
        // It does not take the keys from who types: `stop`, for example.
        ImGui::Begin((std::string("##") + name).c_str(), nullptr,
                     ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                         ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing);
        ImGui::ProgressBar(static_cast<float>(done), {-5 * em, 0}, text.c_str());
        ImGui::SameLine();
        const bool stopped = ImGui::Button("stop", {-1, 0});
        notePlace(std::string(name) + ":stop");
        ImGui::End();
        y -= 2.6f * em;
        return stopped;
    };
    if (bake_.busy()) {
        const BakeStatus status = bake_.status();
        if (strip("bake", fmt::format("{}: {:.0f} %", nameOf(bake_.file()), 100 * status.done), status.done,
                  status.secondsLeft))
            bake_.stop();
    }
    // A screenshot of a picture that is finished takes no time.
    PictureJob& job = end_.job;
    if (!job.busy()) return;
    const std::string state = job.bakes()         ? "waits for the bake"
                              : job.frames() == 1 ? "settles"
                                                  : fmt::format("{} of {}", job.done() + 1, job.frames());
    if (strip("record", nameOf(job.file()) + ": " + state, job.part(), job.secondsLeft())) job.stop();
}

Layout Viewer::layout() const {
    const float em = ImGui::GetFontSize() > 0 ? ImGui::GetFontSize() : 14 * gui_.scale();
    Layout layout;
    layout.display = window_.size();
    layout.top = em + 2 * ImGui::GetStyle().FramePadding.y;
    const float side = showSide_ ? std::min(sideEm_ * em, 0.3f * layout.display.x) : 0;
    layout.left = layout.right = side;
    layout.bottom = showConsole_ ? std::min(consoleEm_ * em, 0.4f * layout.display.y) : 0;
    return layout;
}

void Viewer::gui(const Layout& layout) {
    beginPlaces();
    placesRecorded_ = std::exchange(placesAsked_, false);
    closeMenusOnEscape();
    keys();
    menuBar();
    if (showSide_) {
        leftPanel(layout);
        rightPanel(layout);
    }
    if (showConsole_) bottomPanel(layout);
    picture(layout.pictureAt(), layout.pictureSize());
    jobStrips(layout.pictureAt(), layout.pictureSize());
    if (const std::optional<FileChoice> choice = fileDialog_.show()) takeFile(*choice);
    unsavedQuestion();
    resizePanels(layout);
}

// Borders between panels and picture are dragged.
void Viewer::resizePanels(const Layout& layout) {
    const float em = ImGui::GetFontSize();
    const auto border = [&](const char* name, const ImVec2& at, const ImVec2& size, ImGuiMouseCursor cursor) {
        ImGui::SetNextWindowPos(at);
        ImGui::SetNextWindowSize(size);
        ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
        ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
        ImGui::Begin(name, nullptr,
                     ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                         ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBackground);
        ImGui::InvisibleButton("border", size);
        if (ImGui::IsItemHovered() || ImGui::IsItemActive()) ImGui::SetMouseCursor(cursor);
        const bool dragged = ImGui::IsItemActive();
        notePlace(std::string("border:") + (name + 2));
        ImGui::End();
        ImGui::PopStyleVar(2);
        return dragged;
    };
    const float thick = 0.3f * em, height = layout.display.y - layout.top;
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    if (showSide_) {
        if (border("##left border", {layout.left - thick, layout.top}, {thick, height},
                   ImGuiMouseCursor_ResizeEW))
            sideEm_ = std::clamp(mouse.x / em, 10.0f, 60.0f);
        if (border("##right border", {layout.display.x - layout.right, layout.top}, {thick, height},
                   ImGuiMouseCursor_ResizeEW))
            sideEm_ = std::clamp((layout.display.x - mouse.x) / em, 10.0f, 60.0f);
    }
    if (showConsole_ && border("##console border", {layout.left, layout.display.y - layout.bottom},
                               {layout.pictureSize().x, thick}, ImGuiMouseCursor_ResizeNS))
        consoleEm_ = std::clamp((layout.display.y - mouse.y) / em, 4.0f, 60.0f);
}

void Viewer::picture(const glm::vec2& at, const glm::vec2& size) {
    ImGui::SetNextWindowPos({at.x, at.y});
    ImGui::SetNextWindowSize({size.x, size.y});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::Begin("##picture", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    ImGui::PopStyleVar();
    clicked_ = view_.show(session_, at, size, static_cast<float>(ImGui::GetTime() - lastFrame_));
    drawInspection(session_, picker_, inspection_, at, size);
    overlayText(at, size);
    ImGui::End();
}

// Mode names over the picture's halves, what the reference is at, and why there may be nothing to see.
void Viewer::overlayText(const glm::vec2& at, const glm::vec2& size) {
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float em = ImGui::GetFontSize();
    const auto label = [&](const std::string& text, float x, float y, bool fromRight) {
        const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
        const ImVec2 low{fromRight ? x - extent.x - em : x, y};
        list->AddRectFilled(low, {low.x + extent.x + em, low.y + 1.5f * em}, IM_COL32(20, 20, 20, 170), 4);
        list->AddText({low.x + 0.5f * em, low.y + 0.25f * em}, IM_COL32(230, 230, 230, 255), text.c_str());
    };
    label(view_.slot(false).label(), at.x + 0.5f * em, at.y + 0.5f * em, false);
    if (view_.split.on)
        label(view_.slot(true).label() + (view_.split.errors ? ": error of the left" : ""),
              at.x + size.x - 0.5f * em, at.y + 0.5f * em, true);
    if (!hint_) return;
    const float wrap = std::min(30 * em, size.x - 4 * em);
    const ImVec2 extent = ImGui::CalcTextSize(hint_->c_str(), nullptr, false, wrap);
    const ImVec2 low{at.x + 0.5f * (size.x - extent.x) - em, at.y + 0.5f * (size.y - extent.y) - em};
    list->AddRectFilled(low, {low.x + extent.x + 2 * em, low.y + extent.y + 2 * em},
                        IM_COL32(28, 28, 28, 235), 6);
    list->AddText(ImGui::GetFont(), em, {low.x + em, low.y + em}, IM_COL32(235, 220, 180, 255),
                  hint_->c_str(), nullptr, wrap);
}

void Viewer::leftPanel(const Layout& layout) {
    ImGui::SetNextWindowPos({0, layout.top});
    ImGui::SetNextWindowSize({layout.left, layout.display.y - layout.top});
    ImGui::Begin("##left", nullptr, kPanel);
    const std::vector<Stage> stages = stagesOf(conelight::getSetting(session_.settings(), "mode"));
    stageTabs(stages);
    const Stage& stage = stages[stage_];
    ImGui::SetNextItemWidth(-1);
    ImGui::InputTextWithHint("##filter", "filter", &filter_);
    ImGui::BeginChild(stage.name);
    if (stage.prefixes.empty())
        sceneTree(session_, filter_, [this](const std::string& line) { runLine(line); });
    else
        settingsPanel_.show(session_.settings(), session_.revisions().settings, stage.prefixes, filter_,
                            [this](const std::string& key, const std::string& value, bool done) {
                                if (!value.empty()) attempt([&] { session_.setSetting(key, value, key); });
                                if (done) session_.seal();
                            });
    ImGui::EndChild();
    ImGui::End();
}

// Whole names on as many lines as they take: ImGui's own tabs cut them in narrow windows.
void Viewer::stageTabs(const std::vector<Stage>& stages) {
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

void Viewer::rightPanel(const Layout& layout) {
    ImGui::SetNextWindowPos({layout.display.x - layout.right, layout.top});
    ImGui::SetNextWindowSize({layout.right, layout.display.y - layout.top});
    ImGui::Begin("##right", nullptr, kPanel);
    if (ImGui::CollapsingHeader("Selection", ImGuiTreeNodeFlags_DefaultOpen)) selectionEditor(session_);
    if (ImGui::CollapsingHeader("Pixel", ImGuiTreeNodeFlags_DefaultOpen))
        inspectorPanel(session_, inspection_);
    const bool camera = ImGui::CollapsingHeader("Camera");
    notePlace("header:Camera");
    if (camera) {
        cameraEditor(session_);
        pathEditor(
            session_, {filmFrames_, end_.traced.samplesPerPixel},
            [this](const std::string& line) { runLine(line); },
            [this](FilePurpose purpose) { fileDialog_.open(purpose, session_.path()); });
    }
    if (ImGui::CollapsingHeader("Frame", ImGuiTreeNodeFlags_DefaultOpen)) {
        const float em = ImGui::GetFontSize();
        ImGui::SetNextItemWidth(std::min(8 * em, ImGui::GetContentRegionAvail().x - 5.5f * em));
        ImGui::SliderFloat("resolution", &view_.resolutionScale, 0.25f, 1.0f, "%.2f");
        notePlace("resolution");
        if (ImGui::IsItemHovered())
            ImGui::SetTooltip("pixels of the picture, as a part of those of the window, along each edge");
        if (const FrameStats* stats = view_.slot(false).stats())
            statsPanel(*stats, session_.frameTimes(), median(guiTimes_));
    }
    ImGui::End();
}

void Viewer::bottomPanel(const Layout& layout) {
    ImGui::SetNextWindowPos({layout.left, layout.display.y - layout.bottom});
    ImGui::SetNextWindowSize({layout.pictureSize().x, layout.bottom});
    ImGui::Begin("##bottom", nullptr, kPanel);
    console_.show();
    ImGui::End();
}

}  // namespace conelight::program
