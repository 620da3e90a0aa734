// SPDX-License-Identifier: MIT
// The panels beside the picture. Left: the scene's tree and, stage by stage, all settings. Right: what is
// selected, what the clicked pixel gathered, the camera with its path and films, and what a frame costs.
#pragma once

#include <string>
#include <vector>

#include "session/session.h"
#include "viewer/document.h"
#include "viewer/key_strip.h"
#include "viewer/long_work.h"
#include "viewer/panel_layout.h"
#include "viewer/picture_view.h"
#include "viewer/pixel_probe.h"
#include "viewer/scene_tree.h"
#include "viewer/selection_editor.h"
#include "viewer/selection_menu.h"
#include "viewer/settings_panel.h"
#include "viewer/timings.h"
#include "viewer/viewer_console.h"

namespace conelight::program {

class LeftPanel {
  public:
    LeftPanel(Session& session, ViewerConsole& console, SelectionMenu& menu)
        : session_(session),
          console_(console),
          tree_({[this](const std::string& line) { console_.run(line); },
                 [&menu](const glm::vec2& at) { menu.open(at); }}) {}
    void show(const Layout& layout);

  private:
    // A tab, and what the keys of its settings begin with; the gather stage shows its mode's.
    struct Stage {
        const char* name;
        std::vector<std::string> prefixes;
    };
    static std::vector<Stage> stagesOf(const std::string& mode);
    void showTabs(const std::vector<Stage>& stages);

    Session& session_;
    ViewerConsole& console_;
    SceneTree tree_;
    SettingsPanel settings_;
    std::size_t stage_ = 0;
    std::string filter_;
};

class RightPanel {
  public:
    struct Inputs {
        Session& session;
        PictureView& view;
        ViewerConsole& console;
        PixelProbe& probe;
        Document& document;
        Film& film;
        const Timings& timings;
    };
    explicit RightPanel(const Inputs& inputs) : in_(inputs) {}
    void show(const Layout& layout);

  private:
    void showCamera();
    void showFrame();

    Inputs in_;
    KeyStrip strip_;
    SelectionEditor selection_;
};

}  // namespace conelight::program
