// SPDX-License-Identifier: MIT
// Form factor from a point to a polygon, unoccluded: the part of the light from a diffuse surface that comes
// from the polygon. Lambert's formula (Baum, Rushmeier and Winget 1989, "Improving radiosity solutions
// through the use of analytically determined form-factors"), after clipping to the horizon of the receiver.
// Exact.
#pragma once

#include <glm/glm.hpp>
#include <span>

namespace conelight::reference {

constexpr std::size_t kMostCorners = 32;

// [0,1]. `corners` in order around the polygon, flat and convex, at most kMostCorners; both windings count the same.
// `normal` is unit. 0 where the polygon is below the horizon.
double polygonFormFactor(const glm::dvec3& point, const glm::dvec3& normal,
                         std::span<const glm::dvec3> corners);

}  // namespace conelight::reference
