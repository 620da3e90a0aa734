// SPDX-License-Identifier: MIT
#include "viewer/panel_layout.h"

#include <imgui.h>

#include <algorithm>
#include <string>

#include "viewer/widget_places.h"

namespace conelight::program {
namespace {

// What appears while a dialog is open must not ask for the focus: Dear ImGui 1.86 ends the program.
constexpr ImGuiWindowFlags kKeepsFocus = ImGuiWindowFlags_NoFocusOnAppearing;

// A stripe that can be dragged. Returns whether it is.
bool border(const char* name, const ImVec2& at, const ImVec2& size, ImGuiMouseCursor cursor) {
    ImGui::SetNextWindowPos(at);
    ImGui::SetNextWindowSize(size);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
    ImGui::Begin((std::string("##") + name).c_str(), nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBackground | kKeepsFocus);
    ImGui::InvisibleButton("border", size);
    if (ImGui::IsItemHovered() || ImGui::IsItemActive()) ImGui::SetMouseCursor(cursor);
    const bool dragged = ImGui::IsItemActive();
    notePlace(std::string("border:") + name);
    ImGui::End();
    ImGui::PopStyleVar(2);
    return dragged;
}

}  // namespace

Layout PanelLayout::layout() const {
    const float em = ImGui::GetFontSize() > 0 ? ImGui::GetFontSize() : 14 * gui_.scale();
    Layout layout;
    layout.display = window_.size();
    layout.top = em + 2 * ImGui::GetStyle().FramePadding.y;
    const float side = showSide ? std::min(sizes_.side * em, 0.3f * layout.display.x) : 0;
    layout.left = layout.right = side;
    layout.bottom = showConsole ? std::min(sizes_.console * em, 0.4f * layout.display.y) : 0;
    return layout;
}

void PanelLayout::dragBorders(const Layout& layout) {
    const float em = ImGui::GetFontSize();
    const float thick = 0.3f * em, height = layout.display.y - layout.top;
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    if (showSide) {
        if (border("left border", {layout.left - thick, layout.top}, {thick, height},
                   ImGuiMouseCursor_ResizeEW))
            sizes_.side = std::clamp(mouse.x / em, 10.0f, 60.0f);
        if (border("right border", {layout.display.x - layout.right, layout.top}, {thick, height},
                   ImGuiMouseCursor_ResizeEW))
            sizes_.side = std::clamp((layout.display.x - mouse.x) / em, 10.0f, 60.0f);
    }
    if (showConsole && border("console border", {layout.left, layout.display.y - layout.bottom},
                              {layout.pictureSize().x, thick}, ImGuiMouseCursor_ResizeNS))
        sizes_.console = std::clamp((layout.display.y - mouse.y) / em, 4.0f, 60.0f);
}

void beginPanel(const char* name, const glm::vec2& at, const glm::vec2& size) {
    ImGui::SetNextWindowPos({at.x, at.y});
    ImGui::SetNextWindowSize({size.x, size.y});
    ImGui::Begin(name, nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus | kKeepsFocus);
}

}  // namespace conelight::program
