// SPDX-License-Identifier: MIT
// Drawings of voxelization by raster: triangles are projected along an axis, and the pixels whose middles
// they cover become voxels (OpenGL's rule; the thesis's program voxelizes so).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <tuple>

#include "figures/drawings/drawings.h"
#include "figures/drawings/space_view.h"

namespace conelight::figures {
namespace {

using glm::dvec3;
using glm::ivec3;
using Triangle = std::array<dvec3, 3>;

struct Less {
    bool operator()(const ivec3& a, const ivec3& b) const {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    }
};
using Voxels = std::set<ivec3, Less>;

int dominantAxis(const Triangle& t) {
    const dvec3 n = glm::abs(glm::cross(t[1] - t[0], t[2] - t[0]));
    return n.x > n.y ? (n.x > n.z ? 0 : 2) : (n.y > n.z ? 1 : 2);
}

// Voxels of a triangle, seen along `axis`; corners are in voxels.
void rasterize(const Triangle& t, int axis, int size, Voxels& voxels) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto area = [&](const dvec3& a, const dvec3& b, double x, double y) {
        return (b[u] - a[u]) * (y - a[v]) - (b[v] - a[v]) * (x - a[u]);
    };
    const double whole = area(t[0], t[1], t[2][u], t[2][v]);
    if (std::abs(whole) < 1e-12) return;  // edge on: no pixel
    for (int i = 0; i < size; ++i)
        for (int j = 0; j < size; ++j) {
            const double x = i + 0.5, y = j + 0.5;
            const double a = area(t[1], t[2], x, y) / whole, b = area(t[2], t[0], x, y) / whole,
                         c = 1 - a - b;
            if (a < 0 || b < 0 || c < 0) continue;
            const double depth = a * t[0][axis] + b * t[1][axis] + c * t[2][axis];
            if (depth < 0 || depth >= size) continue;
            ivec3 voxel(0);
            voxel[axis] = int(depth);
            voxel[u] = i;
            voxel[v] = j;
            voxels.insert(voxel);
        }
}

// Far ones first, so that near ones cover them.
void drawVoxels(Drawing& d, const SpaceView& view, const Voxels& voxels, const dvec3& rgb) {
    std::vector<ivec3> sorted(voxels.begin(), voxels.end());
    std::stable_sort(sorted.begin(), sorted.end(), [&](const ivec3& a, const ivec3& b) {
        return view.depth(dvec3(a)) < view.depth(dvec3(b));
    });
    for (const ivec3& voxel : sorted) {
        // Faces between two voxels are never seen.
        glm::bvec3 open(true);
        for (int axis = 0; axis < 3; ++axis) {
            ivec3 next = voxel;
            next[axis] += view.toEye()[axis] > 0 ? 1 : -1;
            open[axis] = voxels.count(next) == 0;
        }
        drawCube(d, view, dvec3(voxel), 1, rgb, open);
    }
}

void drawGridFrame(Drawing& d, const SpaceView& view, int size) {
    const double s = size;
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (int i = 0; i < 4; ++i) {
            dvec3 from(0);
            from[u] = (i & 1) * s;
            from[v] = (i >> 1) * s;
            dvec3 to = from;
            to[axis] = s;
            d.line(view.at(from), view.at(to), stroke(colour::kPale, 0.8));
        }
    }
}

// A quarter of a dome: it faces every axis somewhere.
std::vector<Triangle> dome(int size, int pieces) {
    const auto at = [&](int i, int j) {
        const double theta = 0.5 * kPi * i / pieces, phi = 0.5 * kPi * j / pieces;
        return (size - 1.3) *
                   dvec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)) +
               0.4;
    };
    std::vector<Triangle> triangles;
    for (int i = 0; i < pieces; ++i)
        for (int j = 0; j < pieces; ++j) {
            triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    return triangles;
}

}  // namespace

std::string drawViewportProjection() {
    Drawing d;
    constexpr int kSize = 8;
    const SpaceView view{.scale = 34, .azimuthDeg = 30, .elevationDeg = 24};
    const Triangle triangle = {dvec3(2.2, 1.0, 1.1), dvec3(5.6, 6.9, 2.3), dvec3(3.4, 3.0, 7.2)};
    constexpr double kScreen = -6;  // the viewport stands behind the grid, along -x
    Voxels voxels;
    rasterize(triangle, 0, kSize, voxels);
    // The viewport: one pixel per column of voxels.
    for (int j = 0; j < kSize; ++j)
        for (int k = 0; k < kSize; ++k) {
            const bool covered = std::any_of(voxels.begin(), voxels.end(),
                                             [&](const ivec3& v) { return v.y == j && v.z == k; });
            d.polygon(
                view.outline(
                    {{kScreen, j, k}, {kScreen, j + 1, k}, {kScreen, j + 1, k + 1}, {kScreen, j, k + 1}}),
                {.stroke = colour::kPale, .width = 0.8, .fill = covered ? "#f5d596" : "#fbfcfe"});
        }
    Triangle seen = triangle;
    for (dvec3& p : seen) p.x = kScreen;
    d.polygon(view.outline({seen[0], seen[1], seen[2]}), stroke(colour::kOrange, 2));
    for (int i = 0; i < 3; ++i)
        d.line(view.at(seen[i]), view.at(triangle[i]), stroke(colour::kOrange, 1.2, "5 4"));
    drawGridFrame(d, view, kSize);
    drawVoxels(d, view, voxels, {0.61, 0.80, 0.92});
    d.polygon(view.outline({triangle[0], triangle[1], triangle[2]}), {.stroke = colour::kBlue, .width = 2.4});
    d.text(view.at({kScreen, 4, 8}) + Point(10, -52), "viewport: one pixel per column",
           {.size = 14, .colour = "#8a6100"});
    d.text(view.at({8, 5, 0}) + Point(0, 44), "3D texture: depth picks the voxel",
           {.size = 14, .colour = colour::kBlue});
    d.text(view.at({8, 5, 0}) + Point(0, 66),
           fmt::format("{} pixels are covered, {} voxels are filled", voxels.size(), voxels.size()),
           {.size = 14, .colour = colour::kNote});
    return d.svg("A triangle is projected on the viewport and stored as voxels");
}

std::string drawThreeVoxelizations() {
    Drawing d;
    constexpr int kSize = 18;
    const std::vector<Triangle> surface = dome(kSize, 24);
    const char* titles[] = {"along x", "along y", "along z", "each triangle along its own"};
    std::array<Voxels, 4> all;
    for (int way = 0; way < 4; ++way)
        for (const Triangle& t : surface)
            rasterize(t, way < 3 ? way : dominantAxis(t), kSize, all[std::size_t(way)]);
    Voxels together;
    for (int way = 0; way < 3; ++way)
        together.insert(all[std::size_t(way)].begin(), all[std::size_t(way)].end());
    for (int way = 0; way < 4; ++way) {
        const SpaceView view{.origin = Point((way % 2) * 480, (way / 2) * 480),
                             .scale = 13,
                             .azimuthDeg = 40,
                             .elevationDeg = 30};
        drawVoxels(d, view, all[std::size_t(way)],
                   way < 3 ? dvec3(0.95, 0.76, 0.42) : dvec3(0.47, 0.78, 0.68));
        const Point foot = view.at({kSize, kSize, 0}) + Point(0, 34);
        d.text(foot, titles[way], {.size = 16, .bold = true});
        std::size_t lost = 0;
        for (const ivec3& v : together) lost += all[std::size_t(way)].count(v) == 0;
        d.text(foot + Point(0, 22),
               fmt::format("{} voxels; {} more in the other directions", all[std::size_t(way)].size(), lost),
               {.size = 13, .colour = colour::kNote});
    }
    return d.svg("One surface voxelized from three directions");
}

std::string drawDominantAxis() {
    Drawing d;
    const Triangle triangle = {dvec3(1.0, 0.9, 1.0), dvec3(3.6, 1.5, 1.3), dvec3(2.2, 2.6, 3.6)};
    const dvec3 n = glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
    const int best = dominantAxis(triangle);
    constexpr double kSize = 4.4;
    const SpaceView view{.scale = 78, .azimuthDeg = 36, .elevationDeg = 27};
    const char* names[] = {"x", "y", "z"};
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        dvec3 b(0), c(0);
        b[u] = kSize;
        c[v] = kSize;
        d.polygon(view.outline({dvec3(0), b, b + c, c}),
                  {.stroke = colour::kPale, .width = 1, .fill = "#f6f8fb", .opacity = 0.9});
    }
    for (int axis = 0; axis < 3; ++axis) {
        Triangle seen = triangle;
        for (dvec3& p : seen) p[axis] = 0;
        const bool chosen = axis == best;
        for (std::size_t i = 0; i < 3; ++i)
            d.line(view.at(triangle[i]), view.at(seen[i]),
                   stroke(chosen ? colour::kOrange : colour::kPale, 1, "4 4"));
        d.polygon(view.outline({seen[0], seen[1], seen[2]}),
                  {.stroke = chosen ? colour::kOrange : colour::kPale,
                   .width = chosen ? 2.4 : 1.4,
                   .fill = chosen ? "#f5d596" : "#dfe4ec"});
    }
    for (int axis = 0; axis < 3; ++axis) {
        dvec3 end(0);
        end[axis] = kSize + 0.5;
        d.arrow(view.at(dvec3(0)), view.at(end), stroke(colour::kInk, 1.6));
        d.text(view.at(end * 1.06) + Point(0, 5), names[axis], {.size = 18, .italic = true});
    }
    d.polygon(view.outline({triangle[0], triangle[1], triangle[2]}),
              {.stroke = colour::kBlue, .width = 2.4, .fill = "#9cc9e6", .opacity = 0.85});
    const dvec3 centre = (triangle[0] + triangle[1] + triangle[2]) / 3.0;
    d.arrow(view.at(centre), view.at(centre + 1.3 * glm::normalize(n)), stroke(colour::kBlue, 2));
    d.text(view.at(centre + 1.45 * glm::normalize(n)) + Point(0, 5), "n",
           {.size = 18, .colour = colour::kBlue, .italic = true});
    const Point foot = view.at({kSize, kSize, 0}) + Point(0, 60);
    d.text(foot,
           fmt::format("area of the shadow along x: {:.2f}, y: {:.2f}, z: {:.2f}", 0.5 * std::abs(n.x),
                       0.5 * std::abs(n.y), 0.5 * std::abs(n.z)),
           {.size = 16});
    d.text(foot + Point(0, 26),
           fmt::format("largest |n · axis|: {} is chosen, most pixels are covered", names[best]),
           {.size = 14, .colour = colour::kNote});
    return d.svg("The dominant axis of a triangle");
}

}  // namespace conelight::figures
