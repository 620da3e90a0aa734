// SPDX-License-Identifier: MIT
#include "viewer/help_menu.h"

#include <fcntl.h>
#include <imgui.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include "conelight/version.h"
#include "provenance.h"
#include "viewer/imgui_names.h"
#include "viewer/widget_places.h"

namespace conelight::program {
namespace {

namespace fs = std::filesystem;

// A program that nobody waits for: its parent is gone at once.
void startAlone(const char* const* words) {
    const pid_t child = ::fork();
    if (child < 0) return;
    if (child > 0) {
        ::waitpid(child, nullptr, 0);
        return;
    }
    if (::fork() != 0) ::_exit(0);
    ::setsid();
    const int nowhere = ::open("/dev/null", O_RDWR);
    for (const int stream : {0, 1, 2}) ::dup2(nowhere, stream);
    ::execvp(words[0], const_cast<char* const*>(words));
    ::_exit(127);
}

// Whether a program of this name is in one of the folders of PATH.
bool isInstalled(const std::string& program) {
    const char* const path = std::getenv("PATH");
    for (std::string rest = path == nullptr ? "" : path; !rest.empty();) {
        const std::size_t end = std::min(rest.find(':'), rest.size());
        if (::access((rest.substr(0, end) + "/" + program).c_str(), X_OK) == 0) return true;
        rest.erase(0, std::min(end + 1, rest.size()));
    }
    return false;
}

}  // namespace

std::optional<std::string> guideFile() {
    std::error_code code;
    const fs::path program = fs::read_symlink("/proc/self/exe", code);
    if (code) return std::nullopt;
    for (fs::path folder = program.parent_path(); folder.has_relative_path(); folder = folder.parent_path())
        for (const char* place : {"share/doc/conelight/docs/guide/viewer.md", "docs/guide/viewer.md"})
            if (fs::exists(folder / place, code)) return (folder / place).string();
    return std::nullopt;
}

void HelpMenu::openGuide() {
    const std::optional<std::string> guide = guideFile();
    if (!guide) return console_.fail("help: the guide is not installed with this program");
    const bool opens = isInstalled("xdg-open");
    console_.say((opens ? "help: opening " : "help: the guide is ") + *guide);
    const char* const words[] = {"xdg-open", guide->c_str(), nullptr};
    if (opens) startAlone(words);
}

void HelpMenu::showItems() {
    if (ImGui::MenuItem("Guide", "Shift+F1")) openGuide();
    notePlace("menu:Guide");
    ImGui::MenuItem("Mouse and keys", "F1", &keys_.open);
    notePlace("menu:Mouse and keys");
    if (ImGui::MenuItem("About Conelight", "Ctrl+F1")) openAbout();
    notePlace("menu:About");
}

void HelpMenu::showAbout() {
    constexpr const char* kTitle = "About Conelight";
    if (std::exchange(wantsAbout_, false)) ImGui::OpenPopup(kTitle);
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * display.x, 0.5f * display.y}, ImGuiCond_Appearing, {0.5f, 0.5f});
    if (!ImGui::BeginPopupModal(kTitle, nullptr, ImGuiWindowFlags_AlwaysAutoResize)) return;
    ImGui::TextUnformatted(softwareName().c_str());
    notePlace("about:version");
    ImGui::TextUnformatted("Global illumination in real time by tracing voxels");
    ImGui::Separator();
    ImGui::Text("OpenGL: %s", window_.description().c_str());
    ImGui::Text("Dear ImGui %s", IMGUI_VERSION);
    ImGui::TextUnformatted("Licence: MIT");
    if (ImGui::Button("Close") || escapePressed()) ImGui::CloseCurrentPopup();
    notePlace("about:close");
    ImGui::EndPopup();
}

}  // namespace conelight::program
