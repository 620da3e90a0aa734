// SPDX-License-Identifier: MIT
// How a camera sees space: the rays through points of its picture, and one kind of projection in place of the other.
#pragma once

#include <glm/glm.hpp>
#include <string>

#include "conelight/scene.h"

namespace conelight::program {

struct ViewRay {
    glm::vec3 origin{0}, direction{0};  // unit
    float perDepth = 1;                 // m along it for each along the view
};
// Through a point of the picture: (-1,-1) lower left, (1,1) upper right.
ViewRay viewRay(const Camera& camera, float aspect, const glm::vec2& ndc);
// From where the camera sees a point of the world, towards it.
ViewRay viewRayTo(const Camera& camera, const glm::vec3& point);

// "fov 45 deg", or "orthographic 2.5 m".
std::string projectionText(const Camera& camera);

// From where perspective shows the target as large as this camera does, m.
float apparentDistance(const Camera& camera);
// Parallel rays in place of perspective, or the other way round; what is at the target stays as large.
void switchProjection(Camera& camera);

}  // namespace conelight::program
