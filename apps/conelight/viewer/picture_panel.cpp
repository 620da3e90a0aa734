// SPDX-License-Identifier: MIT
#include "viewer/picture_panel.h"

#include <imgui.h>

#include <algorithm>

namespace conelight::program {

std::optional<PictureView::Click> PicturePanel::show(const glm::vec2& at, const glm::vec2& size,
                                                     float seconds) {
    ImGui::SetNextWindowPos({at.x, at.y});
    ImGui::SetNextWindowSize({size.x, size.y});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::Begin("##picture", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    ImGui::PopStyleVar();
    const std::optional<PictureView::Click> clicked = in_.view.show(in_.session, at, size, seconds);
    if (in_.view.slot(false).texture() != 0)
        outline_.draw(in_.session, in_.view.bounds, at, size, in_.view.moving());
    in_.probe.drawOverPicture(at, size);
    if (in_.view.slot(false).texture() != 0) showLabels(at, size);
    if (!in_.notice.empty())
        showText(in_.notice, at, size);
    else if (in_.hint)
        showText(*in_.hint, at, size);
    ImGui::End();
    return clicked;
}

void PicturePanel::showLabels(const glm::vec2& at, const glm::vec2& size) {
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float em = ImGui::GetFontSize();
    const auto label = [&](const std::string& text, float x, float y, bool fromRight) {
        const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
        const ImVec2 low{fromRight ? x - extent.x - em : x, y};
        list->AddRectFilled(low, {low.x + extent.x + em, low.y + 1.5f * em}, IM_COL32(20, 20, 20, 170), 4);
        list->AddText({low.x + 0.5f * em, low.y + 0.25f * em}, IM_COL32(230, 230, 230, 255), text.c_str());
    };
    label(in_.view.slot(false).label(), at.x + 0.5f * em, at.y + 0.5f * em, false);
    if (in_.view.split.on)
        label(in_.view.slot(true).label() + (in_.view.split.errors ? ": error of the left" : ""),
              at.x + size.x - 0.5f * em, at.y + 0.5f * em, true);
}

// In the middle.
void PicturePanel::showText(const std::string& words, const glm::vec2& at, const glm::vec2& size) {
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float em = ImGui::GetFontSize();
    const char* text = words.c_str();
    const float wrap = std::min(30 * em, size.x - 4 * em);
    const ImVec2 extent = ImGui::CalcTextSize(text, nullptr, false, wrap);
    const ImVec2 low{at.x + 0.5f * (size.x - extent.x) - em, at.y + 0.5f * (size.y - extent.y) - em};
    list->AddRectFilled(low, {low.x + extent.x + 2 * em, low.y + extent.y + 2 * em},
                        IM_COL32(28, 28, 28, 235), 6);
    list->AddText(ImGui::GetFont(), em, {low.x + em, low.y + em}, IM_COL32(235, 220, 180, 255), text, nullptr,
                  wrap);
}

}  // namespace conelight::program
