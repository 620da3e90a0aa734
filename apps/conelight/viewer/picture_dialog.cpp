// SPDX-License-Identifier: MIT
#include "viewer/picture_dialog.h"

#include <fmt/core.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <span>

#include "console/statements.h"
#include "viewer/imgui_names.h"
#include "viewer/requests.h"
#include "viewer/widget_places.h"

namespace conelight::program {
namespace {

constexpr int kLeastEdge = 2, kLongestEdge = 16384;

struct SizeChoice {
    const char* text;
    int width, height;  // 0: of the window; -1: typed
};
constexpr SizeChoice kSizes[] = {{"as in the window", 0, 0},  {"1280 x 720", 1280, 720},
                                 {"1920 x 1080", 1920, 1080}, {"3840 x 2160", 3840, 2160},
                                 {"2048 x 2048", 2048, 2048}, {"other", -1, -1}};

struct Kind {
    const char* text;
    const char* ending;
    bool alpha;        // can have it
    const char* word;  // of the command, besides
};
constexpr Kind kPictures[] = {{"PNG, 8 bits", ".png", true, ""},
                              {"PNG, 16 bits", ".png", true, " 16bit"},
                              {"EXR, linear", ".exr", true, ""},
                              {"JPEG", ".jpg", false, ""}};
constexpr Kind kFilms[] = {{"MP4", ".mp4", false, ""},
                           {"WebM", ".webm", false, ""},
                           {"MOV, ProRes 4444", ".mov", true, ""},
                           {"animated WebP", ".webp", false, ""},
                           {"animated GIF", ".gif", false, ""},
                           {"PNG, numbered", "%04d.png", true, ""},
                           {"EXR, numbered", "%04d.exr", true, ""}};

struct Movement {
    const char* text;
    const char* word;
};
constexpr Movement kMovements[] = {
    {"once round the target", " turntable"}, {"along the camera path", " path"}, {"the clip", " clip"}};

void label(const char* text) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(text);
    ImGui::SameLine(7 * ImGui::GetFontSize());
    ImGui::SetNextItemWidth(-1);
}

// A list to choose from. Returns whether another was chosen.
template <class Choice>
bool chooser(const char* name, std::span<const Choice> choices, int& chosen) {
    bool changed = false;
    const bool open =
        ImGui::BeginCombo((std::string("##") + name).c_str(), choices[static_cast<std::size_t>(chosen)].text);
    notePlace(std::string("picture:") + name);
    if (!open) return false;
    for (int i = 0; i < static_cast<int>(choices.size()); ++i) {
        const char* text = choices[static_cast<std::size_t>(i)].text;
        if (ImGui::Selectable(text, i == chosen)) {
            changed = i != chosen;
            chosen = i;
        }
        notePlace(std::string("choice:") + text);
    }
    ImGui::EndCombo();
    return changed;
}

}  // namespace

void PictureDialog::open(bool film, int frames) {
    wanted_ = true;
    film_ = film;
    seconds_ = static_cast<float>(frames) / static_cast<float>(rate_);
    name_ = nextName(film ? kFilms[filmKind_].ending : kPictures[pictureKind_].ending);
}

int PictureDialog::frames() const {
    return std::clamp(static_cast<int>(std::lround(seconds_ * static_cast<float>(rate_))), 1, 100000);
}

void PictureDialog::sizeRows() {
    label("size");
    chooser<SizeChoice>("size", kSizes, size_);
    if (kSizes[size_].width > 0) {
        width_ = kSizes[size_].width;
        height_ = kSizes[size_].height;
    }
    if (kSizes[size_].width >= 0) return;
    label("pixels");
    const float width = 5 * ImGui::GetFontSize();
    for (const auto& [name, value] : {std::pair("width", &width_), std::pair("height", &height_)}) {
        ImGui::SetNextItemWidth(width);
        ImGui::InputInt((std::string("##") + name).c_str(), value, 0);
        notePlace(std::string("picture:") + name);
        if (value == &width_) ImGui::SameLine();
        *value = std::clamp(*value, kLeastEdge, kLongestEdge);
    }
}

void PictureDialog::kindRows() {
    label("file");
    const bool changed =
        film_ ? chooser<Kind>("kind", kFilms, filmKind_) : chooser<Kind>("kind", kPictures, pictureKind_);
    const Kind& kind = film_ ? kFilms[filmKind_] : kPictures[pictureKind_];
    if (changed) name_ = nextName(kind.ending);
    label("sky");
    ImGui::BeginDisabled(!kind.alpha);
    if (!kind.alpha) alpha_ = false;
    ImGui::Checkbox("clear (alpha)", &alpha_);
    notePlace("picture:alpha");
    ImGui::EndDisabled();
}

void PictureDialog::movementRows(const Session& session) {
    label("movement");
    chooser<Movement>("movement", kMovements, movement_);
    const bool path = movement_ == 1, clip = movement_ == 2;
    if ((path && session.cameraPath().empty()) || (clip && session.clips().empty()))
        ImGui::TextDisabled(path ? "no key frames yet: heading Camera" : "the scene has no clip");
    label("length");
    const float width = 5 * ImGui::GetFontSize();
    ImGui::SetNextItemWidth(width);
    ImGui::InputFloat("s##seconds", &seconds_, 0, 0, "%.3g");
    notePlace("picture:seconds");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(width);
    ImGui::InputInt("a second", &rate_, 0);
    notePlace("picture:rate");
    rate_ = std::clamp(rate_, 1, 240);
    seconds_ = std::isfinite(seconds_) ? std::max(seconds_, 0.0f) : 1;
    ImGui::SameLine();
    ImGui::TextDisabled("%d frames", frames());
}

void PictureDialog::nameRow() {
    label("name");
    entered_ = ImGui::InputText("##name", &name_,
                                ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    notePlace("picture:name");
}

std::string PictureDialog::line() const {
    std::string line =
        film_ ? fmt::format("record {} {}", quoted(name_), frames()) : "screenshot " + quoted(name_);
    if (film_) line += kMovements[movement_].word;
    if (kSizes[size_].width != 0) line += fmt::format(" {}x{}", width_, height_);
    if (film_) line += fmt::format(" {}fps", rate_);
    if (alpha_) line += " alpha";
    return line + (film_ ? kFilms[filmKind_] : kPictures[pictureKind_]).word;
}

std::optional<std::string> PictureDialog::show(const Session& session) {
    const char* title = film_ ? "Write a film###written" : "Write a picture###written";
    if (wanted_) ImGui::OpenPopup(title);
    const bool first = std::exchange(wanted_, false);
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowSize({std::min(30 * ImGui::GetFontSize(), display.x), 0}, ImGuiCond_Appearing);
    ImGui::SetNextWindowPos({0.5f * display.x, 0.5f * display.y}, ImGuiCond_Appearing, {0.5f, 0.5f});
    if (!ImGui::BeginPopupModal(title, nullptr,
                                ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings))
        return std::nullopt;
    ImGui::Dummy({28 * ImGui::GetFontSize(), 0});
    sizeRows();
    kindRows();
    if (film_) movementRows(session);
    if (first) ImGui::SetKeyboardFocusHere();
    nameRow();
    std::error_code ignored;
    const bool replaces = std::filesystem::exists(name_, ignored);
    const std::string text = replaces ? "Replace " + name_ : film_ ? "Write the film" : "Write the picture";
    const bool taken = ImGui::Button((text + "###take").c_str()) || (entered_ && !replaces);
    notePlace("picture:take");
    ImGui::SameLine();
    const bool cancelled = ImGui::Button("Cancel") || escapePressed();
    notePlace("picture:cancel");
    const bool done = taken && !name_.empty();
    if (done || cancelled) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    return done ? std::optional(line()) : std::nullopt;
}

}  // namespace conelight::program
