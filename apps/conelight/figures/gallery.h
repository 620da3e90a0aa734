// SPDX-License-Identifier: MIT
// A folder of figures: the files, figures.json (what is in it), index.html (a page to look at them).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "figures/figure.h"

namespace conelight::figures {

class Gallery {
  public:
    // Makes the folder, reads what an earlier call left there. Throws Error(Usage) when the folder holds a
    // figures.json or an index.html of somebody else, Error(Runtime) when it cannot be written to.
    explicit Gallery(const std::string& directory);

    // Writes the figure's files and the page; files that the figure had before and has no more are removed.
    // Throws Error(Usage) instead of writing over a file that is not of this gallery.
    void add(const Figure& figure, const std::vector<Panel>& panels);

    const std::vector<std::string>& lastFiles() const { return lastFiles_; }

  private:
    struct File {
        std::string name, label;
    };
    struct Entry {
        std::string id;
        std::vector<File> files;
    };
    void read();
    void refuseForeign(const std::string& file) const;
    void writePage() const;

    std::filesystem::path directory_;
    std::vector<Entry> entries_;
    std::vector<std::string> lastFiles_;
};

// The gallery as a page of the documentation: title, caption, what is seen, command.
std::string galleryMarkdown();

}  // namespace conelight::figures
