// SPDX-License-Identifier: MIT
// Where a scene has changed since the last look, for light elsewhere to stay: instances that came, went, moved, bent or look
// other than they did, where they were and where they are; lights. On the CPU.
#pragma once

#include <vector>

#include "light/edits.h"
#include "light/light_edits.h"
#include "light/sky_edits.h"
#include "scene/instance_history.h"

namespace conelight::light {

class EditPlaces {
  public:
    static constexpr std::size_t kMost = CHANGED_PLACES;  // of more those near each other are one

    // Spheres round what came or went, and round where things moved or bent, by which part of their size; lights that
    // changed, and what emits; sky and suns. None: nothing to go by, light may be another everywhere: at the first look, for
    // another scene, and for what is unlit. Costs four comparisons where nothing changed.
    SceneEdits look(const scene::GpuScene& scene);

  private:
    struct Entry {
        base::Revision revision;
        Aabb bounds;
        glm::vec3 emission{0};
        bool unlit = false;
    };
    bool lookAtInstances(const scene::GpuScene& scene);
    bool mostIsOther(const scene::GpuScene& scene) const;
    void addGlow(const Entry& was, const Entry& is, float part);
    bool lookAtLights(const scene::GpuScene& scene);
    base::Revision scene_, lit_, skyLit_;
    scene::InstanceHistory instances_;
    LightEdits lights_;
    SkyEdits sky_;
    std::vector<Entry> entries_;
    EditList edits_;  // of this look
};

}  // namespace conelight::light
