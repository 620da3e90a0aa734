// SPDX-License-Identifier: MIT
// Points of space on a drawing: a parallel projection, z up.
#pragma once

#include <array>
#include <vector>

#include "figures/drawings/drawing.h"

namespace conelight::figures {

struct SpaceView {
    Point origin{0};           // where (0,0,0) comes to lie, pixels
    double scale = 100;        // pixels per unit
    double azimuthDeg = 35;    // of the eye, from +x towards +y
    double elevationDeg = 25;  // of the eye

    Point at(const glm::dvec3& p) const;
    std::vector<Point> outline(const std::vector<glm::dvec3>& points) const;
    double depth(const glm::dvec3& p) const;  // larger is nearer to the eye
    glm::dvec3 toEye() const;
};

// The visible faces of a cube, shaded by their direction; `open`: those of the axes that are drawn.
void drawCube(Drawing& drawing, const SpaceView& view, const glm::dvec3& corner, double size,
              const glm::dvec3& rgb, glm::bvec3 open = glm::bvec3(true));
// "#rrggbb" of 0..1, as stored in a picture.
std::string hexColour(const glm::dvec3& rgb);

}  // namespace conelight::figures
