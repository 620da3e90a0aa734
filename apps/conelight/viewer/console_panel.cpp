// SPDX-License-Identifier: MIT
#include "viewer/console_panel.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "viewer/text_wrap.h"
#include "viewer/widget_places.h"

namespace conelight::program {
namespace {

constexpr std::size_t kKeptLines = 2000;

// What all candidates start with.
std::string commonStart(const std::vector<std::string>& words) {
    std::string start = words.front();
    for (const std::string& word : words) {
        std::size_t same = 0;
        while (same < std::min(start.size(), word.size()) && start[same] == word[same]) ++same;
        start.resize(same);
    }
    return start;
}

// Errors stand out; so does what was typed.
void line(const std::string& text, bool isError) {
    const bool typed = text.compare(0, 2, "> ") == 0;
    if (isError) ImGui::PushStyleColor(ImGuiCol_Text, {0.95f, 0.55f, 0.45f, 1});
    if (typed) ImGui::PushStyleColor(ImGuiCol_Text, {0.60f, 0.72f, 0.84f, 1});
    ImGui::TextUnformatted(text.c_str());
    if (isError || typed) ImGui::PopStyleColor();
}

void replaceLine(ImGuiInputTextCallbackData* data, const std::string& text) {
    data->DeleteChars(0, data->BufTextLen);
    data->InsertChars(0, text.c_str());
}

}  // namespace

void ConsolePanel::say(const std::string& text, bool isError) {
    std::size_t from = 0;
    while (from <= text.size()) {
        const std::size_t end = std::min(text.find('\n', from), text.size());
        if (end > from || end < text.size()) lines_.push_back({text.substr(from, end - from), isError});
        from = end + 1;
    }
    while (lines_.size() > kKeptLines) lines_.pop_front();
    if (isError) ++errors_;
    scrollDown_ = saidMore_ = true;
}

void ConsolePanel::completeLine(void* callbackData) {
    auto* data = static_cast<ImGuiInputTextCallbackData*>(callbackData);
    const std::vector<std::string> whole =
        complete_(std::string(data->Buf, static_cast<std::size_t>(data->BufTextLen)));
    if (whole.empty()) return;
    replaceLine(data, whole.size() == 1 ? whole.front() + " " : commonStart(whole));
    if (whole.size() == 1) return;
    std::string all;
    for (const std::string& line : whole) all += (all.empty() ? "" : "   ") + line;
    say(all);
}

void ConsolePanel::recall(void* callbackData) {
    auto* data = static_cast<ImGuiInputTextCallbackData*>(callbackData);
    const std::string typed(data->Buf, static_cast<std::size_t>(data->BufTextLen));
    replaceLine(data, data->EventKey == ImGuiKey_UpArrow ? history_.back(typed) : history_.forward(typed));
}

int ConsolePanel::edited(void* callbackData) {
    auto* data = static_cast<ImGuiInputTextCallbackData*>(callbackData);
    auto* panel = static_cast<ConsolePanel*>(data->UserData);
    if (data->EventFlag == ImGuiInputTextFlags_CallbackCompletion) panel->completeLine(data);
    if (data->EventFlag == ImGuiInputTextFlags_CallbackHistory) panel->recall(data);
    return 0;
}

void ConsolePanel::wrap(float room) {
    if (room == shownRoom_ && !std::exchange(saidMore_, false)) return;
    shownRoom_ = room;
    shown_.clear();
    for (const Line& one : lines_) {
        std::istringstream pieces(wrappedAtSpaces(one.text, room));
        for (std::string piece; std::getline(pieces, piece);) shown_.push_back({piece, one.isError});
        if (one.text.empty()) shown_.push_back(one);
    }
}

void ConsolePanel::show() {
    const float footer = ImGui::GetFrameHeightWithSpacing();
    ImGui::BeginChild("##log", {0, -footer});
    wrap(ImGui::GetWindowWidth() - ImGui::GetStyle().ScrollbarSize);
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(shown_.size()));
    while (clipper.Step())
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i)
            line(shown_[static_cast<std::size_t>(i)].text, shown_[static_cast<std::size_t>(i)].isError);
    clipper.End();
    if (scrollDown_) ImGui::SetScrollHereY(1);
    scrollDown_ = false;
    ImGui::EndChild();

    ImGui::SetNextItemWidth(-1);
    if (framesToFocus_ > 0) ImGui::SetKeyboardFocusHere();
    const bool entered = ImGui::InputTextWithHint(
        "##line", "command; `help` lists them, Tab completes", &line_,
        ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_CallbackCompletion |
            ImGuiInputTextFlags_CallbackHistory,
        [](ImGuiInputTextCallbackData* data) { return edited(data); }, this);
    notePlace("console");
    if (framesToFocus_ > 0) framesToFocus_ = ImGui::IsItemActive() ? 0 : framesToFocus_ - 1;
    if (!entered) return;
    if (!line_.empty()) {
        say("> " + line_);
        enter_(line_);
    }
    line_.clear();
    focus();
}

}  // namespace conelight::program
