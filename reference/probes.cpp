// SPDX-License-Identifier: MIT
// Rays of a probe are stratified over the sphere; each carries one path, so a probe is an unbiased estimate of
// its projected radiance. Irradiance and distances are weighted means of the same rays.
#include "reference/probes.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <thread>

#include "base/log.h"
#include "math/octahedral.h"
#include "reference/arriving_light.h"
#include "reference/probe_placement.h"
#include "reference/radiosity_parallel.h"

namespace conelight::reference {
namespace {

// A probe that sees backs along more than this share of its rays is in a wall (Majercik et al. 2019).
constexpr float kMostProbeBacks = 0.25f;
// Probes keep this share of the spacing away from walls, and leave their place by at most the second share.
constexpr float kClearance = 0.2f, kMostMove = 0.45f;
constexpr int kMoves = 6;
constexpr int kMoveRays = 128;
// Distances count by this power of the cosine to a texel's direction, and up to this many cells.
constexpr float kDistancePower = 50, kFarthest = 1.5f;

glm::vec3 onSphere(const glm::vec2& u) {
    const float z = 1 - 2 * u.x, r = std::sqrt(std::max(0.0f, 1 - z * z)), phi = 2 * glm::pi<float>() * u.y;
    return {r * std::cos(phi), r * std::sin(phi), z};
}

constexpr float kOnSphere = 1 / (4 * glm::pi<float>());  // density of onSphere()

template <std::size_t N>
std::vector<glm::vec3> directionsOf(int side) {
    std::vector<glm::vec3> directions(N);
    for (std::size_t i = 0; i < N; ++i) {
        const glm::vec2 texel(static_cast<int>(i) % side, static_cast<int>(i) / side);
        directions[i] = math::octDecode((2.0f * texel + 1.0f) / static_cast<float>(side) - 1.0f);
    }
    return directions;
}

class ProbeBake {
  public:
    ProbeBake(const Scene& scene, const ProbeGrid& grid, const ProbeSettings& settings)
        : rays_(scene, {settings.samples, settings.bounces, settings.seed}),
          grid_(grid),
          settings_(settings) {}

    Probe probe(const glm::ivec3& at) const {
        Probe result;
        settle(result, grid_.place(at));
        if (result.active) gather(result, static_cast<std::uint32_t>(grid_.index(at)));
        return result;
    }

  private:
    float clearance() const {
        return kClearance * std::min({grid_.spacing.x, grid_.spacing.y, grid_.spacing.z});
    }

    // What a look around from a point tells: is it in a wall, and where to go from here.
    struct Look {
        float backs = 0;
        glm::vec3 move{0};
    };
    Look look(const glm::vec3& from) const {
        float nearestBack = INFINITY, nearestFront = INFINITY;
        glm::vec3 toBack(0), toFront(0);
        int backs = 0;
        for (int i = 0; i < kMoveRays; ++i) {
            Sampler sampler(1, static_cast<std::uint32_t>(i), std::bit_width(unsigned(kMoveRays) - 1));
            const glm::vec3 direction = onSphere(sampler.next2());
            RayHit hit;
            const Arriving met = rays_.meet(from, direction, hit);
            if (!std::isfinite(met.distance)) continue;
            backs += met.back ? 1 : 0;
            float& nearest = met.back ? nearestBack : nearestFront;
            if (met.distance >= nearest) continue;
            nearest = met.distance;
            (met.back ? toBack : toFront) = direction;
        }
        Look result;
        result.backs = static_cast<float>(backs) / kMoveRays;
        if (result.backs > kMostProbeBacks)
            result.move = toBack * (nearestBack + clearance());
        else if (nearestFront < clearance())
            result.move = toFront * (nearestFront - clearance());
        return result;
    }

    void settle(Probe& probe, const glm::vec3& place) const {
        glm::vec3 position = place;
        Look seen = look(position);
        probe.position = position;
        probe.active = seen.backs <= kMostProbeBacks;
        for (int i = 0; i < kMoves && seen.move != glm::vec3(0); ++i) {
            position = glm::clamp(position + seen.move, place - kMostMove * grid_.spacing,
                                  place + kMostMove * grid_.spacing);
            seen = look(position);
            if (seen.backs > kMostProbeBacks) continue;
            probe.position = position;
            probe.active = true;
        }
    }

    void gather(Probe& probe, std::uint32_t index) const {
        static const std::vector<glm::vec3> normals =
            directionsOf<kIrradianceSide * kIrradianceSide>(kIrradianceSide);
        static const std::vector<glm::vec3> ways = directionsOf<kDistanceSide * kDistanceSide>(kDistanceSide);
        const float farthest = kFarthest * glm::length(grid_.spacing);
        std::array<float, kIrradianceSide * kIrradianceSide> cosines{};
        std::array<float, kDistanceSide * kDistanceSide> powers{};
        const std::uint32_t key = combineBits(mixBits(settings_.seed), index);
        const int bits = std::bit_width(static_cast<unsigned>(settings_.samples - 1));
        PathSample path;
        const scene::Surroundings& surroundings = rays_.surroundings();
        const auto add = [&](const glm::vec3& radiance, const glm::vec3& direction) {
            const std::array<float, 9> basis = harmonicsAt(direction);
            for (std::size_t k = 0; k < basis.size(); ++k) probe.harmonics[k] += radiance * basis[k];
            for (std::size_t k = 0; k < normals.size(); ++k)
                probe.irradiance[k] += radiance * std::max(glm::dot(normals[k], direction), 0.0f);
        };
        for (int i = 0; i < settings_.samples; ++i) {
            Sampler sampler(key, static_cast<std::uint32_t>(i), bits);
            const glm::vec3 direction = onSphere(sampler.next2());
            const scene::Surroundings::Draw sky =
                surroundings.hasPicture() ? surroundings.draw(sampler.next2()) : scene::Surroundings::Draw{};
            const Arriving met = rays_.arriving(probe.position, direction, sampler, path);
            const bool alsoDrawn = surroundings.hasPicture() && !std::isfinite(met.distance);
            add(met.radiance * (alsoDrawn ? misWeight(kOnSphere, surroundings.density(direction)) : 1.0f),
                direction);
            // A sun of a few texels is met by hardly any ray: directions of a picture are drawn by its light, too.
            if (sky.density > 0 && rays_.isOpen(probe.position, sky.direction))
                add(surroundings.radiance(sky.direction) *
                        (kOnSphere / sky.density * misWeight(sky.density, kOnSphere)),
                    sky.direction);
            for (std::size_t k = 0; k < normals.size(); ++k)
                cosines[k] += std::max(glm::dot(normals[k], direction), 0.0f);
            const float distance = std::min(met.distance, farthest);
            for (std::size_t k = 0; k < ways.size(); ++k) {
                const float cosine = glm::dot(ways[k], direction);
                if (cosine <= 0.7f) continue;  // 0.7^50 is 2e-8
                const float weight = std::pow(cosine, kDistancePower);
                probe.distance[k] += glm::vec2(distance, distance * distance) * weight;
                powers[k] += weight;
            }
        }
        for (glm::vec3& c : probe.harmonics)
            c *= 4 * glm::pi<float>() / static_cast<float>(settings_.samples);
        for (std::size_t k = 0; k < cosines.size(); ++k)
            if (cosines[k] > 0) probe.irradiance[k] *= glm::pi<float>() / cosines[k];
        for (std::size_t k = 0; k < powers.size(); ++k)
            probe.distance[k] =
                powers[k] > 0 ? probe.distance[k] / powers[k] : glm::vec2(farthest, farthest * farthest);
    }

    ArrivingLight rays_;
    ProbeGrid grid_;
    ProbeSettings settings_;
};

}  // namespace

ProbeGrid fitProbeGrid(const Aabb& bounds, float spacing) {
    if (!(spacing > 0) || !std::isfinite(spacing))
        base::fail(ErrorKind::Usage, "probes %g m apart; right would be a distance above 0",
                   static_cast<double>(spacing));
    if (bounds.empty()) base::fail(ErrorKind::BadInput, "probes: the scene has no visible instance");
    ProbeGrid grid;
    double count = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const double cells = std::max(
            1.0, std::ceil(static_cast<double>(bounds.extent()[axis]) / static_cast<double>(spacing) - 1e-4));
        count *= cells;
        if (count > static_cast<double>(kMostProbes))
            base::fail(ErrorKind::Usage,
                       "probes %g m apart are more than %zu; right would be a larger spacing",
                       static_cast<double>(spacing), kMostProbes);
        grid.counts[axis] = static_cast<int>(cells);
    }
    grid.spacing = glm::max(bounds.extent() / glm::vec3(grid.counts), glm::vec3(1e-6f));
    grid.origin = bounds.min + 0.5f * grid.spacing;
    return grid;
}

ProbeVolume bakeProbes(const Scene& scene, const ProbeGrid& grid, const ProbeSettings& settings,
                       const std::function<bool(double)>& onProgress, PartialBake* partial) {
    if (settings.samples < 16 || settings.samples > (1 << 20) || settings.bounces < -1 ||
        settings.bounces == 0 || settings.threads < 0)
        base::fail(ErrorKind::Usage,
                   "probes: %d samples, %d bounces, %d threads; right would be 16 to 1048576, "
                   "-1 or 1 and more, 0 or more",
                   settings.samples, settings.bounces, settings.threads);
    scene.validate();
    const ProbeBake bake(scene, grid, settings);
    ProbeVolume volume{.grid = grid, .probes = std::vector<Probe>(grid.size())};
    if (partial != nullptr) partial->prepare(grid.size(), sizeof(Probe));
    const std::vector<bool> wanted =
        settings.nearSurfaces ? probesNearSurfaces(scene, grid) : std::vector<bool>(grid.size(), true);
    const auto body = [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (partial != nullptr && partial->take(i, volume.probes[i])) continue;
            const int n = static_cast<int>(i);
            const glm::ivec3 at(n % grid.counts.x, n / grid.counts.x % grid.counts.y,
                                n / (grid.counts.x * grid.counts.y));
            if (wanted[i])
                volume.probes[i] = bake.probe(at);
            else
                volume.probes[i].position = grid.place(at);
            if (partial != nullptr) partial->put(i, volume.probes[i]);
        }
    };
    return parallelFor(grid.size(), settings.threads, body, onProgress) ? volume : ProbeVolume{};
}

}  // namespace conelight::reference
