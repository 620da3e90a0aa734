// SPDX-License-Identifier: MIT
// Sets of cones that stand for a hemisphere: name and count -> directions, apertures, weights.
//
// Method: the hemisphere about +z is cut into one cell per cone; each cone takes over the moments of order
// zero and one of its cell under the cosine weight (docs/theory/4a_cones.md, (4.5) to (4.8)):
//   weight     the cell's cosine integral                    -> the weights of a set sum to pi
//   direction  the cell's cosine-weighted mean direction, normalised
//   aperture   such that the plain mean over the cone has the length of that mean direction; for a cap this
//              is the cap itself, so N small equal cells get cones of 2 pi / N each
// So any surrounding that is linear in direction is integrated exactly by cones that average it.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "conelight/settings.h"

namespace conelight::gather {

struct Cone {
    glm::vec3 direction;  // unit, z > 0 (z is the surface's normal)
    float weight;         // sr, cosine-weighted
    float cosHalfAngle;   // [1/3, 1)
    float tanHalfAngle() const;
};

constexpr int kMaxCones = 64;  // size of the table in shared/cones.h

// The cones of a set; `count` (1..kMaxCones) counts for DiffuseSet::Fibonacci only.
//   One, Five, Six, Nine  a polar cap and rings of sectors, all cells of one set of equal solid angle
//   Fibonacci             Voronoi cells of a spherical Fibonacci lattice (Gonzalez 2010, "Measurement of
//   Areas
//                         on a Sphere Using Fibonacci and Latitude-Longitude Lattices"), any count
//   Best6 ...     a search over nine scenes (docs/measurements/cone_sets.md); apertures and weights are its own
//   Own           none: they are given
std::vector<Cone> coneSet(DiffuseSet set, int count);

// The set that the settings name.
std::vector<Cone> coneSet(const ConesSettings& settings);

}  // namespace conelight::gather
