// SPDX-License-Identifier: MIT
#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <utility>

#include "conelight/error.h"
#include "viewer/panels.h"
#include "viewer/text_wrap.h"
#include "viewer/widget_places.h"

namespace conelight::program {
namespace {

// Tables of many numbers are wider than the panel.
constexpr ImGuiTableFlags kScrolled = ImGuiTableFlags_ScrollX | ImGuiTableFlags_ScrollY |
                                      ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit;

std::string spacedText(const glm::vec3& v) { return fmt::format("{:.4g}  {:.4g}  {:.4g}", v.x, v.y, v.z); }

// In tables: a grey as one number.
std::string shortText(const glm::vec3& v) {
    return v.x == v.y && v.y == v.z ? fmt::format("{:.4g}", v.x) : spacedText(v);
}

void row(const char* name, const std::string& value) {
    ImGui::TableNextRow();
    ImGui::TableSetColumnIndex(0);
    ImGui::TextDisabled("%s", name);
    ImGui::TableSetColumnIndex(1);
    ImGui::TextUnformatted(wrappedAtSpaces(value, ImGui::GetContentRegionAvail().x).c_str());
}

// Of rows: names and, in what is left of the panel, values, which wrap.
bool beginRows(const char* id) {
    if (!ImGui::BeginTable(id, 2, ImGuiTableFlags_SizingFixedFit)) return false;
    // Said, not fitted: a column has no width before it was drawn once, and the next frame may be long.
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthFixed, 7.2f * ImGui::GetFontSize());
    ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
    return true;
}

void partRow(const char* name, const InspectedPart& part) {
    if (part.used) row(name, spacedText(part.value) + "  x  " + spacedText(part.scale));
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

// With widths in heights of text.
void columns(std::initializer_list<std::pair<const char*, float>> columns) {
    for (const auto& [head, width] : columns)
        ImGui::TableSetupColumn(head, ImGuiTableColumnFlags_WidthFixed, width * ImGui::GetFontSize());
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
    columns({{"cone or ray", 7}, {"end", 4}, {"m", 3.5f}, {"weight", 4.5f}, {"radiance", 10}});
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
        row("normal", spacedText(face.normal));
        row("plane", fmt::format("{:+.3f} voxels, coverage {:.3g}", face.plane, face.coverage));
        row("albedo", spacedText(face.albedo));
        row("radiance", spacedText(face.radiance) + "  W/(sr m2)");
        row("irradiance / pi", spacedText(face.irradiance));
        row("cache age", face.updates < 0 ? std::string("inside a closed object")
                                          : fmt::format("{} updates", face.updates));
        ImGui::EndTable();
    }
    if (!ImGui::BeginTable("steps", 6, kScrolled, {0, 12 * ImGui::GetFontSize()})) return;
    ImGui::TableSetupScrollFreeze(0, 1);
    columns({{"step", 6}, {"m", 3.5f}, {"size m", 4}, {"level", 3}, {"opacity", 4}, {"radiance", 10}});
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
    const bool cleared = ImGui::SmallButton("clear");
    notePlace("inspector:clear");
    if (cleared) return inspection.reset();
    if (!beginRows("inspector")) return;
    row("pixel", fmt::format("{}, {}", inspection->pixel.x, inspection->pixel.y));
    row("radiance", spacedText(glm::vec3(inspection->radiance)) + "  W/(sr m2)");
    if (inspection->hit) {
        const Pick& hit = *inspection->hit;
        row("object", hit.object);
        const bool named = hit.material >= 0;
        row("material",
            named ? session.scene().materials[static_cast<std::size_t>(hit.material)].name : "(none)");
        row("position", spacedText(hit.position) + "  m");
        row("normal", spacedText(hit.normal));
        row("shading normal", spacedText(hit.shadingNormal));
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

}  // namespace conelight::program
