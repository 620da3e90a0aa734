// SPDX-License-Identifier: MIT
// Where a scene has changed since the last look, for light elsewhere to stay: instances that came, went, moved, bent or look
// other than they did, where they were and where they are; lights. On the CPU.
#pragma once

#include <vector>

#include "light/edits.h"
#include "light/light_edits.h"
#include "light/light_scale.h"
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
        std::size_t looks = 0;  // of what emits or did, all else of its material, as a number
        bool unlit = false;
    };
    // What emits, or did. It moved by a part of its size; 1: it is somewhere else, or not known.
    struct Glow {
        Entry was, is;
        float part = 0;
    };
    bool lookAtInstances(const scene::GpuScene& scene);
    void lookAtLights(const scene::GpuScene& scene);
    LightChange lightChange(const glm::vec3& scale) const;
    bool mostIsOther(const scene::GpuScene& scene, const LightChange& change) const;
    bool judgeLight(const scene::GpuScene& scene);
    std::optional<ScaledChange> scaledChange(const scene::GpuScene& scene) const;
    base::Revision scene_, lit_, skyLit_;
    scene::InstanceHistory instances_;
    LightEdits lights_;
    SkyEdits sky_;
    std::vector<Entry> entries_;
    std::vector<Glow> glows_;  // at this look
    EditList edits_;           // of this look
};

}  // namespace conelight::light
