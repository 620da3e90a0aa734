// SPDX-License-Identifier: MIT
#include "viewer/key_list.h"

#include <imgui.h>

#include <utility>

#include "viewer/widget_places.h"

namespace conelight::program {
namespace {

constexpr std::pair<const char*, const char*> kKeys[] = {
    {"left drag", "round the target"},
    {"right drag", "look; with W A S D Q E fly"},
    {"middle drag, wheel", "pan, nearer or farther"},
    {"left click", "select, and show what lit the pixel"},
    {"Ctrl or Shift+click", "select beside the others"},
    {"right click", "a menu of what is there"},
    {"Escape", "close; rays away; select nothing"},
    {"1 2 3", "handles: move, turn, scale"},
    {"F", "see all of the selection"},
    {"N R T", "view from front, right, top"},
    {"Shift+N R T", "view from back, left, bottom"},
    {"keypad 1 3 7", "the same, with Ctrl the other side"},
    {"V, keypad 5", "parallel rays, or perspective"},
    {"G, L, O", "grid and axes, headlight, turntable"},
    {"B", "keep the view as a camera"},
    {"PageUp, PageDown", "the scene's cameras in turn"},
    {"H, Shift+H, Ctrl+H", "hide; hide all others; show all"},
    {"Delete, Ctrl+D", "delete, duplicate what is selected"},
    {"Ctrl+A, Ctrl+I", "select all; invert the selection"},
    {"Shift+L", "lights in the picture, or not"},
    {"X", "split the picture"},
    {"I", "histogram and waveform"},
    {"Z", "marks clipping, false colours, neither"},
    {"K, C", "keep the picture as A; A or the live one"},
    {"P", "screenshot"},
    {"Ctrl+P, Ctrl+Shift+P", "picture, film: size, kind, alpha"},
    {"Tab, F11", "panels away, full screen"},
    {"Ctrl+O, Ctrl+S", "open, save"},
    {"Ctrl+Z, Ctrl+Y", "undo, redo"},
    {"Ctrl + -", "larger, smaller text"},
    {"F5", "read the scene again"},
    {"F10, Alt+F E A V P H", "menus; arrows and Return in them"},
    {"F6", "next panel; arrows, Space in it"},
    {"Ctrl+J, Ctrl+L", "console, light theme"},
    {"Ctrl+Shift+S O R", "settings: save, load, the scene's own"},
    {"Ctrl+Q", "quit"},
    {"Shift+F1", "the guide"},
    {"F1, ?", "this list"}};

}  // namespace

void KeyList::show(const glm::vec2& at, const glm::vec2& size) {
    if (!open) return;
    const float em = ImGui::GetFontSize();
    ImGui::SetNextWindowPos(
        {at.x + 0.5f * size.x, 0.5f * (ImGui::GetIO().DisplaySize.y + ImGui::GetFrameHeight())},
        ImGuiCond_Always, {0.5f, 0.5f});
    // What does not fit is scrolled to.
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float most = display.y - 2 * ImGui::GetFrameHeight();
    ImGui::SetNextWindowSizeConstraints({0, 0}, {display.x, most});
    ImGui::Begin("Mouse and keys", &open,
                 ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing);
    if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
        ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed, 11 * em);
        ImGui::TableSetupColumn("does", ImGuiTableColumnFlags_WidthFixed, 17 * em);
        for (const auto& [keys, does] : kKeys) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(keys);
            if (keys == kKeys[0].first) notePlace("keys");
            ImGui::TableNextColumn();
            ImGui::TextDisabled("%s", does);
        }
        ImGui::EndTable();
    }
    ImGui::End();
}

}  // namespace conelight::program
