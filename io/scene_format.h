// SPDX-License-Identifier: MIT
// Scene formats that somebody else brings: what reads and writes them, by extension. loadScene, writeScene
// and the lists of extensions ask here after glTF and before Assimp.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "conelight/scene.h"
#include "io/scene_file.h"

namespace conelight::io {

// A line of a file's syntax tree.
struct SyntaxLine {
    int depth = 0;     // 0: top level
    std::string text;  // key, or key = word
    int line = 0;      // in the file, from 1
};

struct SceneFormat {
    std::string name;                     // Scene::format of scenes that keep its conventions
    std::string title;                    // for messages: "the X's format"
    std::vector<std::string> extensions;  // lower case, with dot; the first is the usual one
    std::function<Scene(const std::filesystem::path& path, const LoadOptions& options)> read;
    // As writeScene; the name is free or may be replaced.
    std::function<std::vector<std::string>(const std::string& path, const Scene& scene, bool force)> write;
    // The tree of a text, from top to bottom; `file` starts error lines. Empty: the format is no text.
    std::function<std::vector<SyntaxLine>(std::string_view text, const std::string& file)> syntax;
};

// Call before anything is loaded, from one thread. A format of the same name is replaced.
void registerSceneFormat(SceneFormat format);
const std::vector<SceneFormat>& sceneFormats();
// By extension (lower case, with dot), or by name; null when nobody registered it.
const SceneFormat* sceneFormatOf(const std::string& extension);
const SceneFormat* sceneFormatNamed(const std::string& name);

}  // namespace conelight::io
