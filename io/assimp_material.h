// SPDX-License-Identifier: MIT
// Materials and textures of Assimp scenes as metallic-roughness. Private to this room.
#pragma once

#include "conelight/scene.h"
#include "io/scene_folder.h"

struct aiScene;

namespace conelight::io {

// Appends one Material per material of `source` (same order) and the textures they use to `scene`; texture
// files are looked for in `folder`. Missing, broken and too large textures
// (TextureBudget) become notes.
void importAssimpMaterials(const aiScene& source, const SceneFolder& folder, std::uint64_t maxTexels,
                           Scene& scene);

}  // namespace conelight::io
