// SPDX-License-Identifier: MIT
// Drawings of beams and their tree: a room of upright walls with two mirrors, traced by the beam tracer itself through a
// camera that sees a thin level slice of it, and seen from above.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "figures/drawings/drawings.h"
#include "figures/drawings/flat_room.h"
#include "reference/beam_tree.h"

namespace conelight::figures {
namespace {

using reference::Beam;
using reference::BeamPart;

constexpr double kPixelsPerMetre = 64;
constexpr const char* kTints[] = {colour::kSky, colour::kOrange, colour::kGreen, colour::kPurple,
                                  colour::kRed};

struct Wall {
    const char* name;
    Point from, to;  // plan, m
    bool mirror = false;
};
constexpr Wall kWalls[] = {
    {"left wall", {0, 0}, {0, 4.4}},        {"front wall", {0, 4.4}, {7, 4.4}},
    {"right wall", {7, 4.4}, {7, 3.5}},     {"mirror B", {7, 3.5}, {7, 0.9}, true},
    {"right wall", {7, 0.9}, {7, 0}},       {"back wall", {7, 0}, {5.4, 0}},
    {"mirror A", {5.4, 0}, {2.4, 0}, true}, {"back wall", {2.4, 0}, {0, 0}},
    {"pillar", {3.5, 1.6}, {4.1, 1.6}},     {"pillar", {4.1, 1.6}, {4.1, 2.2}},
    {"pillar", {4.1, 2.2}, {3.5, 2.2}},     {"pillar", {3.5, 2.2}, {3.5, 1.6}},
};
constexpr Point kEye(0.9, 3.7), kLooksAt(4.6, 1.2);

Scene roomOfWalls() {
    Scene scene;
    scene.materials.resize(2);
    scene.materials[1].metallic = 1;
    scene.materials[1].roughness = 0;
    for (Material& material : scene.materials) material.doubleSided = true;
    for (const Wall& wall : kWalls) {
        Mesh mesh;
        for (const Point& p : {wall.from, wall.to})
            for (const float height : {-1.0f, 1.0f}) mesh.positions.emplace_back(p.x, height, p.y);
        mesh.indices = {0, 2, 3, 3, 1, 0};
        Instance instance;
        instance.name = wall.name;
        instance.mesh = static_cast<int>(scene.meshes.size());
        instance.material = wall.mirror ? 1 : 0;
        scene.meshes.push_back(std::move(mesh));
        scene.instances.push_back(std::move(instance));
    }
    return scene;
}

struct TracedRoom {
    Scene scene = roomOfWalls();
    reference::BeamScene polygons{scene, false, 1};
    reference::BeamTree tree;

    TracedRoom() {
        Camera camera;
        camera.eye = {kEye.x, 0, kEye.y};
        camera.target = {kLooksAt.x, 0, kLooksAt.y};
        camera.fovY = 0.0175f;  // a degree
        // Three mirrors in a row at most: more would hide each other.
        tree = beamTree(polygons, reference::Lens(camera, 56, 1), {3, 0.002, false});
    }
    std::string nameOf(std::uint32_t polygon) const {
        return scene.instances[polygons.polygons()[polygon].instance].name;
    }
};

Point plan(const glm::dvec3& p) { return kPixelsPerMetre * Point(p.x, p.z); }

// The two ends of an upright polygon, seen from above.
std::pair<Point, Point> endsOf(const reference::Corners& corners) {
    std::pair<Point, Point> ends(plan(corners[0]), plan(corners[0]));
    for (const glm::dvec3& a : corners)
        for (const glm::dvec3& b : corners)
            if (glm::length(plan(a) - plan(b)) > glm::length(ends.first - ends.second))
                ends = {plan(a), plan(b)};
    return ends;
}

// Where the line from `from` to `to` crosses the line through two points.
Point crossing(Point from, Point to, const std::pair<Point, Point>& line) {
    const Point way = to - from, along = line.second - line.first, start = line.first - from;
    const double t = (start.x * along.y - start.y * along.x) / (way.x * along.y - way.y * along.x);
    return from + t * way;
}

const char* tintOf(std::size_t beam) { return kTints[beam % std::size(kTints)]; }

// Returns where its number stands.
Point drawBeam(Drawing& d, const TracedRoom& room, std::size_t index) {
    const Beam& beam = room.tree.beams[index];
    const Point apex = plan(beam.apex.place);
    const std::pair<Point, Point> window = endsOf(beam.window);
    if (beam.parent >= 0)
        for (const Point& end : {window.first, window.second})
            d.line(apex, end, stroke(tintOf(index), 1, "3 5"));
    double widest = 0;
    Point label;
    for (const BeamPart& part : beam.parts) {
        const std::pair<Point, Point> ends = endsOf(part.corners);
        const Point a = beam.parent < 0 ? apex : crossing(apex, ends.first, window);
        const Point b = beam.parent < 0 ? apex : crossing(apex, ends.second, window);
        d.polygon({a, ends.first, ends.second, b}, {.stroke = "none", .fill = tintOf(index), .opacity = 0.3});
        d.line(a, ends.first, {.stroke = tintOf(index), .width = 0.8, .opacity = 0.7});
        d.line(b, ends.second, {.stroke = tintOf(index), .width = 0.8, .opacity = 0.7});
        const double width = glm::length(ends.first - ends.second) * glm::length(ends.first - a);
        if (width <= widest) continue;
        widest = width;
        label = 0.2 * (a + b) + 0.3 * (ends.first + ends.second);
    }
    return label;
}

// Numbers of beams that have one apex.
std::string beamsFrom(const TracedRoom& room, const Point& apex) {
    std::string numbers;
    for (std::size_t i = 0; i < room.tree.beams.size(); ++i)
        if (glm::length(plan(room.tree.beams[i].apex.place) - apex) < 1)
            numbers += fmt::format("{}{}", numbers.empty() ? "" : ", ", i + 1);
    return numbers;
}

double layTree(const TracedRoom& room, std::size_t index, double left, std::vector<Point>& places) {
    constexpr double kWidth = 150, kHeight = 165;
    double right = left;
    for (const BeamPart& part : room.tree.beams[index].parts)
        if (part.child >= 0) right = layTree(room, std::size_t(part.child), right, places);
    right = std::max(right, left + kWidth);
    places[index] = {0.5 * (left + right), kHeight * room.tree.beams[index].depth};
    return right;
}

}  // namespace

std::string drawBeamPlan() {
    const TracedRoom room;
    Drawing d;
    std::vector<Point> numbers;
    for (std::size_t i = 0; i < room.tree.beams.size(); ++i) numbers.push_back(drawBeam(d, room, i));
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        d.circle(numbers[i], 10, {.stroke = tintOf(i), .width = 1.2, .fill = colour::kPaper});
        d.text(numbers[i] + Point(0, 5), std::to_string(i + 1), {.size = 13, .bold = true});
    }
    for (const Wall& wall : kWalls)
        d.line(kPixelsPerMetre * wall.from, kPixelsPerMetre * wall.to,
               wall.mirror ? stroke(colour::kBlue, 5) : stroke(colour::kInk, 2.4));
    d.text(kPixelsPerMetre * Point(2.0, -0.18), "mirror A",
           {.size = 15, .colour = colour::kBlue, .bold = true});
    d.text(kPixelsPerMetre * Point(7.2, 3.75), "mirror B",
           {.size = 15, .anchor = Anchor::Start, .colour = colour::kBlue, .bold = true});
    d.text(kPixelsPerMetre * Point(3.8, 1.95), "pillar", {.size = 13});
    std::vector<Point> named;
    for (const Beam& beam : room.tree.beams) {
        const Point apex = plan(beam.apex.place);
        if (std::any_of(named.begin(), named.end(), [&](Point p) { return glm::length(p - apex) < 1; }))
            continue;
        named.push_back(apex);
        const bool eye = beam.parent < 0;
        if (eye) drawEye(d, apex, glm::normalize(kLooksAt - kEye));
        if (!eye)
            d.circle(apex, 5, {.stroke = colour::kInk, .width = 1.4, .fill = colour::kPaper, .dash = "3 2"});
        d.text(apex + Point(0, eye ? 30 : -14),
               eye ? "eye" : fmt::format("apex of {}", beamsFrom(room, apex)), {.size = 14});
    }
    return d.svg("Beams in a room with two mirrors, seen from above");
}

std::string drawBeamTree() {
    const TracedRoom room;
    std::vector<Point> places(room.tree.beams.size());
    layTree(room, 0, 0, places);
    Drawing d;
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < room.tree.beams.size(); ++i) {
        const Beam& beam = room.tree.beams[i];
        std::vector<std::string> lines = {fmt::format(
            "{}  {}", i + 1, beam.parent < 0 ? "from the eye" : "by " + room.nameOf(beam.mirror))};
        std::set<std::string> ends;
        for (const BeamPart& part : beam.parts)
            if (ends.insert(room.nameOf(part.polygon)).second) lines.push_back(room.nameOf(part.polygon));
        boxes.push_back(box(d, places[i], lines, colour::kWash, 120));
        d.rect(boxes.back().centre - boxes.back().half, {2 * boxes.back().half.x, 5}, filled(tintOf(i)));
    }
    for (std::size_t i = 1; i < boxes.size(); ++i) {
        const Box& from = boxes[std::size_t(room.tree.beams[i].parent)];
        d.arrow(from.bottom(), boxes[i].top(), stroke(tintOf(i), 2));
    }
    return d.svg("The tree of the beams");
}

}  // namespace conelight::figures
