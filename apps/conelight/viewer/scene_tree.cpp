// SPDX-License-Identifier: MIT
#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>

#include "io/scene_info.h"
#include "viewer/panels.h"
#include "viewer/widget_places.h"

namespace conelight::program {
namespace {

std::string nameOr(const std::string& name, const char* kind, std::size_t index) {
    return name.empty() ? fmt::format("{} {}", kind, index) : name;
}

// A line of a list: shown when it matches the filter, selects what it names.
void entry(Session& session, const std::string& label, const std::string& filter, const Selection& what) {
    if (label.find(filter) == std::string::npos) return;
    ImGui::PushID(static_cast<int>(what.index));
    if (ImGui::Selectable(label.c_str(), session.selection() == what)) session.select(what);
    notePlace("entry:" + label);
    ImGui::PopID();
}

bool heading(const char* name, std::size_t count) {
    return ImGui::CollapsingHeader(fmt::format("{} ({})###{}", name, count, name).c_str(),
                                   count <= 32 ? ImGuiTreeNodeFlags_DefaultOpen : 0);
}

void objects(Session& session, const std::string& filter) {
    const std::vector<Instance>& instances = session.scene().instances;
    if (!heading("Objects", instances.size())) return;
    // Long lists draw only the lines that are seen.
    std::vector<std::size_t> shown;
    for (std::size_t i = 0; i < instances.size(); ++i)
        if (nameOr(instances[i].name, "object", i).find(filter) != std::string::npos) shown.push_back(i);
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(shown.size()));
    while (clipper.Step())
        for (int line = clipper.DisplayStart; line < clipper.DisplayEnd; ++line) {
            const std::size_t i = shown[static_cast<std::size_t>(line)];
            ImGui::PushID(static_cast<int>(i));
            bool visible = instances[i].visible;
            const bool switched = ImGui::Checkbox("##visible", &visible);
            notePlace("visible:" + nameOr(instances[i].name, "object", i));
            if (switched) {
                Instance changed = instances[i];
                changed.visible = visible;
                session.setInstances({{i, changed}},
                                     visible ? "show " + changed.name : "hide " + changed.name);
            }
            ImGui::SameLine();
            const Selection what{SelectionKind::Instance, i};
            if (ImGui::Selectable(nameOr(instances[i].name, "object", i).c_str(),
                                  session.selection() == what))
                session.select(what);
            notePlace("object:" + nameOr(instances[i].name, "object", i));
            ImGui::PopID();
        }
}

// Lamps that are no lights of the scene but surfaces: their materials.
void glowing(Session& session, const std::string& filter) {
    const std::vector<Material>& materials = session.scene().materials;
    for (std::size_t i = 0; i < materials.size(); ++i)
        if (materials[i].emission != glm::vec3(0))
            entry(session, nameOr(materials[i].name, "material", i) + " (glows)", filter,
                  {SelectionKind::Material, i});
}

// One where the eye is.
void addLight(const RunLine& run) {
    ImGui::SetNextItemWidth(-1);
    if (ImGui::BeginCombo("##add light", "add a light at the eye", ImGuiComboFlags_NoArrowButton)) {
        for (int i = 0; i < 4; ++i) {
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

void sceneTree(Session& session, const std::string& filter, const RunLine& run) {
    const Scene& scene = session.scene();
    objects(session, filter);
    if (heading("Lights", scene.lights.size())) {
        for (std::size_t i = 0; i < scene.lights.size(); ++i)
            entry(session,
                  fmt::format("{}  ({})", nameOr(scene.lights[i].name, "light", i),
                              io::lightTypeName(scene.lights[i].type)),
                  filter, {SelectionKind::Light, i});
        glowing(session, filter);
        addLight(run);
    }
    if (heading("Materials", scene.materials.size()))
        for (std::size_t i = 0; i < scene.materials.size(); ++i)
            entry(session, nameOr(scene.materials[i].name, "material", i), filter,
                  {SelectionKind::Material, i});
    if (heading("Cameras", scene.cameras.size()))
        for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
            const std::string name = nameOr(scene.cameras[i].name, "camera", i);
            ImGui::PushID(static_cast<int>(i));
            if (ImGui::Selectable(name.c_str())) session.jumpCamera(scene.cameras[i], "camera " + name);
            notePlace("camera:" + name);
            ImGui::PopID();
        }
    glm::vec3 sky = scene.sky;
    if (ImGui::ColorEdit3("sky", &sky.x, ImGuiColorEditFlags_Float | ImGuiColorEditFlags_HDR))
        session.setSky(glm::max(sky, glm::vec3(0)), "sky", "sky");
    notePlace("edit:sky");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("radiance of the surroundings, W/(sr m^2)");
    if (ImGui::IsItemDeactivatedAfterEdit()) session.seal();
    if (scene.environment.image != nullptr) drawEnvironment(session);
}

}  // namespace conelight::program
