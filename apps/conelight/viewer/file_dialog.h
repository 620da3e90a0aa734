// SPDX-License-Identifier: MIT
// The dialog in which files are named: folders, the files that fit, a box for any other; for scenes to open
// the generated ones too, for files to write a question before one is replaced.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace conelight::program {

enum class FilePurpose {
    OpenScene,
    SaveScene,
    LoadPreset,
    SavePreset,
    LoadPath,
    SavePath,
    RecordPath,
    RecordTurntable,
    ImportScene
};

struct FileChoice {
    FilePurpose purpose = FilePurpose::OpenScene;
    std::string file;
};

class FileDialog {
  public:
    // Starts in the folder of `near` (a file or builtin:NAME: the current folder) when nothing was chosen for
    // this purpose before.
    void open(FilePurpose purpose, const std::string& near);
    // Draws it when it is open; returns what was chosen, once. What is there already may be replaced: the
    // user has said so.
    std::optional<FileChoice> show();
    bool isOpen() const { return wanted_ || shown_; }

  private:
    struct Entry {
        std::string name;
        bool isFolder = false;
    };
    void enter(const std::string& folder);
    void listFiles(float width, float height, std::optional<std::string>& chosen);
    std::string typedPath() const;

    bool wanted_ = false, shown_ = false;
    FilePurpose purpose_ = FilePurpose::OpenScene;
    std::string folder_, typed_;
    std::vector<Entry> entries_;
};

}  // namespace conelight::program
