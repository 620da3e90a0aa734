// SPDX-License-Identifier: MIT
// The axes of a light's profile, and what it sends out.
#pragma once

#include "conelight/scene.h"

namespace conelight::scene {

// Where a profile's directions are counted from: `direction` has angle 0, u the angle 0 about it, -v a quarter turn.
struct ProfileFrame {
    glm::vec3 direction, u, v;  // unit, at right angles, u x v = direction
};
ProfileFrame profileFrame(const Light& light);

// The integral over all directions of the profile's factor times the cone's (KHR_lights_punctual); a light without a
// cone has cosines of -2 and -3.
float profileFlux(const Light& light, float cosInner, float cosOuter);

}  // namespace conelight::scene
