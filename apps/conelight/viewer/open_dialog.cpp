// SPDX-License-Identifier: MIT
#include "viewer/open_dialog.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "io/generated.h"
#include "io/scene_file.h"

namespace conelight::program {
namespace {

namespace fs = std::filesystem;

// What is offered; any file can be named in the box.
bool mayBeScene(const fs::path& file) {
    static const std::vector<std::string> kEndings = io::sceneExtensions();
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return std::binary_search(kEndings.begin(), kEndings.end(), ending);
}

}  // namespace

void OpenDialog::open(const std::string& scene) {
    wanted_ = true;
    typed_.clear();
    std::error_code error;
    const fs::path folder = fs::absolute(scene, error).parent_path();
    enter(!error && fs::is_directory(folder, error) ? folder.string() : fs::current_path(error).string());
}

void OpenDialog::enter(const std::string& folder) {
    folder_ = folder;
    entries_.clear();
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        std::error_code ignored;
        const std::string name = it->path().filename().string();
        const bool isFolder = it->is_directory(ignored);
        if (name.front() != '.' && (isFolder || mayBeScene(it->path()))) entries_.push_back({name, isFolder});
    }
    std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
        return a.isFolder != b.isFolder ? a.isFolder : a.name < b.name;
    });
    if (fs::path(folder).has_relative_path()) entries_.insert(entries_.begin(), {"..", true});
}

std::optional<std::string> OpenDialog::show() {
    if (wanted_) ImGui::OpenPopup("Open a scene");
    wanted_ = false;
    std::optional<std::string> chosen;
    const float em = ImGui::GetFontSize();
    ImGui::SetNextWindowSize({36 * em, 26 * em}, ImGuiCond_Appearing);
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * display.x, 0.5f * display.y}, ImGuiCond_Appearing, {0.5f, 0.5f});
    if (!ImGui::BeginPopupModal("Open a scene")) return chosen;
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(-1);
    if (ImGui::InputTextWithHint("##path", "a file, or builtin:NAME", &typed_,
                                 ImGuiInputTextFlags_EnterReturnsTrue) &&
        !typed_.empty())
        chosen = typed_;
    ImGui::TextDisabled("%s", folder_.c_str());

    ImGui::BeginChild("##files", {0.68f * ImGui::GetContentRegionAvail().x, -1.8f * em});
    std::string next;
    for (const Entry& entry : entries_) {
        const std::string shown = entry.isFolder ? entry.name + "/" : entry.name;
        if (!ImGui::Selectable(shown.c_str(), false, ImGuiSelectableFlags_DontClosePopups)) continue;
        const std::string path = (fs::path(folder_) / entry.name).lexically_normal().string();
        if (entry.isFolder)
            next = path;
        else
            chosen = path;
    }
    ImGui::EndChild();
    ImGui::SameLine();
    ImGui::BeginChild("##builtin", {0, -1.8f * em});
    ImGui::TextDisabled("generated");
    for (const io::GeneratedSceneInfo& scene : io::generatedScenes()) {
        const std::string name(scene.name);
        if (ImGui::Selectable(name.c_str(), false, ImGuiSelectableFlags_DontClosePopups))
            chosen = "builtin:" + name;
    }
    ImGui::EndChild();
    if (!next.empty()) enter(fs::path(next).has_filename() ? next : fs::path(next).parent_path().string());
    if (ImGui::Button("Cancel") || chosen) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    return chosen;
}

}  // namespace conelight::program
