// SPDX-License-Identifier: MIT
// KHR_draco_mesh_compression: the accessors of compressed primitives are filled. Private to this room.
#pragma once

#include "io/gltf_file.h"

namespace conelight::io {

// Decodes all compressed primitives of the file and gives their elements to its accessors. Throws
// Error(BadInput).
void unpackDraco(GltfFile& file);

}  // namespace conelight::io
