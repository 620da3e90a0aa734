// SPDX-License-Identifier: MIT
// The one door to files that a scene names (buffers, pictures, materials, meshes): every importer opens them
// here. A scene may come from a stranger, so it reads from its own folder and below, and regular files only.
// Links are followed first and judged by where they lead. Private to this room and to guests with a format.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/files.h"

namespace conelight::io {

class SceneFolder {
  public:
    // The folder of the file `scene`. allowOutside: files anywhere may be read.
    SceneFolder(const std::filesystem::path& scene, bool allowOutside);

    // Lets in what lies below `folder` too, as a format documents it. The root of the file system lets in
    // nothing.
    void alsoBelow(const std::filesystem::path& folder);

    // "." for a scene in the working folder.
    const std::filesystem::path& path() const { return folder_; }

    // Why the file is not read; "" when it may be. A relative `file` is relative to the working folder.
    std::string refusal(const std::filesystem::path& file) const;
    // Whether a refusal says no more than that there is no such file.
    static bool isMissing(const std::string& refusal);

    // The first file that may be read; when there is none, why the first that is there is refused.
    struct Choice {
        std::filesystem::path file;  // empty: none
        std::string refusal;
    };
    Choice firstOf(const std::vector<std::filesystem::path>& candidates) const;

    // Throws Error(BadInput) "FILE: why", for what is refused and for what readFile refuses.
    Bytes read(const std::filesystem::path& file) const;

  private:
    bool inside(const std::filesystem::path& resolved) const;

    std::filesystem::path folder_;
    std::vector<std::filesystem::path> roots_;  // resolved
    bool allowOutside_;
};

}  // namespace conelight::io
