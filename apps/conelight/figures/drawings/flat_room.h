// SPDX-License-Identifier: MIT
// A room in two dimensions in which drawings trace their rays and cones: walls, a block, a lamp.
#pragma once

#include <optional>
#include <vector>

#include "figures/drawings/drawing.h"

namespace conelight::figures {

struct FlatWall {
    Point from, to;
    std::string colour;
};

struct FlatHit {
    double distance;
    const FlatWall* wall;
};

struct FlatRoom {
    Point corner;  // upper left, pixels
    Point size{300, 210};
    std::vector<FlatWall> walls;
    Point lampFrom, lampTo;

    explicit FlatRoom(Point corner);
    std::optional<FlatHit> hit(Point from, Point way) const;
    Point lamp() const { return 0.5 * (lampFrom + lampTo); }
    // Where a drawing asks for light: on the floor, beside the block.
    Point receiver() const { return corner + Point(0.36 * size.x, size.y); }
    void draw(Drawing& drawing) const;
};

// Direction at `angle` from straight up, rad, positive to the right.
Point upTurned(double angle);
// An eye that looks along `way`.
void drawEye(Drawing& drawing, Point at, Point way);
// A lamp bulb with rays of light round it.
void drawBulb(Drawing& drawing, Point at);

}  // namespace conelight::figures
