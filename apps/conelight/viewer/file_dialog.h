// SPDX-License-Identifier: MIT
// The dialog in which files are named: folders, the files that fit, a box for any other, which completes paths; for
// scenes to open places, previews and the generated ones too, for files to write a question before one is replaced.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "viewer/thumbnails.h"

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
    // `recent`: scenes that were opened, newest first.
    FileDialog(Thumbnails& thumbnails, const std::vector<std::string>& recent)
        : thumbnails_(thumbnails), recent_(recent) {}

    // Starts in the folder of `near` (a file or builtin:NAME: the current folder) when nothing was chosen for
    // this purpose before.
    void open(FilePurpose purpose, const std::string& near);
    // Draws it when it is open; returns what was chosen, once. What is there already may be replaced: the
    // user has said so.
    std::optional<FileChoice> show();
    bool isOpen() const { return wanted_ || shown_; }

    enum class Order { Name, Size, Time };

  private:
    struct Entry {
        std::string name;
        bool isFolder = false;
        std::uintmax_t bytes = 0;
        std::filesystem::file_time_type time{};
    };
    void enter(const std::string& folder);
    void sort();
    bool nameBox();
    void listPlaces(std::string& next) const;
    void listGenerated(std::optional<std::string>& chosen);
    void listFiles(float width, float height, std::optional<std::string>& chosen);
    void header();
    bool row(const Entry& entry, bool marked);
    void preview();
    void footer(std::optional<std::string>& chosen, bool entered);
    std::vector<const Entry*> offered() const;
    std::string typedPath() const;

    Thumbnails& thumbnails_;
    const std::vector<std::string>& recent_;
    bool wanted_ = false, shown_ = false;
    FilePurpose purpose_ = FilePurpose::OpenScene;
    std::string folder_, typed_;
    std::vector<Entry> entries_;
    Order order_ = Order::Name;
    bool backwards_ = false;
    int marked_ = -1;        // by the arrows, of offered(); -1: none
    std::string previewed_;  // the scene
};

}  // namespace conelight::program
