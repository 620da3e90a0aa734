// SPDX-License-Identifier: MIT
#include "gather/cone_set.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/assert.h"

namespace conelight::gather {
namespace {

// Integrals over a cell of the hemisphere: of cos, and of the direction times cos.
struct Moments {
    double cosine = 0;
    glm::dvec3 direction{0};
};

// Cell between two heights z (= cosines) and azimuths center +- halfWidth, in closed form:
//   int z dw               = 2 halfWidth (z1^2 - z0^2) / 2
//   int z z dw             = 2 halfWidth (z1^3 - z0^3) / 3
//   int sqrt(1-z^2) z dw   = 2 sin(halfWidth) ((1-z0^2)^(3/2) - (1-z1^2)^(3/2)) / 3     along the centre
Moments sectorMoments(double z0, double z1, double center, double halfWidth) {
    const double width = 2 * halfWidth;
    const double lateral =
        2 * std::sin(halfWidth) * (std::pow(1 - z0 * z0, 1.5) - std::pow(1 - z1 * z1, 1.5)) / 3;
    return {
        width * (z1 * z1 - z0 * z0) / 2,
        {lateral * std::cos(center), lateral * std::sin(center), width * (z1 * z1 * z1 - z0 * z0 * z0) / 3}};
}

// A polar cap and rings of `ringCounts` sectors, every cell 2 pi / N. Each ring is turned against the one
// inside it by half a sector, so that its cones look between the others.
std::vector<Moments> ringCells(const std::vector<int>& ringCounts) {
    int total = 1;
    for (const int count : ringCounts) total += count;
    std::vector<Moments> cells;
    // Solid angle is proportional to the height difference: a cell takes 1 / N of the unit height.
    double top = 1.0;
    double bottom = 1.0 - 1.0 / total;
    cells.push_back(sectorMoments(bottom, top, 0, std::numbers::pi));
    // First azimuth: a quarter sector, by eye. Cones along grid axes or diagonals would see walls of voxels
    // edge on, and show the grid.
    double turn = 0.25;
    for (const int count : ringCounts) {
        top = bottom;
        bottom = std::max(0.0, top - static_cast<double>(count) / total);
        for (int i = 0; i < count; ++i)
            cells.push_back(sectorMoments(bottom, top, 2 * std::numbers::pi * (i + turn) / count,
                                          std::numbers::pi / count));
        turn += 0.5;
    }
    return cells;
}

// Voronoi cells of the lattice z = 1 - (i + 1/2) / N, azimuth i times the golden angle. Integrated by the
// midpoint rule on a product grid, whose sums over the hemisphere are exact for 1 and z, 0 for x and y, and
// off by 1 / (4 kHeights^2) for z^2.
std::vector<Moments> fibonacciCells(int count) {
    constexpr int kHeights = 128;   // 3e-5 relative error of the mean direction's length
    constexpr int kAzimuths = 256;  // 64 cones: 512 points per cell, edges blurred to 2 % of its width
    const double goldenAngle = std::numbers::pi * (3 - std::sqrt(5.0));
    std::vector<glm::vec3> seeds;
    for (int i = 0; i < count; ++i) {
        const double z = 1 - (i + 0.5) / count;
        const double r = std::sqrt(1 - z * z);
        seeds.emplace_back(r * std::cos(i * goldenAngle), r * std::sin(i * goldenAngle), z);
    }
    std::vector<Moments> cells(static_cast<std::size_t>(count));
    for (int i = 0; i < kHeights; ++i) {
        const double z = (i + 0.5) / kHeights;
        const double r = std::sqrt(1 - z * z);
        for (int j = 0; j < kAzimuths; ++j) {
            const double azimuth = 2 * std::numbers::pi * (j + 0.5) / kAzimuths;
            const glm::dvec3 direction{r * std::cos(azimuth), r * std::sin(azimuth), z};
            std::size_t nearest = 0;
            float best = -2;
            for (std::size_t k = 0; k < seeds.size(); ++k) {
                const float cosine = glm::dot(seeds[k], glm::vec3(direction));
                if (cosine <= best) continue;
                best = cosine;
                nearest = k;
            }
            const double weight = z * 2 * std::numbers::pi / (static_cast<double>(kHeights) * kAzimuths);
            cells[nearest].cosine += weight;
            cells[nearest].direction += weight * direction;
        }
    }
    return cells;
}

// A ring of the sets that a search found: degrees from the normal, full angle in rad, part of all weight.
struct FoundRing {
    int cones;
    double tilt, aperture, weight;
};

// Tuned on the nine scenes of docs/measurements/cone_sets.md, each held out in turn there.
std::vector<FoundRing> foundRings(DiffuseSet set) {
    switch (set) {
        case DiffuseSet::Best6:
            return {{1, 0, 0.70, 0.21}, {5, 50, 0.65, 0.79}};
        case DiffuseSet::Best9:
            return {{3, 25, 0.65, 0.44}, {6, 60, 0.45, 0.56}};
        case DiffuseSet::Best12:
            return {{1, 0, 0.70, 0.06}, {3, 25, 0.65, 0.31}, {8, 55, 0.45, 0.63}};
        default:
            return {{1, 0, 0.70, 0.10}, {7, 35, 0.65, 0.46}, {8, 60, 0.45, 0.44}};
    }
}

std::vector<Cone> bestCones(DiffuseSet set) {
    std::vector<Cone> cones;
    double turn = 0.25;  // as in the search: each ring looks between the cones of the one inside it
    for (const FoundRing& ring : foundRings(set)) {
        const double tilt = ring.tilt * std::numbers::pi / 180;
        for (int i = 0; i < ring.cones; ++i) {
            const double azimuth = 2 * std::numbers::pi * (i + turn) / ring.cones;
            cones.push_back({glm::vec3(std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth),
                                       std::cos(tilt)),
                             static_cast<float>(ring.weight * std::numbers::pi / ring.cones),
                             static_cast<float>(std::cos(0.5 * ring.aperture))});
        }
        if (ring.cones > 1) turn += 0.5;
    }
    return cones;
}

}  // namespace

float Cone::tanHalfAngle() const { return std::sqrt(1 - cosHalfAngle * cosHalfAngle) / cosHalfAngle; }

std::vector<Cone> coneSet(DiffuseSet set, int count) {
    CONELIGHT_ASSERT(count >= 1 && count <= kMaxCones, "a cone set has 1 to 64 cones");
    std::vector<Moments> cells;
    switch (set) {
        case DiffuseSet::One:
            cells = ringCells({});
            break;
        case DiffuseSet::Five:
            cells = ringCells({4});
            break;
        case DiffuseSet::Six:
            cells = ringCells({5});
            break;
        case DiffuseSet::Nine:
            cells = ringCells({4, 4});
            break;
        case DiffuseSet::Fibonacci:
            cells = fibonacciCells(count);
            break;
        case DiffuseSet::Best6:
        case DiffuseSet::Best9:
        case DiffuseSet::Best12:
        case DiffuseSet::Best16:
            return bestCones(set);
        case DiffuseSet::Own:
            break;
    }
    std::vector<Cone> cones;
    for (const Moments& cell : cells) {
        // A cone of half-angle t has the mean direction (1 + cos t) / 2 along its axis.
        const double length = glm::length(cell.direction);
        const double mean = std::min(length / cell.cosine, 1.0);
        cones.push_back({glm::vec3(cell.direction / length), static_cast<float>(cell.cosine),
                         static_cast<float>(2 * mean - 1)});
    }
    return cones;
}

std::vector<Cone> coneSet(const ConesSettings& settings) {
    if (settings.diffuseSet == DiffuseSet::Own && settings.ownSet.empty()) return coneSet(DiffuseSet::Six, 6);
    if (settings.diffuseSet != DiffuseSet::Own) return coneSet(settings.diffuseSet, settings.count);
    double weights = 0;
    for (const SetCone& cone : settings.ownSet) weights += double(cone.weight);
    std::vector<Cone> cones;
    for (const SetCone& cone : settings.ownSet)
        cones.push_back({glm::normalize(cone.direction),
                         static_cast<float>(double(cone.weight) * std::numbers::pi / weights),
                         std::cos(0.5f * cone.aperture)});
    return cones;
}

}  // namespace conelight::gather
