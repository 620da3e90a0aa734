// SPDX-License-Identifier: MIT
#include "viewer/file_dialog.h"

#include <fmt/core.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <utility>

#include "console/names.h"
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

std::string sizeText(std::uintmax_t bytes) {
    const auto kib = static_cast<double>(bytes) / 1024;
    return kib < 1000 ? fmt::format("{:.0f} KiB", std::ceil(kib)) : fmt::format("{:.1f} MiB", kib / 1024);
}

std::string changedText(fs::file_time_type time) {
    const auto wall = std::chrono::time_point_cast<std::chrono::seconds>(
        time - fs::file_time_type::clock::now() + std::chrono::system_clock::now());
    const std::time_t seconds = std::chrono::system_clock::to_time_t(wall);
    std::tm local{};
    localtime_r(&seconds, &local);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%d %H:%M", &local);
    return text;
}

std::string homeFolder() {
    const char* home = std::getenv("HOME");
    return home != nullptr && home[0] == '/' ? home : "";
}

std::string withoutTilde(const std::string& path) {
    const bool home = path == "~" || path.rfind("~/", 0) == 0;
    return home ? homeFolder() + path.substr(1) : path;
}

bool containsText(std::string name, std::string part) {
    const auto lower = [](unsigned char c) { return static_cast<char>(std::tolower(c)); };
    std::transform(name.begin(), name.end(), name.begin(), lower);
    std::transform(part.begin(), part.end(), part.begin(), lower);
    return name.find(part) != std::string::npos;
}

// What the box's keys need of the dialog.
struct BoxKeys {
    std::string folder;
    int step = 0;
};

// As far as all that begins so agree.
std::string completed(const std::string& typed, const std::string& folder) {
    const std::string path = withoutTilde(typed);
    const bool whole = fs::path(path).is_absolute();
    const std::string base = whole ? "" : folder + (folder.ends_with('/') ? "" : "/");
    std::string common;
    bool first = true;
    for (const std::string& file : filesFor(base + path)) {
        if (file.rfind(base + path, 0) != 0) continue;
        if (std::exchange(first, false)) common = file;
        const auto end = std::mismatch(common.begin(), common.end(), file.begin(), file.end()).first;
        common.erase(end, common.end());
    }
    return common.size() > base.size() + path.size() ? common.substr(base.size()) : typed;
}

int onBoxKey(ImGuiInputTextCallbackData* data) {
    auto* const keys = static_cast<BoxKeys*>(data->UserData);
    if (data->EventFlag == ImGuiInputTextFlags_CallbackHistory)
        keys->step = data->EventKey == ImGuiKey_DownArrow ? 1 : -1;
    if (data->EventFlag != ImGuiInputTextFlags_CallbackCompletion) return 0;
    const std::string whole =
        completed(std::string(data->Buf, static_cast<std::size_t>(data->BufTextLen)), keys->folder);
    data->DeleteChars(0, data->BufTextLen);
    data->InsertChars(0, whole.c_str());
    return 0;
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
    previewed_.clear();
    marked_ = -1;
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        std::error_code ignored;
        Entry entry{it->path().filename().string(), it->is_directory(ignored), 0, {}};
        if (entry.name.front() == '.' || (!entry.isFolder && !isOffered(it->path(), infoOf(purpose_))))
            continue;
        if (!entry.isFolder) entry.bytes = it->file_size(ignored);
        entry.time = it->last_write_time(ignored);
        entries_.push_back(std::move(entry));
    }
    sort();
}

// Folders first, "..", which leads out, before all.
void FileDialog::sort() {
    std::erase_if(entries_, [](const Entry& entry) { return entry.name == ".."; });
    std::sort(entries_.begin(), entries_.end(), [&](const Entry& a, const Entry& b) {
        if (a.isFolder != b.isFolder) return a.isFolder;
        const Entry &first = backwards_ ? b : a, &second = backwards_ ? a : b;
        if (order_ == Order::Size && a.bytes != b.bytes) return first.bytes < second.bytes;
        if (order_ == Order::Time && a.time != b.time) return first.time < second.time;
        return first.name < second.name;
    });
    if (fs::path(folder_).has_relative_path()) entries_.insert(entries_.begin(), {"..", true, 0, {}});
}

// What stands in the box, as a path: names without a folder are in the one that is shown.
std::string FileDialog::typedPath() const {
    const std::string typed = withoutTilde(typed_);
    if (typed.rfind("builtin:", 0) == 0 || fs::path(typed).is_absolute()) return typed;
    return (fs::path(folder_) / typed).lexically_normal().string();
}

// Part of a name in the box leaves those that have it.
std::vector<const FileDialog::Entry*> FileDialog::offered() const {
    const bool reads = infoOf(purpose_).button == nullptr;
    const bool filters = reads && typed_.find_first_of("/~:") == std::string::npos;
    std::vector<const Entry*> list;
    for (const Entry& entry : entries_)
        if (!filters || entry.name == ".." || containsText(entry.name, typed_)) list.push_back(&entry);
    return list;
}

// Tab completes, arrows go through the list. Returns whether Return was pressed.
bool FileDialog::nameBox() {
    const PurposeInfo& info = infoOf(purpose_);
    BoxKeys keys{folder_};
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(-1);
    const std::string before = typed_;
    const bool entered = ImGui::InputTextWithHint(
        "##path", info.hint, &typed_,
        ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll |
            ImGuiInputTextFlags_CallbackCompletion | ImGuiInputTextFlags_CallbackHistory,
        onBoxKey, &keys);
    notePlace("dialog:name");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s; Tab completes a path", info.hint);
    if (typed_ != before) marked_ = -1;
    const int count = static_cast<int>(offered().size());
    if (keys.step != 0 && count > 0) marked_ = std::clamp(marked_ + keys.step, 0, count - 1);
    return entered;
}

void FileDialog::listPlaces(std::string& next) const {
    std::error_code ignored;
    std::vector<std::pair<std::string, std::string>> places = {
        {"home", homeFolder()}, {"working folder", fs::current_path(ignored).string()}};
    for (const std::string& scene : recent_) {
        const fs::path folder = fs::path(scene).parent_path();
        const bool known = std::any_of(places.begin(), places.end(),
                                       [&](const auto& place) { return place.second == folder.string(); });
        if (folder.is_absolute() && !known) places.emplace_back(folder.filename().string(), folder.string());
    }
    for (const auto& [name, folder] : places) {
        if (folder.empty()) continue;
        if (ImGui::Selectable((name + "##" + folder).c_str(), folder == folder_, kKeepPopup)) next = folder;
        notePlace("place:" + name);
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", folder.c_str());
    }
}

void FileDialog::listGenerated(std::optional<std::string>& chosen) {
    for (const io::GeneratedSceneInfo& scene : io::generatedScenes()) {
        const std::string name(scene.name);
        if (ImGui::Selectable(name.c_str(), false, kKeepPopup)) chosen = "builtin:" + name;
        notePlace("file:builtin:" + name);
        if (ImGui::IsItemHovered()) previewed_ = "builtin:" + name;
    }
}

// A click sorts by it, a second one the other way round.
void FileDialog::header() {
    const std::pair<const char*, Order> columns[] = {
        {"name", Order::Name}, {"size", Order::Size}, {"changed", Order::Time}};
    const float em = ImGui::GetFontSize();
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("size", ImGuiTableColumnFlags_WidthFixed, 5 * em);
    ImGui::TableSetupColumn("changed", ImGuiTableColumnFlags_WidthFixed, 8.5f * em);
    ImGui::TableNextRow();
    for (const auto& [name, order] : columns) {
        ImGui::TableNextColumn();
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const bool pressed = ImGui::Selectable((std::string(name) + "##sort").c_str(), false, kKeepPopup);
        if (order == order_) {
            const float x = at.x + ImGui::CalcTextSize(name).x + 0.8f * em, y = at.y + 0.5f * em;
            const float tip = (backwards_ ? -0.2f : 0.2f) * em;
            ImGui::GetWindowDrawList()->AddTriangleFilled({x - 0.3f * em, y - tip}, {x + 0.3f * em, y - tip},
                                                          {x, y + tip}, ImGui::GetColorU32(ImGuiCol_Text));
        }
        if (pressed) {
            backwards_ = order == order_ && !backwards_;
            order_ = order;
            sort();
        }
        notePlace(std::string("sort:") + name);
    }
}

// Returns whether it was pressed.
bool FileDialog::row(const Entry& entry, bool marked) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const std::string shown = entry.isFolder ? entry.name + "/" : entry.name;
    const bool pressed =
        ImGui::Selectable(shown.c_str(), marked, kKeepPopup | ImGuiSelectableFlags_SpanAllColumns);
    notePlace("file:" + entry.name);
    if ((ImGui::IsItemHovered() || marked) && !entry.isFolder)
        previewed_ = (fs::path(folder_) / entry.name).lexically_normal().string();
    ImGui::TableNextColumn();
    if (!entry.isFolder) ImGui::TextDisabled("%s", sizeText(entry.bytes).c_str());
    ImGui::TableNextColumn();
    if (entry.name != "..") ImGui::TextDisabled("%s", changedText(entry.time).c_str());
    return pressed;
}

void FileDialog::listFiles(float width, float height, std::optional<std::string>& chosen) {
    const bool reads = infoOf(purpose_).button == nullptr;
    std::string next;
    ImGui::BeginChild("##files", {width, height});
    if (ImGui::BeginTable("##table", 3)) {
        header();
        int index = 0;
        for (const Entry* entry : offered()) {
            if (!row(*entry, index++ == marked_)) continue;
            const std::string path = (fs::path(folder_) / entry->name).lexically_normal().string();
            if (entry->isFolder)
                next = path;
            else if (reads)
                chosen = path;
            else
                typed_ = entry->name;
        }
        ImGui::EndTable();
    }
    ImGui::EndChild();
    if (next.empty()) return;
    if (reads) typed_.clear();
    enter(fs::path(next).has_filename() ? next : fs::path(next).parent_path().string());
}

void FileDialog::preview() {
    ImGui::BeginChild("##preview", {0, -ImGui::GetFrameHeightWithSpacing()});
    if (!previewed_.empty()) {
        const float width = ImGui::GetContentRegionAvail().x;
        thumbnails_.show(previewed_, width);
        ImGui::PushTextWrapPos(0);
        ImGui::TextDisabled("%s", fs::path(previewed_).filename().c_str());
        ImGui::PopTextWrapPos();
    }
    ImGui::EndChild();
}

// A file that would be replaced is named on the button, and Return alone does not do it.
void FileDialog::footer(std::optional<std::string>& chosen, bool entered) {
    const PurposeInfo& info = infoOf(purpose_);
    std::error_code ignored;
    const bool folder = !typed_.empty() && fs::is_directory(typedPath(), ignored);
    const bool replaces =
        info.button != nullptr && !folder && !typed_.empty() && fs::exists(typedPath(), ignored);
    if (info.button != nullptr) {
        const std::string text = replaces ? "Replace " + typed_ : info.button;
        if (ImGui::Button((text + "###take").c_str()) && !typed_.empty()) chosen = typedPath();
        notePlace("dialog:take");
        ImGui::SameLine();
    }
    const std::vector<const Entry*> list = offered();
    const Entry* const marked =
        marked_ >= 0 && marked_ < static_cast<int>(list.size()) ? list[std::size_t(marked_)] : nullptr;
    if (entered && marked != nullptr) {
        const std::string path = (fs::path(folder_) / marked->name).lexically_normal().string();
        if (marked->isFolder) {
            typed_.clear();
            enter(fs::path(path).has_filename() ? path : fs::path(path).parent_path().string());
        } else {
            chosen = path;
        }
    } else if (entered && folder) {
        enter(fs::path(typedPath()).lexically_normal().string());
        typed_.clear();
    } else if (entered && !typed_.empty() && !replaces) {
        chosen = typedPath();
    }
    if (ImGui::Button("Cancel") || escapePressed() || chosen) ImGui::CloseCurrentPopup();
    notePlace("dialog:cancel");
}

std::optional<FileChoice> FileDialog::show() {
    const PurposeInfo& info = infoOf(purpose_);
    if (wanted_) ImGui::OpenPopup(info.title);
    wanted_ = false;
    const float em = ImGui::GetFontSize();
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const bool scenes = purpose_ == FilePurpose::OpenScene || purpose_ == FilePurpose::ImportScene;
    ImGui::SetNextWindowSize({std::min((scenes ? 64 : 40) * em, display.x), std::min(30 * em, display.y)},
                             ImGuiCond_Appearing);
    ImGui::SetNextWindowPos({0.5f * display.x, 0.5f * display.y}, ImGuiCond_Appearing, {0.5f, 0.5f});
    shown_ = ImGui::BeginPopupModal(info.title);
    if (!shown_) return std::nullopt;
    std::optional<std::string> chosen;
    const bool entered = nameBox();
    ImGui::TextDisabled("%s", folder_.c_str());
    const float footerHeight = -ImGui::GetFrameHeightWithSpacing();
    if (scenes) {
        std::string next;
        ImGui::BeginChild("##places", {10 * em, footerHeight});
        ImGui::TextDisabled("places");
        listPlaces(next);
        ImGui::TextDisabled("generated");
        ImGui::BeginChild("##builtin");
        listGenerated(chosen);
        ImGui::EndChild();
        ImGui::EndChild();
        ImGui::SameLine();
        if (!next.empty()) enter(next);
    }
    const float room = ImGui::GetContentRegionAvail().x;
    listFiles(scenes ? room - std::min(18 * em, 0.4f * room) : 0, footerHeight, chosen);
    if (scenes) {
        ImGui::SameLine();
        preview();
    }
    footer(chosen, entered);
    ImGui::EndPopup();
    if (!chosen) return std::nullopt;
    return FileChoice{purpose_, *chosen};
}

}  // namespace conelight::program
