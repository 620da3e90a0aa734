// SPDX-License-Identifier: MIT
#include "scene/instance_history.h"

#include <algorithm>

namespace conelight::scene {

const std::vector<InstanceChange>& InstanceHistory::look(const GpuScene& scene) {
    changes_.clear();
    fewer_ = false;
    if (at_ == scene.geometryRevision()) return changes_;
    at_ = scene.geometryRevision();
    const std::size_t count = scene.instances().size(), known = std::min(placed_.size(), count);
    fewer_ = placed_.size() > count;
    placed_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        Placed& was = placed_[i];
        const Placed is{scene.instances()[i].worldFromObject, scene.shapeRevision(i), scene.entryRevision(i)};
        const bool came = i >= known || was.entry != is.entry;
        const bool moved = !came && was.worldFromObject != is.worldFromObject;
        const bool reshaped = !came && was.shape != is.shape;
        if (came || moved || reshaped)
            changes_.push_back({i, came, moved, reshaped, reshaped && was.shape == scene.shapeBefore(i),
                                was.worldFromObject});
        was = is;
    }
    return changes_;
}

std::vector<glm::mat4> oldFromWorld(const GpuScene& scene, const std::vector<InstanceChange>& changes) {
    std::vector<glm::mat4> matrices(std::max<std::size_t>(scene.instances().size(), 1), glm::mat4(1));
    for (const InstanceChange& change : changes)
        if (change.moved)
            matrices[change.index] =
                change.worldFromObject * glm::inverse(scene.instances()[change.index].worldFromObject);
    return matrices;
}

}  // namespace conelight::scene
