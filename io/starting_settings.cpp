// SPDX-License-Identifier: MIT
#include "io/starting_settings.h"

#include <algorithm>

namespace conelight::io {

void addStartingSettings(Scene& scene) {
    scene.settings.emplace_back("image.exposure", "auto");
    if (scene.instances.empty()) return;
    const glm::vec3 edges = scene.bounds().extent();
    if (std::max({edges.x, edges.y, edges.z}) > kLargeScene)
        scene.settings.emplace_back("voxels.levels", "0");
}

}  // namespace conelight::io
