// SPDX-License-Identifier: MIT
#include "scene/gpu_lights.h"

#include <algorithm>
#include <cmath>

namespace conelight::scene {
namespace {

// Half angle above which a spot is given the six maps of a point light instead of one: at 60 degrees a single
// perspective map spends four times as many texels per solid angle in its corners as in its middle.
constexpr float kWidestSingleMap = 1.0471976f;

// Two unit vectors that span the plane normal to a unit vector (Duff et al. 2017, "Building an Orthonormal
// Basis, Revisited").
void basis(const glm::vec3& n, glm::vec3& u, glm::vec3& v) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    u = {1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x};
    v = {b, sign + n.y * n.y * a, -n.y};
}

gpu::Light packed(const Light& light) {
    gpu::Light g{};
    const float length = glm::length(light.direction);
    g.position = light.position;
    g.direction = length > 0 ? light.direction / length : glm::vec3(0, -1, 0);
    g.shadow = -1;
    g.intensity = light.intensity;
    g.range = light.range;
    g.cosInner = -2.0f;
    g.cosOuter = -3.0f;
    g.falloff = light.falloff;
    g.customFalloff = light.customFalloff ? 1u : 0u;
    g.flags = light.castsShadow ? LIGHT_CASTS_SHADOW : 0u;
    g.sampleGrid = 4;
    basis(g.direction, g.halfU, g.halfV);
    switch (light.type) {
        case LightType::Point:
            g.type = LIGHT_POINT;
            break;
        case LightType::Spot:
            g.type = light.outerAngle > kWidestSingleMap ? LIGHT_POINT : LIGHT_SPOT;
            g.cosInner = std::cos(light.innerAngle);
            g.cosOuter = std::cos(light.outerAngle);
            break;
        case LightType::Directional:
            g.type = LIGHT_DIRECTIONAL;
            break;
        case LightType::Rect:
            g.type = LIGHT_RECT;
            g.halfU = light.halfU;
            g.halfV = light.halfV;
            // The normal is that of the edges; `direction` only says which side shines.
            if (const glm::vec3 n = glm::cross(g.halfU, g.halfV); glm::length(n) > 0)
                g.direction = glm::normalize(n) * (glm::dot(n, g.direction) < 0 ? -1.0f : 1.0f);
            break;
    }
    return g;
}

}  // namespace

std::vector<gpu::Light> packedLights(const std::vector<Light>& lights) {
    std::vector<gpu::Light> table;
    for (const Light& light : lights)
        if (light.enabled) table.push_back(packed(light));
    std::stable_sort(table.begin(), table.end(),
                     [](const gpu::Light& a, const gpu::Light& b) { return a.type < b.type; });
    return table;
}

glm::uvec4 lightEnds(const std::vector<gpu::Light>& lights) {
    glm::uvec4 ends(0);
    for (const gpu::Light& light : lights)
        for (int kind = static_cast<int>(light.type); kind < 4; ++kind) ++ends[kind];
    return ends;
}

}  // namespace conelight::scene
