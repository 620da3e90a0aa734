// SPDX-License-Identifier: MIT
// Menu and keys, and the dialog that they open.
#include <fmt/core.h>
#include <imgui.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <utility>

#include "viewer/imgui_names.h"
#include "viewer/viewer_window.h"
#include "viewer/widget_places.h"

namespace conelight::program {
namespace {

constexpr float kTextStep = 1.1f;

}  // namespace

void Viewer::keys() {
    const std::vector<platform::Window::KeyPress> presses = window_.takeKeyPresses();
    // Whoever typed `path play` still has the cursor in the console's line.
    for (const auto& press : presses)
        if (press.key == GLFW_KEY_ESCAPE && session_.playing()) {
            session_.stopPlaying();
            if (gui_.wantsKeyboard()) console_.focus();
        }
    if (gui_.wantsKeyboard() || window_.cursorCaptured()) return;
    for (const auto& press : presses) {
        if (press.key == GLFW_KEY_F && !press.control) focus();
        if (press.key >= GLFW_KEY_1 && press.key <= GLFW_KEY_3 && !press.control)
            view_.gizmo.tool = static_cast<GizmoTool>(press.key - GLFW_KEY_1);
        if (press.key == GLFW_KEY_F11) window_.setFullscreen(!window_.fullscreen());
        if (press.key == GLFW_KEY_TAB) showSide_ = showConsole_ = !showSide_;
        if (press.key == GLFW_KEY_X && !press.control) view_.split.on = !view_.split.on;
        if (press.key == GLFW_KEY_Z && press.control) press.shift ? session_.redo() : session_.undo();
        if (press.key == GLFW_KEY_Y && press.control) session_.redo();
        if (press.key == GLFW_KEY_O && press.control)
            fileDialog_.open(FilePurpose::OpenScene, session_.path());
        if (press.control && (press.key == GLFW_KEY_EQUAL || press.key == GLFW_KEY_KP_ADD))
            gui_.setScale(gui_.scale() * kTextStep);
        if (press.control && (press.key == GLFW_KEY_MINUS || press.key == GLFW_KEY_KP_SUBTRACT))
            gui_.setScale(gui_.scale() / kTextStep);
        if (press.key == GLFW_KEY_S && press.control)
            fileDialog_.open(FilePurpose::SaveScene, session_.path());
        if (press.key == GLFW_KEY_P && !press.control)
            session_.request({RequestKind::Screenshot, nextScreenshot()});
    }
}

void Viewer::menuBar() {
    if (!ImGui::BeginMainMenuBar()) return;
    fileMenu();
    const bool edit = ImGui::BeginMenu("Edit");
    notePlace("menu:Edit");
    if (edit) {
        if (ImGui::MenuItem("Undo", "Ctrl+Z", false, session_.undoSteps() > 0)) session_.undo();
        notePlace("menu:Undo");
        if (ImGui::MenuItem("Redo", "Ctrl+Y", false, session_.redoSteps() > 0)) session_.redo();
        notePlace("menu:Redo");
        ImGui::EndMenu();
    }
    const bool view = ImGui::BeginMenu("View");
    notePlace("menu:View");
    if (view) {
        if (ImGui::MenuItem("Focus", "F")) focus();
        const auto tool = [&](const char* name, const char* key, GizmoTool one) {
            if (ImGui::MenuItem(name, key, view_.gizmo.tool == one)) view_.gizmo.tool = one;
        };
        ImGui::Separator();
        tool("Move", "1", GizmoTool::Move);
        tool("Turn", "2", GizmoTool::Turn);
        tool("Scale", "3", GizmoTool::Scale);
        ImGui::Separator();
        ImGui::MenuItem("Split", "X", &view_.split.on);
        ImGui::MenuItem("Panels", "Tab", &showSide_);
        ImGui::MenuItem("Console", nullptr, &showConsole_);
        ImGui::Separator();
        if (ImGui::MenuItem("Larger text", "Ctrl++")) gui_.setScale(gui_.scale() * kTextStep);
        if (ImGui::MenuItem("Smaller text", "Ctrl+-")) gui_.setScale(gui_.scale() / kTextStep);
        if (ImGui::MenuItem("Fullscreen", "F11")) window_.setFullscreen(!window_.fullscreen());
        ImGui::EndMenu();
    }
    modeControls();
    ImGui::EndMainMenuBar();
}

void Viewer::fileMenu() {
    const bool open = ImGui::BeginMenu("File");
    notePlace("menu:File");
    if (!open) return;
    if (ImGui::MenuItem("Open...", "Ctrl+O")) fileDialog_.open(FilePurpose::OpenScene, session_.path());
    notePlace("menu:Open");
    if (ImGui::BeginMenu("Open recent", !state_.recent().empty())) {
        for (const std::string& scene : state_.recent()) {
            if (ImGui::MenuItem(scene.c_str())) openScene(scene);
            notePlace("recent:" + scene);
        }
        ImGui::EndMenu();
    }
    notePlace("menu:Open recent");
    if (ImGui::MenuItem("Reload", nullptr, false, !session_.path().empty())) reload();
    if (ImGui::MenuItem("Save scene as...", "Ctrl+S"))
        fileDialog_.open(FilePurpose::SaveScene, session_.path());
    notePlace("menu:Save scene");
    ImGui::Separator();
    presetMenu();
    ImGui::Separator();
    if (ImGui::MenuItem("Screenshot", "P")) session_.request({RequestKind::Screenshot, nextScreenshot()});
    ImGui::Separator();
    if (ImGui::MenuItem("Quit")) leave({});
    notePlace("menu:Quit");
    ImGui::EndMenu();
}

// Settings as files: those of the current folder are in reach.
void Viewer::presetMenu() {
    const bool open = ImGui::BeginMenu("Presets");
    notePlace("menu:Presets");
    if (!open) return;
    if (ImGui::IsWindowAppearing()) attempt([&] { presets_ = presetsIn("."); });
    if (ImGui::MenuItem("Save settings as...")) fileDialog_.open(FilePurpose::SavePreset, session_.path());
    notePlace("menu:Save settings");
    if (ImGui::MenuItem("Load...")) fileDialog_.open(FilePurpose::LoadPreset, session_.path());
    notePlace("menu:Load preset");
    if (ImGui::MenuItem("Back to the scene's own")) runLine("reset");
    notePlace("menu:Reset");
    if (!presets_.empty()) ImGui::Separator();
    for (const std::string& name : presets_) {
        if (ImGui::MenuItem(name.c_str())) runLine("preset load " + quoted(name));
        notePlace("preset:" + name);
    }
    ImGui::EndMenu();
}

// What was chosen in the dialog is done by the console's commands, which say how it went.
void Viewer::takeFile(const FileChoice& choice) {
    const std::string file = quoted(choice.file);
    switch (choice.purpose) {
        case FilePurpose::OpenScene:
            return openScene(choice.file);
        case FilePurpose::SaveScene:
            return runLine("save " + file + " overwrite");
        case FilePurpose::LoadPreset:
            return runLine("preset load " + file);
        case FilePurpose::SavePreset:
            return runLine("preset save " + file + " overwrite");
        case FilePurpose::LoadPath:
            return runLine("path load " + file);
        case FilePurpose::SavePath:
            return runLine("path save " + file + " overwrite");
        case FilePurpose::RecordPath:
            return runLine(fmt::format("record {} {} path", file, filmFrames_));
        case FilePurpose::RecordTurntable:
            return runLine(fmt::format("record {} {} turntable", file, filmFrames_));
    }
}

void Viewer::leave(const Leaving& leaving) {
    if (!session_.unsaved()) return leaveNow(leaving);
    leaving_ = leaving;
    savesFirst_ = false;
    window_.show();
}

void Viewer::leaveNow(Leaving leaving) {
    leaving_.reset();
    if (leaving.to == Leaving::To::End) {
        end_.quit = true;
        return;
    }
    Request request{RequestKind::Load};
    request.file = std::move(leaving.file);
    request.keepView = leaving.to == Leaving::To::FileAsChanged;
    session_.request(request);
}

// Whether changes of the scene may be lost.
void Viewer::unsavedQuestion() {
    if (!leaving_) return;
    if (savesFirst_) {
        if (!session_.unsaved())
            leaveNow(*leaving_);
        else if (!fileDialog_.isOpen() && commands_.idle())
            leaving_.reset();  // not saved after all
        return;
    }
    constexpr const char* kTitle = "Changes that are not saved";
    const bool reloads = leaving_->to == Leaving::To::FileAsChanged;
    if (!ImGui::IsPopupOpen(kTitle)) ImGui::OpenPopup(kTitle);
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * display.x, 0.5f * display.y}, ImGuiCond_Appearing, {0.5f, 0.5f});
    if (!ImGui::BeginPopupModal(kTitle, nullptr, ImGuiWindowFlags_AlwaysAutoResize)) return;
    if (reloads) ImGui::Text("%s is to be read again.", session_.path().c_str());
    ImGui::TextUnformatted("The scene has changes that are in no file.");
    const auto button = [](const char* text, const char* place) {
        const bool pressed = ImGui::Button(text);
        notePlace(place);
        ImGui::SameLine();
        return pressed;
    };
    const bool saves = button("Save as...", "unsaved:save");
    const bool leaves = button(leaving_->to == Leaving::To::End          ? "Quit without them"
                               : leaving_->to == Leaving::To::OtherScene ? "Open without them"
                                                                         : "Read the file, lose them",
                               "unsaved:lose");
    const bool stays = button(reloads ? "Keep them" : "Cancel", "unsaved:stay") || escapePressed();
    if (saves || leaves || stays) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    if (saves) {
        savesFirst_ = true;
        fileDialog_.open(FilePurpose::SaveScene, session_.path());
    } else if (leaves) {
        leaveNow(*leaving_);
    } else if (stays) {
        leaving_.reset();
    }
}

void Viewer::runLine(const std::string& line) {
    console_.say("> " + line);
    commands_.submit(line);
}

void Viewer::modeControls() {
    const float em = ImGui::GetFontSize();
    ImGui::SameLine(0, 2 * em);
    // The names are asked for only while the list is open.
    const auto combo = [&](const char* id, const std::string& value, const auto& namesOf,
                           float width) -> std::optional<std::string> {
        std::optional<std::string> chosen;
        ImGui::SetNextItemWidth(width * em);
        if (ImGui::BeginCombo(id, value.c_str())) {
            for (const std::string& name : namesOf()) {
                if (ImGui::Selectable(name.c_str(), name == value)) chosen = name;
                notePlace("choice:" + name);
                if (const char* text = aboutMode(name); *text != 0 && ImGui::IsItemHovered())
                    ImGui::SetTooltip("%s", text);
            }
            ImGui::EndCombo();
        }
        return chosen;
    };
    if (const auto mode = combo("##mode", session_.mode(), sessionModes, 7))
        attempt([&] { session_.setMode(*mode); });
    notePlace("mode");
    ImGui::SameLine();
    if (const auto name = combo(
            "##component", conelight::getSetting(session_.settings(), "component"),
            [] { return settingChoices("component"); }, 7))
        attempt([&] { session_.setSetting("component", *name); });
    notePlace("component");
    ImGui::SameLine();
    ImGui::Checkbox("split", &view_.split.on);
    notePlace("split on");
    if (!view_.split.on) return;
    ImGui::SameLine();
    if (const auto mode = combo("##right", view_.split.mode, sessionModes, 7)) view_.split.mode = *mode;
    notePlace("split mode");
    ImGui::SameLine();
    ImGui::Checkbox("error", &view_.split.errors);
    notePlace("error");
    if (!view_.split.errors) return;
    ImGui::SameLine();
    ImGui::SetNextItemWidth(6 * em);
    ImGui::SliderFloat("##errorscale", &view_.split.errorScale, 0.05f, 4.0f, "x %.2f",
                       ImGuiSliderFlags_Logarithmic);
}

}  // namespace conelight::program
