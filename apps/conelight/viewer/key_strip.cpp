// SPDX-License-Identifier: MIT
#include "viewer/key_strip.h"

#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "session/lengths.h"
#include "viewer/widget_places.h"

namespace conelight::program {

namespace {

constexpr float kKeyReach = 6;     // px from a key's middle that take it
constexpr double kTimeStep = 0.1;  // s: times that a drag gives
constexpr ImU32 kStripGround = IM_COL32(32, 32, 34, 255), kTick = IM_COL32(110, 110, 115, 255),
                kTimeText = IM_COL32(150, 150, 155, 255), kKeyColor = IM_COL32(235, 190, 70, 255),
                kSelectedKey = IM_COL32(70, 190, 255, 255), kHeadColor = IM_COL32(235, 90, 80, 255);

}  // namespace

// Of the strip on the screen.
struct KeyStrip::Place {
    ImVec2 low, high;
    double from, until;

    float inset() const { return 8; }
    float xOf(double seconds) const {
        const double part = (seconds - from) / (until - from);
        return low.x + inset() + static_cast<float>(part) * (high.x - low.x - 2 * inset());
    }
    double secondsAt(float x) const {
        return from +
               (until - from) * static_cast<double>((x - low.x - inset()) / (high.x - low.x - 2 * inset()));
    }
    float middleY() const { return high.y - 0.28f * (high.y - low.y); }
    std::optional<std::size_t> keyAt(const CameraPath& path, float x) const {
        std::optional<std::size_t> found;
        float nearest = kKeyReach;
        for (std::size_t i = 0; i < path.keys().size(); ++i) {
            const float distance = std::fabs(x - xOf(path.keys()[i].seconds));
            if (distance > nearest) continue;
            nearest = distance;
            found = i;
        }
        return found;
    }
};

void KeyStrip::takeMouse(Session& session, const Place& place) {
    const CameraPath& path = session.cameraPath();
    const float x = ImGui::GetIO().MousePos.x;
    const bool down = ImGui::IsItemActive();
    if (down && hand_ == Hand::Away) {
        selected_ = place.keyAt(path, x);
        hand_ = selected_ ? Hand::Presses : Hand::Scrubs;
        pressedX_ = static_cast<double>(x);
        if (selected_) {
            seconds_ = path.keys()[*selected_].seconds;
            session.jumpCamera(path.keys()[*selected_].camera, "path at");
        }
    }
    if (hand_ == Hand::Presses && std::fabs(static_cast<double>(x) - pressedX_) > 3) hand_ = Hand::Moves;
    if (hand_ == Hand::Scrubs) {
        seconds_ = std::clamp(place.secondsAt(x), path.start(), path.end());
        session.moveCamera(path.at(seconds_));
    } else if (hand_ == Hand::Moves && selected_ && *selected_ < path.keys().size()) {
        const double wanted = std::max(std::round(place.secondsAt(x) / kTimeStep) * kTimeStep, 0.0);
        const double seconds = path.freeTime(*selected_, wanted, kTimeStep);
        if (seconds != path.keys()[*selected_].seconds) {
            CameraPath moved = path;
            moved.move(*selected_, seconds);
            session.setCameraPath(moved, "path move", fmt::format("path move {}", *selected_));
        }
        seconds_ = seconds;
    }
    if (!down) {
        if (hand_ == Hand::Moves) session.seal();
        hand_ = Hand::Away;
    }
}

void KeyStrip::draw(const Session& session, const Place& place) const {
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float em = ImGui::GetFontSize();
    list->AddRectFilled(place.low, place.high, kStripGround, 3);
    // Ticks as far apart as their numbers are wide.
    const float perSecond =
        (place.xOf(place.until) - place.xOf(place.from)) / float(place.until - place.from);
    double step = static_cast<double>(roundLengthBelow(3 * em / perSecond));
    while (step * static_cast<double>(perSecond) < static_cast<double>(2.5f * em)) step *= 2;
    for (int i = 0; i * step <= place.until - place.from + 1e-6; ++i) {
        const double seconds = place.from + i * step;
        const float x = place.xOf(seconds);
        list->AddLine({x, place.low.y + 1.15f * em}, {x, place.high.y - 2}, kTick);
        const std::string text = fmt::format("{:g}", seconds);
        list->AddText({x - 0.5f * ImGui::CalcTextSize(text.c_str()).x, place.low.y + 1}, kTimeText,
                      text.c_str());
    }
    const float y = place.middleY();
    list->AddLine({place.xOf(session.cameraPath().start()), y}, {place.xOf(session.cameraPath().end()), y},
                  kTick, 2);
    const float head = place.xOf(session.playedSeconds().value_or(seconds_));
    list->AddLine({head, place.low.y + 1.15f * em}, {head, place.high.y - 1}, kHeadColor, 2);
    const std::vector<PathKey>& keys = session.cameraPath().keys();
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const float x = place.xOf(keys[i].seconds), r = 0.42f * em;
        list->AddQuadFilled({x, y - r}, {x + r, y}, {x, y + r}, {x - r, y},
                            selected_ == i ? kSelectedKey : kKeyColor);
        notePlace(fmt::format("key:{}", i), {x - r, y - r}, {x + r, y + r});
    }
}

void KeyStrip::showSelected(const Session& session, const RunLine& run) {
    if (!selected_) {
        ImGui::TextDisabled("drag a key to move it, beside keys to scrub");
        return;
    }
    const std::vector<PathKey>& keys = session.cameraPath().keys();
    const std::string text = fmt::format("key {} at {:.4g} s", *selected_, keys[*selected_].seconds);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(text.c_str());
    notePlace("key:text");
    ImGui::SameLine();
    const std::size_t chosen = *selected_;
    if (ImGui::SmallButton("delete")) {
        selected_.reset();
        run(fmt::format("path remove {}", chosen));
    }
    notePlace("key:remove");
    ImGui::SameLine();
    if (ImGui::SmallButton("set to view")) run(fmt::format("path add {}", keys[chosen].seconds));
    notePlace("key:set");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("the key becomes the view that is shown");
}

void KeyStrip::show(Session& session, const RunLine& run) {
    const CameraPath& path = session.cameraPath();
    if (path.empty()) {
        selected_.reset();
        return;
    }
    if (selected_ && *selected_ >= path.keys().size()) selected_.reset();
    if (hand_ == Hand::Away) {
        from_ = 0;
        until_ = std::max(1.25 * path.end(), 1.0);
    }
    const float width = std::max(ImGui::GetContentRegionAvail().x, 40.0f), height = 3 * ImGui::GetFontSize();
    const ImVec2 low = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("keys", {width, height});
    notePlace("keys:strip");
    const Place place{low, {low.x + width, low.y + height}, from_, until_};
    takeMouse(session, place);
    draw(session, place);
    showSelected(session, run);
}

}  // namespace conelight::program
