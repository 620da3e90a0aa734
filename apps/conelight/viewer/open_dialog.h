// SPDX-License-Identifier: MIT
// The dialog of File / Open: folders and files that may be scenes, and the generated scenes.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace conelight::program {

class OpenDialog {
  public:
    void open(const std::string& scene);  // starts in the folder of this one
    // Draws it when it is open; returns what was chosen, once.
    std::optional<std::string> show();

  private:
    struct Entry {
        std::string name;
        bool isFolder = false;
    };
    void enter(const std::string& folder);

    bool wanted_ = false;
    std::string folder_, typed_;
    std::vector<Entry> entries_;
};

}  // namespace conelight::program
