// SPDX-License-Identifier: MIT
#include "viewer/scene_tree.h"

#include <fmt/core.h>
#include <imgui.h>
#include <imgui_internal.h>  // PushItemFlag

#include <algorithm>
#include <utility>

#include "io/scene_info.h"
#include "viewer/widget_places.h"

namespace conelight::program {
namespace {

std::string nameOr(const std::string& name, const char* kind, std::size_t index) {
    return name.empty() ? fmt::format("{} {}", kind, index) : name;
}

// Indices of what has a name with `filter` in it.
template <class T>
std::vector<std::size_t> matching(const std::vector<T>& things, const char* kind, const std::string& filter) {
    std::vector<std::size_t> shown;
    for (std::size_t i = 0; i < things.size(); ++i)
        if (filter.empty() || nameOr(things[i].name, kind, i).find(filter) != std::string::npos)
            shown.push_back(i);
    return shown;
}

// Draws the lines of a list that are seen.
template <class Line>
void clipped(std::size_t count, float rowHeight, const Line& line) {
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(count), rowHeight);
    while (clipper.Step())
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) line(static_cast<std::size_t>(i));
}

// One where the eye is.
void addLight(const RunLine& run) {
    ImGui::SetNextItemWidth(-1);
    if (ImGui::BeginCombo("##add light", "add a light at the eye", ImGuiComboFlags_NoArrowButton)) {
        for (int i = 0; i < kLightTypes; ++i) {
            const char* kind = io::lightTypeName(static_cast<LightType>(i));
            if (ImGui::Selectable(kind)) run(std::string("light add ") + kind);
            notePlace(std::string("add light:") + kind);
        }
        ImGui::EndCombo();
    }
    notePlace("add light");
}

// Turn and strength of the surroundings; dragged values are one step.
void drawEnvironment(Session& session) {
    Environment environment = session.scene().environment;
    float degrees = glm::degrees(environment.rotation);
    bool changed = ImGui::SliderFloat("environment turn", &degrees, -180, 180, "%.0f deg");
    notePlace("edit:environment turn");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", environment.file.c_str());
    bool ended = ImGui::IsItemDeactivatedAfterEdit();
    changed |= ImGui::DragFloat("environment strength", &environment.strength, 0.02f, 0, 1e6f, "%.2f");
    notePlace("edit:environment strength");
    ended |= ImGui::IsItemDeactivatedAfterEdit();
    if (changed) {
        environment.rotation = glm::radians(degrees);
        environment.strength = std::max(environment.strength, 0.0f);
        session.setEnvironment(environment, session.scene().lights, "environment", "environment");
    }
    if (ended) session.seal();
}

}  // namespace

// A click in the list is seen where it is.
void SceneTree::followSelection(const Session& session) {
    if (session.selection() == seen_) return;
    seen_ = session.selection();
    reveal_.reset();
    if (seen_.kind != SelectionKind::None) reveal_ = seen_;
}

bool SceneTree::heading(const char* name, std::size_t count, SelectionKind kind) {
    if (reveal_ && reveal_->kind == kind) ImGui::SetNextItemOpen(true);
    return ImGui::CollapsingHeader(fmt::format("{} ({})###{}", name, count, name).c_str(),
                                   count <= 32 ? ImGuiTreeNodeFlags_DefaultOpen : 0);
}

// Before the rows are drawn: to the middle, unless the row is seen already.
void SceneTree::scrollTo(const std::vector<std::size_t>& shown, SelectionKind kind, float rowHeight) {
    if (!reveal_ || reveal_->kind != kind) return;
    const auto found = std::find(shown.begin(), shown.end(), reveal_->index);
    scrollTo(static_cast<std::size_t>(found - shown.begin()), shown.size(), rowHeight);
}

// Line `number` of `count`; a higher one is not among them.
void SceneTree::scrollTo(std::size_t number, std::size_t count, float rowHeight) {
    reveal_.reset();
    if (number >= count) return;
    const float top = ImGui::GetCursorPosY() + static_cast<float>(number) * rowHeight;
    const float height = ImGui::GetWindowHeight(), from = ImGui::GetScrollY();
    if (top >= from && top + rowHeight <= from + height) return;
    ImGui::SetScrollY(std::max(top - 0.5f * (height - rowHeight), 0.0f));
}

void SceneTree::click(Session& session, const Selection& what, const std::vector<std::size_t>& shown) {
    const ImGuiIO& io = ImGui::GetIO();
    const bool several = what.kind != SelectionKind::Material;
    const auto from = std::find(shown.begin(), shown.end(), anchor_.index);
    const auto to = std::find(shown.begin(), shown.end(), what.index);
    const bool hasAnchor = anchor_.kind == what.kind && from != shown.end() && to != shown.end();
    if (several && io.KeyShift && hasAnchor) {
        std::vector<Selection> all = io.KeyCtrl ? session.selected() : std::vector<Selection>{};
        for (auto i = std::min(from, to); i <= std::max(from, to); ++i) all.push_back({what.kind, *i});
        all.push_back(what);
        session.selectAll(all);
    } else {
        several && (io.KeyCtrl || io.KeyShift) ? session.toggleSelected(what) : session.select(what);
        anchor_ = what;
    }
    seen_ = session.selection();
}

void SceneTree::row(Session& session, const std::string& label, const Selection& what,
                    const std::vector<std::size_t>& shown) {
    // Headings have the colour of rows, too.
    ImGui::PushStyleColor(ImGuiCol_Header, ImGui::GetStyleColorVec4(ImGuiCol_HeaderActive));
    const bool clicked = ImGui::Selectable(label.c_str(), session.isSelected(what));
    ImGui::PopStyleColor();
    if (clicked) click(session, what, shown);
    if (!ImGui::IsItemHovered() || !ImGui::IsMouseReleased(ImGuiMouseButton_Right)) return;
    if (!session.isSelected(what)) click(session, what, shown);
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    actions_.openMenu({mouse.x, mouse.y});
}

void SceneTree::visibleBox(Session& session, std::size_t index, const std::string& name) {
    bool visible = session.scene().instances[index].visible;
    const bool switched = ImGui::Checkbox("##visible", &visible);
    notePlace("visible:" + name);
    if (!switched) return;
    Instance changed = session.scene().instances[index];
    changed.visible = visible;
    session.setInstances({{index, changed}}, visible ? "show " + changed.name : "hide " + changed.name);
}

// All of a group's objects at once.
void SceneTree::visibleBoxOfGroup(Session& session, std::size_t group, const std::string& name) {
    const ObjectTree::Count& count = tree_.countOf(group);
    bool visible = count.visible > 0;
    ImGui::PushItemFlag(ImGuiItemFlags_MixedValue, visible && count.visible < count.objects);
    const bool switched = ImGui::Checkbox("##visible", &visible);
    ImGui::PopItemFlag();
    notePlace("visible:" + name + "/");
    if (!switched) return;
    // What is hidden in part is shown.
    visible = count.visible < count.objects;
    std::vector<std::pair<std::size_t, Instance>> changed;
    for (const Selection& part : tree_.partsOf(session.scene(), group)) {
        if (part.kind != SelectionKind::Instance) continue;
        Instance instance = session.scene().instances[part.index];
        if (std::exchange(instance.visible, visible) != visible) changed.emplace_back(part.index, instance);
    }
    session.setInstances(changed, (visible ? "show " : "hide ") + name);
}

void SceneTree::clickGroup(Session& session, std::size_t group) {
    std::vector<Selection> parts = tree_.partsOf(session.scene(), group);
    const ImGuiIO& io = ImGui::GetIO();
    if (io.KeyCtrl || io.KeyShift) {
        const bool leaves = tree_.countOf(group).selected == tree_.countOf(group).all;
        std::vector<Selection> others = session.selected();
        std::erase_if(others, [&](const Selection& one) {
            return std::find(parts.begin(), parts.end(), one) != parts.end();
        });
        if (leaves) parts.clear();
        parts.insert(parts.begin(), others.begin(), others.end());
    }
    session.selectAll(parts);
    anchor_ = {};
    seen_ = session.selection();
}

// Its arrow folds it, its name selects all that is in it. Returns whether the arrow was clicked.
bool SceneTree::groupRow(Session& session, std::size_t group) {
    const Group& shown = session.scene().groups[group];
    const std::string name = shown.name.empty() ? fmt::format("group {}", group) : shown.name;
    const ObjectTree::Count& count = tree_.countOf(group);
    ImGui::PushID("group");
    ImGui::PushID(static_cast<int>(group));
    visibleBoxOfGroup(session, group, name);
    ImGui::SameLine(0, foldWidth_ + ImGui::GetStyle().ItemSpacing.x);
    const bool selected = count.selected == count.all;
    ImGui::SetNextItemOpen(tree_.isOpen(group));
    ImGui::PushStyleColor(ImGuiCol_Header, ImGui::GetStyleColorVec4(ImGuiCol_HeaderActive));
    ImGui::TreeNodeEx("##node",
                      ImGuiTreeNodeFlags_OpenOnArrow | ImGuiTreeNodeFlags_NoTreePushOnOpen |
                          ImGuiTreeNodeFlags_SpanAvailWidth |
                          (selected ? ImGuiTreeNodeFlags_Selected : ImGuiTreeNodeFlags_None),
                      "%s  (%zu)", name.c_str(), count.objects);
    ImGui::PopStyleColor();
    const bool folds = ImGui::IsItemToggledOpen();
    notePlace("group:" + name);
    const ImVec2 low = ImGui::GetItemRectMin();
    notePlace("fold:" + name, {low.x, low.y},
              {low.x + ImGui::GetTreeNodeToLabelSpacing(), ImGui::GetItemRectMax().y});
    if (ImGui::IsItemClicked() && !folds) clickGroup(session, group);
    if (ImGui::IsItemHovered() && ImGui::IsMouseReleased(ImGuiMouseButton_Right)) {
        if (!selected) clickGroup(session, group);
        const ImVec2 mouse = ImGui::GetIO().MousePos;
        actions_.openMenu({mouse.x, mouse.y});
    }
    ImGui::PopID();
    ImGui::PopID();
    return folds;
}

void SceneTree::objects(Session& session, const std::string& filter) {
    const Scene& scene = session.scene();
    if (!heading("Objects", scene.instances.size(), SelectionKind::Instance)) return;
    const Revisions& now = session.revisions();
    tree_.update(scene, 1 + now.scene + now.instances + now.lights, filter);
    if (tree_.hasGroups()) tree_.countSelected(scene, session.selected());
    if (reveal_ && reveal_->kind == SelectionKind::Instance) tree_.reveal(scene, reveal_->index);
    const float height = ImGui::GetFrameHeightWithSpacing(), step = ImGui::GetTreeNodeToLabelSpacing();
    if (reveal_ && reveal_->kind == SelectionKind::Instance)
        scrollTo(tree_.lineOf(reveal_->index), tree_.lines().size(), height);
    std::optional<std::size_t> folded;
    clipped(tree_.lines().size(), height, [&](std::size_t number) {
        const ObjectTree::Line line = tree_.lines()[number];
        foldWidth_ = 0.6f * step * static_cast<float>(line.depth);
        if (line.isGroup) {
            if (groupRow(session, line.index)) folded = line.index;
            return;
        }
        const std::string name = objectLabel(scene, line.index);
        ImGui::PushID(static_cast<int>(line.index));
        visibleBox(session, line.index, name);
        ImGui::SameLine(0, ImGui::GetStyle().ItemSpacing.x + foldWidth_ + (tree_.hasGroups() ? step : 0));
        row(session, name, {SelectionKind::Instance, line.index}, tree_.shownInstances());
        notePlace("object:" + name);
        ImGui::PopID();
    });
    if (folded) tree_.fold(*folded, !tree_.isOpen(*folded));
}

void SceneTree::lights(Session& session, const std::string& filter) {
    const std::vector<Light>& all = session.scene().lights;
    if (!heading("Lights", all.size(), SelectionKind::Light)) return;
    const std::vector<std::size_t> shown = matching(all, "light", filter);
    const float height = ImGui::GetTextLineHeightWithSpacing();
    scrollTo(shown, SelectionKind::Light, height);
    clipped(shown.size(), height, [&](std::size_t line) {
        const std::size_t i = shown[line];
        const std::string name = nameOr(all[i].name, "light", i);
        ImGui::PushID(static_cast<int>(i));
        row(session, fmt::format("{}  ({})", name, io::lightTypeName(all[i].type)), {SelectionKind::Light, i},
            shown);
        notePlace("entry:" + name);
        ImGui::PopID();
    });
    // Lamps that are no lights of the scene but surfaces: their materials.
    const std::vector<Material>& materials = session.scene().materials;
    for (std::size_t i = 0; i < materials.size(); ++i) {
        if (materials[i].emission == glm::vec3(0)) continue;
        const std::string label = nameOr(materials[i].name, "material", i) + " (glows)";
        if (label.find(filter) == std::string::npos) continue;
        ImGui::PushID(static_cast<int>(i));
        row(session, label, {SelectionKind::Material, i}, {});
        notePlace("entry:" + label);
        ImGui::PopID();
    }
    addLight(actions_.run);
}

void SceneTree::materials(Session& session, const std::string& filter) {
    const std::vector<Material>& all = session.scene().materials;
    if (!heading("Materials", all.size(), SelectionKind::Material)) return;
    const std::uint64_t revision = 1 + session.revisions().scene + session.revisions().materials;
    if (materials_.revision != revision || materials_.filter != filter)
        materials_ = {filter, revision, matching(all, "material", filter)};
    const float height = ImGui::GetTextLineHeightWithSpacing();
    scrollTo(materials_.shown, SelectionKind::Material, height);
    clipped(materials_.shown.size(), height, [&](std::size_t line) {
        const std::size_t i = materials_.shown[line];
        const std::string name = nameOr(all[i].name, "material", i);
        ImGui::PushID(static_cast<int>(i));
        row(session, name, {SelectionKind::Material, i}, materials_.shown);
        notePlace("entry:" + name);
        ImGui::PopID();
    });
}

void SceneTree::cameras(Session& session) {
    const Scene& scene = session.scene();
    if (!heading("Cameras", scene.cameras.size(), SelectionKind::None)) return;
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
        const std::string name = nameOr(scene.cameras[i].name, "camera", i);
        ImGui::PushID(static_cast<int>(i));
        if (ImGui::Selectable(name.c_str())) session.jumpCamera(scene.cameras[i], "camera " + name);
        notePlace("camera:" + name);
        ImGui::PopID();
    }
}

void SceneTree::show(Session& session, const std::string& filter) {
    followSelection(session);
    // Things of several kinds may have one name and number.
    const auto list = [](const char* id, const auto& draw) {
        ImGui::PushID(id);
        draw();
        ImGui::PopID();
    };
    list("objects", [&] { objects(session, filter); });
    list("lights", [&] { lights(session, filter); });
    list("materials", [&] { materials(session, filter); });
    list("cameras", [&] { cameras(session); });
    const Scene& scene = session.scene();
    glm::vec3 sky = scene.sky;
    if (ImGui::ColorEdit3("sky", &sky.x, ImGuiColorEditFlags_Float | ImGuiColorEditFlags_HDR))
        session.setSky(glm::max(sky, glm::vec3(0)), "sky", "sky");
    notePlace("edit:sky");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("radiance of the surroundings, W/(sr m^2)");
    if (ImGui::IsItemDeactivatedAfterEdit()) session.seal();
    if (scene.environment.image != nullptr) drawEnvironment(session);
}

}  // namespace conelight::program
