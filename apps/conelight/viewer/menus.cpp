// SPDX-License-Identifier: MIT
#include "viewer/menus.h"

#include <imgui.h>
#include <imgui_internal.h>  // ClosePopupToLevel, and what keys mark
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <tuple>
#include <utility>

#include "session/addition.h"
#include "viewer/focus.h"
#include "viewer/imgui_names.h"
#include "viewer/requests.h"
#include "viewer/standard_views.h"
#include "viewer/widget_places.h"

namespace conelight::program {
namespace {

// Shows which entry the keys are at, whatever the mouse is over.
void markForKeys() {
    ImGuiContext& gui = *ImGui::GetCurrentContext();
#if IMGUI_VERSION_NUM >= 19140
    gui.NavCursorVisible = gui.NavHighlightItemUnderNav = true;
#else
    gui.NavDisableHighlight = false;
    gui.NavDisableMouseHover = true;
#endif
}

constexpr float kTextStep = 1.1f;
constexpr int kFramesOfArrows = 4;  // Dear ImGui takes two from one menu to the next

// Menus and lists; dialogs answer the key themselves.
// Returns whether one is open.
bool closeMenusOnEscape() {
    const bool open = ImGui::GetCurrentContext()->OpenPopupStack.Size > 0;
    if (open && escapePressed() && ImGui::GetTopMostPopupModal() == nullptr)
        ImGui::ClosePopupToLevel(0, true);
    return open;
}

void askForScreenshot(Session& session) { session.request({RequestKind::Screenshot, nextName(".png")}); }

}  // namespace

void Menus::takeKeys() {
    // Dear ImGui's own keys may have closed it at the begin of this frame.
    const bool menuOpen = closeMenusOnEscape() || popupsOpen_;
    const std::vector<platform::Window::KeyEvent>& presses = in_.gui.keyPresses();
    // Whoever typed `path play`, or `open`, still has the cursor in the console's line.
    const bool loads = in_.work.loads() && !menuOpen;
    const bool begins = !in_.view.notice.empty() && !in_.view.halted() && !menuOpen;
    for (const auto& press : presses)
        if (press.key == GLFW_KEY_ESCAPE && (in_.session.playing() || loads || begins)) {
            if (loads)
                in_.work.stopLoading();
            else if (in_.session.playing())
                in_.session.stopPlaying();
            else
                in_.view.halt(in_.session);
            if (in_.gui.wantsKeyboard()) in_.console.panel().focus();
            return;
        }
    for (const auto& press : presses)
        if (press.key == GLFW_KEY_ESCAPE && in_.view.turntable.turns()) return in_.view.turntable.stop();
    // A dialog and a captured cursor have the keys for themselves.
    if (in_.window.cursorCaptured() || ImGui::GetTopMostPopupModal() != nullptr) return;
    for (const auto& press : presses) {
        if (takeMenuKey(press) || in_.gui.wantsKeyboard()) continue;
        if (press.key == GLFW_KEY_ESCAPE && !menuOpen)
            takeEscape();
        else if (!menuOpen && !takeFunctionKey(press) && !takeViewKey(press))
            press.control() ? takeControlKey(press) : takeKey(press);
    }
}

// Opens menus and goes from panel to panel, also while text is typed. Returns whether it was one of those.
bool Menus::takeMenuKey(const platform::Window::KeyEvent& press) {
    constexpr std::pair<int, const char*> kMenus[] = {{GLFW_KEY_F, "File"},    {GLFW_KEY_E, "Edit"},
                                                      {GLFW_KEY_A, "Add"},     {GLFW_KEY_V, "View"},
                                                      {GLFW_KEY_P, "Picture"}, {GLFW_KEY_H, "Help"}};
    if (press.key == GLFW_KEY_F10) wanted_ = "File";
    for (const auto& [key, name] : kMenus)
        if ((press.modifiers & GLFW_MOD_ALT) != 0 && press.key == key) wanted_ = name;
    if (press.key == GLFW_KEY_F6) focusNextPanel();
    return press.key == GLFW_KEY_F10 || press.key == GLFW_KEY_F6 || (press.modifiers & GLFW_MOD_ALT) != 0;
}

// Left, right, the console, and back to the picture. Arrows go through a panel, Space presses, Return types.
void Menus::focusNextPanel() {
    const auto highlight = [](const char* window) {
        ImGui::SetWindowFocus(window);
        markForKeys();
    };
    panel_ = (panel_ + 1) % 4;
    if (panel_ == 1 && !in_.panels.showSide) panel_ = 3;
    if (panel_ == 3 && !in_.panels.showConsole) panel_ = 0;
    if (panel_ == 1 || panel_ == 2) highlight(panel_ == 1 ? "##left" : "##right");
    if (panel_ == 3) in_.console.panel().focus();
    if (panel_ == 0) ImGui::SetWindowFocus(nullptr);
}

bool Menus::takeFunctionKey(const platform::Window::KeyEvent& press) {
    switch (press.key) {
        case GLFW_KEY_F1:
            if (press.shift())
                help_.openGuide();
            else if (press.control())
                help_.openAbout();
            else
                in_.keys.open = !in_.keys.open;
            return true;
        case GLFW_KEY_F5:
            if (!in_.session.path().empty()) in_.document.reload();
            return true;
        case GLFW_KEY_F11:
            in_.window.setFullscreen(!in_.window.fullscreen());
            return true;
        case GLFW_KEY_TAB:
            in_.panels.showAll(!in_.panels.showSide);
            return true;
        default:
            return false;
    }
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
    if (press.key == GLFW_KEY_KP_5 || (press.key == GLFW_KEY_V && !press.control())) {
        in_.console.run("camera orthographic");
        return true;
    }
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
        case GLFW_KEY_G:
            return in_.view.guides.setAll(!in_.view.guides.any());
        case GLFW_KEY_L:
            if (!press.shift()) return toggleHeadlight();
            in_.view.lights.shown = !in_.view.lights.shown;
            return;
        case GLFW_KEY_O:
            return in_.view.turntable.toggle(in_.session);
        case GLFW_KEY_P:
            return askForScreenshot(in_.session);
        default:
            takePictureKey(press);
            return;
    }
}

void Menus::takeShiftedControlKey(int key) {
    switch (key) {
        case GLFW_KEY_S:
            return in_.document.ask(FilePurpose::SavePreset);
        case GLFW_KEY_O:
            return in_.document.ask(FilePurpose::LoadPreset);
        case GLFW_KEY_R:
            return in_.console.run("reset");
        case GLFW_KEY_P:
            return in_.document.askForPicture(true);
        case GLFW_KEY_Z:
            in_.session.redo();
            return;
        default:
            return;
    }
}

void Menus::takeControlKey(const platform::Window::KeyEvent& press) {
    const bool zooms = press.key == GLFW_KEY_EQUAL;  // + is Shift+= on many keyboards
    if (press.shift() && !zooms) return takeShiftedControlKey(press.key);
    switch (press.key) {
        case GLFW_KEY_Q:
            return in_.document.quit();
        case GLFW_KEY_J:
            in_.panels.showConsole = !in_.panels.showConsole;
            return;
        case GLFW_KEY_Z:
            in_.session.undo();
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
        case GLFW_KEY_P:
            return in_.document.askForPicture(false);
        case GLFW_KEY_EQUAL:
        case GLFW_KEY_KP_ADD:
            return in_.gui.setScale(in_.gui.scale() * kTextStep);
        case GLFW_KEY_MINUS:
        case GLFW_KEY_KP_SUBTRACT:
            return in_.gui.setScale(in_.gui.scale() / kTextStep);
        case GLFW_KEY_0:
        case GLFW_KEY_KP_0:
            return in_.gui.setScale(0);
        case GLFW_KEY_L:
            return in_.gui.setLight(!in_.gui.light());
        default:
            return;
    }
}

void Menus::showBar() {
    if (ImGui::BeginMainMenuBar()) {
        fileMenu();
        editMenu();
        addMenu();
        viewMenu();
        pictureMenu();
        if (beginMenu("Help")) {
            help_.showItems();
            ImGui::EndMenu();
        }
        modeControls(in_.session, in_.view.split, in_.console);
        ImGui::EndMainMenuBar();
    }
    help_.showAbout();
    if (framesOfArrows_ > 0)
        framesOfArrows_ =
            ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId) ? kFramesOfArrows : framesOfArrows_ - 1;
    popupsOpen_ = ImGui::GetCurrentContext()->OpenPopupStack.Size > 0;
}

// One that a key asked for opens with its first entry marked. Arrows go on from there, also to its neighbours.
bool Menus::beginMenu(const char* name) {
    const ImGuiID id = ImGui::GetID(name);
    const bool byArrow = ImGui::GetCurrentContext()->NavId == id && std::exchange(markedMenu_, id) != id;
    if (wanted_ == name || (byArrow && framesOfArrows_ > 0)) {
        framesOfArrows_ = kFramesOfArrows;
        markedMenu_ = id;
        wanted_.clear();
        ImGui::OpenPopup(name);
        markForKeys();
    }
    const bool open = ImGui::BeginMenu(name);
    notePlace(std::string("menu:") + name);
    return open;
}

void Menus::fileMenu() {
    if (!beginMenu("File")) return;
    if (ImGui::MenuItem("Open...", "Ctrl+O")) in_.document.ask(FilePurpose::OpenScene);
    notePlace("menu:Open");
    const std::vector<std::string>& recent = in_.document.recent();
    if (ImGui::BeginMenu("Open recent", !recent.empty())) {
        for (const std::string& scene : recent) {
            if (ImGui::MenuItem(scene.c_str())) in_.document.open(scene);
            notePlace("recent:" + scene);
            if (!ImGui::IsItemHovered()) continue;
            ImGui::BeginTooltip();
            in_.document.thumbnails().show(scene, 14 * ImGui::GetFontSize());
            ImGui::EndTooltip();
        }
        ImGui::EndMenu();
    }
    notePlace("menu:Open recent");
    if (ImGui::MenuItem("Reload", "F5", false, !in_.session.path().empty())) in_.document.reload();
    if (ImGui::MenuItem("Save scene as...", "Ctrl+S")) in_.document.ask(FilePurpose::SaveScene);
    notePlace("menu:Save scene");
    ImGui::Separator();
    presetMenu();
    ImGui::Separator();
    if (ImGui::MenuItem("Screenshot", "P")) askForScreenshot(in_.session);
    if (ImGui::MenuItem("Picture as...", "Ctrl+P")) in_.document.askForPicture(false);
    notePlace("menu:Picture");
    if (ImGui::MenuItem("Film as...", "Ctrl+Shift+P")) in_.document.askForPicture(true);
    notePlace("menu:Film");
    ImGui::Separator();
    if (ImGui::MenuItem("Quit", "Ctrl+Q")) in_.document.quit();
    notePlace("menu:Quit");
    ImGui::EndMenu();
}

// Settings as files: those of the current folder are in reach.
void Menus::presetMenu() {
    const bool open = ImGui::BeginMenu("Presets");
    notePlace("menu:Presets");
    if (!open) return;
    if (ImGui::IsWindowAppearing()) in_.console.attempt([&] { presets_ = presetsIn("."); });
    if (ImGui::MenuItem("Save settings as...", "Ctrl+Shift+S")) in_.document.ask(FilePurpose::SavePreset);
    notePlace("menu:Save settings");
    if (ImGui::MenuItem("Load...", "Ctrl+Shift+O")) in_.document.ask(FilePurpose::LoadPreset);
    notePlace("menu:Load preset");
    if (ImGui::MenuItem("Back to the scene's own", "Ctrl+Shift+R")) in_.console.run("reset");
    notePlace("menu:Reset");
    if (!presets_.empty()) ImGui::Separator();
    for (const std::string& name : presets_) {
        if (ImGui::MenuItem(name.c_str())) in_.console.run("preset load " + quoted(name));
        notePlace("preset:" + name);
    }
    ImGui::EndMenu();
}

void Menus::editMenu() {
    if (!beginMenu("Edit")) return;
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
    if (!beginMenu("Add")) return;
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

void Menus::toggleHeadlight() {
    float& light = in_.view.headlight;
    light = light > 0 ? 0 : headlightFor(in_.session.settings().image);
}

// What is laid over the picture, or moves or lights it for looking.
void Menus::guidesMenu() {
    ViewGuides& guides = in_.view.guides;
    if (ImGui::MenuItem("Grid, axes and scale", "G", guides.any())) guides.setAll(!guides.any());
    notePlace("menu:Guides");
    ImGui::MenuItem("Grid on the ground", nullptr, &guides.grid);
    notePlace("menu:Grid");
    ImGui::MenuItem("Axes", nullptr, &guides.axes);
    notePlace("menu:Axes");
    ImGui::MenuItem("Scale bar", nullptr, &guides.scale);
    notePlace("menu:Scale bar");
    if (ImGui::MenuItem("Headlight", "L", in_.view.headlight > 0)) toggleHeadlight();
    notePlace("menu:Headlight");
    if (ImGui::MenuItem("Turntable", "O", in_.view.turntable.turns())) in_.view.turntable.toggle(in_.session);
    notePlace("menu:Turntable");
}

void Menus::viewMenu() {
    if (!beginMenu("View")) return;
    if (ImGui::MenuItem("Focus", "F")) focusOnSelection(in_.session, in_.view.pictureSize());
    if (ImGui::MenuItem("Orthographic", "V", in_.session.camera().isOrthographic()))
        in_.console.run("camera orthographic");
    notePlace("menu:Orthographic");
    ImGui::Separator();
    GizmoTool& tool = in_.view.gizmo.tool;
    if (ImGui::MenuItem("Move", "1", tool == GizmoTool::Move)) tool = GizmoTool::Move;
    if (ImGui::MenuItem("Turn", "2", tool == GizmoTool::Turn)) tool = GizmoTool::Turn;
    if (ImGui::MenuItem("Scale", "3", tool == GizmoTool::Scale)) tool = GizmoTool::Scale;
    ImGui::Separator();
    guidesMenu();
    ImGui::Separator();
    ImGui::MenuItem("Split", "X", &in_.view.split.on);
    ImGui::MenuItem("Lights", "Shift+L", &in_.view.lights.shown);
    notePlace("menu:Lights");
    ImGui::MenuItem("Panels", "Tab", &in_.panels.showSide);
    ImGui::MenuItem("Console", "Ctrl+J", &in_.panels.showConsole);
    notePlace("menu:Console");
    ImGui::Separator();
    if (ImGui::MenuItem("Larger text", "Ctrl++")) in_.gui.setScale(in_.gui.scale() * kTextStep);
    if (ImGui::MenuItem("Smaller text", "Ctrl+-")) in_.gui.setScale(in_.gui.scale() / kTextStep);
    if (ImGui::MenuItem("Text as the screen's", "Ctrl+0")) in_.gui.setScale(0);
    if (ImGui::MenuItem("Light theme", "Ctrl+L", in_.gui.light())) in_.gui.setLight(!in_.gui.light());
    notePlace("menu:Light theme");
    if (ImGui::MenuItem("Next panel", "F6")) focusNextPanel();
    if (ImGui::MenuItem("Fullscreen", "F11")) in_.window.setFullscreen(!in_.window.fullscreen());
    ImGui::EndMenu();
}

}  // namespace conelight::program
