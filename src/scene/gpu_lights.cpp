// SPDX-License-Identifier: MIT
#include "scene/gpu_lights.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "scene/light_profile.h"

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
    if (light.profile != nullptr && !hasArea(light.type)) {
        const ProfileFrame axes = profileFrame(light);
        g.halfU = axes.u;
        g.halfV = axes.v;
    }
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
        case LightType::Sphere:
            g.type = LIGHT_RECT;
            g.flags |= LIGHT_SPHERE;
            g.halfU *= glm::length(light.halfU);
            g.halfV *= glm::length(light.halfU);
            break;
        case LightType::Disk:
            g.flags |= LIGHT_DISK;
            [[fallthrough]];
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

Profiles profilesOf(const std::vector<Light>& lights) {
    Profiles all;
    for (const Light& light : lights) {
        const bool used = light.enabled && light.profile != nullptr &&
                          (light.type == LightType::Point || light.type == LightType::Spot);
        if (used && all.size() < kMostProfiles &&
            std::find(all.begin(), all.end(), light.profile) == all.end())
            all.push_back(light.profile);
    }
    return all;
}

std::vector<gpu::Light> packedLights(const std::vector<Light>& lights) {
    std::vector<gpu::Light> table;
    const Profiles profiles = profilesOf(lights);
    for (const Light& light : lights) {
        if (!light.enabled) continue;
        table.push_back(packed(light));
        const auto layer = std::find(profiles.begin(), profiles.end(), light.profile);
        if (table.back().type <= LIGHT_SPOT && layer != profiles.end())
            table.back().flags |= static_cast<std::uint32_t>(layer - profiles.begin() + 1)
                                  << LIGHT_PROFILE_SHIFT;
    }
    std::stable_sort(table.begin(), table.end(),
                     [](const gpu::Light& a, const gpu::Light& b) { return a.type < b.type; });
    return table;
}

float areaOf(const gpu::Light& light) {
    const bool round = (light.flags & (LIGHT_DISK | LIGHT_SPHERE)) != 0;
    return (round ? glm::pi<float>() : 4.0f) * glm::length(glm::cross(light.halfU, light.halfV));
}

glm::uvec4 lightEnds(const std::vector<gpu::Light>& lights) {
    glm::uvec4 ends(0);
    for (const gpu::Light& light : lights)
        for (int kind = static_cast<int>(light.type); kind < 4; ++kind) ++ends[kind];
    return ends;
}

}  // namespace conelight::scene
