// SPDX-License-Identifier: MIT
#include "viewer/scopes_panel.h"

#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "viewer/widget_places.h"

namespace conelight::program {
namespace {

constexpr ImU32 kGround = IM_COL32(12, 12, 12, 225), kGrid = IM_COL32(90, 90, 90, 255),
                kLetters = IM_COL32(200, 200, 200, 255);

ImU32 colorOf(const glm::u8vec3& c) { return IM_COL32(c.r, c.g, c.b, 255); }

void text(const glm::vec2& at, const std::string& words) {
    ImGui::GetWindowDrawList()->AddText({at.x, at.y}, kLetters, words.c_str());
}

// The tallest bar between the ends: what is black or clipped would leave no room for the rest.
template <class Counts>
std::uint32_t mostIn(const Counts& counts) {
    return *std::max_element(counts.begin() + 1, counts.end() - 1);
}

// Height of a bar, 0 to 1: by roots, so that small parts are seen beside large ones.
float heightOf(std::uint32_t count, std::uint32_t most) {
    return std::sqrt(std::min(static_cast<float>(count) / static_cast<float>(std::max(most, 1u)), 1.0f));
}

}  // namespace

const Scopes& ScopesPanel::follow(const Source& source, const ImageSettings& look) {
    if (source.name == name_ && source.version == version_ && look == look_) return scopes_;
    scopes_ = scopesOf(source.read(), look);
    name_ = source.name;
    version_ = source.version;
    look_ = look;
    drawn_ = false;
    return scopes_;
}

void ScopesPanel::show(const Source& source, const ImageSettings& look, const glm::vec2& at,
                       const glm::vec2& size) {
    if (!open) return;
    follow(source, look);
    if (!drawn_) waveform_.update(Scopes::kColumns, Scopes::kLevels, waveformPicture(scopes_));
    drawn_ = true;
    const float em = ImGui::GetFontSize(), width = std::min(22 * em, 0.6f * size.x), height = 22 * em;
    const glm::vec2 low = at + size - glm::vec2(width, height) - 0.5f * em;
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddRectFilled({low.x, low.y}, {low.x + width, low.y + height}, kGround, 4);
    notePlace("scopes", low, low + glm::vec2(width, height));
    const float inner = width - em;
    glm::vec2 place = low + 0.5f * em;
    place.y += showLuminance(place, inner);
    place.y += showChannels(place, inner);
    const ImVec2 from{place.x, place.y}, to{place.x + inner, low.y + height - 3.3f * em};
    list->AddImage((ImTextureID)(static_cast<std::uintptr_t>(waveform_.name())), from, to);
    notePlace("scopes:waveform", {from.x, from.y}, {to.x, to.y});
    text({place.x, low.y + height - 3 * em}, fmt::format("median {:+.1f} stops", scopes_.median));
    text({place.x, low.y + height - 1.6f * em},
         fmt::format("clipped: {:.2g} % over, {:.2g} % under", 100 * scopes_.part(scopes_.over),
                     100 * scopes_.part(scopes_.under)));
}

// A bar per sixth of a stop in the colour of its stop, numbers below. Returns the height.
float ScopesPanel::showLuminance(const glm::vec2& at, float width) const {
    const float em = ImGui::GetFontSize(), height = 5 * em, step = width / Scopes::kBins;
    ImDrawList* list = ImGui::GetWindowDrawList();
    const std::uint32_t most = mostIn(scopes_.luminance);
    for (int i = 0; i < Scopes::kBins; ++i) {
        const float part = heightOf(scopes_.luminance[static_cast<std::size_t>(i)], most);
        const float stops = Scopes::kDarkest + (static_cast<float>(i) + 0.5f) / Scopes::kBinsPerStop;
        const glm::u8vec3 color = stops < -6.5f ? glm::u8vec3(70, 60, 80) : falseColor(stops);
        const float x = at.x + step * static_cast<float>(i);
        if (part > 0)
            list->AddRectFilled({x, at.y + height * (1 - part)}, {x + step, at.y + height}, colorOf(color));
    }
    for (int stop = Scopes::kDarkest + 2; stop < Scopes::kBrightest; stop += 2) {
        const float x = at.x + step * static_cast<float>((stop - Scopes::kDarkest) * Scopes::kBinsPerStop);
        list->AddLine({x, at.y}, {x, at.y + height + 0.2f * em}, stop == 0 ? kLetters : kGrid);
        const std::string number = fmt::format("{}", stop);
        text({x - 0.5f * ImGui::CalcTextSize(number.c_str()).x, at.y + height + 0.2f * em}, number);
    }
    notePlace("scopes:luminance", at, at + glm::vec2(width, height));
    return height + 1.5f * em;
}

float ScopesPanel::showChannels(const glm::vec2& at, float width) const {
    constexpr ImU32 kColors[] = {IM_COL32(235, 70, 60, 255), IM_COL32(80, 210, 80, 255),
                                 IM_COL32(90, 130, 255, 255)};
    const float em = ImGui::GetFontSize(), height = 4 * em;
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddLine({at.x, at.y + height}, {at.x + width, at.y + height}, kGrid);
    for (std::size_t c = 0; c < 3; ++c) {
        const auto& counts = scopes_.channels[c];
        const std::uint32_t most = mostIn(counts);
        std::array<ImVec2, Scopes::kLevels> line;
        for (std::size_t i = 0; i < counts.size(); ++i)
            line[i] = {at.x + width * (static_cast<float>(i) + 0.5f) / Scopes::kLevels,
                       at.y + height * (1 - heightOf(counts[i], most))};
        for (std::size_t i = 1; i < line.size(); ++i) list->AddLine(line[i - 1], line[i], kColors[c], 1.2f);
    }
    notePlace("scopes:channels", at, at + glm::vec2(width, height));
    return height + 0.5f * em;
}

void showFalseColorKey(const glm::vec2& at, const glm::vec2& size) {
    constexpr int kMost = 6;
    const float em = ImGui::GetFontSize(), box = std::min(2 * em, size.x / (2 * kMost + 2));
    const glm::vec2 low = at + glm::vec2(0.5f * em, size.y - 3.1f * em);
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddRectFilled({low.x, low.y}, {low.x + box * (2 * kMost + 1) + em, low.y + 2.6f * em}, kGround, 4);
    for (int stop = -kMost; stop <= kMost; ++stop) {
        const float x = low.x + 0.5f * em + box * static_cast<float>(stop + kMost);
        list->AddRectFilled({x, low.y + 0.3f * em}, {x + box, low.y + 1.2f * em},
                            colorOf(falseColor(static_cast<float>(stop))));
        const std::string number = stop == 0 ? "0" : fmt::format("{:+}", stop);
        text({x + 0.5f * (box - ImGui::CalcTextSize(number.c_str()).x), low.y + 1.3f * em}, number);
        if (stop == 0) notePlace("false colors", {x, low.y + 0.3f * em}, {x + box, low.y + 1.2f * em});
    }
}

}  // namespace conelight::program
