// SPDX-License-Identifier: MIT
#include "viewer/file_dialog.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "io/generated.h"
#include "io/scene_file.h"
#include "viewer/imgui_names.h"
#include "viewer/widget_places.h"

namespace conelight::program {
namespace {

namespace fs = std::filesystem;

struct PurposeInfo {
    const char* title;
    const char* hint;
    const char* button;  // null: files to read, a click on one takes it
    const char* suggested;
    std::vector<std::string> endings;  // of files that are offered
};

const PurposeInfo& infoOf(FilePurpose purpose) {
    static const std::vector<PurposeInfo> kInfos = {
        {"Open a scene", "a file, or builtin:NAME", nullptr, "", io::sceneExtensions()},
        {"Save the scene",
         "a name ending in .glb, .gltf, or .txt (the thesis's format)",
         "Save",
         "scene.glb",
         {".glb", ".gltf", ".txt"}},
        {"Load a preset", "a file of settings (.json)", nullptr, "", {".json"}},
        {"Save the settings", "a name ending in .json", "Save", "preset.json", {".json"}},
        {"Load a camera path", "a file of key frames (.json)", nullptr, "", {".json"}},
        {"Save the camera path", "a name ending in .json", "Save", "path.json", {".json"}},
        {"Record along the camera path",
         "a name ending in .mp4, or numbered pictures: frame%04d.png",
         "Record",
         "path.mp4",
         {".mp4"}},
        {"Record a turn round the target",
         "a name ending in .mp4, or numbered pictures: frame%04d.png",
         "Record",
         "turntable.mp4",
         {".mp4"}},
        {"Import into the scene", "a file, or builtin:NAME", nullptr, "", io::sceneExtensions()}};
    return kInfos[static_cast<std::size_t>(purpose)];
}

// What is offered; any file can be named in the box.
bool isOffered(const fs::path& file, const PurposeInfo& info) {
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return std::find(info.endings.begin(), info.endings.end(), ending) != info.endings.end();
}

}  // namespace

void FileDialog::open(FilePurpose purpose, const std::string& near) {
    wanted_ = true;
    purpose_ = purpose;
    typed_ = infoOf(purpose).suggested;
    std::error_code error;
    const fs::path folder = fs::absolute(near, error).parent_path();
    const bool known = !error && fs::is_directory(folder, error) && near.rfind("builtin:", 0) != 0;
    enter(known ? folder.string() : fs::current_path(error).string());
}

void FileDialog::enter(const std::string& folder) {
    folder_ = folder;
    entries_.clear();
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        std::error_code ignored;
        const std::string name = it->path().filename().string();
        const bool isFolder = it->is_directory(ignored);
        if (name.front() != '.' && (isFolder || isOffered(it->path(), infoOf(purpose_))))
            entries_.push_back({name, isFolder});
    }
    std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
        return a.isFolder != b.isFolder ? a.isFolder : a.name < b.name;
    });
    if (fs::path(folder).has_relative_path()) entries_.insert(entries_.begin(), {"..", true});
}

// What stands in the box, as a path: names without a folder are in the one that is shown.
std::string FileDialog::typedPath() const {
    if (typed_.rfind("builtin:", 0) == 0 || fs::path(typed_).is_absolute()) return typed_;
    return (fs::path(folder_) / typed_).lexically_normal().string();
}

void FileDialog::listFiles(float width, float height, std::optional<std::string>& chosen) {
    const bool reads = infoOf(purpose_).button == nullptr;
    ImGui::BeginChild("##files", {width, height});
    std::string next;
    for (const Entry& entry : entries_) {
        const std::string shown = entry.isFolder ? entry.name + "/" : entry.name;
        const bool pressed = ImGui::Selectable(shown.c_str(), false, kKeepPopup);
        notePlace("file:" + entry.name);
        if (!pressed) continue;
        const std::string path = (fs::path(folder_) / entry.name).lexically_normal().string();
        if (entry.isFolder)
            next = path;
        else if (reads)
            chosen = path;
        else
            typed_ = entry.name;
    }
    ImGui::EndChild();
    if (!next.empty()) enter(fs::path(next).has_filename() ? next : fs::path(next).parent_path().string());
}

std::optional<FileChoice> FileDialog::show() {
    const PurposeInfo& info = infoOf(purpose_);
    if (wanted_) ImGui::OpenPopup(info.title);
    wanted_ = false;
    const float em = ImGui::GetFontSize();
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowSize({std::min(36 * em, display.x), std::min(26 * em, display.y)},
                             ImGuiCond_Appearing);
    ImGui::SetNextWindowPos({0.5f * display.x, 0.5f * display.y}, ImGuiCond_Appearing, {0.5f, 0.5f});
    shown_ = ImGui::BeginPopupModal(info.title);
    if (!shown_) return std::nullopt;
    std::optional<std::string> chosen;
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(-1);
    const bool entered =
        ImGui::InputTextWithHint("##path", info.hint, &typed_,
                                 ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    notePlace("dialog:name");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", info.hint);
    ImGui::TextDisabled("%s", folder_.c_str());

    const bool scenes = purpose_ == FilePurpose::OpenScene || purpose_ == FilePurpose::ImportScene;
    const float footer = -ImGui::GetFrameHeightWithSpacing();
    listFiles(scenes ? 0.68f * ImGui::GetContentRegionAvail().x : 0, footer, chosen);
    if (scenes) {
        ImGui::SameLine();
        ImGui::BeginChild("##builtin", {0, footer});
        ImGui::TextDisabled("generated");
        for (const io::GeneratedSceneInfo& scene : io::generatedScenes()) {
            const std::string name(scene.name);
            if (ImGui::Selectable(name.c_str(), false, kKeepPopup)) chosen = "builtin:" + name;
            notePlace("file:builtin:" + name);
        }
        ImGui::EndChild();
    }
    // A file that would be replaced is named on the button, and Return alone does not do it.
    std::error_code ignored;
    const bool replaces = info.button != nullptr && !typed_.empty() && fs::exists(typedPath(), ignored);
    if (info.button != nullptr) {
        const std::string text = replaces ? "Replace " + typed_ : info.button;
        if (ImGui::Button((text + "###take").c_str()) && !typed_.empty()) chosen = typedPath();
        notePlace("dialog:take");
        ImGui::SameLine();
    }
    if (entered && !typed_.empty() && !replaces) chosen = typedPath();
    if (ImGui::Button("Cancel") || escapePressed() || chosen) ImGui::CloseCurrentPopup();
    notePlace("dialog:cancel");
    ImGui::EndPopup();
    if (!chosen) return std::nullopt;
    return FileChoice{purpose_, *chosen};
}

}  // namespace conelight::program
