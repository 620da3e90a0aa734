// SPDX-License-Identifier: MIT
// Files for Assimp's importers: what they open, they get through the door of SceneFolder, whole and in memory,
// OBJ and MTL in plain spelling. Nothing is written. Private to this room.
#pragma once

#include <assimp/IOSystem.hpp>
#include <string>
#include <vector>

#include "io/scene_folder.h"

namespace conelight::io {

class AssimpFiles final : public Assimp::IOSystem {
  public:
    explicit AssimpFiles(const SceneFolder& folder) : folder_(folder) {}

    bool Exists(const char* file) const override;
    Assimp::IOStream* Open(const char* file, const char* mode) override;
    void Close(Assimp::IOStream* stream) override;
    char getOsSeparator() const override { return '/'; }
    bool CreateDirectory(const std::string&) override { return false; }
    bool ChangeDirectory(const std::string&) override { return false; }
    bool DeleteFile(const std::string&) override { return false; }

    // "NAME: why; left out" for each file that is there and was refused.
    const std::vector<std::string>& notes() const { return notes_; }

  private:
    void note(const std::string& file, const std::string& why) const;

    const SceneFolder& folder_;
    mutable std::vector<std::string> notes_;
};

}  // namespace conelight::io
