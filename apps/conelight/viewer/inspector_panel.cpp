// SPDX-License-Identifier: MIT
#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "conelight/error.h"
#include "viewer/panels.h"
#include "viewer/widget_places.h"

namespace conelight::program {
namespace {

// Tables of many numbers are wider than the panel.
constexpr ImGuiTableFlags kScrolled = ImGuiTableFlags_ScrollX | ImGuiTableFlags_ScrollY |
                                      ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit;

std::string text(const glm::vec3& v) { return fmt::format("{:.4g}  {:.4g}  {:.4g}", v.x, v.y, v.z); }

// In tables: a grey as one number.
std::string shortText(const glm::vec3& v) {
    return v.x == v.y && v.y == v.z ? fmt::format("{:.4g}", v.x) : text(v);
}

// `text` with line feeds at spaces, so that lines are as wide as there is room. ImGui's own wrapping also
// breaks behind the point of a number.
std::string wrappedAtSpaces(const std::string& text) {
    const float room = ImGui::GetContentRegionAvail().x;
    std::string out;
    float width = 0;
    for (std::size_t from = 0; from < text.size();) {
        const std::size_t to = std::min(text.find(' ', from + 1), text.size());
        const std::string word = text.substr(from, to - from);
        const float wide = ImGui::CalcTextSize(word.c_str()).x;
        const bool breaks = width > 0 && width + wide > room;
        out += breaks ? "\n" + word.substr(word.front() == ' ' ? 1 : 0) : word;
        width = breaks ? wide : width + wide;
        from = to;
    }
    return out;
}

void row(const char* name, const std::string& value) {
    ImGui::TableNextRow();
    ImGui::TableSetColumnIndex(0);
    ImGui::TextDisabled("%s", name);
    ImGui::TableSetColumnIndex(1);
    ImGui::TextUnformatted(wrappedAtSpaces(value).c_str());
}

// Of rows: names and, in what is left of the panel, values, which wrap.
bool beginRows(const char* id) {
    if (!ImGui::BeginTable(id, 2, ImGuiTableFlags_SizingFixedFit)) return false;
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthFixed);
    ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
    return true;
}

void partRow(const char* name, const InspectedPart& part) {
    if (part.used) row(name, text(part.value) + "  x  " + text(part.scale));
}

// Long tables make only the lines that are seen.
template <class Line>
void forLinesSeen(std::size_t count, const Line& line) {
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(count));
    while (clipper.Step())
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) line(static_cast<std::size_t>(i));
}

// A path that was not followed has no end.
std::string metres(const InspectedPath& path) {
    return path.end == PathEnd::Unused ? "-" : fmt::format("{:.3g}", path.distance);
}

void cells(const std::vector<std::string>& texts) {
    for (const std::string& one : texts) {
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(one.c_str());
    }
}

// Every path in a line.
void pathTable(Inspection& inspection) {
    if (!ImGui::BeginTable("paths", 5, kScrolled, {0, 12 * ImGui::GetFontSize()})) return;
    ImGui::TableSetupScrollFreeze(0, 1);
    for (const char* head : {"cone or ray", "end", "m", "weight", "radiance"}) ImGui::TableSetupColumn(head);
    ImGui::TableHeadersRow();
    forLinesSeen(inspection.gathered->paths.size(), [&](std::size_t i) {
        const InspectedPath& path = inspection.gathered->paths[i];
        const int number = static_cast<int>(i);
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        const bool chosen = inspection.chosen == number;
        if (ImGui::Selectable(fmt::format("{} {}##path", number, nameOf(path.kind)).c_str(), chosen,
                              ImGuiSelectableFlags_SpanAllColumns))
            inspection.chosen = chosen ? -1 : number;
        notePlace(fmt::format("path:{}", number));
        cells({nameOf(path.end), metres(path), shortText(path.weight), shortText(path.radiance)});
    });
    ImGui::EndTable();
}

// Face and steps of one.
void chosenPath(const InspectedPath& path) {
    if (path.face && beginRows("face")) {
        const InspectedFace& face = *path.face;
        row("voxel", fmt::format("{} {} {}", face.voxel.x, face.voxel.y, face.voxel.z));
        row("normal", text(face.normal));
        row("plane", fmt::format("{:+.3f} voxels, coverage {:.3g}", face.plane, face.coverage));
        row("albedo", text(face.albedo));
        row("radiance", text(face.radiance) + "  W/(sr m2)");
        row("irradiance / pi", text(face.irradiance));
        row("cache age", face.updates < 0 ? std::string("inside a closed object")
                                          : fmt::format("{} updates", face.updates));
        ImGui::EndTable();
    }
    if (!ImGui::BeginTable("steps", 6, kScrolled, {0, 12 * ImGui::GetFontSize()})) return;
    ImGui::TableSetupScrollFreeze(0, 1);
    for (const char* head : {"step", "m", "size m", "level", "opacity", "radiance"})
        ImGui::TableSetupColumn(head);
    ImGui::TableHeadersRow();
    forLinesSeen(path.steps.size(), [&](std::size_t i) {
        const InspectedStep& step = path.steps[i];
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(nameOf(step.kind));
        notePlace(fmt::format("step:{}", i));
        cells({fmt::format("{:.3g}", step.distance), fmt::format("{:.3g}", step.size),
               fmt::format("{:.3g}", step.level), fmt::format("{:.3f}", step.total),
               shortText(step.radiance)});
    });
    ImGui::EndTable();
}

}  // namespace

void inspectorPanel(const Session& session, std::optional<Inspection>& inspection) {
    if (!inspection) {
        ImGui::TextDisabled("click a pixel");
        return;
    }
    if (!beginRows("inspector")) return;
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
    if (inspection->gathered) {
        partRow("diffuse", inspection->gathered->diffuse);
        partRow("specular", inspection->gathered->specular);
        partRow("open", inspection->gathered->occlusion);
    }
    ImGui::EndTable();
    if (!inspection->gathered || inspection->gathered->paths.empty()) return;
    pathTable(*inspection);
    const std::vector<InspectedPath>& paths = inspection->gathered->paths;
    if (inspection->chosen >= 0 && static_cast<std::size_t>(inspection->chosen) < paths.size())
        chosenPath(paths[static_cast<std::size_t>(inspection->chosen)]);
}

void inspectGathering(Inspection& inspection, Renderer* renderer) {
    inspection.gathered.reset();
    if (renderer == nullptr) return;
    try {
        inspection.gathered = renderer->inspectPixel(inspection.pixel.x, inspection.pixel.y);
    } catch (const Error&) {
        // The picture changed its size since the click: there is nothing to show.
    }
}

void drawInspection(const Session& session, Picker& picker, std::optional<Inspection>& inspection,
                    const glm::vec2& at, const glm::vec2& size) {
    if (!inspection || !inspection->gathered || size.x < 1 || size.y < 1) return;
    const float aspect = size.x / size.y;
    const std::uint64_t key[3] = {session.revisions().camera + 1, session.revisions().sceneTables(),
                                  static_cast<std::uint64_t>(inspection->chosen + 2) * 100000 +
                                      static_cast<std::uint64_t>(1000 * aspect)};
    if (!std::equal(std::begin(key), std::end(key), std::begin(inspection->linesOf))) {
        inspection->lines = inspectionLines(*inspection->gathered, session.camera(), aspect,
                                            inspection->chosen, seenFrom(picker, session));
        std::copy(std::begin(key), std::end(key), std::begin(inspection->linesOf));
    }
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->PushClipRect({at.x, at.y}, {at.x + size.x, at.y + size.y}, true);
    for (const PictureLine& line : inspection->lines) {
        const glm::vec2 from = at + line.from * size, to = at + line.to * size;
        list->AddLine(
            {from.x, from.y}, {to.x, to.y},
            ImGui::ColorConvertFloat4ToU32({line.color.r, line.color.g, line.color.b, line.opacity}), 1.2f);
    }
    list->PopClipRect();
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
