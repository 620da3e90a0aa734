// SPDX-License-Identifier: MIT
// Where a scene has changed since the last look, for light elsewhere to stay: instances that came, went, moved, bent or look
// other than they did, where they were and where they are. On the CPU.
#pragma once

#include <optional>
#include <vector>

#include "scene/instance_history.h"
#include "shared/irradiance.h"

namespace conelight::light {

// A sphere in world space, m, and the part of its cross-section that changed, [0,1].
struct EditSphere {
    glm::vec3 center{0};
    float radius = 0, part = 1;
};

// Of a change, all of them; none: it may be anywhere.
using EditSpheres = std::optional<std::vector<EditSphere>>;

// Into a block of shaders: placeCount, places, placeParts.
template <typename Constants>
void putPlaces(Constants& constants, const std::vector<EditSphere>& places) {
    constants.placeCount = static_cast<std::uint32_t>(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        constants.places[i] = {places[i].center, places[i].radius};
        constants.placeParts[i / 4][static_cast<int>(i % 4)] = places[i].part;
    }
}

class EditPlaces {
  public:
    static constexpr std::size_t kMost = CHANGED_PLACES;  // of more those near each other are one

    // Spheres round what came or went, and round where things moved or bent, by which part of their size. None: nothing to go
    // by, light may be another everywhere: at the first look, when lights, the sky or what emits changed, and for another
    // scene. Costs three comparisons where nothing changed.
    EditSpheres look(const scene::GpuScene& scene);

  private:
    struct Entry {
        base::Revision revision;
        Aabb bounds;
        bool emits = false;
    };
    bool isOther(const scene::GpuScene& scene) const;
    base::Revision scene_, lights_, sky_;
    scene::InstanceHistory instances_;
    std::vector<Entry> entries_;
};

}  // namespace conelight::light
