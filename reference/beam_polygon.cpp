// SPDX-License-Identifier: MIT
#include "reference/beam_polygon.h"

#include <algorithm>
#include <cmath>

namespace conelight::reference {
namespace {

// Sine of an angle below which three points are taken to be in one line.
constexpr double kInLine = 1e-12;

}  // namespace

void BeamBox::grow(const Corners& corners) {
    for (const glm::dvec3& corner : corners) {
        low = glm::min(low, corner);
        high = glm::max(high, corner);
    }
}

bool BeamBox::meets(const BeamBox& other, double margin) const {
    return glm::all(glm::lessThanEqual(low, other.high + margin)) &&
           glm::all(glm::lessThanEqual(other.low, high + margin));
}

double BeamBox::most(const BeamPlane& plane) const {
    return plane.at({plane.normal.x > 0 ? high.x : low.x, plane.normal.y > 0 ? high.y : low.y,
                     plane.normal.z > 0 ? high.z : low.z});
}

Side sideOf(const Corners& polygon, const BeamPlane& plane, double within) {
    bool front = false, back = false;
    for (const glm::dvec3& corner : polygon) {
        const double at = plane.at(corner);
        front |= at > within;
        back |= at < -within;
    }
    if (front) return back ? Side::Both : Side::Front;
    return back ? Side::Back : Side::On;
}

CutPolygon cut(const Corners& polygon, const BeamPlane& plane, double within) {
    CutPolygon parts;
    parts.front.reserve(polygon.size() + 1);
    parts.back.reserve(polygon.size() + 1);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double atA = plane.at(a), atB = plane.at(b);
        if (atA >= -within) parts.front.push_back(a);
        if (atA <= within) parts.back.push_back(a);
        if ((atA > within && atB < -within) || (atA < -within && atB > within)) {
            // From the front to the back whatever the order, so that neighbours round alike.
            const bool forward = atA > 0;
            const glm::dvec3 &p = forward ? a : b, &q = forward ? b : a;
            const double atP = forward ? atA : atB, atQ = forward ? atB : atA;
            const glm::dvec3 corner = p + (q - p) * (atP / (atP - atQ));
            parts.front.push_back(corner);
            parts.back.push_back(corner);
        }
    }
    return parts;
}

bool keepFront(Corners& polygon, const BeamPlane& plane, double within) {
    switch (sideOf(polygon, plane, within)) {
        case Side::Front:
            return true;
        case Side::Both:
            polygon = cut(polygon, plane, within).front;
            return polygon.size() >= 3;
        default:
            return false;
    }
}

bool planeOf(const Corners& polygon, BeamPlane& plane) {
    const glm::dvec3 middle = centroidOf(polygon);
    glm::dvec3 sum(0);
    double longest = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 a = polygon[i] - middle, b = polygon[(i + 1) % polygon.size()] - middle;
        sum += glm::cross(a, b);
        longest = std::max(longest, glm::dot(a, a));
    }
    const double length = glm::length(sum);
    if (!(length > kInLine * longest)) return false;
    plane.normal = sum / length;
    plane.offset = glm::dot(plane.normal, middle);
    return true;
}

bool planeThrough(const BeamApex& apex, const std::array<glm::dvec3, 2>& edge, const glm::dvec3& inside,
                  BeamPlane& plane) {
    const glm::dvec3 way = apex.parallel ? apex.place : apex.place - edge[0];
    const glm::dvec3 cross = glm::cross(edge[1] - edge[0], way);
    const double length = glm::length(cross);
    if (!(length > kInLine * glm::length(edge[1] - edge[0]) * glm::length(way)) || !(length > 0))
        return false;
    plane.normal = cross / length;
    plane.offset = glm::dot(plane.normal, edge[0]);
    if (plane.at(inside) < 0) plane = {-plane.normal, -plane.offset};
    return true;
}

std::vector<BeamPlane> sidesOf(const BeamApex& apex, const Corners& polygon) {
    std::vector<BeamPlane> sides;
    const glm::dvec3 middle = centroidOf(polygon);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        BeamPlane plane;
        if (planeThrough(apex, {polygon[i], polygon[(i + 1) % polygon.size()]}, middle, plane))
            sides.push_back(plane);
    }
    return sides;
}

glm::dvec3 centroidOf(const Corners& polygon) {
    glm::dvec3 sum(0);
    for (const glm::dvec3& corner : polygon) sum += corner;
    return sum / static_cast<double>(polygon.size());
}

glm::dvec3 reflected(const glm::dvec3& p, const BeamPlane& mirror) {
    return p - 2 * mirror.at(p) * mirror.normal;
}

BeamApex reflected(const BeamApex& apex, const BeamPlane& mirror) {
    if (!apex.parallel) return {reflected(apex.place, mirror), false};
    return {apex.place - 2 * glm::dot(apex.place, mirror.normal) * mirror.normal, true};
}

}  // namespace conelight::reference
