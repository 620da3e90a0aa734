// SPDX-License-Identifier: MIT
#include "viewer/selection_menu.h"

#include <fmt/core.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>

#include "session/material_edit.h"
#include "session/rename.h"
#include "viewer/focus.h"
#include "viewer/widget_places.h"

namespace conelight::program {

void SelectionMenu::show() {
    constexpr const char* kPopup = "##selection menu";
    if (asked_) {
        ImGui::OpenPopup(kPopup);
        ImGui::SetNextWindowPos({asked_->x, asked_->y});
        name_ = nameOf(in_.session, in_.session.selection());
        asked_.reset();
    }
    if (!ImGui::BeginPopup(kPopup)) return;
    items();
    ImGui::EndPopup();
}

void SelectionMenu::item(const char* text, const char* keys, const std::string& line, bool enabled) {
    if (ImGui::MenuItem(text, keys, false, enabled)) in_.console.run(line);
    notePlace(std::string("item:") + text);
}

void SelectionMenu::items() {
    const Session& session = in_.session;
    const std::size_t count = session.selected().size();
    if (count == 1)
        nameField();
    else if (count > 1)
        ImGui::TextDisabled("%zu selected", count);
    else
        ImGui::TextDisabled("nothing is selected");
    ImGui::Separator();
    if (ImGui::MenuItem(count == 0 ? "See all" : "See all of it", "F"))
        focusOnSelection(in_.session, in_.view.pictureSize());
    notePlace("item:See");
    const SelectionKind kind = session.selection().kind;
    if (kind == SelectionKind::Instance || kind == SelectionKind::Light) objectItems();
    if (kind == SelectionKind::Material) materialItems();
    ImGui::Separator();
    item("Show all", "Ctrl+H", "show");
    item("Select all", "Ctrl+A", "select all");
    item("Invert selection", "Ctrl+I", "select invert");
    if (count > 0) item("Select none", "Escape", "select none");
}

void SelectionMenu::nameField() {
    ImGui::SetNextItemWidth(12 * ImGui::GetFontSize());
    const bool entered = ImGui::InputText("name", &name_, ImGuiInputTextFlags_EnterReturnsTrue);
    notePlace("item:name");
    if (!entered) return;
    if (!name_.empty()) renameAll(in_.session, in_.session.selected(), name_);
    ImGui::CloseCurrentPopup();
}

void SelectionMenu::objectItems() {
    const Scene& scene = in_.session.scene();
    const std::vector<std::size_t> objects = in_.session.selectedOf(SelectionKind::Instance);
    item("Hide", "H", "hide");
    item("Hide all others", "Shift+H", "isolate", !objects.empty());
    item("Duplicate", "Ctrl+D", "duplicate");
    item("Delete", "Del", "delete");
    if (objects.empty()) return;
    ImGui::Separator();
    const int material = scene.instances[objects.front()].material;
    if (ImGui::MenuItem("Edit material", nullptr, false, material >= 0))
        in_.session.select({SelectionKind::Material, static_cast<std::size_t>(material)});
    notePlace("item:Edit material");
    const std::vector<std::size_t> uses = usesOfMaterials(scene);
    const bool shared = material >= 0 && uses[static_cast<std::size_t>(material)] > 1;
    item("Make material single", nullptr, "single_material", shared);
    if (ImGui::MenuItem("Select all of this material", nullptr, false, shared)) {
        std::vector<Selection> users;
        for (std::size_t i = 0; i < scene.instances.size(); ++i)
            if (scene.instances[i].material == material) users.push_back({SelectionKind::Instance, i});
        in_.session.selectAll(users);
    }
    notePlace("item:Select all of this material");
}

void SelectionMenu::materialItems() {
    const Scene& scene = in_.session.scene();
    const auto material = static_cast<int>(in_.session.selection().index);
    std::vector<Selection> users;
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
        if (scene.instances[i].material == material) users.push_back({SelectionKind::Instance, i});
    const std::string text = fmt::format("Select its objects ({})", users.size());
    if (ImGui::MenuItem(text.c_str(), nullptr, false, !users.empty())) in_.session.selectAll(users);
    notePlace("item:Select its objects");
}

}  // namespace conelight::program
