// SPDX-License-Identifier: MIT
// Which lights are others than at the last look, and what they change (docs/theory/4d_cache.md, "Lights that change").
// On the CPU.
#pragma once

#include <optional>
#include <vector>

#include "conelight/scene.h"
#include "light/edits.h"

namespace conelight::light {

// As a light edit what a light does, all of it; none: it has no place, or does not fall off as light does.
std::optional<LightEdit> placeOf(const Light& light);

// By how much of what it was a colour is another, in the channel where that is most; infinite where there was none.
float partOf(const glm::vec3& was, const glm::vec3& is);

class LightEdits {
  public:
    struct Change {
        std::vector<LightEdit> lights;
        float everywhere = 0, everywherePart = 0;  // as in EditList
        bool isAnything = false;                   // there is nothing to go by
    };
    Change look(const std::vector<Light>& lights);
    // Of the last look: of all lights that are on, W; infinite with one that has no place.
    float flux() const;

  private:
    std::vector<Light> lights_;
};

}  // namespace conelight::light
