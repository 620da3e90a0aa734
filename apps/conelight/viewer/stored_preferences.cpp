// SPDX-License-Identifier: MIT
#include "viewer/stored_preferences.h"

#include <imgui.h>

#include <filesystem>
#include <system_error>

#include "conelight/error.h"
#include "io/files.h"

namespace conelight::program {
namespace {

constexpr std::uint64_t kMostBytes = 1 << 16;  // far more than it ever has

}  // namespace

StoredPreferences::StoredPreferences(const StateFiles& state) {
    if (state.folder().empty()) return;
    file_ = state.folder() + "/preferences";
    std::error_code ignored;
    if (!std::filesystem::exists(file_, ignored)) return;
    try {
        const io::Bytes bytes = io::readFile(file_, kMostBytes);
        values_ = preferencesOf({bytes.begin(), bytes.end()});
    } catch (const Error& error) {
        const std::string reason = error.what();
        complaint_ = (reason.rfind(file_, 0) == 0 ? reason : file_ + ": " + reason) +
                     "; the window begins with its defaults";
    }
}

void StoredPreferences::apply(Gui& gui, PanelLayout& panels) const {
    gui.setLight(values_.light);
    panels.setSizes({values_.sideEm, values_.consoleEm});
    panels.showSide = values_.side;
    panels.showConsole = values_.console;
}

void StoredPreferences::follow(const platform::Window& window, const Gui& gui, const PanelLayout& panels) {
    if (file_.empty() || ImGui::IsAnyMouseDown()) return;
    Preferences now = values_;
    if (gui.chosenScale()) now.uiScale = *gui.chosenScale();
    now.light = gui.light();
    now.sideEm = panels.sizes().side;
    now.consoleEm = panels.sizes().console;
    now.side = panels.showSide;
    now.console = panels.showConsole;
    if (!window.fullscreen() && !window.minimized()) {
        const glm::ivec2 size = window.size();
        if (!firstSize_) firstSize_ = size;
        resized_ = resized_ || size != *firstSize_;
        if (resized_) {
            now.width = size.x;
            now.height = size.y;
        }
    }
    if (now == values_) return;
    values_ = now;
    const std::string text = textOf(now);
    try {
        io::writeFile(file_, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    } catch (const Error&) {
        file_.clear();  // what cannot be written is not remembered
    }
}

}  // namespace conelight::program
