// SPDX-License-Identifier: MIT
// Spheres of light: numbers in [0,1) -> directions to one; and rays against one.
#pragma once

#include <glm/glm.hpp>

#include "reference/lights.h"

namespace conelight::reference {

struct SphereShape {
    glm::vec3 center{0};
    float radius = 0;
};

// A direction to the sphere, evenly over its solid angle: fills in direction, distance, target and density. False from
// within, as it shines outwards.
bool sampleSphere(const SphereShape& sphere, const glm::vec3& from, const glm::vec2& u, LightSample& result);
// The same for a direction that is given. False where it passes by.
bool sphereAlong(const SphereShape& sphere, const glm::vec3& from, const glm::vec3& direction,
                 LightSample& result);

}  // namespace conelight::reference
