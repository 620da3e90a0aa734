// SPDX-License-Identifier: MIT
#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtx/euler_angles.hpp>

#include "io/scene_info.h"
#include "session/lens_range.h"
#include "session/light_edit.h"
#include "viewer/panels.h"
#include "viewer/widget_places.h"

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

// Of the widget before: it can be found by `where edit:NAME`, and the end of its drag ends a step of undo.
void seals(Session& session, const char* name) {
    notePlace(std::string("edit:") + name);
    if (ImGui::IsItemDeactivatedAfterEdit()) session.seal();
}

void editInstance(Session& session, std::size_t index) {
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
    changed |= ImGui::Checkbox("visible", &instance.visible);
    ImGui::SameLine();
    changed |= ImGui::Checkbox("voxelized", &instance.voxelized);
    changed |= ImGui::Checkbox("casts shadow", &instance.castsShadow);
    ImGui::SameLine();
    changed |= ImGui::Checkbox("dynamic", &instance.dynamic);
    if (changed) session.setInstances({{index, instance}}, "edit " + instance.name, key);
    if (instance.material < 0) return;
    if (ImGui::Button("edit material"))
        session.select({SelectionKind::Material, static_cast<std::size_t>(instance.material)});
    notePlace("edit:material");
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

void editMaterial(Session& session, std::size_t index) {
    Material m = session.scene().materials[index];
    ImGui::TextUnformatted(m.name.empty() ? fmt::format("material {}", index).c_str() : m.name.c_str());
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
    changed |=
        ImGui::ColorEdit3("emission", &m.emission.x, ImGuiColorEditFlags_Float | ImGuiColorEditFlags_HDR);
    seals(session, "emission");
    changed |= ImGui::Checkbox("double-sided", &m.doubleSided);
    ImGui::SameLine();
    changed |= ImGui::Checkbox("unlit", &m.unlit);
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

// Intensities span decades: colour and strength apart.
bool editIntensity(Session& session, Light& light) {
    bool changed = false;
    float strength = std::max({light.intensity.r, light.intensity.g, light.intensity.b});
    glm::vec3 color = strength > 0 ? light.intensity / strength : glm::vec3(1);
    if (ImGui::ColorEdit3("colour", &color.x, ImGuiColorEditFlags_Float)) {
        light.intensity = color * strength;
        changed = true;
    }
    seals(session, "colour");
    if (ImGui::DragFloat(io::lightUnit(light.type), &strength, 0.01f * std::max(strength, 0.1f), 0.0f, 1e6f,
                         "%.4g")) {
        light.intensity = color * strength;
        changed = true;
    }
    seals(session, "strength");
    return changed;
}

// The cone of a spot, the size of a rectangle.
bool editShape(Session& session, Light& light) {
    bool changed = false;
    if (light.type == LightType::Spot) {
        changed |= ImGui::SliderAngle("inner", &light.innerAngle, 0, 89);
        seals(session, "inner");
        changed |= ImGui::SliderAngle("outer", &light.outerAngle, 1, 90);
        seals(session, "outer");
        light.innerAngle = std::min(light.innerAngle, light.outerAngle - 0.001f);
    }
    if (light.type == LightType::Rect) {
        glm::vec2 size(2 * glm::length(light.halfU), 2 * glm::length(light.halfV));
        if (ImGui::DragFloat2("size (m)", &size.x, 0.01f, 0.001f, 1e4f)) {
            light.halfU = 0.5f * std::max(size.x, 0.001f) * glm::normalize(light.halfU);
            light.halfV = 0.5f * std::max(size.y, 0.001f) * glm::normalize(light.halfV);
            changed = true;
        }
        seals(session, "size");
    }
    return changed;
}

void editLight(Session& session, std::size_t index) {
    std::vector<Light> lights = session.scene().lights;
    Light& light = lights[index];
    const char* kinds[4];
    for (int i = 0; i < 4; ++i) kinds[i] = io::lightTypeName(static_cast<LightType>(i));
    int type = static_cast<int>(light.type);
    bool changed = ImGui::Checkbox("on", &light.enabled);
    ImGui::SameLine();
    changed |= ImGui::Checkbox("casts shadow", &light.castsShadow);
    if (ImGui::Combo("kind", &type, kinds, 4)) {
        light.type = static_cast<LightType>(type);
        aimLight(light, light.direction);
        changed = true;
    }
    notePlace("edit:kind");
    changed |= editIntensity(session, light);
    if (light.type != LightType::Directional)
        changed |= ImGui::DragFloat3("position (m)", &light.position.x, 0.01f);
    seals(session, "light position");
    glm::vec3 direction = light.direction;
    if (light.type != LightType::Point && ImGui::DragFloat3("direction", &direction.x, 0.01f) &&
        glm::length(direction) > 1e-4f) {
        aimLight(light, direction);
        changed = true;
    }
    seals(session, "direction");
    changed |= editShape(session, light);
    const bool deleted = ImGui::Button("delete");
    notePlace("edit:delete");
    if (deleted) {
        lights.erase(lights.begin() + static_cast<std::ptrdiff_t>(index));
        session.select({});
        session.setLights(lights, "delete light");
        return;
    }
    if (changed) session.setLights(lights, "edit light", fmt::format("light {}", index));
}

}  // namespace

void selectionEditor(Session& session) {
    const Selection selection = session.selection();
    const Scene& scene = session.scene();
    ImGui::PushItemWidth(-8.0f * ImGui::GetFontSize());
    if (selection.kind == SelectionKind::Instance && selection.index < scene.instances.size())
        editInstance(session, selection.index);
    else if (selection.kind == SelectionKind::Material && selection.index < scene.materials.size())
        editMaterial(session, selection.index);
    else if (selection.kind == SelectionKind::Light && selection.index < scene.lights.size())
        editLight(session, selection.index);
    else {
        ImGui::PushTextWrapPos(0);
        ImGui::TextDisabled("click an object in the picture or in the list");
        ImGui::PopTextWrapPos();
    }
    ImGui::PopItemWidth();
}

void cameraEditor(Session& session) {
    Camera camera = session.camera();
    ImGui::PushItemWidth(-8.0f * ImGui::GetFontSize());
    bool changed = ImGui::DragFloat3("eye (m)", &camera.eye.x, 0.01f);
    seals(session, "eye");
    changed |= ImGui::DragFloat3("target (m)", &camera.target.x, 0.01f);
    seals(session, "target");
    changed |= ImGui::SliderAngle("field of view", &camera.fovY, 1, 150);
    seals(session, "field of view");
    // Wide lenses, of models of towns, are typed.
    changed |= ImGui::SliderFloat("lens (m)", &camera.lensDiameter, 0, 0.5f, "%.4g", ImGuiSliderFlags_None);
    seals(session, "lens");
    if (camera.lensDiameter > 0) {
        changed |= ImGui::DragFloat("focus (m)", &camera.focusDistance, 0.01f, 0, 1e6f,
                                    camera.focusDistance > 0 ? "%.4g" : "at the target");
        seals(session, "focus");
    }
    camera.lensDiameter = std::clamp(camera.lensDiameter, 0.0f, kWidestLens);
    camera.focusDistance = std::max(camera.focusDistance, 0.0f);
    ImGui::PopItemWidth();
    if (changed && glm::length(camera.target - camera.eye) > 1e-6f)
        session.jumpCamera(camera, "edit camera", "camera");
}

}  // namespace conelight::program
