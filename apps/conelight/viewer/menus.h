// SPDX-License-Identifier: MIT
// The menu bar with the choice of modes, and the keys that do the same.
#pragma once

#include <string>
#include <vector>

#include "platform/window.h"
#include "session/session.h"
#include "viewer/document.h"
#include "viewer/gui.h"
#include "viewer/key_list.h"
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
    };
    explicit Menus(const Inputs& inputs) : in_(inputs) {}

    void takeKeys();
    void showBar();

  private:
    void takeEscape();
    void takeKey(const platform::Window::KeyEvent& press);
    bool takeViewKey(const platform::Window::KeyEvent& press);
    void takeControlKey(const platform::Window::KeyEvent& press);
    void fileMenu();
    void presetMenu();
    void editMenu();
    void addMenu();
    void viewMenu();

    Inputs in_;
    std::vector<std::string> presets_;  // of the current folder, while the menu shows them
};

// Mode, component and split, into the menu bar.
void modeControls(Session& session, Split& split, ViewerConsole& console);

}  // namespace conelight::program
