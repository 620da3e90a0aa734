// SPDX-License-Identifier: MIT
#include "viewer/selection_editor.h"

#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtx/euler_angles.hpp>

#include "session/lens_range.h"
#include "session/material_edit.h"
#include "session/projection.h"
#include "viewer/edit_steps.h"

namespace conelight::program {
namespace {

constexpr float kRadPerDeg = 0.01745329252f;

// A matrix as translation, Euler angles (YXZ, degrees) and scale; shear is lost, which is why only the parts
// that the user changes are applied, as a factor on the matrix.
struct Placement {
    glm::vec3 position, scale;
};
Placement placementOf(const glm::mat4& m) {
    return {glm::vec3(m[3]),
            {glm::length(glm::vec3(m[0])), glm::length(glm::vec3(m[1])), glm::length(glm::vec3(m[2]))}};
}

// Of all objects that are selected.
void editFlags(Session& session, const Instance& shown) {
    const auto flag = [&](const char* name, bool Instance::*member) {
        bool on = shown.*member;
        const bool switched = ImGui::Checkbox(name, &on);
        notePlace(std::string("edit:") + name);
        if (!switched) return;
        std::vector<std::pair<std::size_t, Instance>> changed;
        for (const std::size_t i : session.selectedOf(SelectionKind::Instance)) {
            changed.emplace_back(i, session.scene().instances[i]);
            changed.back().second.*member = on;
        }
        session.setInstances(changed, std::string(name) + (on ? " on" : " off"));
    };
    flag("visible", &Instance::visible);
    ImGui::SameLine();
    flag("voxelized", &Instance::voxelized);
    flag("casts shadow", &Instance::castsShadow);
    ImGui::SameLine();
    flag("dynamic", &Instance::dynamic);
}

bool editGlass(Session& session, Material& m) {
    bool changed = ImGui::SliderFloat("transmission", &m.transmission, 0, 1);
    seals(session, "transmission");
    if (!(m.transmission > 0)) return changed;
    bool solid = m.thickness > 0;
    if (ImGui::Checkbox("solid", &solid)) {
        m.thickness = solid ? 1.0f : 0.0f;
        changed = true;
    }
    if (!solid) return changed;
    changed |= ImGui::ColorEdit3("attenuation", &m.attenuationColor.x, ImGuiColorEditFlags_Float);
    seals(session, "attenuation");
    changed |=
        ImGui::DragFloat("attenuation distance", &m.attenuationDistance, 0.01f, 0.0f, 1000.0f, "%.3f m");
    seals(session, "attenuation distance");
    m.attenuationColor = glm::clamp(m.attenuationColor, kLeastAttenuationColor, 1.0f);
    return changed;
}

bool editLayers(Session& session, Material& m) {
    bool changed = ImGui::SliderFloat("coat", &m.coat, 0, 1);
    seals(session, "coat");
    if (m.coat > 0) {
        changed |= ImGui::SliderFloat("coat roughness", &m.coatRoughness, 0, 1);
        seals(session, "coat roughness");
    }
    changed |= ImGui::ColorEdit3("sheen", &m.sheenColor.x, ImGuiColorEditFlags_Float);
    seals(session, "sheen");
    if (m.sheenColor != glm::vec3(0)) {
        changed |= ImGui::SliderFloat("sheen roughness", &m.sheenRoughness, 0, 1);
        seals(session, "sheen roughness");
    }
    m.sheenColor = glm::clamp(m.sheenColor, 0.0f, 1.0f);
    return changed;
}

}  // namespace

void SelectionEditor::editInstance(Session& session, std::size_t index, const RunLine& run) {
    Instance instance = session.scene().instances[index];
    const std::string key = fmt::format("instance {}", index);
    ImGui::TextUnformatted(instance.name.empty() ? key.c_str() : instance.name.c_str());
    const Mesh& mesh = session.scene().meshes[static_cast<std::size_t>(instance.mesh)];
    ImGui::TextDisabled("%zu triangles", mesh.triangleCount());
    bool changed = false;
    Placement p = placementOf(instance.worldFromObject);
    if (ImGui::DragFloat3("position (m)", &p.position.x, 0.01f)) {
        instance.worldFromObject[3] = glm::vec4(p.position, 1);
        changed = true;
    }
    notePlace("edit:position");
    seals(session, "position");
    glm::vec3 turn(0);
    if (ImGui::DragFloat3("turn (deg)", &turn.x, 0.5f)) {
        const glm::mat4 rotation =
            glm::eulerAngleYXZ(turn.y * kRadPerDeg, turn.x * kRadPerDeg, turn.z * kRadPerDeg);
        glm::mat4 m = instance.worldFromObject;
        m[3] = {0, 0, 0, 1};
        m = rotation * m;
        m[3] = instance.worldFromObject[3];
        instance.worldFromObject = m;
        changed = true;
    }
    seals(session, "turn");
    const glm::vec3 before = p.scale;
    if (ImGui::DragFloat3("scale", &p.scale.x, 0.01f, 0.001f, 1000.0f)) {
        for (int i = 0; i < 3; ++i)
            if (before[i] > 0) instance.worldFromObject[i] *= std::max(p.scale[i], 0.001f) / before[i];
        changed = true;
    }
    seals(session, "scale");
    if (changed) session.setInstances({{index, instance}}, "edit " + instance.name, key);
    editFlags(session, instance);
    showMaterialOf(session, instance, run);
}

// The material's name, who else has it, a copy for this one.
void SelectionEditor::showMaterialOf(Session& session, const Instance& instance, const RunLine& run) {
    if (instance.material < 0) return;
    const auto material = static_cast<std::size_t>(instance.material);
    const std::size_t uses = usesOf(session, material);
    const std::string& name = session.scene().materials[material].name;
    ImGui::Text("%s", name.empty() ? fmt::format("material {}", material).c_str() : name.c_str());
    if (uses > 1) {
        ImGui::SameLine();
        ImGui::TextDisabled("shared by %zu objects", uses);
        notePlace("shared");
    }
    if (ImGui::Button("edit material")) session.select({SelectionKind::Material, material});
    notePlace("edit:material");
    if (uses < 2) return;
    ImGui::SameLine();
    if (ImGui::Button("make single")) run("single_material");
    notePlace("edit:make single");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("a copy of the material for what is selected alone");
}

std::size_t SelectionEditor::usesOf(const Session& session, std::size_t material) {
    const Revisions& now = session.revisions();
    const std::uint64_t revision = 1 + now.scene + now.instances + now.materials;
    if (revision != usesRevision_) uses_ = usesOfMaterials(session.scene());
    usesRevision_ = revision;
    return uses_[material];
}

void SelectionEditor::editMaterial(Session& session, std::size_t index) {
    Material m = session.scene().materials[index];
    ImGui::TextUnformatted(m.name.empty() ? fmt::format("material {}", index).c_str() : m.name.c_str());
    if (const std::size_t uses = usesOf(session, index); uses != 1) {
        ImGui::TextDisabled(uses == 0 ? "no object has it" : "shared by %zu objects", uses);
        notePlace("shared");
    }
    bool changed = ImGui::ColorEdit4("base colour", &m.baseColor.x, ImGuiColorEditFlags_Float);
    seals(session, "base colour");
    changed |= ImGui::SliderFloat("metallic", &m.metallic, 0, 1);
    seals(session, "metallic");
    changed |= ImGui::SliderFloat("roughness", &m.roughness, 0, 1);
    seals(session, "roughness");
    changed |= ImGui::DragFloat("ior", &m.ior, 0.01f, 1.0f, 4.0f);
    seals(session, "ior");
    changed |= ImGui::SliderFloat("specular", &m.specular, 0, 1);
    seals(session, "specular");
    changed |= editGlass(session, m);
    changed |= editLayers(session, m);
    changed |=
        ImGui::ColorEdit3("emission", &m.emission.x, ImGuiColorEditFlags_Float | ImGuiColorEditFlags_HDR);
    seals(session, "emission");
    changed |= ImGui::Checkbox("double-sided", &m.doubleSided);
    ImGui::SameLine();
    changed |= ImGui::Checkbox("unlit", &m.unlit);
    textures_.showThumbnails(session, m);
    if (ImGui::TreeNode("Phong (modes thesis, phong)")) {
        bool own = m.phong.has_value();
        if (ImGui::Checkbox("own values", &own)) {
            changed = true;
            m.phong = own ? std::optional(phongFromPbr(m)) : std::nullopt;
        }
        if (m.phong) {
            const auto value = [&](bool edited, const char* name) {
                seals(session, name);
                changed |= edited;
            };
            value(ImGui::ColorEdit3("colour", &m.phong->color.x, ImGuiColorEditFlags_Float), "phong colour");
            value(ImGui::DragFloat("shininess", &m.phong->shininess, 0.5f, 0.0f, 1000.0f), "shininess");
            value(ImGui::SliderFloat("ambient", &m.phong->ambientStrength, 0, 1), "ambient");
            value(ImGui::SliderFloat("diffuse", &m.phong->diffuseStrength, 0, 1), "diffuse");
            value(ImGui::SliderFloat("gloss", &m.phong->specularStrength, 0, 1), "gloss");
        }
        ImGui::TreePop();
    }
    m.emission = glm::max(m.emission, glm::vec3(0));
    if (changed) session.setMaterials({{index, m}}, "edit " + m.name, fmt::format("material {}", index));
}

void SelectionEditor::show(Session& session, const RunLine& run) {
    const Selection selection = session.selection();
    ImGui::PushItemWidth(-8.0f * ImGui::GetFontSize());
    if (session.selected().size() > 1) {
        ImGui::TextDisabled("%zu selected; of these the last:", session.selected().size());
        notePlace("several");
    }
    if (selection.kind == SelectionKind::Instance)
        editInstance(session, selection.index, run);
    else if (selection.kind == SelectionKind::Material)
        editMaterial(session, selection.index);
    else if (selection.kind == SelectionKind::Light)
        editLight(session, selection.index, lights_);
    else {
        ImGui::PushTextWrapPos(0);
        ImGui::TextDisabled("click an object in the picture or in the list");
        ImGui::PopTextWrapPos();
    }
    ImGui::PopItemWidth();
    textures_.showOpen(session);
}

namespace {

// Returns whether something was changed.
bool lensEditor(Session& session, Camera& camera) {
    // Wide lenses, of models of towns, are typed.
    bool changed =
        ImGui::SliderFloat("lens (m)", &camera.lensDiameter, 0, 0.5f, "%.4g", ImGuiSliderFlags_None);
    seals(session, "lens");
    if (camera.lensDiameter > 0) {
        changed |= ImGui::DragFloat("focus (m)", &camera.focusDistance, 0.01f, 0, 1e6f,
                                    camera.focusDistance > 0 ? "%.4g" : "at the target");
        seals(session, "focus");
    }
    camera.lensDiameter = std::clamp(camera.lensDiameter, 0.0f, kWidestLens);
    camera.focusDistance = std::max(camera.focusDistance, 0.0f);
    return changed;
}

}  // namespace

void cameraEditor(Session& session) {
    Camera camera = session.camera();
    ImGui::PushItemWidth(-8.0f * ImGui::GetFontSize());
    bool changed = ImGui::DragFloat3("eye (m)", &camera.eye.x, 0.01f);
    seals(session, "eye");
    changed |= ImGui::DragFloat3("target (m)", &camera.target.x, 0.01f);
    seals(session, "target");
    bool parallel = camera.isOrthographic();
    if (ImGui::Checkbox("orthographic", &parallel)) {
        switchProjection(camera);
        session.jumpCamera(camera, parallel ? "orthographic" : "perspective");
    }
    notePlace("edit:orthographic");
    if (camera.isOrthographic()) {
        changed |= ImGui::DragFloat("height (m)", &camera.orthographicHeight,
                                    0.01f * camera.orthographicHeight, kLeastView, kTallestView, "%.4g");
        camera.orthographicHeight = std::clamp(camera.orthographicHeight, kLeastView, kTallestView);
        seals(session, "height");
    } else {
        changed |= ImGui::SliderAngle("field of view", &camera.fovY, 1, 150);
        seals(session, "field of view");
    }
    if (!camera.isOrthographic()) changed |= lensEditor(session, camera);
    ImGui::PopItemWidth();
    if (changed && glm::length(camera.target - camera.eye) > 1e-6f)
        session.jumpCamera(camera, "edit camera", "camera");
}

}  // namespace conelight::program
