// SPDX-License-Identifier: MIT
// Drawings of the march along a cone: its samples, and the sizes that mip levels can have.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "figures/drawings/drawings.h"
#include "figures/drawings/flat_room.h"
#include "figures/drawings/space_view.h"

namespace conelight::figures {
namespace {

struct Sample {
    double t, diameter;
};

// Samples of a march: the first at `start`, each next one `factor` diameters on, d = 2 t tan(aperture / 2).
std::vector<Sample> marchOf(double aperture, double start, double factor, double reach) {
    std::vector<Sample> samples;
    for (double t = start; t < reach;) {
        const double diameter = 2 * t * std::tan(0.5 * aperture);
        samples.push_back({t, diameter});
        t += factor * diameter;
    }
    return samples;
}

}  // namespace

std::string drawConeMarch() {
    Drawing d;
    const double aperture = 0.5, factor = 1.0, pixels = 100, reach = 6.2;
    const Point x(0, 0), way(std::cos(0.16), -std::sin(0.16)), across(-way.y, way.x);
    d.polygon({x + Point(-16, -90), x + Point(0, -90), x + Point(0, 90), x + Point(-16, 90)},
              filled("#d8dde6"));
    d.line(x + Point(0, -90), x + Point(0, 90), stroke(colour::kInk, 2));
    const double half = std::tan(0.5 * aperture) * reach * pixels;
    const Point end = x + way * (reach * pixels);
    d.polygon({x, end + across * half, end - across * half},
              {.stroke = colour::kBlue, .width = 1.4, .fill = "#eef5fb"});
    // A surface that the cone meets: what it hides is taken front to back.
    constexpr double kSurface = 3.2;
    const Point wall = x + way * (kSurface * pixels);
    d.line(wall - across * 130.0, wall + across * 130.0, stroke(colour::kRed, 3));
    d.text(wall - across * 140.0 + Point(0, -4), "a surface of opacity 0.75",
           {.size = 13, .colour = colour::kRed});
    const std::vector<Sample> samples = marchOf(aperture, 0.8, factor, reach - 0.7);
    double left = 1;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const Point at = x + way * (samples[i].t * pixels);
        const double radius = 0.5 * samples[i].diameter * pixels;
        // Opacity of what a sample meets: by how much of its sphere lies behind the surface.
        const double met =
            std::clamp((samples[i].t + 0.5 * samples[i].diameter - kSurface) / samples[i].diameter, 0.0, 1.0);
        const double opacity = 0.75 * met;
        const glm::dvec3 tint = glm::mix(glm::dvec3(0.62, 0.79, 0.90), glm::dvec3(0.90, 0.55, 0.35), opacity);
        d.circle(at, radius,
                 {.stroke = colour::kBlue, .width = 1.4, .fill = hexColour(tint), .opacity = 0.8});
        d.circle(at, 2.5, filled(colour::kInk));
        const Point foot(90 + 84.0 * double(i), 170);
        d.line(at + Point(0, 2), foot - Point(0, 16), stroke(colour::kPale, 0.6, "2 3"));
        d.text(foot, fmt::format("t_{{{}}} = {:.2f}", i, samples[i].t), {.size = 12});
        d.text(foot + Point(0, 16),
               fmt::format("level {:.1f}", std::max(std::log2(samples[i].diameter / 0.34), 0.0)),
               {.size = 12, .colour = colour::kBlue});
        d.text(foot + Point(0, 32), fmt::format("left {:.0f} %", 100 * left),
               {.size = 12, .colour = colour::kRed});
        left *= 1 - opacity;
    }
    d.arc(x, 150, 0.16 - 0.5 * aperture, 0.16 + 0.5 * aperture, stroke(colour::kInk, 1.2));
    d.text(x + Point(150 * std::cos(0.42) + 12, -150 * std::sin(0.42) - 14), "γ",
           {.size = 18, .italic = true});
    d.circle(x, 4.5, filled(colour::kInk));
    d.text(x + Point(-24, 6), "x", {.size = 18, .italic = true});
    d.text({300, 250}, "d = 2 t tan(γ/2),  t_{k+1} = t_{k} + β d_{k},  level = log_{2}(d / voxel)",
           {.size = 17});
    d.text(
        {300, 276},
        fmt::format("γ = {:.2f} rad, β = {:.1f}; left: light that still comes through when a sample is taken",
                    aperture, factor),
        {.size = 13, .colour = colour::kNote});
    return d.svg("Samples along a cone");
}

std::string plotPowerOfTwo() {
    Drawing d;
    const double wide = 620, high = 250, reach = 8, most = 8;
    const Point origin(0, 0);
    const auto at = [&](double t, double size) {
        return origin + Point(t / reach * wide, -size / most * high);
    };
    d.line(origin, at(reach, 0), stroke(colour::kInk, 1.5));
    d.line(origin, at(0, most), stroke(colour::kInk, 1.5));
    for (const int size : {1, 2, 4, 8}) {
        d.line(at(0, size), at(reach, size), stroke(colour::kPale, 0.7, "2 4"));
        d.text(at(0, size) + Point(-10, 5), fmt::format("{}", size), {.size = 13, .anchor = Anchor::End});
    }
    for (int t = 0; t <= 8; t += 2) d.text(at(t, 0) + Point(0, 20), fmt::format("{}", t), {.size = 13});
    d.text(at(0.5 * reach, 0) + Point(0, 44), "distance t along the cone, in lengths", {.size = 14});
    d.text(at(0, 0.5 * most) + Point(-44, 0), "size of a sample, voxels", {.size = 14, .turnDeg = -90});
    // What the cone asks for, and the nearest that whole levels have: texels of 1, 2, 4, 8 voxels.
    std::vector<Point> wanted, whole;
    double worst = 1;
    for (int i = 0; i <= 400; ++i) {
        const double t = reach * i / 400, size = t;
        wanted.push_back(at(t, size));
        const double level = std::round(std::log2(std::max(size, 1.0)));
        whole.push_back(at(t, std::exp2(level)));
        if (size >= 1) worst = std::max(worst, std::max(std::exp2(level) / size, size / std::exp2(level)));
    }
    d.polyline(wanted, stroke(colour::kBlue, 2.4));
    d.polyline(whole, stroke(colour::kRed, 2.2));
    d.text(at(3.15, 7.0), "the cone's diameter",
           {.size = 14, .anchor = Anchor::Start, .colour = colour::kBlue});
    d.text(at(3.15, 6.3), "nearest whole level",
           {.size = 14, .anchor = Anchor::Start, .colour = colour::kRed});
    d.text(at(0.2, 7.0), fmt::format("off by up to {:.2f} times", worst),
           {.size = 14, .anchor = Anchor::Start, .colour = colour::kNote});
    // Below: the cone and the texels that stand for it.
    const Point eye(0, 250);
    const double unit = wide / reach;
    d.polygon({eye, eye + Point(wide, -0.5 * 0.5 * wide), eye + Point(wide, 0.5 * 0.5 * wide)},
              {.stroke = colour::kBlue, .width = 1.6, .fill = "#eef5fb"});
    for (const double t : {1.0, 1.7, 2.9, 4.9, 7.3}) {
        const double size = std::exp2(std::round(std::log2(t)));
        const Point centre = eye + Point(t * unit, 0);
        d.rect(centre - 0.25 * size * unit, Point(0.5 * size * unit),
               {.stroke = colour::kRed, .width = 1.6, .fill = "#f1c7b4", .opacity = 0.6});
        d.circle(centre, 0.25 * t * unit, stroke(colour::kBlue, 1.6));
    }
    return d.svg("Sizes that a power of two allows along a cone");
}

}  // namespace conelight::figures
