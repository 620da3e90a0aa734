// SPDX-License-Identifier: MIT
// Where a scene's instances were when somebody looked last, and what has become of them since. Who keeps anything from
// picture to picture has one of its own, since each looks at its own times. On the CPU.
#pragma once

#include <vector>

#include "base/revision.h"
#include "scene/gpu_scene.h"

namespace conelight::scene {

// An instance whose place or vertices are not those of the last look.
struct InstanceChange {
    std::size_t index = 0;
    bool came = false;      // it was not there, and counts as one that neither moved nor bent
    bool moved = false;     // its matrix is another
    bool reshaped = false;  // the vertices of its mesh are others
    // Of the last look, the vertices are those that GpuScene::firstVertexBefore keeps.
    bool keepsVertices = false;
    glm::mat4 worldFromObject{1};  // at the last look
};

class InstanceHistory {
  public:
    // Looks again: changes since the last look, by ascending index; at the first, all have come. Costs one comparison
    // where no geometry has changed.
    const std::vector<InstanceChange>& look(const GpuScene& scene);
    // Of the last look: the scene's geometry; none: nobody has looked.
    base::Revision at() const { return at_; }
    // Whether the scene had more instances at the look before that.
    bool fewer() const { return fewer_; }
    void forget() { *this = {}; }

  private:
    struct Placed {
        glm::mat4 worldFromObject;
        base::Revision shape, entry;
    };
    std::vector<Placed> placed_;
    std::vector<InstanceChange> changes_;
    base::Revision at_;
    bool fewer_ = false;
};

// Of each instance of the scene: a point of it in the world now -> where it was at the last look, had its vertices
// stayed. 4x4, one for scenes without instances.
std::vector<glm::mat4> oldFromWorld(const GpuScene& scene, const std::vector<InstanceChange>& changes);

}  // namespace conelight::scene
