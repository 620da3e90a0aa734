// SPDX-License-Identifier: MIT
// Light probes: a scene -> indirect irradiance at the points of a grid, as spherical harmonics and as
// octahedral maps with distances, for hosts that look it up themselves. Method and layout: docs/guide/bake.md.
//
// What arrives is what the path tracer finds along rays from a probe, less what lights and flat emissive quads
// send straight: hosts draw that themselves. Light of the sky and of other emitters is in it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "conelight/scene.h"
#include "reference/baked_picture.h"
#include "reference/partial_bake.h"

namespace conelight::reference {

struct ProbeGrid {
    glm::vec3 origin{0};  // of probe 0, 0, 0; m
    glm::vec3 spacing{1};
    glm::ivec3 counts{1};

    std::size_t size() const {
        return static_cast<std::size_t>(counts.x) * static_cast<std::size_t>(counts.y) *
               static_cast<std::size_t>(counts.z);
    }
    // x runs fastest, then y.
    std::size_t index(const glm::ivec3& at) const {
        return static_cast<std::size_t>(at.x + counts.x * (at.y + counts.y * at.z));
    }
    glm::vec3 place(const glm::ivec3& at) const { return origin + spacing * glm::vec3(at); }
};
// Cells of equal size, at most `spacing` m long, that fill the bounds; a probe in the middle of each. Throws
// Error(Usage) for a spacing that is not above 0 and for more than kMostProbes.
constexpr std::size_t kMostProbes = 1 << 18;
ProbeGrid fitProbeGrid(const Aabb& bounds, float spacing);

constexpr int kIrradianceSide = 8;  // texels of an octahedral map
constexpr int kDistanceSide = 16;

struct Probe {
    glm::vec3 position{0};  // moved off its place in the grid where that is in or near a wall
    bool active = false;    // false: in a wall or left out, and not to be used
    // Radiance, W/(sr m^2), projected on the nine real harmonics up to band 2, in the order of
    // harmonicsAt().
    std::array<glm::vec3, 9> harmonics{};
    // Irradiance, W/m^2, by normal; row by row, texel (x, y) is octDecode((2 (x, y) + 1) / side - 1).
    std::array<glm::vec3, kIrradianceSide * kIrradianceSide> irradiance{};
    // Distance to what is met about a direction, m, and its square: means.
    std::array<glm::vec2, kDistanceSide * kDistanceSide> distance{};
};

struct ProbeVolume {
    ProbeGrid grid;
    std::vector<Probe> probes;  // grid.size()
};

struct ProbeSettings {
    int samples = 1024;  // rays of a probe; 16..2^20
    int bounces = -1;    // of indirect light, 1 or more; -1: all
    std::uint32_t seed = 1;
    int threads = 0;            // 0: all cores
    bool nearSurfaces = false;  // those that no lookup at a surface reads are not active, and cost nothing
};

// `onProgress(done)`, done in [0,1], is called now and then; when it returns false, an empty volume is
// returned. The same bits for the same seed, whatever the number of threads. `partial`: probes that are done are
// taken from it, and others put there.
ProbeVolume bakeProbes(const Scene& scene, const ProbeGrid& grid, const ProbeSettings& settings,
                       const std::function<bool(double)>& onProgress = {}, PartialBake* partial = nullptr);

// The nine harmonics at a unit direction: 1; y, z, x; xy, yz, 3z^2 - 1, xz, x^2 - y^2, orthonormal (Ramamoorthi
// and Hanrahan 2001, "An Efficient Representation for Irradiance Environment Maps").
std::array<float, 9> harmonicsAt(const glm::vec3& direction);
// Irradiance on a plane facing `normal`, W/m^2, from projected radiance.
glm::vec3 irradianceOf(const std::array<glm::vec3, 9>& harmonics, const glm::vec3& normal);

enum class ProbeKind { Harmonics, Octahedral };
// Irradiance at a surface point: eight probes weighted by place, facing and visibility (Majercik et al. 2019,
// "Dynamic Diffuse Global Illumination with Ray-Traced Irradiance Fields").
glm::vec3 irradianceAt(const ProbeVolume& volume, ProbeKind kind, const glm::vec3& point,
                       const glm::vec3& normal);

BakedPicture drawWithProbes(const Scene& scene, const ProbeVolume& volume, ProbeKind kind,
                            const Camera& camera, const PathTracedPicture& truth);

}  // namespace conelight::reference
