// SPDX-License-Identifier: MIT
#include "viewer/document.h"

#include <fmt/core.h>
#include <imgui.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <utility>

#include "console/statements.h"
#include "io/files.h"
#include "picture_input.h"
#include "viewer/imgui_names.h"
#include "viewer/widget_places.h"

namespace conelight::program {
namespace {

// What was chosen is done by the console's commands, which say how it went.
std::string commandFor(const FileChoice& choice, int filmFrames) {
    const std::string file = quoted(choice.file);
    switch (choice.purpose) {
        case FilePurpose::SaveScene:
            return "save " + file + " overwrite";
        case FilePurpose::LoadPreset:
            return "preset load " + file;
        case FilePurpose::SavePreset:
            return "preset save " + file + " overwrite";
        case FilePurpose::LoadPath:
            return "path load " + file;
        case FilePurpose::SavePath:
            return "path save " + file + " overwrite";
        case FilePurpose::RecordPath:
            return fmt::format("record {} {} path", file, filmFrames);
        case FilePurpose::RecordTurntable:
            return fmt::format("record {} {} turntable", file, filmFrames);
        case FilePurpose::ImportScene:
            return "import " + file;
        case FilePurpose::OpenScene:  // asks about unsaved changes first
            break;
    }
    return {};
}

}  // namespace

// With Shift into the scene, else in its place; of several files the first is opened, all are added.
void Document::drop(const std::vector<std::string>& files) {
    const bool adds = in_.window.isKeyDown(GLFW_KEY_LEFT_SHIFT) || in_.window.isKeyDown(GLFW_KEY_RIGHT_SHIFT);
    if (!files.empty() && io::lowerExtension(files.front()) == ".ies") return dropProfile(files.front());
    if (!adds && !files.empty()) return open(files.front());
    for (const std::string& file : files) take({FilePurpose::ImportScene, file});
}

// On the lights that are selected.
void Document::dropProfile(const std::string& file) {
    const Session& session = in_.session;
    const std::vector<std::size_t> lights = session.selectedOf(SelectionKind::Light);
    if (lights.empty()) in_.console.say(file + ": a profile is for a point light or spot; select one first");
    for (const std::size_t light : lights)
        in_.console.run("light " + quoted(session.scene().lights[light].name) + " profile " + quoted(file));
}

void Document::take(const FileChoice& choice) {
    if (choice.purpose == FilePurpose::OpenScene)
        open(choice.file);
    else
        in_.console.run(commandFor(choice, in_.film.frames));
}

// The view stays when the file is read again.
void Document::follow() {
    const std::string& scene = in_.session.path();
    watch_.setScene(scene);
    // What this program saved is what it shows.
    if (std::exchange(savesSeen_, in_.session.saves()) != in_.session.saves()) watch_.acceptScene();
    if (watch_.sceneChanged()) reload();

    std::string title =
        scene.empty() ? "Conelight" : scene + (in_.session.unsaved() ? " * - Conelight" : " - Conelight");
    if (title != title_) in_.window.setTitle(title_ = std::move(title));
    if (scene == remembered_) return;
    remembered_ = scene;
    in_.state.opened(remembered_);
}

void Document::open(const std::string& file) {
    if (isPictureFile(file)) return in_.console.run("keep " + quoted(file) + "; flip on");
    leave({Leaving::To::OtherScene, file});
}

void Document::leave(const Leaving& leaving) {
    if (!in_.session.unsaved()) return leaveNow(leaving);
    leaving_ = leaving;
    savesFirst_ = false;
    in_.window.show();
}

void Document::leaveNow(Leaving leaving) {
    leaving_.reset();
    if (leaving.to == Leaving::To::End) {
        in_.ending.asked = true;
        return;
    }
    Request request{RequestKind::Load};
    request.file = std::move(leaving.file);
    request.keepView = leaving.to == Leaving::To::FileAsChanged;
    in_.session.request(request);
}

void Document::showDialogs() {
    if (const std::optional<FileChoice> choice = files_.show()) take(*choice);
    if (const std::optional<std::string> line = picture_.show(in_.session)) in_.console.run(*line);
    if (leaving_ && savesFirst_)
        followSaving();
    else if (leaving_)
        showQuestion();
}

void Document::followSaving() {
    if (!in_.session.unsaved())
        leaveNow(*leaving_);
    else if (!files_.isOpen() && in_.console.commands().idle())
        leaving_.reset();  // not saved after all
}

// Whether changes of the scene may be lost.
void Document::showQuestion() {
    constexpr const char* kTitle = "Changes that are not saved";
    const bool reloads = leaving_->to == Leaving::To::FileAsChanged;
    if (!ImGui::IsPopupOpen(kTitle)) ImGui::OpenPopup(kTitle);
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * display.x, 0.5f * display.y}, ImGuiCond_Appearing, {0.5f, 0.5f});
    if (!ImGui::BeginPopupModal(kTitle, nullptr, ImGuiWindowFlags_AlwaysAutoResize)) return;
    if (reloads) ImGui::Text("%s is to be read again.", in_.session.path().c_str());
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
        ask(FilePurpose::SaveScene);
    } else if (leaves) {
        leaveNow(*leaving_);
    } else if (stays) {
        leaving_.reset();
    }
}

}  // namespace conelight::program
