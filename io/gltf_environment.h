// SPDX-License-Identifier: MIT
// The surroundings of a glTF scene: ours in its extras, and EXT_lights_image_based. Private to this room.
#pragma once

#include "conelight/scene.h"
#include "io/gltf_file.h"

namespace conelight::io {

// What io/gltf_write.cpp keeps in extras.conelight.environment; absent: nothing.
void readOwnEnvironment(GltfFile& file, const GltfValue& own, Environment& to);

// The light that `scene` names through EXT_lights_image_based; absent: nothing. Its cube, level 0 and turned as
// the file says, becomes a latitude-longitude picture. Appends to `notes` what is not kept.
void readImageBasedLight(GltfFile& file, const GltfValue& scene, Environment& to,
                         std::vector<std::string>& notes);

}  // namespace conelight::io
