// SPDX-License-Identifier: MIT
// By which factor a scene's light has changed where it has changed, as that of a lamp that is dimmed: what it lit is known
// then, too (docs/theory/4d_cache.md, "Light that is scaled"). On the CPU.
#pragma once

#include <vector>

#include "conelight/scene.h"

namespace conelight::light {

// A lamp, a sun, the sky or what emits: all that it sends out, W per channel.
struct LightSource {
    glm::vec3 was{0}, is{0};
};

// The factor of which the sum of |is - factor * was| is least over all that changed, in each channel: the median of is / was,
// weighed with `was`; 1 where nothing that shone changed. Not negative, finite.
glm::vec3 commonScale(const std::vector<LightSource>& sources);

constexpr float kScaleRounding = 1e-6f;  // of what it is, what something scaled may differ by

// scale * was; in channels where that is `is` but for rounding, `is`.
glm::vec3 scaledTo(const glm::vec3& was, const glm::vec3& scale, const glm::vec3& is);

}  // namespace conelight::light
