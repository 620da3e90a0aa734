// SPDX-License-Identifier: MIT
// Drawings of how radiosity, rays and cones gather light. Rays and cones are traced in a flat room; the cones
// are those of the renderer's own sets.
#include <algorithm>
#include <cmath>

#include "figures/drawings/drawings.h"
#include "figures/drawings/flat_room.h"
#include "gather/cone_set.h"

namespace conelight::figures {
namespace {

struct Patch {
    Point at, normal;
    const FlatWall* wall;
};

// Walls cut into patches of about `length` pixels, with the side that faces the room.
std::vector<Patch> patchesOf(const FlatRoom& room, double length) {
    std::vector<Patch> patches;
    for (std::size_t w = 0; w < room.walls.size(); ++w) {
        const FlatWall& wall = room.walls[w];
        const Point edge = wall.to - wall.from;
        const int count = std::max(2, int(std::lround(glm::length(edge) / length)));
        const Point across = glm::normalize(Point(-edge.y, edge.x));
        for (int i = 0; i < count; ++i) {
            const Point at = wall.from + edge * ((i + 0.5) / count);
            const Point centre = room.corner + Point(0.36, 0.3) * room.size;
            const Point outward = w == 6   ? Point(1, 0)
                                  : w == 5 ? Point(0, -1)
                                  : w == 4 ? Point(-1, 0)
                                           : Point(0);
            const double side = glm::dot(across, outward == Point(0) ? centre - at : outward);
            patches.push_back({at, side > 0 ? across : -across, &wall});
        }
    }
    return patches;
}

bool sees(const FlatRoom& room, const Patch& a, Point from) {
    const Point way = a.at + a.normal * 2.0 - from;
    const std::optional<FlatHit> hit = room.hit(from, way);
    return (!hit || hit->distance > 1) && glm::dot(a.normal, way) < 0;
}

void drawPatches(Drawing& d, const FlatRoom& room, double length, Point receiver) {
    for (const Patch& patch : patchesOf(room, length)) {
        const Point along(-patch.normal.y, patch.normal.x);
        d.line(patch.at - 0.5 * along * 6.0, patch.at + 0.5 * along * 6.0, stroke(colour::kInk, 1));
        d.line(patch.at - patch.normal * 4.0, patch.at + patch.normal * 4.0, stroke(colour::kInk, 1.2));
        if (sees(room, patch, receiver) && glm::length(patch.at - receiver) > 8)
            d.line(receiver, patch.at, stroke(patch.wall->colour, 1.1));
    }
}

void drawRays(Drawing& d, const FlatRoom& room, Point from, int count, double width) {
    for (int i = 0; i < count; ++i) {
        // Cosine-distributed in the plane: even steps of the sine.
        const double angle = std::asin(-1 + 2 * (i + 0.5) / count);
        const std::optional<FlatHit> hit = room.hit(from, upTurned(angle));
        if (!hit) continue;
        const Point end = from + hit->distance * upTurned(angle);
        d.line(from, end, stroke(hit->wall->colour, width));
        d.circle(end, 2.6, filled(hit->wall->colour));
    }
}

// The cones of a set that lie in the drawing's plane, by the azimuths nearest to it.
void drawCones(Drawing& d, const FlatRoom& room, Point from) {
    std::vector<std::pair<double, double>> cones;  // angle, half angle
    for (const gather::Cone& cone : gather::coneSet(DiffuseSet::Five, 5)) {
        const double tilt = std::acos(double(cone.direction.z)), half = std::acos(double(cone.cosHalfAngle));
        if (tilt < 0.01) cones.emplace_back(0, half);
        // The ring's cones all tilt alike: one to each side.
        if (tilt >= 0.01 && cones.size() < 3) cones.emplace_back(cones.size() == 1 ? -tilt : tilt, half);
    }
    for (const auto& [angle, half] : cones) {
        std::vector<Point> outline{from};
        constexpr int kPieces = 40;
        for (int i = 0; i <= kPieces; ++i) {
            const double a = angle - half + 2 * half * i / kPieces;
            if (std::abs(a) > kPi / 2 - 0.02) continue;
            const std::optional<FlatHit> hit = room.hit(from, upTurned(a));
            outline.push_back(from + (hit ? hit->distance - 3 : 0) * upTurned(a));
        }
        const std::optional<FlatHit> axis = room.hit(from, upTurned(angle));
        const std::string tint = axis ? axis->wall->colour : colour::kPale;
        d.polygon(outline, {.stroke = tint, .width = 1.2, .fill = tint, .opacity = 0.38});
        d.line(from, from + 0.75 * (axis ? axis->distance : 60) * upTurned(angle), stroke(tint, 1.4, "6 4"));
    }
}

void drawReceiver(Drawing& d, Point at) {
    d.circle(at, 5, filled(colour::kInk));
    d.text(at + Point(0, 24), "x", {.size = 18, .italic = true});
}

}  // namespace

std::string drawTwoApproximations() {
    Drawing d;
    const FlatRoom left({0, 0}), right({430, 0});
    left.draw(d);
    drawPatches(d, left, 30, left.receiver() - Point(0, 3));
    drawReceiver(d, left.receiver());
    d.text(left.corner + Point(150, -22), "radiosity: all patches at once", {.size = 16, .bold = true});
    d.text(left.corner + Point(150, 268), "B_{i} = E_{i} + ρ_{i} Σ_{j} F_{ij} B_{j}", {.size = 18});
    d.text(left.corner + Point(150, 294), "one system for the scene, diffuse, any view",
           {.size = 13, .colour = colour::kNote});
    // A path from the eye: at each hit one ray to the lamp, one further on.
    right.draw(d);
    const Point eye = right.corner + Point(48, 74);
    std::vector<Point> path{eye + Point(16, 14)};
    Point way = glm::normalize(right.receiver() - eye);
    for (int bounce = 0; bounce < 3; ++bounce) {
        const std::optional<FlatHit> hit = right.hit(path.back(), way);
        if (!hit) break;
        path.push_back(path.back() + (hit->distance - 1.5) * way);
        way = bounce == 0 ? glm::normalize(Point(0.42, -0.62)) : glm::normalize(Point(-0.72, 0.42));
    }
    for (std::size_t i = 1; i < path.size(); ++i) {
        d.arrow(path[i - 1], path[i], stroke(colour::kPurple, 2.2));
        const Point toLamp = right.lamp() + Point(0, 6) - path[i];
        const std::optional<FlatHit> hit = right.hit(path[i], toLamp);
        const bool blocked = hit && hit->distance < 0.98;
        d.line(path[i], path[i] + toLamp * (blocked ? hit->distance : 1),
               stroke(colour::kOrange, 1.6, "5 4"));
        if (blocked) {
            const Point at = path[i] + toLamp * hit->distance;
            d.line(at + Point(-6, -6), at + Point(6, 6), stroke(colour::kRed, 2.4));
            d.line(at + Point(-6, 6), at + Point(6, -6), stroke(colour::kRed, 2.4));
        }
    }
    drawEye(d, eye, way = glm::normalize(right.receiver() - eye));
    d.text(right.corner + Point(150, -22), "ray tracing: path by path", {.size = 16, .bold = true});
    d.text(right.corner + Point(150, 268), "L_{o} ≈ L_{e} + 1/N Σ f_{r} L_{i} cos θ_{i} / p(ω_{i})",
           {.size = 18});
    d.text(right.corner + Point(150, 294), "dashed: is the lamp seen from here?",
           {.size = 13, .colour = colour::kNote});
    return d.svg("Two ways to approximate the rendering equation: radiosity and ray tracing");
}

std::string drawThreeGatherings() {
    Drawing d;
    const FlatRoom cones({0, 0}), rays({400, 0}), patches({800, 0});
    const std::pair<const FlatRoom*, const char*> panels[] = {{&cones, "cones: a few wide ones"},
                                                              {&rays, "rays: many thin ones"},
                                                              {&patches, "radiosity: patch to patch"}};
    for (const auto& [room, title] : panels) {
        room->draw(d);
        d.text(room->corner + Point(150, -22), title, {.size = 16, .bold = true});
    }
    drawCones(d, cones, cones.receiver() - Point(0, 3));
    drawRays(d, rays, rays.receiver() - Point(0, 3), 40, 1);
    drawPatches(d, patches, 30, patches.receiver() - Point(0, 3));
    for (const auto& [room, title] : panels) drawReceiver(d, room->receiver());
    d.text(cones.corner + Point(150, 268), "what lies in a cone is averaged by voxels",
           {.size = 13, .colour = colour::kNote});
    d.text(rays.corner + Point(150, 268), "each ray tests surfaces exactly",
           {.size = 13, .colour = colour::kNote});
    d.text(patches.corner + Point(150, 268), "view factors between all patches",
           {.size = 13, .colour = colour::kNote});
    return d.svg("Cone tracing, ray tracing and radiosity at one point");
}

}  // namespace conelight::figures
