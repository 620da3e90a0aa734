// SPDX-License-Identifier: MIT
// The "animations" of a glTF file -> clips. Private to this room.
#pragma once

#include <string>
#include <vector>

#include "io/animation.h"
#include "io/gltf_file.h"

namespace conelight::io {

// A node's own place. Fails for a rotation without length.
NodePose readNodePose(const GltfValue& node);

// How many morph targets the node's mesh has.
std::size_t morphTargets(const GltfFile& file, const GltfValue& node);

// All clips; what is left out is one line each in `notes`. Fails with the JSON path of what cannot be used.
std::vector<AnimationClip> readClips(GltfFile& file, std::vector<std::string>& notes);

}  // namespace conelight::io
