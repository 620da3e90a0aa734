// SPDX-License-Identifier: MIT
// How much of the sky is another than at the last look (docs/theory/4d_cache.md, "Lights that change"). On the CPU.
#pragma once

#include <vector>

#include "conelight/scene.h"
#include "light/edits.h"
#include "light/light_scale.h"

namespace conelight::light {

class SkyEdits {
  public:
    void look(const glm::vec3& sky, const Environment& environment);
    void keep() { before_ = now_; }  // a look at the same sky
    // At the last look: from what it was, `scale` times as bright, to what it is. No light has a place.
    LightChange change(const glm::vec3& scale = glm::vec3(1)) const;
    // What it was and is, in a scene of the radius, m.
    void addSource(std::vector<LightSource>& sources, float radius) const;

  private:
    struct Sky {
        glm::vec3 radiance{0};
        Environment environment;
        glm::vec3 picture{0};  // mean radiance of its picture, over all directions
        glm::vec3 mean() const { return radiance + environment.strength * picture; }
    };
    static bool areComparable(const Sky& was, const Sky& is);
    Sky before_, now_;
};

}  // namespace conelight::light
