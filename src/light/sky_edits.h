// SPDX-License-Identifier: MIT
// How much of the sky is another than at the last look (docs/theory/4d_cache.md, "Lights that change"). On the CPU.
#pragma once

#include "conelight/scene.h"

namespace conelight::light {

class SkyEdits {
  public:
    struct Change {
        float irradiance = 0;     // W/m^2, mean of the channels: by which it may be another below an open sky
        float part = 0;           // of what it was
        bool isAnything = false;  // there is nothing to go by
    };
    Change look(const glm::vec3& sky, const Environment& environment);

  private:
    glm::vec3 sky_{0};
    Environment environment_;
    double mean_ = -1;  // of its picture, over all directions and channels; negative: not known
};

}  // namespace conelight::light
