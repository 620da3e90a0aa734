// SPDX-License-Identifier: MIT
// Which lights are others than at the last look, and what they change (docs/theory/4d_cache.md, "Lights that change").
// On the CPU.
#pragma once

#include <optional>
#include <vector>

#include "conelight/scene.h"
#include "light/edits.h"
#include "light/light_scale.h"

namespace conelight::light {

// As a light edit what a light does, all of it; none: it has no place, or does not fall off as light does.
std::optional<LightEdit> placeOf(const Light& light);

// By how much of what it was a colour is another, in the channel where that is most; infinite where there was none.
float partOf(const glm::vec3& was, const glm::vec3& is);

class LightEdits {
  public:
    void look(const std::vector<Light>& lights);
    void keep() { same_ = true; }  // a look at the same lights
    // At the last look: from what they were, `scale` times as bright, to what they are.
    LightChange change(const glm::vec3& scale = glm::vec3(1)) const;
    // What they were and are, in a scene of the radius, m.
    void addSources(std::vector<LightSource>& sources, float radius) const;
    // All lights that are on, W; infinite with one that has no place.
    float flux() const;

  private:
    const std::vector<Light>& before() const { return same_ ? lights_ : before_; }
    template <typename Pair>
    void forPairs(const Pair& pair) const;
    std::vector<Light> lights_, before_;
    bool same_ = false;  // lights_ are what they were
};

}  // namespace conelight::light
