// SPDX-License-Identifier: MIT
// Where a scene has changed since the last look, for light elsewhere to stay: instances that came, went, moved, bent or look
// other than they did, where they were and where they are. On the CPU.
#pragma once

#include <optional>
#include <vector>

#include "scene/gpu_scene.h"
#include "shared/irradiance.h"

namespace conelight::light {

class EditPlaces {
  public:
    static constexpr std::size_t kMost = CHANGED_PLACES;  // more are taken together

    // Spheres at what changed, world space, w: radius, m. They are as large as what came, went or bent; of what moved by a
    // part of its size they have that part of its cross-section. None: nothing to go by, light may be another everywhere:
    // at the first look, when lights, the sky or what emits changed, and for another scene. Costs three comparisons where
    // nothing changed.
    std::optional<std::vector<glm::vec4>> look(const scene::GpuScene& scene);

  private:
    struct Entry {
        base::Revision revision, shape, entry;
        Aabb bounds;
        glm::mat4 place{1};
        bool emits = false;
    };
    bool isOther(const scene::GpuScene& scene) const;
    base::Revision scene_, geometry_, lights_, sky_;
    std::vector<Entry> entries_;
};

}  // namespace conelight::light
