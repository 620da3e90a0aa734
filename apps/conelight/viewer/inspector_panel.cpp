// SPDX-License-Identifier: MIT
#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "viewer/panels.h"

namespace conelight::program {
namespace {

std::string text(const glm::vec3& v) { return fmt::format("{:.4g}  {:.4g}  {:.4g}", v.x, v.y, v.z); }

void row(const char* name, const std::string& value) {
    ImGui::TableNextRow();
    ImGui::TableSetColumnIndex(0);
    ImGui::TextDisabled("%s", name);
    ImGui::TableSetColumnIndex(1);
    ImGui::TextUnformatted(value.c_str());
}

}  // namespace

void inspectorPanel(const Session& session, const std::optional<Inspection>& inspection) {
    if (!inspection) {
        ImGui::TextDisabled("click a pixel");
        return;
    }
    if (!ImGui::BeginTable("inspector", 2, ImGuiTableFlags_SizingFixedFit)) return;
    row("pixel", fmt::format("{}, {}", inspection->pixel.x, inspection->pixel.y));
    row("radiance", text(glm::vec3(inspection->radiance)) + "  W/(sr m2)");
    if (inspection->hit) {
        const Pick& hit = *inspection->hit;
        row("object", hit.object);
        const bool named = hit.material >= 0;
        row("material",
            named ? session.scene().materials[static_cast<std::size_t>(hit.material)].name : "(none)");
        row("position", text(hit.position) + "  m");
        row("normal", text(hit.normal));
        row("shading normal", text(hit.shadingNormal));
        row("distance", fmt::format("{:.4g}  m", hit.distance));
        row("triangle", fmt::format("{}", hit.triangle));
    } else {
        row("hit", "nothing: the sky");
    }
    ImGui::EndTable();
}

std::optional<std::string> whyBlack(const Session& session, const Image& picture) {
    float brightest = 0;
    float covered = 0;
    for (const glm::vec4& pixel : picture.pixels) {
        const float value = std::max({pixel.x, pixel.y, pixel.z});
        if (std::isfinite(value)) brightest = std::max(brightest, value);
        covered += pixel.w;
    }
    const float shown = brightest * std::exp2(session.settings().image.exposure);
    // 8 bits round what is below 1/3000 (sRGB's first step) to black.
    if (picture.pixels.empty() || shown > 1.0f / 3000) return std::nullopt;

    const Scene& scene = session.scene();
    if (scene.instances.empty()) return "The scene is empty: open a file, or drop one here.";
    if (session.showsNothing()) return "Objects and voxels are both switched off (console: objs).";
    if (covered == 0) {
        const Aabb bounds = scene.bounds();
        const glm::vec3 away = session.camera().eye - bounds.center();
        return glm::length(away) > 0.5f * glm::length(bounds.extent())
                   ? "The camera looks past the scene: press F to see all of it."
                   : "The camera sees no surface: it looks out of the scene, or at backs of single-sided "
                     "surfaces. Press F to see all of it.";
    }
    bool lit = scene.sky != glm::vec3(0);
    for (const Light& light : scene.lights) lit = lit || (light.enabled && light.intensity != glm::vec3(0));
    for (const Material& material : scene.materials)
        lit = lit || material.emission != glm::vec3(0) || material.unlit;
    if (!lit) return "There is no light: add one (panel Scene), or give the scene a sky.";
    if (brightest > 0)
        return fmt::format("The picture is there but dark: raise the exposure by {:.0f} stops (panel Image).",
                           std::ceil(std::log2(0.5f / shown)));
    return "No light reaches what the camera sees: it may be inside a wall or a closed object, or all light "
           "is "
           "indirect and `bounces` is 0. Press F to see the whole scene.";
}

}  // namespace conelight::program
