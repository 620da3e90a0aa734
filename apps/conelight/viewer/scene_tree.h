// SPDX-License-Identifier: MIT
// Objects in their groups, lights, materials, cameras and sky as lists. A click selects, with Ctrl beside the others, with Shift all
// from the last click on; the right button opens the menu of what is selected. What is selected elsewhere is scrolled
// to. Long lists draw only the lines that are seen.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "session/session.h"
#include "viewer/object_tree.h"
#include "viewer/panels.h"

namespace conelight::program {

class SceneTree {
  public:
    struct Actions {
        RunLine run;
        std::function<void(const glm::vec2& at)> openMenu;
    };
    explicit SceneTree(Actions actions) : actions_(std::move(actions)) {}

    // Names that contain `filter`.
    void show(Session& session, const std::string& filter);

  private:
    // What of a list is shown, until names or filter change.
    struct Rows {
        std::string filter;
        std::uint64_t revision = 0;
        std::vector<std::size_t> shown;
    };
    void followSelection(const Session& session);
    bool heading(const char* name, std::size_t count, SelectionKind kind);
    void scrollTo(const std::vector<std::size_t>& shown, SelectionKind kind, float rowHeight);
    void scrollTo(std::size_t number, std::size_t count, float rowHeight);
    void row(Session& session, const std::string& label, const Selection& what,
             const std::vector<std::size_t>& shown);
    void click(Session& session, const Selection& what, const std::vector<std::size_t>& shown);
    void objects(Session& session, const std::string& filter);
    void visibleBox(Session& session, std::size_t index, const std::string& name);
    bool groupRow(Session& session, std::size_t group);
    void clickGroup(Session& session, std::size_t group);
    void visibleBoxOfGroup(Session& session, std::size_t group, const std::string& name);
    void lights(Session& session, const std::string& filter);
    void materials(Session& session, const std::string& filter);
    void cameras(Session& session);

    Actions actions_;
    ObjectTree tree_;
    Rows materials_;
    float foldWidth_ = 0;              // of the line that is drawn
    Selection seen_;                   // what was selected last
    std::optional<Selection> reveal_;  // to be scrolled to
    Selection anchor_;                 // where a click with Shift begins
};

}  // namespace conelight::program
