// SPDX-License-Identifier: MIT
// Drawings of solid angle, projected area and the inverse square.
#include <fmt/format.h>

#include <cmath>

#include "figures/drawings/drawings.h"
#include "figures/drawings/space_view.h"

namespace conelight::figures {
namespace {

using glm::dvec3;

dvec3 onSphere(double theta, double phi, double radius = 1) {
    return radius * dvec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
}

// A curve through points of a function over [from, to].
template <class At>
std::vector<Point> curve(const SpaceView& view, double from, double to, const At& at, int pieces = 60) {
    std::vector<Point> points;
    for (int i = 0; i <= pieces; ++i) points.push_back(view.at(at(from + (to - from) * i / pieces)));
    return points;
}

// A square of half-edge `half` about `centre`, at right angles to `normal`.
std::vector<dvec3> square(dvec3 centre, dvec3 normal, double half) {
    const dvec3 u = glm::normalize(glm::cross(normal, dvec3(0, 0, 1)));
    const dvec3 v = glm::cross(u, normal);
    return {centre + half * (-u - v), centre + half * (u - v), centre + half * (u + v),
            centre + half * (v - u)};
}

// Points of a polygon moved along `direction` onto the plane through `origin` at right angles to it.
std::vector<dvec3> onPlane(std::vector<dvec3> points, dvec3 origin, dvec3 direction) {
    for (dvec3& p : points) p -= direction * glm::dot(p - origin, direction);
    return points;
}

void drawAxes(Drawing& d, const SpaceView& view, double length) {
    const char* names[] = {"x", "y", "z"};
    for (int axis = 0; axis < 3; ++axis) {
        dvec3 end(0);
        end[axis] = length;
        d.arrow(view.at(dvec3(0)), view.at(end), stroke(colour::kPale, 1.2));
        d.text(view.at(end * 1.07) + Point(0, 5), names[axis], {.italic = true});
    }
}

// The sphere's outline, its equator, and two meridians.
void drawSphere(Drawing& d, const SpaceView& view) {
    d.circle(view.origin, view.scale, {.stroke = colour::kPale, .width = 1.2, .fill = "#f6f8fb"});
    d.polyline(curve(view, 0, 2 * kPi, [](double phi) { return onSphere(kPi / 2, phi); }),
               stroke(colour::kPale, 1, "4 4"));
    for (const double phi : {0.0, kPi / 2})
        d.polyline(curve(view, 0, kPi / 2, [phi](double theta) { return onSphere(theta, phi); }),
                   stroke(colour::kPale, 1));
}

}  // namespace

std::string drawSolidAngle() {
    Drawing d;
    const SpaceView view{.scale = 230, .azimuthDeg = 8, .elevationDeg = 20};
    const double theta = 0.86, phi = 0.62, dTheta = 0.30, dPhi = 0.34;
    drawSphere(d, view);
    drawAxes(d, view, 1.28);
    std::vector<dvec3> patch;
    constexpr int kPieces = 16;
    for (int i = 0; i <= kPieces; ++i) patch.push_back(onSphere(theta, phi + dPhi * i / kPieces));
    for (int i = 0; i <= kPieces; ++i) patch.push_back(onSphere(theta + dTheta * i / kPieces, phi + dPhi));
    for (int i = kPieces; i >= 0; --i) patch.push_back(onSphere(theta + dTheta, phi + dPhi * i / kPieces));
    for (int i = kPieces; i >= 0; --i) patch.push_back(onSphere(theta + dTheta * i / kPieces, phi));
    for (const double t : {theta, theta + dTheta})
        for (const double p : {phi, phi + dPhi})
            d.line(view.at(dvec3(0)), view.at(onSphere(t, p)), stroke(colour::kBlue, 1, "5 4"));
    d.polygon(view.outline(patch), {.stroke = colour::kBlue, .width = 2, .fill = "#9cc9e6"});
    // The angles: from the pole to the patch, and round the pole.
    d.polyline(curve(view, 0, theta, [&](double t) { return onSphere(t, phi, 0.42); }),
               stroke(colour::kRed, 1.8));
    d.text(view.at(onSphere(0.55 * theta, phi, 0.52)) + Point(4, 4), "θ",
           {.size = 18, .colour = colour::kRed});
    d.line(view.at(dvec3(0)), view.at(onSphere(kPi / 2, phi)), stroke(colour::kGreen, 1.1, "3 4"));
    d.polyline(curve(view, phi, phi, [](double p) { return onSphere(kPi / 2, p); }),
               stroke(colour::kGreen, 1));
    d.polyline(curve(view, 0, phi, [](double p) { return onSphere(kPi / 2, p, 0.5); }),
               stroke(colour::kGreen, 1.8));
    d.text(view.at(onSphere(kPi / 2, 0.5 * phi, 0.62)) + Point(0, 8), "φ",
           {.size = 18, .colour = colour::kGreen});
    const Point right = view.at(onSphere(theta + 0.5 * dTheta, phi + dPhi));
    d.text(right + Point(10, 4), "dθ", {.size = 17, .anchor = Anchor::Start, .colour = colour::kBlue});
    const Point below = view.at(onSphere(theta + dTheta, phi + 0.5 * dPhi));
    d.text(below + Point(0, 26), "sin θ dφ", {.size = 17, .colour = colour::kBlue});
    const double exact = (std::cos(theta) - std::cos(theta + dTheta)) * dPhi;
    const Point foot(0, view.scale + 46);
    d.text(foot, "dω = sin θ dθ dφ", {.size = 20});
    d.text(
        foot + Point(0, 26),
        fmt::format("this patch: {:.4f} sr, {:.2f} % of the hemisphere's 2π", exact, 100 * exact / (2 * kPi)),
        {.size = 14, .colour = "#4a5160"});
    return d.svg("Solid angle of a patch on the unit sphere");
}

std::string drawProjectedPatch() {
    Drawing d;
    const SpaceView view{.scale = 120, .azimuthDeg = 14, .elevationDeg = 24};
    const dvec3 x(0, 0, 0), seen(0, 3.6, 1.0), way = glm::normalize(x - seen);
    const dvec3 normal = glm::normalize(dvec3(0.45, -0.7, 0.5));
    const std::vector<dvec3> patch = square(seen, normal, 0.62);
    const std::vector<dvec3> projected = onPlane(patch, seen, way);
    const std::vector<dvec3> plane = square(seen, way, 1.0);
    d.polygon(view.outline(plane), {.stroke = colour::kPale, .width = 1, .fill = "#f6f8fb", .dash = "5 4"});
    for (std::size_t i = 0; i < patch.size(); ++i)
        d.line(view.at(patch[i]), view.at(projected[i]), stroke(colour::kOrange, 1, "3 3"));
    d.polygon(view.outline(projected),
              {.stroke = colour::kOrange, .width = 2, .fill = "#f5d596", .opacity = 0.9});
    d.polygon(view.outline(patch), {.stroke = colour::kBlue, .width = 2, .fill = "#9cc9e6", .opacity = 0.75});
    d.line(view.at(x), view.at(seen), stroke(colour::kInk, 1.3, "7 5"));
    d.arrow(view.at(seen), view.at(seen + normal * 1.25), stroke(colour::kBlue, 2));
    d.text(view.at(seen + normal * 1.32) + Point(0, -4), "n'",
           {.size = 18, .colour = colour::kBlue, .italic = true});
    d.arrow(view.at(seen), view.at(seen + way * 1.25), stroke(colour::kRed, 2));
    d.text(view.at(seen + way * 1.25) + Point(-30, 34), "(x − x') / ‖x − x'‖",
           {.size = 15, .colour = colour::kRed});
    // The angle between both, on the great circle through them.
    const double angle = std::acos(glm::dot(normal, way));
    const dvec3 across = glm::normalize(normal - way * glm::dot(normal, way));
    d.polyline(curve(view, 0, angle,
                     [&](double a) { return seen + 0.7 * (std::cos(a) * way + std::sin(a) * across); }),
               stroke(colour::kInk, 1.3));
    d.text(view.at(seen + 0.88 * (std::cos(0.5 * angle) * way + std::sin(0.5 * angle) * across)), "θ'",
           {.size = 18});
    d.circle(view.at(x), 4.5, filled(colour::kInk));
    d.text(view.at(x) + Point(-6, 26), "x", {.size = 19, .italic = true});
    d.circle(view.at(seen), 4, filled(colour::kInk));
    d.text(view.at(seen) + Point(14, 20), "x'", {.size = 19, .italic = true});
    const Point foot = view.at(dvec3(0, 1.9, -0.95)) + Point(0, 60);
    d.text(foot, "projected area = dA cos θ'", {.size = 20});
    d.text(foot + Point(0, 26),
           fmt::format("here θ' = {:.0f}°: {:.2f} of dA (blue) is left (orange)", angle * 180 / kPi,
                       std::cos(angle)),
           {.size = 14, .colour = "#4a5160"});
    return d.svg("A patch projected on the plane across the line of sight");
}

namespace {

// One half of the figure: what happens in the step is drawn by the caller on top.
void drawStepTitle(Drawing& d, Point at, const std::string& title, const std::string& formula) {
    d.text(at, title, {.size = 16, .bold = true});
    d.text(at + Point(0, 28), formula, {.size = 19});
}

}  // namespace

std::string drawTwoProjections() {
    Drawing d;
    // First, from the side: the patch seen edge on, and its shadow on the plane across the line of sight.
    const Point x(0, 0), seen(300, -110);
    const Point way = glm::normalize(x - seen), across(-way.y, way.x);
    const double theta = 0.9, half = 95;
    const Point edge = std::cos(theta) * across + std::sin(theta) * way;
    const Point a = seen + half * edge, b = seen - half * edge;
    const Point pa = seen + across * glm::dot(a - seen, across),
                pb = seen + across * glm::dot(b - seen, across);
    d.line(x, seen, stroke(colour::kInk, 1.2, "7 5"));
    d.line(seen + across * 125.0, seen - across * 125.0, stroke(colour::kPale, 1.2, "5 4"));
    d.line(a, pa, stroke(colour::kOrange, 1.2, "3 3"));
    d.line(b, pb, stroke(colour::kOrange, 1.2, "3 3"));
    d.line(pa, pb, stroke(colour::kOrange, 7));
    d.line(a, b, stroke(colour::kBlue, 5));
    d.text(b + Point(-14, 20), "dA", {.size = 18, .anchor = Anchor::End, .colour = colour::kBlue});
    d.text(pb + Point(14, 22), "dA cos θ", {.size = 18, .anchor = Anchor::Start, .colour = colour::kOrange});
    d.arc(seen, 46, std::atan2(-across.y, across.x), std::atan2(-edge.y, edge.x), stroke(colour::kInk, 1.3));
    const Point middle = glm::normalize(across + edge);
    d.text(seen + middle * 62.0 + Point(0, 6), "θ", {.size = 17});
    d.circle(x, 4.5, filled(colour::kInk));
    d.text(x + Point(-2, 26), "x", {.size = 19, .italic = true});
    drawStepTitle(d, {170, 110}, "1. turn it to face x", "dA → dA cos θ");
    // Then, towards the centre of the unit sphere about x.
    const Point centre(560, 0);
    const double radius = 120, distance = glm::length(seen - x), size = half * std::cos(theta);
    const Point far = centre - way * distance;
    const double angle = std::atan2(-(far.y - centre.y), far.x - centre.x),
                 spread = std::atan2(size, distance);
    d.arc(centre, radius, angle - 0.9, angle + 0.9, stroke(colour::kPale, 1.5));
    for (const double sign : {-1.0, 1.0})
        d.line(centre, far + across * (sign * size), stroke(colour::kOrange, 1.2, "3 3"));
    d.line(far + across * size, far - across * size, stroke(colour::kOrange, 7));
    d.arc(centre, radius, angle - spread, angle + spread, stroke(colour::kGreen, 7));
    d.line(centre, far, stroke(colour::kInk, 1.2, "7 5"));
    d.text(far + Point(38, 46), "dA cos θ", {.size = 18, .anchor = Anchor::Start, .colour = colour::kOrange});
    d.text(centre + (radius + 26) * Point(std::cos(angle + 0.42), -std::sin(angle + 0.42)) + Point(0, -4),
           "dω", {.size = 19, .colour = colour::kGreen});
    d.text(centre + (radius + 12) * Point(std::cos(angle - 0.82), -std::sin(angle - 0.82)) + Point(6, 4),
           "unit sphere", {.size = 13, .anchor = Anchor::Start, .colour = "#4a5160"});
    d.text(0.35 * centre + 0.65 * far + Point(0, -14), "r = ‖x − x'‖", {.size = 15, .turnDeg = -20});
    d.circle(centre, 4.5, filled(colour::kInk));
    d.text(centre + Point(-2, 26), "x", {.size = 19, .italic = true});
    drawStepTitle(d, {720, 110}, "2. draw it in to the unit sphere", "dω = dA cos θ / r^{2}");
    return d.svg("Two projections: of a patch across the line of sight, then on the unit sphere");
}

std::string drawInverseSquare() {
    Drawing d;
    const SpaceView view{.scale = 105, .azimuthDeg = 63, .elevationDeg = 20};
    const double half = 0.36;
    const dvec3 lamp(0);
    constexpr const char* kFills[] = {"#ffd966", "#ffe69c", "#fff2cc"};
    for (int n = 3; n >= 1; --n) {
        const double y = 1.7 * n, side = half * n;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                const dvec3 low(-side + 2 * half * i, y, -side + 2 * half * j);
                d.polygon(view.outline({low, low + dvec3(2 * half, 0, 0), low + dvec3(2 * half, 0, 2 * half),
                                        low + dvec3(0, 0, 2 * half)}),
                          {.stroke = colour::kOrange, .width = 1.4, .fill = kFills[n - 1], .opacity = 0.92});
            }
        for (const double u : {-1.0, 1.0})
            for (const double v : {-1.0, 1.0})
                d.line(view.at(dvec3(side * u, y, side * v)),
                       view.at(dvec3(side * u, y, side * v) * ((n - 1.0) / n)),
                       stroke(colour::kOrange, 1, "4 3"));
    }
    for (int n = 1; n <= 3; ++n) {
        const Point top = view.at(dvec3(-half * n, 1.7 * n, half * n));
        const std::string far = n == 1 ? "r" : fmt::format("{}r", n),
                          light = n == 1 ? "E" : fmt::format("E/{}", n * n);
        d.text(top + Point(4, -10), fmt::format("{}: {}", far, light), {.size = 18, .colour = colour::kRed});
    }
    for (int i = 0; i < 12; ++i) {
        const double angle = 2 * kPi * i / 12;
        const Point way(std::cos(angle), std::sin(angle));
        d.line(view.at(lamp) + way * 15.0, view.at(lamp) + way * 24.0, stroke(colour::kOrange, 2));
    }
    d.circle(view.at(lamp), 11, {.stroke = colour::kOrange, .width = 2, .fill = "#ffd966"});
    d.text(view.at(lamp) + Point(0, -36), "Φ", {.size = 20});
    d.text({view.at(dvec3(0, 3.0, 0)).x, view.at(dvec3(0, 5.1, -1.08)).y + 80}, "E = Φ cos θ / (4π r^{2})",
           {.size = 20});
    return d.svg("The inverse-square law");
}

}  // namespace conelight::figures
