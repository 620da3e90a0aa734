// SPDX-License-Identifier: MIT
// The editor of a light: kind, colour by channels or by temperature, strength in a unit that is chosen, place, shape.
#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "conelight/error.h"
#include "io/light_profile_file.h"
#include "io/scene_info.h"
#include "session/light_edit.h"
#include "viewer/edit_steps.h"
#include "viewer/selection_editor.h"

namespace conelight::program {
namespace {

LightUnit shownUnit(const Light& light, const LightView& view) {
    const std::vector<LightUnit> units = unitsOf(light);
    return std::find(units.begin(), units.end(), view.unit) != units.end() ? view.unit : LightUnit::Radiant;
}

// By channels, or as that of a black body. The strength in the unit that is shown stays.
bool editColor(Session& session, Light& light, LightView& view) {
    const float strength = strengthIn(light, LightUnit::Radiant);
    glm::vec3 color = strength > 0 ? light.intensity / strength : glm::vec3(1);
    bool changed = false;
    if (!view.byTemperature) {
        if (ImGui::ColorEdit3("colour", &color.x, ImGuiColorEditFlags_Float)) {
            light.intensity = color * strength;
            changed = true;
        }
        seals(session, "colour");
    } else {
        const std::optional<float> now = kelvinOf(color);
        float kelvin = now.value_or(6504);
        const char* format = now ? "%.0f K" : "no black body's";
        if (ImGui::SliderFloat("temperature", &kelvin, kLeastKelvin, 15000, format,
                               ImGuiSliderFlags_Logarithmic)) {
            setKelvin(light, kelvin, shownUnit(light, view));
            changed = true;
        }
        seals(session, "temperature");
    }
    ImGui::Checkbox("by temperature", &view.byTemperature);
    notePlace("edit:by temperature");
    if (view.byTemperature) {
        ImGui::SameLine();
        ImGui::ColorButton("##colour", {color.r, color.g, color.b, 1}, ImGuiColorEditFlags_Float);
    }
    return changed;
}

// Intensities span decades: a drag goes on in parts of what there is.
bool editStrength(Session& session, Light& light, LightView& view) {
    const LightUnit unit = shownUnit(light, view);
    float strength = strengthIn(light, unit);
    bool changed = false;
    ImGui::SetNextItemWidth(-8.0f * ImGui::GetFontSize());
    if (ImGui::DragFloat("##strength", &strength, 0.01f * std::max(strength, 0.1f), 0.0f, 1e9f, "%.4g")) {
        setStrength(light, unit, strength);
        changed = true;
    }
    seals(session, "strength");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1);
    if (ImGui::BeginCombo("##unit", unitName(light.type, unit))) {
        for (const LightUnit one : unitsOf(light)) {
            if (ImGui::Selectable(unitName(light.type, one), one == unit)) view.unit = one;
            notePlace(std::string("unit:") + unitName(light.type, one));
        }
        ImGui::EndCombo();
    }
    notePlace("edit:unit");
    // The same in the other units.
    std::string same;
    for (const LightUnit one : unitsOf(light))
        if (one != unit)
            same += fmt::format("{}{:.4g} {}", same.empty() ? "= " : " = ", strengthIn(light, one),
                                unitName(light.type, one));
    ImGui::TextDisabled("%s", same.c_str());
    notePlace("units");
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("683 lm/W times the luminance of linear Rec.709; watts of the strongest channel");
    return changed;
}

// The cone of a spot, the size of an area light.
bool editShape(Session& session, Light& light) {
    bool changed = false;
    if (light.type == LightType::Spot) {
        changed |= ImGui::SliderAngle("inner", &light.innerAngle, 0, 89);
        seals(session, "inner");
        changed |= ImGui::SliderAngle("outer", &light.outerAngle, 1, 90);
        seals(session, "outer");
        light.innerAngle = std::min(light.innerAngle, light.outerAngle - 0.001f);
    }
    if (light.type == LightType::Sphere) {
        float radius = glm::length(light.halfU);
        if (ImGui::DragFloat("radius (m)", &radius, 0.01f, 0.001f, 1e4f)) {
            light.halfU = std::max(radius, 0.001f) * glm::normalize(light.halfU);
            changed = true;
        }
        seals(session, "radius");
    } else if (hasArea(light.type)) {
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

// The profile of a lamp: its file, read once the field is left.
bool editProfile(Session& session, Light& light, LightView& view) {
    if (light.type != LightType::Point && light.type != LightType::Spot) return false;
    const std::string now = light.profile == nullptr ? "" : light.profile->file;
    if (view.profileOf != now || view.light != session.selection().index) view.profile = view.profileOf = now;
    view.light = session.selection().index;
    char text[1024];
    const std::size_t length = std::min(view.profile.size(), sizeof text - 1);
    view.profile.copy(text, length);
    text[length] = 0;
    if (ImGui::InputTextWithHint("profile", "IES file", text, sizeof text)) view.profile = text;
    notePlace("edit:profile");
    bool changed = false;
    if (ImGui::IsItemDeactivatedAfterEdit() && view.profile != now) {
        view.problem.clear();
        try {
            if (view.profile.empty())
                light.profile = nullptr;
            else
                io::setLightProfile(light, io::readLightProfile(view.profile));
            changed = true;
        } catch (const Error& error) {
            view.problem = error.what();
        }
    }
    if (!view.problem.empty()) {
        ImGui::TextWrapped("%s", view.problem.c_str());
        notePlace("profile problem");
    }
    return changed;
}

}  // namespace

void editLight(Session& session, std::size_t index, LightView& view) {
    std::vector<Light> lights = session.scene().lights;
    Light& light = lights[index];
    ImGui::TextUnformatted(light.name.empty() ? fmt::format("light {}", index).c_str() : light.name.c_str());
    const char* kinds[kLightTypes];
    for (int i = 0; i < kLightTypes; ++i) kinds[i] = io::lightTypeName(static_cast<LightType>(i));
    int type = static_cast<int>(light.type);
    bool changed = ImGui::Checkbox("on", &light.enabled);
    ImGui::SameLine();
    changed |= ImGui::Checkbox("casts shadow", &light.castsShadow);
    if (ImGui::Combo("kind", &type, kinds, kLightTypes)) {
        light.type = static_cast<LightType>(type);
        aimLight(light, light.direction);
        changed = true;
    }
    notePlace("edit:kind");
    changed |= editColor(session, light, view);
    changed |= editStrength(session, light, view);
    if (light.type != LightType::Directional)
        changed |= ImGui::DragFloat3("position (m)", &light.position.x, 0.01f);
    seals(session, "light position");
    glm::vec3 direction = light.direction;
    if ((hasDirection(light.type) || light.profile != nullptr) &&
        ImGui::DragFloat3("direction", &direction.x, 0.01f) && glm::length(direction) > 1e-4f) {
        aimLight(light, direction);
        changed = true;
    }
    seals(session, "direction");
    changed |= editShape(session, light);
    changed |= editProfile(session, light, view);
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

}  // namespace conelight::program
