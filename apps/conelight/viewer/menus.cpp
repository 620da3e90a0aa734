// SPDX-License-Identifier: MIT
#include "viewer/menus.h"

#include <imgui.h>
#include <imgui_internal.h>  // ClosePopupToLevel
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "session/addition.h"
#include "viewer/focus.h"
#include "viewer/imgui_names.h"
#include "viewer/requests.h"
#include "viewer/standard_views.h"
#include "viewer/widget_places.h"

namespace conelight::program {
namespace {

constexpr float kTextStep = 1.1f;

// Menus and lists; dialogs answer the key themselves.
// Returns whether one is open.
bool closeMenusOnEscape() {
    const bool open = ImGui::GetCurrentContext()->OpenPopupStack.Size > 0;
    if (open && escapePressed() && ImGui::GetTopMostPopupModal() == nullptr)
        ImGui::ClosePopupToLevel(0, true);
    return open;
}

void askForScreenshot(Session& session) { session.request({RequestKind::Screenshot, nextScreenshot()}); }

}  // namespace

void Menus::takeKeys() {
    const bool menuOpen = closeMenusOnEscape();
    const std::vector<platform::Window::KeyEvent>& presses = in_.gui.keyPresses();
    // Whoever typed `path play` still has the cursor in the console's line.
    for (const auto& press : presses)
        if (press.key == GLFW_KEY_ESCAPE && in_.session.playing()) {
            in_.session.stopPlaying();
            if (in_.gui.wantsKeyboard()) in_.console.panel().focus();
            return;
        }
    if (in_.gui.wantsKeyboard() || in_.window.cursorCaptured()) return;
    for (const auto& press : presses)
        if (press.key == GLFW_KEY_ESCAPE && !menuOpen)
            takeEscape();
        else if (!takeViewKey(press))
            press.control() ? takeControlKey(press) : takeKey(press);
}

// First what was found under the pixel, then the selection.
void Menus::takeEscape() {
    if (in_.keys.open)
        in_.keys.open = false;
    else if (in_.probe.found())
        in_.probe.clear();
    else
        in_.session.select({});
}

// Standard views as on the keypad of Blender, and by letters. Returns whether it was one.
bool Menus::takeViewKey(const platform::Window::KeyEvent& press) {
    struct View {
        int letter, keypad;
        const char *side, *other;
    };
    constexpr View kViews[] = {{GLFW_KEY_N, GLFW_KEY_KP_1, "front", "back"},
                               {GLFW_KEY_R, GLFW_KEY_KP_3, "right", "left"},
                               {GLFW_KEY_T, GLFW_KEY_KP_7, "top", "bottom"}};
    for (const View& view : kViews) {
        const bool keypad = press.key == view.keypad, letter = press.key == view.letter && !press.control();
        if (!keypad && !letter) continue;
        viewFrom(in_.session, (keypad ? press.control() : press.shift()) ? view.other : view.side,
                 in_.view.pictureSize());
        return true;
    }
    return false;
}

void Menus::takeKey(const platform::Window::KeyEvent& press) {
    switch (press.key) {
        case GLFW_KEY_F1:
            in_.keys.open = !in_.keys.open;
            return;
        case GLFW_KEY_SLASH:
            in_.keys.open = in_.keys.open != press.shift();
            return;
        case GLFW_KEY_B:
            return in_.console.say("kept the view as the camera " + keepView(in_.session));
        case GLFW_KEY_PAGE_UP:
        case GLFW_KEY_PAGE_DOWN:
            return nextCamera(in_.session, press.key == GLFW_KEY_PAGE_UP);
        case GLFW_KEY_H:
            return in_.console.run(press.shift() ? "isolate" : "hide");
        case GLFW_KEY_DELETE:
            return in_.console.run("delete");
        case GLFW_KEY_F:
            return focusOnSelection(in_.session, in_.view.pictureSize());
        case GLFW_KEY_1:
        case GLFW_KEY_2:
        case GLFW_KEY_3:
            in_.view.gizmo.tool = static_cast<GizmoTool>(press.key - GLFW_KEY_1);
            return;
        case GLFW_KEY_X:
            in_.view.split.on = !in_.view.split.on;
            return;
        case GLFW_KEY_L:
            in_.view.lights.shown = !in_.view.lights.shown;
            return;
        case GLFW_KEY_P:
            return askForScreenshot(in_.session);
        case GLFW_KEY_F11:
            return in_.window.setFullscreen(!in_.window.fullscreen());
        case GLFW_KEY_TAB:
            return in_.panels.showAll(!in_.panels.showSide);
        default:
            return;
    }
}

void Menus::takeControlKey(const platform::Window::KeyEvent& press) {
    switch (press.key) {
        case GLFW_KEY_Z:
            press.shift() ? in_.session.redo() : in_.session.undo();
            return;
        case GLFW_KEY_Y:
            in_.session.redo();
            return;
        case GLFW_KEY_H:
            return in_.console.run("show");
        case GLFW_KEY_D:
            return in_.console.run("duplicate");
        case GLFW_KEY_A:
            return in_.console.run(press.shift() ? "select none" : "select all");
        case GLFW_KEY_I:
            return in_.console.run("select invert");
        case GLFW_KEY_O:
            return in_.document.ask(FilePurpose::OpenScene);
        case GLFW_KEY_S:
            return in_.document.ask(FilePurpose::SaveScene);
        case GLFW_KEY_EQUAL:
        case GLFW_KEY_KP_ADD:
            return in_.gui.setScale(in_.gui.scale() * kTextStep);
        case GLFW_KEY_MINUS:
        case GLFW_KEY_KP_SUBTRACT:
            return in_.gui.setScale(in_.gui.scale() / kTextStep);
        case GLFW_KEY_F11:
            return in_.window.setFullscreen(!in_.window.fullscreen());
        case GLFW_KEY_TAB:
            return in_.panels.showAll(!in_.panels.showSide);
        default:
            return;
    }
}

void Menus::showBar() {
    if (!ImGui::BeginMainMenuBar()) return;
    fileMenu();
    editMenu();
    addMenu();
    viewMenu();
    modeControls(in_.session, in_.view.split, in_.console);
    ImGui::EndMainMenuBar();
}

void Menus::fileMenu() {
    const bool open = ImGui::BeginMenu("File");
    notePlace("menu:File");
    if (!open) return;
    if (ImGui::MenuItem("Open...", "Ctrl+O")) in_.document.ask(FilePurpose::OpenScene);
    notePlace("menu:Open");
    const std::vector<std::string>& recent = in_.document.recent();
    if (ImGui::BeginMenu("Open recent", !recent.empty())) {
        for (const std::string& scene : recent) {
            if (ImGui::MenuItem(scene.c_str())) in_.document.open(scene);
            notePlace("recent:" + scene);
        }
        ImGui::EndMenu();
    }
    notePlace("menu:Open recent");
    if (ImGui::MenuItem("Reload", nullptr, false, !in_.session.path().empty())) in_.document.reload();
    if (ImGui::MenuItem("Save scene as...", "Ctrl+S")) in_.document.ask(FilePurpose::SaveScene);
    notePlace("menu:Save scene");
    ImGui::Separator();
    presetMenu();
    ImGui::Separator();
    if (ImGui::MenuItem("Screenshot", "P")) askForScreenshot(in_.session);
    ImGui::Separator();
    if (ImGui::MenuItem("Quit")) in_.document.quit();
    notePlace("menu:Quit");
    ImGui::EndMenu();
}

// Settings as files: those of the current folder are in reach.
void Menus::presetMenu() {
    const bool open = ImGui::BeginMenu("Presets");
    notePlace("menu:Presets");
    if (!open) return;
    if (ImGui::IsWindowAppearing()) in_.console.attempt([&] { presets_ = presetsIn("."); });
    if (ImGui::MenuItem("Save settings as...")) in_.document.ask(FilePurpose::SavePreset);
    notePlace("menu:Save settings");
    if (ImGui::MenuItem("Load...")) in_.document.ask(FilePurpose::LoadPreset);
    notePlace("menu:Load preset");
    if (ImGui::MenuItem("Back to the scene's own")) in_.console.run("reset");
    notePlace("menu:Reset");
    if (!presets_.empty()) ImGui::Separator();
    for (const std::string& name : presets_) {
        if (ImGui::MenuItem(name.c_str())) in_.console.run("preset load " + quoted(name));
        notePlace("preset:" + name);
    }
    ImGui::EndMenu();
}

void Menus::editMenu() {
    const bool open = ImGui::BeginMenu("Edit");
    notePlace("menu:Edit");
    if (!open) return;
    if (ImGui::MenuItem("Undo", "Ctrl+Z", false, in_.session.undoSteps() > 0)) in_.session.undo();
    notePlace("menu:Undo");
    if (ImGui::MenuItem("Redo", "Ctrl+Y", false, in_.session.redoSteps() > 0)) in_.session.redo();
    notePlace("menu:Redo");
    ImGui::Separator();
    const SelectionKind kind = in_.session.selection().kind;
    const bool some = kind == SelectionKind::Instance || kind == SelectionKind::Light;
    const bool object = !in_.session.selectedOf(SelectionKind::Instance).empty();
    const auto item = [&](const char* text, const char* keys, const char* line, bool enabled) {
        if (ImGui::MenuItem(text, keys, false, enabled)) in_.console.run(line);
        notePlace(std::string("menu:") + text);
    };
    item("Hide", "H", "hide", some);
    item("Hide all others", "Shift+H", "isolate", object);
    item("Show all", "Ctrl+H", "show", true);
    item("Delete", "Del", "delete", some);
    item("Duplicate", "Ctrl+D", "duplicate", some);
    item("Make material single", nullptr, "single_material", object);
    ImGui::Separator();
    item("Select all", "Ctrl+A", "select all", true);
    item("Select none", "Escape", "select none", true);
    item("Invert selection", "Ctrl+I", "select invert", true);
    ImGui::EndMenu();
}

// Shapes and files where the view looks, lights where the eye is.
void Menus::addMenu() {
    const bool open = ImGui::BeginMenu("Add");
    notePlace("menu:Add");
    if (!open) return;
    const auto item = [&](const std::string& kind, const std::string& line) {
        std::string text = kind;
        text[0] = static_cast<char>(text[0] - 'a' + 'A');
        if (ImGui::MenuItem(text.c_str())) in_.console.run(line);
        notePlace("menu:" + text);
    };
    for (const std::string& kind : shapeKinds()) item(kind, "add " + kind);
    ImGui::Separator();
    for (const char* kind : {"point", "spot", "directional", "rect"})
        item(std::string(kind) + " light", std::string("light add ") + kind);
    ImGui::Separator();
    if (ImGui::MenuItem("Import a file...")) in_.document.ask(FilePurpose::ImportScene);
    notePlace("menu:Import");
    ImGui::EndMenu();
}

void Menus::viewMenu() {
    const bool open = ImGui::BeginMenu("View");
    notePlace("menu:View");
    if (!open) return;
    if (ImGui::MenuItem("Focus", "F")) focusOnSelection(in_.session, in_.view.pictureSize());
    ImGui::Separator();
    GizmoTool& tool = in_.view.gizmo.tool;
    if (ImGui::MenuItem("Move", "1", tool == GizmoTool::Move)) tool = GizmoTool::Move;
    if (ImGui::MenuItem("Turn", "2", tool == GizmoTool::Turn)) tool = GizmoTool::Turn;
    if (ImGui::MenuItem("Scale", "3", tool == GizmoTool::Scale)) tool = GizmoTool::Scale;
    ImGui::Separator();
    ImGui::MenuItem("Split", "X", &in_.view.split.on);
    ImGui::MenuItem("Lights", "L", &in_.view.lights.shown);
    notePlace("menu:Lights");
    ImGui::MenuItem("Panels", "Tab", &in_.panels.showSide);
    ImGui::MenuItem("Console", nullptr, &in_.panels.showConsole);
    ImGui::Separator();
    if (ImGui::MenuItem("Larger text", "Ctrl++")) in_.gui.setScale(in_.gui.scale() * kTextStep);
    if (ImGui::MenuItem("Smaller text", "Ctrl+-")) in_.gui.setScale(in_.gui.scale() / kTextStep);
    ImGui::MenuItem("Mouse and keys", "F1", &in_.keys.open);
    notePlace("menu:Mouse and keys");
    if (ImGui::MenuItem("Fullscreen", "F11")) in_.window.setFullscreen(!in_.window.fullscreen());
    ImGui::EndMenu();
}

}  // namespace conelight::program
