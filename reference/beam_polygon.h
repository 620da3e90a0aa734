// SPDX-License-Identifier: MIT
// Convex polygons in space, planes that cut them, and the point (or direction) that the edges of a beam meet in.
// In double precision: a beam is cut many times, and its parts must fit together.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

namespace conelight::reference {

// Corners of a flat convex polygon, in order.
using Corners = std::vector<glm::dvec3>;

struct BeamPlane {
    glm::dvec3 normal{0};  // unit
    double offset = 0;
    double at(const glm::dvec3& p) const { return glm::dot(normal, p) - offset; }
};

// Where a beam comes from: a point, or for parallel beams the unit direction towards it, infinitely far away.
struct BeamApex {
    glm::dvec3 place{0};
    bool parallel = false;

    // On which side of a plane, and how far (parallel: the cosine).
    double side(const BeamPlane& plane) const {
        return glm::dot(plane.normal, place) - (parallel ? 0.0 : plane.offset);
    }
};

struct BeamBox {
    glm::dvec3 low{1e300}, high{-1e300};
    void grow(const Corners& corners);
    bool meets(const BeamBox& other, double margin) const;
    // The largest value of the plane's at() in the box.
    double most(const BeamPlane& plane) const;
};

enum class Side { Front, Back, Both, On };
// Corners closer to the plane than `within` are on it.
Side sideOf(const Corners& polygon, const BeamPlane& plane, double within);
// The parts in front of the plane and behind it; only for Side::Both. Neighbours that are cut by the same plane get the
// same new corners but for rounding.
struct CutPolygon {
    Corners front, back;
};
CutPolygon cut(const Corners& polygon, const BeamPlane& plane, double within);
// What is in front of the plane; false when nothing is.
bool keepFront(Corners& polygon, const BeamPlane& plane, double within);

// Through the polygon's corners (Newell's method); false for one without area.
bool planeOf(const Corners& polygon, BeamPlane& plane);
// Through two points and the apex, with `inside` in front; false where they lie in one line with it.
bool planeThrough(const BeamApex& apex, const std::array<glm::dvec3, 2>& edge, const glm::dvec3& inside,
                  BeamPlane& plane);
// Planes through the apex and each edge, the polygon in front of them.
std::vector<BeamPlane> sidesOf(const BeamApex& apex, const Corners& polygon);
glm::dvec3 centroidOf(const Corners& polygon);  // mean of the corners

glm::dvec3 reflected(const glm::dvec3& p, const BeamPlane& mirror);
BeamApex reflected(const BeamApex& apex, const BeamPlane& mirror);

}  // namespace conelight::reference
