// SPDX-License-Identifier: MIT
// Scenes in the formats Assimp reads (OBJ, FBX, PLY, STL, Collada, 3DS, IFC, X, ...), isolated in a child
// process (see LoadOptions). Private to this room.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "conelight/scene.h"
#include "io/scene_file.h"

namespace conelight::io {

// The whole file: node hierarchy, instances, materials, textures, lights, cameras; in metres, y up, when the
// format says its units and axes. Missing normals are made smooth up to 60 degrees.
Scene loadAssimp(const std::filesystem::path& path, const LoadOptions& options);

// Only the first mesh of the file, in its own space and without materials.
Mesh loadFirstMesh(const std::filesystem::path& path, const LoadOptions& options);

// Extensions the linked Assimp knows, lower case with dot.
std::vector<std::string> assimpExtensions();

}  // namespace conelight::io
