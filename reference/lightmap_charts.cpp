// SPDX-License-Identifier: MIT
// Charts grow from the largest triangle that is left, over edges that are not creases, as long as no texel of
// their plane is covered twice. Each is turned to the least rectangle that one of its edges allows.
#include "reference/lightmap_charts.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <unordered_set>

#include <glm/gtc/constants.hpp>

#include "base/log.h"
#include "reference/materials.h"

#define STB_RECT_PACK_IMPLEMENTATION
#define STBRP_STATIC
#include <stb_rect_pack.h>

namespace conelight::reference {
namespace {

// Vertex normals on both sides of an edge that agree less are a crease: light is not the same there.
constexpr float kCreaseCosine = 0.9f;
// Small pieces may lie as aslant in a larger chart.
constexpr float kLeastAbsorbedCosine = 0.35f;
constexpr int kGutter = 2;  // texels between charts: one for each to be read at its border
constexpr std::uint32_t kNone = ~0u;

using Corners = std::array<std::uint32_t, 3>;

std::uint64_t pairKey(std::uint32_t a, std::uint32_t b) { return static_cast<std::uint64_t>(a) << 32 | b; }

struct PositionHash {
    std::size_t operator()(const glm::vec3& p) const {
        std::size_t hash = 0;
        for (int i = 0; i < 3; ++i)
            hash = hash * 0x9e3779b97f4a7c15ull + std::bit_cast<std::uint32_t>(p[i] + 0.0f);
        return hash;
    }
};

// What charts are made of: triangles as they stand, and who is whose neighbour.
class Surfaces {
  public:
    Surfaces(const Mesh& mesh, const glm::mat4& worldFromObject) : mesh_(mesh) {
        const glm::mat3 turned(worldFromObject);
        for (const glm::vec3& p : mesh.positions)
            positions_.push_back(glm::vec3(worldFromObject * glm::vec4(p, 1)));
        const glm::mat3 turnNormal = normalTransform(turned);
        mirrored_ = glm::determinant(turned) < 0;
        for (const glm::vec3& n : mesh.normals) {
            const glm::vec3 normal = turnNormal * n;
            normals_.push_back(glm::length(normal) > 1e-20f ? glm::normalize(normal) : normal);
        }
        weld();
        for (std::uint32_t t = 0; t < count(); ++t) addTriangle(t);
    }

    std::uint32_t count() const { return static_cast<std::uint32_t>(mesh_.triangleCount()); }
    Corners corners(std::uint32_t t) const {
        const std::size_t i = 3 * static_cast<std::size_t>(t);
        return {mesh_.indices[i], mesh_.indices[i + 1], mesh_.indices[i + 2]};
    }
    const glm::vec3& position(std::uint32_t vertex) const { return positions_[vertex]; }
    const glm::vec3& face(std::uint32_t t) const { return faces_[t]; }  // unit; 0: no area
    float area(std::uint32_t t) const { return areas_[t]; }

    // Calls visit(other) for triangles over an edge that is no crease.
    template <class Visit>
    void forNeighbours(std::uint32_t t, Visit visit) const {
        const Corners own = corners(t);
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = own[i], b = own[(i + 1) % 3];
            for (std::uint32_t other : edges_.at(edgeKey(a, b)))
                if (other != t && smooth(t, other, a) && smooth(t, other, b)) visit(other);
        }
    }

    // Calls visit(other) for triangles over any edge.
    template <class Visit>
    void forAllNeighbours(std::uint32_t t, Visit visit) const {
        const Corners own = corners(t);
        for (std::size_t i = 0; i < 3; ++i)
            for (const std::uint32_t other : edges_.at(edgeKey(own[i], own[(i + 1) % 3])))
                if (other != t) visit(other);
    }

    // Calls visit(t, other, own, theirs) for triangles that share an edge which is no crease: which of their corners
    // are its ends.
    template <class Visit>
    void forEdges(Visit visit) const {
        for (std::uint32_t t = 0; t < count(); ++t)
            forNeighbours(t, [&](std::uint32_t other) {
                if (other < t) return;
                std::vector<Corners::size_type> own, theirs;
                const Corners a = corners(t), b = corners(other);
                for (std::size_t i = 0; i < 3; ++i)
                    for (std::size_t k = 0; k < 3; ++k)
                        if (welded_[a[i]] == welded_[b[k]]) {
                            own.push_back(i);
                            theirs.push_back(k);
                        }
                if (own.size() == 2) visit(t, other, own, theirs);
            });
    }

  private:
    void weld() {
        std::unordered_map<glm::vec3, std::uint32_t, PositionHash> first;
        for (std::uint32_t v = 0; v < positions_.size(); ++v)
            welded_.push_back(first.emplace(positions_[v], v).first->second);
    }
    std::uint64_t edgeKey(std::uint32_t a, std::uint32_t b) const {
        return pairKey(std::min(welded_[a], welded_[b]), std::max(welded_[a], welded_[b]));
    }
    void addTriangle(std::uint32_t t) {
        const Corners c = corners(t);
        const glm::vec3 u = positions_[c[1]] - positions_[c[0]], v = positions_[c[2]] - positions_[c[0]];
        const glm::vec3 cross = glm::cross(u, v);
        const float length = glm::length(cross);
        const float longest = std::max({glm::dot(u, u), glm::dot(v, v), glm::dot(u - v, u - v)});
        // Needles point anywhere.
        const bool usable = std::isfinite(length) && length > 1e-5f * longest;
        faces_.push_back(usable ? (mirrored_ ? -1.0f : 1.0f) * cross / length : glm::vec3(0));
        areas_.push_back(usable ? 0.5f * length : 0.0f);
        for (std::size_t i = 0; i < 3; ++i) edges_[edgeKey(c[i], c[(i + 1) % 3])].push_back(t);
    }
    glm::vec3 normalAt(std::uint32_t t, std::uint32_t place) const {
        if (normals_.empty()) return faces_[t];
        for (const std::uint32_t v : corners(t))
            if (welded_[v] == welded_[place]) return normals_[v];
        return faces_[t];
    }
    bool smooth(std::uint32_t a, std::uint32_t b, std::uint32_t place) const {
        return glm::dot(normalAt(a, place), normalAt(b, place)) > kCreaseCosine;
    }

    const Mesh& mesh_;
    bool mirrored_ = false;
    std::vector<glm::vec3> positions_, normals_, faces_;
    std::vector<float> areas_;
    std::vector<std::uint32_t> welded_;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> edges_;
};

// Calls visit(x, y) for texels whose middles lie within a triangle, off its edges.
template <class Visit>
void forMiddles(const std::array<glm::dvec2, 3>& p, Visit visit) {
    const double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
    if (!(std::abs(area) > 1e-12)) return;
    const glm::dvec2 low = glm::min(glm::min(p[0], p[1]), p[2]), high = glm::max(glm::max(p[0], p[1]), p[2]);
    for (double y = std::ceil(low.y - 0.5); y + 0.5 <= high.y; ++y)
        for (double x = std::ceil(low.x - 0.5); x + 0.5 <= high.x; ++x) {
            bool within = true;
            for (std::size_t i = 0; i < 3 && within; ++i) {
                const glm::dvec2 a = p[i], b = p[(i + 1) % 3];
                const double side = (b.x - a.x) * (y + 0.5 - a.y) - (b.y - a.y) * (x + 0.5 - a.x);
                within = side / area > 1e-6;
            }
            if (within) visit(static_cast<std::int32_t>(x), static_cast<std::int32_t>(y));
        }
}

struct Chart {
    std::vector<std::uint32_t> triangles;
    glm::vec3 u{0}, v{0}, n{0};                 // unit; the plane's axes and normal
    float area = 0;                             // of the triangles, m^2
    std::unordered_set<std::uint64_t> covered;  // texels of the plane, while it grows
    glm::dvec2 low{0};                          // m along them
    glm::dvec2 extent{0};
    glm::ivec2 size{1};  // texels
};

class Charts {
  public:
    Charts(const Surfaces& surfaces, float texel)
        : surfaces_(surfaces), texel_(texel), chartOf_(surfaces.count(), kNone) {
        std::vector<std::uint32_t> order(surfaces.count());
        std::iota(order.begin(), order.end(), 0u);
        std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
            return surfaces.area(a) > surfaces.area(b);
        });
        for (const std::uint32_t seed : order)
            if (chartOf_[seed] == kNone) grow(seed);
        absorbSmall();
        for (Chart& chart : charts_) turn(chart);
    }
    const std::vector<Chart>& charts() const { return charts_; }
    const std::vector<std::uint32_t>& chartOf() const { return chartOf_; }
    glm::vec2 texelsOf(const Chart& chart, std::uint32_t vertex) const {
        const glm::dvec2 at = along(chart.u, chart.v, vertex) - chart.low;
        glm::vec2 result(0.5f);
        for (int i = 0; i < 2; ++i)
            if (chart.extent[i] > 0)
                result[i] += static_cast<float>(at[i] / chart.extent[i] * (chart.size[i] - 1));
        return result;
    }

  private:
    glm::dvec2 along(const glm::vec3& u, const glm::vec3& v, std::uint32_t vertex) const {
        const glm::dvec3 p(surfaces_.position(vertex));
        return {glm::dot(p, glm::dvec3(u)), glm::dot(p, glm::dvec3(v))};
    }

    // Adds a triangle, unless it covers a texel that is taken.
    bool take(std::uint32_t number, std::uint32_t t) {
        Chart& chart = charts_[number];
        const Corners c = surfaces_.corners(t);
        std::array<glm::dvec2, 3> p;
        for (std::size_t i = 0; i < 3; ++i)
            p[i] = along(chart.u, chart.v, c[i]) / static_cast<double>(texel_);
        bool taken = false;
        const auto key = [](std::int32_t x, std::int32_t y) {
            return pairKey(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
        };
        forMiddles(p, [&](std::int32_t x, std::int32_t y) { taken |= chart.covered.count(key(x, y)) > 0; });
        if (taken) return false;
        forMiddles(p, [&](std::int32_t x, std::int32_t y) { chart.covered.insert(key(x, y)); });
        chart.triangles.push_back(t);
        chart.area += surfaces_.area(t);
        chartOf_[t] = number;
        return true;
    }

    void grow(std::uint32_t seed) {
        const bool flat = surfaces_.face(seed) != glm::vec3(0);
        if (!flat) {  // covers nothing: anywhere will do
            surfaces_.forAllNeighbours(seed, [&](std::uint32_t other) {
                if (chartOf_[seed] == kNone && chartOf_[other] != kNone) take(chartOf_[other], seed);
            });
            if (chartOf_[seed] != kNone) return;
        }
        const auto number = static_cast<std::uint32_t>(charts_.size());
        Chart& chart = charts_.emplace_back();
        const Frame plane(flat ? surfaces_.face(seed) : glm::vec3(0, 1, 0));
        chart.u = plane.u;
        chart.v = plane.w;
        chart.n = plane.n;
        take(number, seed);
        for (std::size_t next = 0; flat && next < chart.triangles.size(); ++next)
            surfaces_.forNeighbours(chart.triangles[next], [&](std::uint32_t other) {
                if (chartOf_[other] == kNone && glm::dot(surfaces_.face(other), chart.n) > kLeastChartCosine)
                    take(number, other);
            });
    }

    // Between round charts small pieces are left: their triangles go to a larger neighbour that has room for them.
    void absorbSmall() {
        constexpr float kSmall = 0.125f;  // of the neighbour's area
        for (bool moved = true; moved;) {
            moved = false;
            for (Chart& chart : charts_) {
                std::vector<std::uint32_t> left;
                for (const std::uint32_t t : chart.triangles) {
                    const std::uint32_t own = chartOf_[t];
                    surfaces_.forNeighbours(t, [&](std::uint32_t other) {
                        const std::uint32_t to = chartOf_[other];
                        if (chartOf_[t] != own || to == own || chart.area >= kSmall * charts_[to].area)
                            return;
                        if (!(glm::dot(surfaces_.face(t), charts_[to].n) > kLeastAbsorbedCosine)) return;
                        // Large charts grow and small ones shrink, so that this ends.
                        if (take(to, t)) chart.area -= surfaces_.area(t);
                    });
                    if (chartOf_[t] == own) left.push_back(t);
                }
                moved |= left.size() < chart.triangles.size();
                chart.triangles = std::move(left);
            }
        }
        dropEmpty();
        for (Chart& chart : charts_) chart.covered.clear();
    }

    void dropEmpty() {
        std::vector<Chart> full;
        for (Chart& chart : charts_) {
            if (chart.triangles.empty()) continue;
            for (const std::uint32_t t : chart.triangles)
                chartOf_[t] = static_cast<std::uint32_t>(full.size());
            full.push_back(std::move(chart));
        }
        charts_ = std::move(full);
    }

    // Along the edge that gives the least rectangle, of those of its first triangles.
    void turn(Chart& chart) {
        constexpr std::size_t kTried = 8;
        const glm::vec3 u = chart.u, v = chart.v;
        double least = INFINITY;
        const auto attempt = [&](const glm::dvec2& way) {
            const double length = glm::length(way);
            if (!(length > 0)) return;
            const glm::vec2 w(way / length);
            Chart turned;
            turned.u = u * w.x + v * w.y;
            turned.v = v * w.x - u * w.y;
            glm::dvec2 high(-INFINITY);
            turned.low = glm::dvec2(INFINITY);
            for (const std::uint32_t t : chart.triangles)
                for (const std::uint32_t vertex : surfaces_.corners(t)) {
                    const glm::dvec2 at = along(turned.u, turned.v, vertex);
                    turned.low = glm::min(turned.low, at);
                    high = glm::max(high, at);
                }
            turned.extent = high - turned.low;
            const double area = (turned.extent.x + static_cast<double>(texel_)) *
                                (turned.extent.y + static_cast<double>(texel_));
            if (!(area < least * (1 - 1e-6))) return;
            least = area;
            chart.u = turned.u;
            chart.v = turned.v;
            chart.low = turned.low;
            chart.extent = turned.extent;
        };
        attempt({1, 0});
        for (std::size_t i = 0; i < std::min(kTried, chart.triangles.size()); ++i) {
            const Corners c = surfaces_.corners(chart.triangles[i]);
            for (std::size_t k = 0; k < 3; ++k) attempt(along(u, v, c[(k + 1) % 3]) - along(u, v, c[k]));
        }
        for (int i = 0; i < 2; ++i) {
            // Rounding must not add a texel.
            const double texels = std::ceil(chart.extent[i] / static_cast<double>(texel_) - 1e-4);
            chart.size[i] = 1 + static_cast<int>(std::clamp(texels, 0.0, 1e6));
        }
    }

    const Surfaces& surfaces_;
    float texel_;
    std::vector<Chart> charts_;
    std::vector<std::uint32_t> chartOf_;
};

// What no cutting could help is known before texels are counted.
bool couldFit(const Surfaces& surfaces, float texel, int side) {
    const double most = static_cast<double>(side) * static_cast<double>(texel);
    double area = 0;
    for (std::uint32_t t = 0; t < surfaces.count(); ++t) {
        const Corners c = surfaces.corners(t);
        for (std::size_t i = 0; i < 3; ++i)
            if (static_cast<double>(
                    glm::distance(surfaces.position(c[i]), surfaces.position(c[(i + 1) % 3]))) >
                glm::root_two<double>() * most)
                return false;
        area += static_cast<double>(kLeastAbsorbedCosine * surfaces.area(t));
    }
    return area <= most * most;
}

template <class T>
void copyVertex(const std::vector<T>& from, std::uint32_t vertex, std::vector<T>& to) {
    if (!from.empty()) to.push_back(from[vertex]);
}

glm::ivec2 layOut(const std::vector<Chart>& charts, int side, std::vector<glm::ivec2>& places) {
    std::vector<glm::ivec2> sizes;
    double area = 0;
    int longest = 1;
    for (const Chart& chart : charts) {
        sizes.push_back(chart.size + kGutter);
        area += static_cast<double>(sizes.back().x) * sizes.back().y;
        longest = std::max({longest, sizes.back().x, sizes.back().y});
    }
    if (longest > side) return glm::ivec2(0);
    for (double edge = std::max<double>(longest, std::sqrt(area)); std::floor(edge) <= side; edge *= 1.05) {
        if (!packRectangles(sizes, glm::ivec2(static_cast<int>(edge)), places)) continue;
        glm::ivec2 used(1);
        for (std::size_t i = 0; i < places.size(); ++i) used = glm::max(used, places[i] + sizes[i]);
        for (glm::ivec2& place : places) place += kGutter / 2;
        return used;
    }
    return glm::ivec2(0);
}

}  // namespace

bool packRectangles(const std::vector<glm::ivec2>& sizes, const glm::ivec2& within,
                    std::vector<glm::ivec2>& places) {
    std::vector<stbrp_rect> rects(sizes.size());
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        rects[i] = {};
        rects[i].id = static_cast<int>(i);
        rects[i].w = static_cast<stbrp_coord>(sizes[i].x);
        rects[i].h = static_cast<stbrp_coord>(sizes[i].y);
    }
    std::vector<stbrp_node> nodes(static_cast<std::size_t>(within.x));
    stbrp_context context;
    stbrp_init_target(&context, within.x, within.y, nodes.data(), within.x);
    stbrp_pack_rects(&context, rects.data(), static_cast<int>(rects.size()));
    places.assign(sizes.size(), glm::ivec2(0));
    for (const stbrp_rect& rect : rects) {
        if (rect.was_packed == 0) return false;
        places[static_cast<std::size_t>(rect.id)] = {static_cast<int>(rect.x), static_cast<int>(rect.y)};
    }
    return true;
}

ChartedMesh chartMesh(const Mesh& mesh, const glm::mat4& worldFromObject, float texel, int side,
                      const std::string& what) {
    const Surfaces surfaces(mesh, worldFromObject);
    const auto tooLarge = [&] {
        base::fail(ErrorKind::Usage,
                   "%s: does not fit into %d x %d texels of %g m; larger texels or maps would be right",
                   what.c_str(), side, side, static_cast<double>(texel));
    };
    if (!couldFit(surfaces, texel, side)) tooLarge();
    const Charts charts(surfaces, texel);
    std::vector<glm::ivec2> places;
    ChartedMesh result;
    result.size = layOut(charts.charts(), side, places);
    if (result.size == glm::ivec2(0)) tooLarge();
    result.chartOf = charts.chartOf();
    result.charts = static_cast<std::uint32_t>(charts.charts().size());
    result.mesh.name = mesh.name;
    std::unordered_map<std::uint64_t, std::uint32_t> made;
    for (std::uint32_t t = 0; t < surfaces.count(); ++t)
        for (const std::uint32_t vertex : surfaces.corners(t)) {
            const std::uint32_t chart = result.chartOf[t];
            const auto next = static_cast<std::uint32_t>(result.mesh.positions.size());
            const auto [found, isNew] = made.emplace(pairKey(chart, vertex), next);
            result.mesh.indices.push_back(found->second);
            if (!isNew) continue;
            copyVertex(mesh.positions, vertex, result.mesh.positions);
            copyVertex(mesh.normals, vertex, result.mesh.normals);
            copyVertex(mesh.uvs, vertex, result.mesh.uvs);
            copyVertex(mesh.tangents, vertex, result.mesh.tangents);
            copyVertex(mesh.colors, vertex, result.mesh.colors);
            result.uvs.push_back(glm::vec2(places[chart]) + charts.texelsOf(charts.charts()[chart], vertex));
        }
    surfaces.forEdges([&](std::uint32_t t, std::uint32_t other, const auto& own, const auto& theirs) {
        if (result.chartOf[t] == result.chartOf[other]) return;
        const auto at = [&](std::uint32_t triangle, std::size_t corner) {
            return result.uvs[result.mesh.indices[3 * static_cast<std::size_t>(triangle) + corner]];
        };
        result.seams.push_back(
            {{at(t, own[0]), at(t, own[1])}, {at(other, theirs[0]), at(other, theirs[1])}});
    });
    return result;
}

}  // namespace conelight::reference
