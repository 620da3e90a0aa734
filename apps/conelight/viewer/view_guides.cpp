// SPDX-License-Identifier: MIT
#include "viewer/view_guides.h"

#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "session/lengths.h"
#include "session/picker.h"
#include "session/projection.h"
#include "viewer/widget_places.h"

namespace conelight::program {
namespace {

// Lengths in heights of text, by eye.
constexpr float kAxis = 2.1f, kBall = 0.65f, kFromCorner = 3.4f, kWidestBar = 9;
constexpr ImU32 kAxisColors[3] = {IM_COL32(235, 80, 70, 255), IM_COL32(110, 190, 70, 255),
                                  IM_COL32(80, 140, 250, 255)};
constexpr ImU32 kHotColor = IM_COL32(255, 255, 255, 255), kInk = IM_COL32(20, 20, 20, 255),
                kPaper = IM_COL32(235, 235, 235, 255);
constexpr const char* kSides[6] = {"right", "top", "front", "left", "bottom", "back"};

ImU32 colorOf(const glm::vec3& color, float opacity) {
    return ImGui::ColorConvertFloat4ToU32({color.x, color.y, color.z, opacity});
}

int numberOf(int axis, bool positive) { return positive ? axis : axis + 3; }

// Of the target, in m.
float metresPerPixelAt(const Camera& camera, const glm::vec2& size) {
    return camera.heightAt(glm::distance(camera.eye, camera.target)) / std::max(size.y, 1.0f);
}

float barLength(const Camera& camera, const glm::vec2& size) {
    const float widest = std::min(kWidestBar * ImGui::GetFontSize(), 0.4f * size.x);
    return roundLengthBelow(std::max(widest * metresPerPixelAt(camera, size), 1e-9f));
}

}  // namespace

// The farthest first.
std::vector<ViewGuides::End> ViewGuides::endsOf(const Camera& camera, const glm::vec2& at,
                                                const glm::vec2& size) {
    const float em = ImGui::GetFontSize();
    const glm::vec2 middle(at.x + size.x - kFromCorner * em, at.y + (kFromCorner + 1.2f) * em);
    const CameraAxes axes = cameraAxes(camera);
    const glm::vec3 forward(axes.forward), right(axes.right), up(axes.up);
    std::vector<End> ends;
    for (int i = 0; i < 6; ++i) {
        End end{i % 3, i < 3, middle, 0};
        glm::vec3 way(0);
        way[end.axis] = end.positive ? 1.0f : -1.0f;
        end.at += kAxis * em * glm::vec2(glm::dot(way, right), -glm::dot(way, up));
        end.depth = -glm::dot(way, forward);
        ends.push_back(end);
    }
    std::stable_sort(ends.begin(), ends.end(), [](const End& a, const End& b) { return a.depth < b.depth; });
    return ends;
}

std::optional<std::string> ViewGuides::takeClick(const Camera& camera, const glm::vec2& at,
                                                 const glm::vec2& size) {
    hot_.reset();
    if (!axes || size.x < 1 || size.y < 1) return std::nullopt;
    const float reach = kBall * ImGui::GetFontSize();
    std::vector<End> ends = endsOf(camera, at, size);
    std::reverse(ends.begin(), ends.end());  // the nearest takes the mouse
    std::optional<std::string> side;
    for (const End& end : ends) {
        const int number = numberOf(end.axis, end.positive);
        ImGui::SetCursorScreenPos({end.at.x - reach, end.at.y - reach});
        if (ImGui::InvisibleButton(kSides[number], {2 * reach, 2 * reach})) side = kSides[number];
        notePlace(std::string("axis:") + kSides[number]);
        if (!ImGui::IsItemHovered()) continue;
        hot_ = number;
        ImGui::SetTooltip("view from the %s", kSides[number]);
    }
    return side;
}

void ViewGuides::drawAxes(const Camera& camera, const glm::vec2& at, const glm::vec2& size) {
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float em = ImGui::GetFontSize(), radius = kBall * em;
    const std::vector<End> ends = endsOf(camera, at, size);
    const glm::vec2 middle = 0.5f * (ends.front().at + ends.back().at);  // of opposite ends
    for (const End& end : ends) {
        const int number = numberOf(end.axis, end.positive);
        const ImU32 color = hot_ == number ? kHotColor : kAxisColors[end.axis];
        const ImVec2 place{end.at.x, end.at.y};
        if (end.positive) {
            list->AddLine({middle.x, middle.y}, place, kAxisColors[end.axis], 2);
            list->AddCircleFilled(place, radius, color, 24);
            const char letter[2] = {"XYZ"[end.axis], '\0'};
            const ImVec2 extent = ImGui::CalcTextSize(letter);
            list->AddText({place.x - 0.5f * extent.x, place.y - 0.5f * extent.y}, kInk, letter);
        } else {
            list->AddCircleFilled(place, radius, IM_COL32(30, 30, 30, 150), 24);
            list->AddCircle(place, radius - 1, color, 24, 1.5f);
        }
    }
}

// A bar as long as that many metres are at the target, in the lower right corner; what a cell of the grid is above.
void ViewGuides::drawScale(const Camera& camera, const glm::vec2& at, const glm::vec2& size) const {
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float em = ImGui::GetFontSize();
    const ImVec2 corner{at.x + size.x - em, at.y + size.y - em};
    std::string words;
    if (scale) {
        const float metres = barLength(camera, size), length = metres / metresPerPixelAt(camera, size);
        const float left = corner.x - length;
        list->AddRectFilled({left - 2, corner.y - 0.3f * em - 2}, {corner.x + 2, corner.y + 2}, kInk);
        list->AddRectFilled({left, corner.y - 0.3f * em}, {corner.x, corner.y}, kPaper);
        notePlace("scale", {left, corner.y - 0.3f * em}, {corner.x, corner.y});
        words = lengthText(metres);
    }
    if (grid)
        words += (words.empty() ? "grid " : "   grid ") + lengthText(gridCell(apparentDistance(camera)));
    const ImVec2 extent = ImGui::CalcTextSize(words.c_str());
    const ImVec2 low{corner.x - extent.x, corner.y - extent.y - (scale ? 0.7f : 0.0f) * em};
    list->AddRectFilled({low.x - 0.4f * em, low.y - 0.1f * em},
                        {low.x + extent.x + 0.4f * em, low.y + 1.2f * em}, IM_COL32(20, 20, 20, 170), 4);
    list->AddText(low, kPaper, words.c_str());
}

void ViewGuides::draw(const Session& session, Picker& picker, const glm::vec2& at, const glm::vec2& size,
                      bool edited) {
    if (!any() || size.x < 1 || size.y < 1) return;
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->PushClipRect({at.x, at.y}, {at.x + size.x, at.y + size.y}, true);
    if (grid)
        for (const PictureLine& line : ground_.lines(session, picker, size.x / size.y, edited)) {
            const glm::vec2 from = at + line.from * size, to = at + line.to * size;
            list->AddLine({from.x, from.y}, {to.x, to.y}, colorOf(line.color, line.opacity), 1.2f);
        }
    if (axes) drawAxes(session.camera(), at, size);
    if (grid || scale) drawScale(session.camera(), at, size);
    list->PopClipRect();
}

std::string ViewGuides::text(const Camera& camera, const glm::vec2& size) const {
    std::string text;
    const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
    if (grid) add("grid " + lengthText(gridCell(apparentDistance(camera))));
    if (axes) add("axes");
    if (scale) add("scale " + lengthText(barLength(camera, size)));
    return text.empty() ? "off" : text;
}

}  // namespace conelight::program
