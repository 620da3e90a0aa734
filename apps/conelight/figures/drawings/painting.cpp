// SPDX-License-Identifier: MIT
#include "figures/drawings/painting.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace conelight::figures {
namespace {

using glm::dvec2;
using glm::dvec3;

// A number of 0..1 per lattice point (lowbias32, Wellons 2018), and smooth noise between them.
double lattice(int x, int y) {
    std::uint32_t h = std::uint32_t(x) * 0x9e3779b9u ^ std::uint32_t(y) * 0x85ebca6bu;
    h = (h ^ h >> 16) * 0x7feb352du;
    h = (h ^ h >> 15) * 0x846ca68bu;
    return double((h ^ h >> 16) >> 8) / double(1 << 24);
}

double noise(dvec2 p) {
    const dvec2 cell = glm::floor(p), f = p - cell, s = f * f * (3.0 - 2.0 * f);
    const int x = int(cell.x), y = int(cell.y);
    return glm::mix(glm::mix(lattice(x, y), lattice(x + 1, y), s.x),
                    glm::mix(lattice(x, y + 1), lattice(x + 1, y + 1), s.x), s.y);
}

double cloudy(dvec2 p, int octaves) {
    double sum = 0, weight = 0.5;
    for (int i = 0; i < octaves; ++i, weight *= 0.5, p = p * 2.03 + 17.0) sum += weight * noise(p);
    return sum;
}

dvec3 sky(dvec2 p) {
    const dvec2 sun(0.66, 0.34);
    const double glow = std::exp(-9 * glm::length(p - sun));
    dvec3 c = glm::mix(dvec3(0.10, 0.22, 0.50), dvec3(0.95, 0.55, 0.25),
                       std::pow(std::clamp(p.y / 0.55, 0.0, 1.0), 1.6));
    const double cloud = std::clamp(2.6 * cloudy({p.x * 4, p.y * 11}, 5) - 1.15, 0.0, 1.0);
    c = glm::mix(c, dvec3(1.0, 0.72, 0.55), 0.7 * cloud);
    if (glm::length(p - sun) < 0.045) c = dvec3(1.0, 0.93, 0.65);
    return c + glow * dvec3(0.55, 0.32, 0.10);
}

// Height of the hills of a row, from the top of the picture: far rows first.
double ridge(double x, int row) {
    return 0.40 + 0.055 * row -
           (0.16 - 0.028 * row) * (cloudy({x * (2.2 + row) + 9.0 * row, 3.7 * row}, 5) - 0.25);
}

dvec3 landscape(dvec2 p) {
    constexpr double kShore = 0.63;
    const bool lake = p.y > kShore;
    dvec2 q = p;
    if (lake) {  // mirrored, with ripples that grow towards the shore below
        q.y = 2 * kShore - p.y;
        q.x += 0.012 * (p.y - kShore) * 8 * (noise({p.x * 30, p.y * 190}) - 0.5);
        q.y = std::max(q.y, 0.02);
    }
    dvec3 c = sky(q);
    for (int row = 0; row < 4; ++row)
        if (q.y > ridge(q.x, row)) {
            const double depth = row / 3.0;
            c = glm::mix(dvec3(0.34, 0.33, 0.46), dvec3(0.05, 0.11, 0.06), depth);
            c *= 0.75 + 0.5 * cloudy({q.x * 60, q.y * 60}, 3);
        }
    if (lake) c = c * dvec3(0.62, 0.68, 0.75) + 0.01;
    // Reeds on the near shore.
    const double reach = 0.90 + 0.05 * noise({p.x * 9, 2}) - 0.10 * std::pow(noise({p.x * 140, 5}), 2.0);
    if (p.y > reach)
        c = glm::mix(dvec3(0.03, 0.06, 0.02), dvec3(0.20, 0.17, 0.05), noise({p.x * 160, p.y * 9}));
    return c;
}

}  // namespace

const dvec3& Painting::at(int x, int y) const {
    return pixels[std::size_t(std::clamp(y, 0, height - 1)) * std::size_t(width) +
                  std::size_t(std::clamp(x, 0, width - 1))];
}

Painting paintLandscape(int size) {
    Painting painting{size, size, {}};
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            painting.pixels.push_back(landscape((dvec2(x, y) + 0.5) / double(size)));
    return painting;
}

std::vector<Painting> levelsOf(Painting painting) {
    std::vector<Painting> levels{std::move(painting)};
    while (levels.back().width > 1) {
        const Painting& fine = levels.back();
        Painting coarse{fine.width / 2, fine.height / 2, {}};
        for (int y = 0; y < coarse.height; ++y)
            for (int x = 0; x < coarse.width; ++x)
                coarse.pixels.push_back(0.25 * (fine.at(2 * x, 2 * y) + fine.at(2 * x + 1, 2 * y) +
                                                fine.at(2 * x, 2 * y + 1) + fine.at(2 * x + 1, 2 * y + 1)));
        levels.push_back(std::move(coarse));
    }
    return levels;
}

dvec3 nearest(const Painting& painting, dvec2 uv) {
    return painting.at(int(std::floor(uv.x * painting.width)), int(std::floor(uv.y * painting.height)));
}

dvec3 bilinear(const Painting& painting, dvec2 uv) {
    const dvec2 p = uv * dvec2(painting.width, painting.height) - 0.5, cell = glm::floor(p), f = p - cell;
    const int x = int(cell.x), y = int(cell.y);
    return glm::mix(glm::mix(painting.at(x, y), painting.at(x + 1, y), f.x),
                    glm::mix(painting.at(x, y + 1), painting.at(x + 1, y + 1), f.x), f.y);
}

dvec3 trilinear(const std::vector<Painting>& levels, dvec2 uv, double level) {
    level = std::clamp(level, 0.0, double(levels.size() - 1));
    const std::size_t fine = std::size_t(level), coarse = std::min(fine + 1, levels.size() - 1);
    return glm::mix(bilinear(levels[fine], uv), bilinear(levels[coarse], uv), level - double(fine));
}

io::ByteImage bytesOf(const Painting& painting) {
    io::ByteImage image{painting.width, painting.height, 3, {}};
    for (const dvec3& c : painting.pixels)
        for (int k = 0; k < 3; ++k)
            image.pixels.push_back(
                std::uint8_t(std::lround(255 * io::srgbFromLinear(std::clamp(float(c[k]), 0.0f, 1.0f)))));
    return image;
}

}  // namespace conelight::figures
