// SPDX-License-Identifier: MIT
// EXT_lights_ies: lights of nodes with the profile of an IES file, in a buffer view or behind a uri. What the extension
// has no place for (a cone, a range, shadows) stands in the node's extras, as conelight.light. Private to this room.
#pragma once

#include <map>
#include <memory>
#include <optional>

#include "conelight/scene.h"
#include "io/gltf_file.h"

namespace conelight::io {

class GltfProfiles {
  public:
    // Name and place are the caller's. Nothing where the node has no such light.
    std::optional<Light> lightOf(GltfFile& file, const GltfValue& node, const GltfValue& own);

  private:
    std::map<std::size_t, std::shared_ptr<const LightProfile>> read_;  // each is read once
};

}  // namespace conelight::io
