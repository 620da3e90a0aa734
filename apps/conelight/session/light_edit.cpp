// SPDX-License-Identifier: MIT
#include "session/light_edit.h"

#include <cmath>

namespace conelight::program {

void aimLight(Light& light, const glm::vec3& direction) {
    light.direction = glm::normalize(direction);
    if (light.type != LightType::Rect && light.type != LightType::Disk) return;
    const glm::vec3 up = std::abs(light.direction.y) > 0.999f ? glm::vec3(0, 0, -1) : glm::vec3(0, 1, 0);
    const glm::vec3 u = glm::normalize(glm::cross(up, light.direction));
    const glm::vec3 v = glm::cross(light.direction, u);
    light.halfU = glm::length(light.halfU) * u;
    light.halfV = glm::length(light.halfV) * v;
}

Light lightAt(const Camera& camera, LightType type, const std::string& name) {
    Light light;
    light.type = type;
    light.name = name;
    light.position = camera.eye;
    aimLight(light, camera.target - camera.eye);
    return light;
}

}  // namespace conelight::program
