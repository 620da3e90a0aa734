// SPDX-License-Identifier: MIT
#include "viewer/widget_places.h"

#include <imgui.h>

#include <map>

namespace conelight::program {
namespace {

// One window per process (platform/window.h), so one table.
struct Places {
    bool asked = false, recording = false;
    std::map<std::string, WidgetPlace> known;
};
Places& places() {
    static Places all;
    return all;
}

}  // namespace

void askForPlaces() { places().asked = true; }

void beginPlaces() {
    Places& all = places();
    all.recording = all.asked;
    all.asked = false;
    if (all.recording) all.known.clear();
}

void notePlace(const std::string& name) {
    if (!places().recording || !ImGui::IsItemVisible()) return;
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    notePlace(name, {low.x, low.y}, {high.x, high.y});
}

void notePlace(const std::string& name, const glm::vec2& low, const glm::vec2& high) {
    if (places().recording) places().known[name] = {low, high};
}

std::optional<WidgetPlace> placeOf(const std::string& name) {
    const auto found = places().known.find(name);
    if (found == places().known.end()) return std::nullopt;
    return found->second;
}

}  // namespace conelight::program
