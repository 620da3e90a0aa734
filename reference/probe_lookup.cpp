// SPDX-License-Identifier: MIT
// What a host's shader does with probes, and the picture that comes of it.
#include <algorithm>
#include <cmath>

#include "math/octahedral.h"

#include <glm/gtc/constants.hpp>
#include "reference/probes.h"

namespace conelight::reference {
namespace {

// As Majercik et al. 2019 have them: points are looked up off their surface by this share of the spacing, and
// probes behind it still count a little.
constexpr float kNormalBias = 0.2f, kLeastFacing = 0.2f;
constexpr float kLeastVariance = 1e-4f;  // of distances, in squares of the spacing

// Bilinear, continued over the edges of the octahedral square.
template <class Texels>
auto octahedralAt(const Texels& texels, int side, const glm::vec3& direction) {
    const glm::vec2 at = (math::octEncode(direction) * 0.5f + 0.5f) * static_cast<float>(side) - 0.5f;
    const glm::ivec2 corner(glm::floor(at));
    const glm::vec2 f = at - glm::vec2(corner);
    const auto fetch = [&](int x, int y) {
        if (x < 0 || x >= side) {
            x = std::clamp(x, 0, side - 1);
            y = side - 1 - y;
        }
        if (y < 0 || y >= side) {
            y = std::clamp(y, 0, side - 1);
            x = side - 1 - x;
        }
        return texels[static_cast<std::size_t>(x + side * y)];
    };
    return glm::mix(glm::mix(fetch(corner.x, corner.y), fetch(corner.x + 1, corner.y), f.x),
                    glm::mix(fetch(corner.x, corner.y + 1), fetch(corner.x + 1, corner.y + 1), f.x), f.y);
}

// The chance that a probe sees a point (Chebyshev; Donnelly and Lauritzen 2006, "Variance Shadow Maps").
float visibility(const Probe& probe, const glm::vec3& point, float spacing) {
    const glm::vec3 way = point - probe.position;
    const float distance = glm::length(way);
    if (!(distance > 0)) return 1;
    const glm::vec2 mean = octahedralAt(probe.distance, kDistanceSide, way / distance);
    if (distance <= mean.x) return 1;
    const float variance = std::max(mean.y - mean.x * mean.x, kLeastVariance * spacing * spacing);
    const float beyond = distance - mean.x;
    const float chance = variance / (variance + beyond * beyond);
    return chance * chance * chance;
}

}  // namespace

std::array<float, 9> harmonicsAt(const glm::vec3& d) {
    return {0.282095f,
            0.488603f * d.y,
            0.488603f * d.z,
            0.488603f * d.x,
            1.092548f * d.x * d.y,
            1.092548f * d.y * d.z,
            0.315392f * (3 * d.z * d.z - 1),
            1.092548f * d.x * d.z,
            0.546274f * (d.x * d.x - d.y * d.y)};
}

glm::vec3 irradianceOf(const std::array<glm::vec3, 9>& harmonics, const glm::vec3& normal) {
    const std::array<float, 9> basis = harmonicsAt(normal);
    glm::vec3 sum(0);
    for (std::size_t k = 0; k < basis.size(); ++k) {
        // The cosine's own projection, by band.
        const float cosine = k == 0  ? glm::pi<float>()
                             : k < 4 ? 2 * glm::pi<float>() / 3
                                     : glm::pi<float>() / 4;
        sum += harmonics[k] * (cosine * basis[k]);
    }
    return glm::max(sum, glm::vec3(0));
}

glm::vec3 irradianceAt(const ProbeVolume& volume, ProbeKind kind, const glm::vec3& point,
                       const glm::vec3& normal) {
    const ProbeGrid& grid = volume.grid;
    const float spacing = std::min({grid.spacing.x, grid.spacing.y, grid.spacing.z});
    const glm::vec3 lifted = point + normal * (kNormalBias * spacing);
    const glm::vec3 cell =
        glm::clamp((lifted - grid.origin) / grid.spacing, glm::vec3(0), glm::vec3(grid.counts - 1));
    const glm::ivec3 corner(glm::floor(cell));
    const glm::vec3 f = cell - glm::vec3(corner);
    glm::vec3 sum(0), blind(0);
    float weights = 0, blindWeights = 0;
    for (int i = 0; i < 8; ++i) {
        const glm::ivec3 step(i & 1, i >> 1 & 1, i >> 2);
        const glm::vec3 share = glm::mix(1.0f - f, f, glm::vec3(step));
        const float placed = share.x * share.y * share.z;
        const Probe& probe = volume.probes[grid.index(glm::min(corner + step, grid.counts - 1))];
        if (placed <= 0 || !probe.active) continue;
        const glm::vec3 way = probe.position - point;
        const float length = glm::length(way);
        const float facing = length > 0 ? (glm::dot(way / length, normal) + 1) * 0.5f : 1;
        const float weight = std::max(placed, 1e-3f) * (facing * facing + kLeastFacing);
        const glm::vec3 light = kind == ProbeKind::Harmonics
                                    ? irradianceOf(probe.harmonics, normal)
                                    : octahedralAt(probe.irradiance, kIrradianceSide, normal);
        const float seen = weight * visibility(probe, lifted, spacing);
        sum += light * seen;
        weights += seen;
        blind += light * weight;
        blindWeights += weight;
    }
    if (weights > 1e-6f) return sum / weights;
    return blindWeights > 0 ? blind / blindWeights : glm::vec3(0);
}

BakedPicture drawWithProbes(const Scene& scene, const ProbeVolume& volume, ProbeKind kind,
                            const Camera& camera, const PathTracedPicture& truth) {
    return drawWithIrradiance(scene, camera, truth, [&](const Surface& surface, const RayHit&) {
        return irradianceAt(volume, kind, surface.position, surface.shadingNormal);
    });
}

}  // namespace conelight::reference
