// SPDX-License-Identifier: MIT
// The menu bar with the choice of modes, and the keys that do the same: every entry has one, and every menu is opened
// by one.
#pragma once

#include <string>
#include <vector>

#include "platform/window.h"
#include "session/session.h"
#include "viewer/document.h"
#include "viewer/gui.h"
#include "viewer/help_menu.h"
#include "viewer/key_list.h"
#include "viewer/long_work.h"
#include "viewer/panel_layout.h"
#include "viewer/picture_view.h"
#include "viewer/pixel_probe.h"
#include "viewer/viewer_console.h"

namespace conelight::program {

class Menus {
  public:
    struct Inputs {
        Session& session;
        platform::Window& window;
        Gui& gui;
        PictureView& view;
        PixelProbe& probe;
        ViewerConsole& console;
        Document& document;
        PanelLayout& panels;
        KeyList& keys;
        LongWork& work;
    };
    explicit Menus(const Inputs& inputs) : in_(inputs), help_(inputs.window, inputs.console, inputs.keys) {}

    void takeKeys();
    void showBar();

  private:
    void takeEscape();
    void takeKey(const platform::Window::KeyEvent& press);
    bool takeViewKey(const platform::Window::KeyEvent& press);
    void takeControlKey(const platform::Window::KeyEvent& press);
    void takeShiftedControlKey(int key);
    bool takeFunctionKey(const platform::Window::KeyEvent& press);
    bool takeMenuKey(const platform::Window::KeyEvent& press);
    bool beginMenu(const char* name);
    void focusNextPanel();
    void fileMenu();
    void presetMenu();
    void editMenu();
    void addMenu();
    void viewMenu();
    void pictureMenu();  // picture_menu.cpp, as takePictureKey
    void takePictureKey(const platform::Window::KeyEvent& press);
    void guidesMenu();
    void toggleHeadlight();

    Inputs in_;
    HelpMenu help_;
    std::string wanted_;                // a menu that a key opens
    bool popupsOpen_ = false;           // at the end of the last frame's bar
    unsigned int markedMenu_ = 0;       // the one in the bar that keys marked last
    int framesOfArrows_ = 0;            // in which a menu that arrows mark opens: one was opened by a key
    int panel_ = 0;                     // that F6 was at
    std::vector<std::string> presets_;  // of the current folder, while the menu shows them
};

// Mode, component and split, into the menu bar.
void modeControls(Session& session, Split& split, ViewerConsole& console);

}  // namespace conelight::program
