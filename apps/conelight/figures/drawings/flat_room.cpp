// SPDX-License-Identifier: MIT
#include "figures/drawings/flat_room.h"

#include <cmath>
#include <numbers>

namespace conelight::figures {

FlatRoom::FlatRoom(Point at) : corner(at) {
    const Point a = corner, b = corner + Point(size.x, 0), c = corner + size, d = corner + Point(0, size.y);
    walls = {{a, b, "#5b6270"}, {b, c, colour::kGreen}, {d, c, "#5b6270"}, {a, d, colour::kRed}};
    const Point low = corner + Point(0.60 * size.x, size.y), high = low - Point(0, 0.42 * size.y);
    const Point across(0.22 * size.x, 0);
    walls.push_back({low, high, colour::kBlue});
    walls.push_back({high, high + across, colour::kBlue});
    walls.push_back({high + across, low + across, colour::kBlue});
    lampFrom = corner + Point(0.42 * size.x, 3);
    lampTo = corner + Point(0.62 * size.x, 3);
}

std::optional<FlatHit> FlatRoom::hit(Point from, Point way) const {
    std::optional<FlatHit> nearest;
    for (const FlatWall& wall : walls) {
        const Point edge = wall.to - wall.from, s = wall.from - from;
        const double det = way.x * edge.y - way.y * edge.x;
        if (std::abs(det) < 1e-9) continue;
        const double t = (s.x * edge.y - s.y * edge.x) / det, u = (s.x * way.y - s.y * way.x) / det;
        if (t < 1e-6 || u < 0 || u > 1) continue;
        if (!nearest || t < nearest->distance) nearest = FlatHit{t, &wall};
    }
    return nearest;
}

void FlatRoom::draw(Drawing& d) const {
    const std::vector<Point> block = {walls[4].from, walls[4].to, walls[5].to, walls[6].to};
    d.polygon(block, {.stroke = "none", .fill = "#dbe9f4"});
    for (const FlatWall& wall : walls) d.line(wall.from, wall.to, stroke(wall.colour, 4));
    d.line(lampFrom, lampTo, stroke("#ffc93c", 7));
}

Point upTurned(double angle) { return {std::sin(angle), -std::cos(angle)}; }

void drawEye(Drawing& d, Point at, Point way) {
    const Point along = glm::normalize(way), across(-along.y, along.x);
    std::vector<Point> lid;
    for (int i = 0; i <= 20; ++i) {
        const double s = -1 + 0.1 * i;
        lid.push_back(at + 17.0 * s * along + 9.0 * (1 - s * s) * across);
    }
    for (int i = 20; i >= 0; --i) {
        const double s = -1 + 0.1 * i;
        lid.push_back(at + 17.0 * s * along - 9.0 * (1 - s * s) * across);
    }
    d.polygon(lid, {.width = 1.6, .fill = colour::kPaper});
    d.circle(at + 3.0 * along, 6, {.width = 1.2, .fill = colour::kSky});
    d.circle(at + 4.5 * along, 2.6, filled(colour::kInk));
}

void drawBulb(Drawing& d, Point at) {
    for (int i = 0; i < 12; ++i) {
        const Point way = upTurned(2 * std::numbers::pi * i / 12);
        d.line(at + way * 14.0, at + way * 21.0, stroke(colour::kOrange, 2));
    }
    d.circle(at, 10, {.stroke = colour::kOrange, .width = 2, .fill = "#ffd966"});
}

}  // namespace conelight::figures
