// SPDX-License-Identifier: MIT
// Drawings of texture filtering: aliasing, levels, magnification, and the march of a flat cone over levels.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "figures/drawings/drawings.h"
#include "figures/drawings/painting.h"
#include "figures/drawings/space_view.h"

namespace conelight::figures {
namespace {

using glm::dvec2;
using glm::dvec3;

// A checkered floor seen from above it, up to the horizon. With `samples` squared points per pixel: the mean
// over its area; with one: its middle.
Painting checkers(int width, int height, int samples) {
    Painting painting{width, height, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            dvec3 sum(0);
            for (int i = 0; i < samples * samples; ++i) {
                const dvec2 p = (dvec2(x, y) + (dvec2(i % samples, i / samples) + 0.5) / double(samples));
                const dvec2 s((p.x - 0.5 * width) / height, (p.y - 0.12 * height) / height);
                if (s.y <= 0) {
                    sum += dvec3(0.55, 0.68, 0.85);
                    continue;
                }
                const dvec2 floor(0.9 * s.x / s.y + 0.37, 0.9 / s.y);  // a pinhole above a plane
                const bool dark = (int(std::floor(2.2 * floor.x)) + int(std::floor(2.2 * floor.y))) % 2 != 0;
                sum += dark ? dvec3(0.03) : dvec3(0.86);
            }
            painting.pixels.push_back(sum / double(samples * samples));
        }
    return painting;
}

dvec3 encoded(const dvec3& linear) {
    const glm::vec3 c = glm::clamp(glm::vec3(linear), 0.0f, 1.0f);
    return {io::srgbFromLinear(c.r), io::srgbFromLinear(c.g), io::srgbFromLinear(c.b)};
}

}  // namespace

std::string drawCheckers() {
    Drawing d;
    const Point size(420, 280);
    d.image({0, 0}, size, bytesOf(checkers(210, 140, 1)));
    d.image({450, 0}, size, bytesOf(checkers(210, 140, 16)));
    d.text({210, 308}, "(a) one point per pixel", {.size = 16, .bold = true});
    d.text({660, 308}, "(b) mean over each pixel", {.size = 16, .bold = true});
    return d.svg("Aliasing of a checkered floor, and what filtering makes of it");
}

std::string drawMipPyramid() {
    Drawing d;
    const std::vector<Painting> levels = levelsOf(paintLandscape(256));
    double x = 0;
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const double edge = levels[i].width * 1.15;
        if (edge >= 8) d.image({x, 300 - edge}, {edge, edge}, bytesOf(levels[i]));
        if (edge < 8) d.rect({x, 300 - edge}, {edge, edge}, filled(hexColour(encoded(levels[i].at(0, 0)))));
        if (edge > 30) {
            d.text({x + 0.5 * edge, 322}, fmt::format("{}", i), {.size = 15, .bold = true});
            d.text({x + 0.5 * edge, 340}, fmt::format("{0}²", levels[i].width),
                   {.size = 12, .colour = colour::kNote});
        }
        x += edge + 16;
    }
    d.text({-8, 322}, "level", {.size = 13, .anchor = Anchor::End, .colour = colour::kNote});
    // The same by whole picture: what is left of it in a coarse level.
    for (std::size_t i = 0; i < 5; ++i) {
        const Point corner(double(i) * 150, 372);
        d.image(corner, {136, 136}, bytesOf(levels[i + 2]));
        d.text(corner + Point(68, 156), fmt::format("level {} magnified", i + 2),
               {.size = 12, .colour = colour::kNote});
    }
    return d.svg("Mip levels of a picture");
}

std::string drawMagnification() {
    Drawing d;
    const Painting picture = paintLandscape(256);
    const dvec2 corner(0.595, 0.275);
    constexpr double kPart = 0.13;
    const Point size(320, 320);
    d.image({0, 0}, size, bytesOf(picture));
    d.rect(Point(corner) * size, kPart * size, stroke(colour::kRed, 2));
    for (int way = 0; way < 2; ++way) {
        Painting zoomed{320, 320, {}};
        for (int y = 0; y < 320; ++y)
            for (int x = 0; x < 320; ++x) {
                const dvec2 uv = corner + kPart * (dvec2(x, y) + 0.5) / 320.0;
                zoomed.pixels.push_back(way == 0 ? nearest(picture, uv) : bilinear(picture, uv));
            }
        const Point at(350.0 * (way + 1), 0);
        d.image(at, size, bytesOf(zoomed));
        d.rect(at, size, stroke(colour::kRed, 1.5));
        d.text(at + Point(160, 348), way == 0 ? "nearest neighbour" : "bilinear", {.size = 16, .bold = true});
    }
    d.text({160, 348}, "256² pixels", {.size = 16, .bold = true});
    return d.svg("Magnification by nearest neighbour and by bilinear filtering");
}

std::string drawFlatConeMarch() {
    Drawing d;
    constexpr int kSize = 256;
    const double shown = 480;
    const std::vector<Painting> levels = levelsOf(paintLandscape(kSize));
    d.image({0, 0}, {shown, shown}, bytesOf(levels.front()));
    d.rect({0, 0}, {shown, shown}, filled("#ffffff", 0.45));
    // d = 2 t tan(aperture / 2) texels wide at t; the level whose texels are that wide.
    const double aperture = 0.42, factor = 0.85;
    const dvec2 from(14, 226), way = glm::normalize(dvec2(0.83, -0.62));
    const double pixel = shown / kSize;
    const dvec2 across(-way.y, way.x);
    const double reach = 262;
    d.polygon({from * pixel, (from + reach * way + std::tan(0.5 * aperture) * reach * across) * pixel,
               (from + reach * way - std::tan(0.5 * aperture) * reach * across) * pixel},
              {.stroke = colour::kRed, .width = 1.6});
    int number = 0;
    for (double t = 9; t < reach - 24; ++number) {
        const double diameter = 2 * t * std::tan(0.5 * aperture), level = std::log2(std::max(diameter, 1.0));
        const dvec2 at = from + t * way;
        const dvec3 c = trilinear(levels, at / double(kSize), level);
        const std::string fill = hexColour(encoded(c));
        d.circle(at * pixel, 0.5 * diameter * pixel, {.stroke = colour::kInk, .width = 1.2, .fill = fill});
        const Point row(shown + 36, 36.0 + 40 * number);
        d.rect(row, {32, 28}, {.width = 1, .fill = fill}, 3);
        d.text(row + Point(46, 20), fmt::format("t = {:.0f}, d = {:.1f}, level {:.2f}", t, diameter, level),
               {.size = 14, .anchor = Anchor::Start});
        t += factor * diameter;
    }
    d.circle(from * pixel, 5, filled(colour::kRed));
    d.text({shown + 36, 18}, "samples along the cone, texels",
           {.size = 15, .anchor = Anchor::Start, .bold = true});
    return d.svg("A flat cone that reads the levels of a picture");
}

}  // namespace conelight::figures
