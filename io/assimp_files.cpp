// SPDX-License-Identifier: MIT
#include "io/assimp_files.h"

#include <fmt/core.h>

#include <assimp/MemoryIOWrapper.h>
#include <algorithm>
#include <cstring>

#include "conelight/error.h"
#include "io/obj_text.h"

namespace conelight::io {

namespace {

class MemoryFile final : public Assimp::MemoryIOStream {
  public:
    explicit MemoryFile(Bytes bytes) : MemoryIOStream(bytes.data(), bytes.size()), bytes_(std::move(bytes)) {}

  private:
    Bytes bytes_;  // moving a vector does not move what it holds
};

}  // namespace

void AssimpFiles::note(const std::string& file, const std::string& why) const {
    std::string text = fmt::format("{}: {}; left out", oneLine(file), why);
    if (std::find(notes_.begin(), notes_.end(), text) == notes_.end()) notes_.push_back(std::move(text));
}

bool AssimpFiles::Exists(const char* file) const {
    const std::string why = folder_.refusal(file);
    if (why.empty()) return true;
    if (!SceneFolder::isMissing(why)) note(file, why);
    return false;
}

Assimp::IOStream* AssimpFiles::Open(const char* file, const char* mode) {
    if (std::strchr(mode, 'r') == nullptr || !Exists(file)) return nullptr;
    try {
        const std::string extension = lowerExtension(file);
        Bytes bytes = folder_.read(file);
        if (extension == ".obj" || extension == ".mtl") bytes = plainObjText(bytes);
        return new MemoryFile(std::move(bytes));
    } catch (const Error& error) {
        note(file, error.what());
        return nullptr;
    }
}

void AssimpFiles::Close(Assimp::IOStream* stream) { delete stream; }

}  // namespace conelight::io
