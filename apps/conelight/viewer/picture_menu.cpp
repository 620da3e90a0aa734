// SPDX-License-Identifier: MIT
// The menu and the keys of what is done with a picture: to judge its exposure, to keep it beside the live one.
#include <imgui.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <string>

#include "viewer/menus.h"
#include "viewer/widget_places.h"

namespace conelight::program {
namespace {

const char* nextCheck(ExposureCheck check) {
    switch (check) {
        case ExposureCheck::Off:
            return "clipping";
        case ExposureCheck::Clipping:
            return "false_color";
        case ExposureCheck::FalseColor:
            return "off";
    }
    return "off";
}

}  // namespace

void Menus::takePictureKey(const platform::Window::KeyEvent& press) {
    switch (press.key) {
        case GLFW_KEY_I:
            return in_.console.run("scopes");
        case GLFW_KEY_Z:
            return in_.console.run(std::string("set image.check ") +
                                   nextCheck(in_.session.settings().image.check));
        case GLFW_KEY_K:
            return in_.console.run("keep");
        case GLFW_KEY_C:
            return in_.console.run("flip");
        default:
            return;
    }
}

void Menus::pictureMenu() {
    if (!beginMenu("Picture")) return;
    const auto item = [&](const char* text, const char* key, bool on, const std::string& line, bool enabled) {
        if (ImGui::MenuItem(text, key, on, enabled)) in_.console.run(line);
        notePlace(std::string("menu:") + text);
    };
    const ExposureCheck check = in_.session.settings().image.check;
    const auto checkItem = [&](const char* text, ExposureCheck which, const char* word) {
        const bool on = check == which;
        item(text, "Z", on, std::string("set image.check ") + (on ? "off" : word), true);
    };
    item("Histogram and waveform", "I", in_.view.scopes.open, "scopes", true);
    checkItem("Mark clipping", ExposureCheck::Clipping, "clipping");
    checkItem("False colours", ExposureCheck::FalseColor, "false_color");
    ImGui::Separator();
    const KeptPicture& kept = in_.view.kept;
    item("Keep as A", "K", false, "keep", true);
    item("Show A", "C", kept.shown, "flip", kept.any());
    item("Split with A", nullptr, in_.view.split.on && in_.view.split.mode == "kept", "split kept",
         kept.any());
    if (ImGui::MenuItem("Whole picture A", nullptr, false, kept.shows())) in_.view.kept.showWhole();
    ImGui::EndMenu();
}

}  // namespace conelight::program
