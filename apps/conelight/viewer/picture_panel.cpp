// SPDX-License-Identifier: MIT
#include "viewer/picture_panel.h"

#include <imgui.h>

#include <algorithm>

#include "viewer/standard_views.h"
#include "viewer/widget_places.h"
#include "viewer/work_bar.h"

namespace conelight::program {
namespace {

// Of what is said in the middle, in either theme.
constexpr ImU32 kNoticeGround = IM_COL32(28, 28, 28, 235), kNoticeLetters = IM_COL32(235, 220, 180, 255);

}  // namespace

std::optional<PictureView::Click> PicturePanel::show(const glm::vec2& at, const glm::vec2& size,
                                                     float seconds) {
    ImGui::SetNextWindowPos({at.x, at.y});
    ImGui::SetNextWindowSize({size.x, size.y});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::Begin("##picture", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    ImGui::PopStyleVar();
    if (const std::optional<std::string> side = in_.view.guides.takeClick(in_.session.camera(), at, size))
        viewFrom(in_.session, *side, in_.view.pictureSize());
    const std::optional<PictureView::Click> clicked = in_.view.show(in_.session, at, size, seconds);
    const bool kept = in_.view.kept.shows(), live = in_.view.slot(false).texture() != 0 && !kept;
    if (live) in_.view.guides.draw(in_.session, in_.probe.picker(), at, size, in_.view.moving());
    if (live) outline_.draw(in_.session, in_.view.bounds, at, size, in_.view.moving());
    if (!kept) in_.probe.drawOverPicture(at, size);
    if (live || kept) showLabels(at, size);
    if (live || kept) showInstruments(at, size);
    if (in_.view.notice.empty() && in_.hint && !kept) showText(*in_.hint, at, size);
    ImGui::End();
    if (!in_.view.notice.empty()) showWork(at, size);
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
    if (in_.view.kept.shows()) return label(in_.view.kept.label(), at.x + 0.5f * em, at.y + 0.5f * em, false);
    label(in_.view.slot(false).label(), at.x + 0.5f * em, at.y + 0.5f * em, false);
    if (in_.view.split.on)
        label((in_.view.split.mode == "kept" ? in_.view.kept.label() : in_.view.slot(true).label()) +
                  (in_.view.split.errors ? ": error of the left" : ""),
              at.x + size.x - 0.5f * em, at.y + 0.5f * em, true);
}

// What helps to judge the exposure.
void PicturePanel::showInstruments(const glm::vec2& at, const glm::vec2& size) {
    const ImageSettings& look = in_.session.settings().image;
    const bool key = look.check == ExposureCheck::FalseColor;
    if (key) showFalseColorKey(at, size);
    const float below = key ? 3.2f * ImGui::GetFontSize() : 0;
    in_.view.scopes.show(in_.view.shownPicture(), look, at, size - glm::vec2(0, below));
}

// What takes long, in the middle: its name, the piece it is at, and a way to end it.
void PicturePanel::showWork(const glm::vec2& at, const glm::vec2& size) {
    const float em = ImGui::GetFontSize();
    ImGui::SetNextWindowPos({at.x + 0.5f * size.x, at.y + 0.5f * size.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(30 * em, size.x - 2 * em), 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {em, em});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 6);
    ImGui::PushStyleColor(ImGuiCol_WindowBg, kNoticeGround);
    // It does not take the keys from who types.
    ImGui::Begin("##work", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(2);
    ImGui::PushStyleColor(ImGuiCol_Text, kNoticeLetters);
    ImGui::TextWrapped("%s%s", in_.view.notice.c_str(),
                       in_.view.halted() ? "\nStopped; the next change draws it." : "");
    ImGui::PopStyleColor();
    const std::string work = in_.view.slot(false).work();
    if (in_.view.halted()) {
        if (ImGui::Button("go on")) in_.view.resume();
        notePlace("work:go on");
    } else if (!work.empty()) {
        showWorkBar(work, -1, -5 * em);
        ImGui::SameLine();
        if (ImGui::Button("stop", {-1, 0})) in_.view.halt(in_.session);
        notePlace("work:stop");
    }
    ImGui::End();
}

// In the middle.
void PicturePanel::showText(const std::string& words, const glm::vec2& at, const glm::vec2& size) {
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float em = ImGui::GetFontSize();
    const char* text = words.c_str();
    const float wrap = std::min(30 * em, size.x - 4 * em);
    const ImVec2 extent = ImGui::CalcTextSize(text, nullptr, false, wrap);
    const ImVec2 low{at.x + 0.5f * (size.x - extent.x) - em, at.y + 0.5f * (size.y - extent.y) - em};
    list->AddRectFilled(low, {low.x + extent.x + 2 * em, low.y + extent.y + 2 * em}, kNoticeGround, 6);
    list->AddText(ImGui::GetFont(), em, {low.x + em, low.y + em}, kNoticeLetters, text, nullptr, wrap);
}

}  // namespace conelight::program
