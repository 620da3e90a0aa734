// SPDX-License-Identifier: MIT
#include "scene/closed_solids.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

#include "shared/scene.h"

namespace conelight::scene {
namespace {

// How far apart positions may be that are one, over the largest coordinate: rounding, of angles too.
constexpr double kApart = 0x1p-21;
constexpr double kFlat = -1e-6;  // least volume over area^1.5 of what counts as looking outwards: rounding
constexpr std::uint32_t kNobody = 0xffffffffu;

std::uint64_t mixed(std::uint64_t x) {  // splitmix64 (Steele et al. 2014)
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

// Sets that are joined (Tarjan 1975); each is named by its least member.
class JoinedSets {
  public:
    explicit JoinedSets(std::size_t count) : parents_(count) {
        std::iota(parents_.begin(), parents_.end(), 0u);
    }
    std::uint32_t of(std::uint32_t i) {
        while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = of(a);
        b = of(b);
        parents_[std::max(a, b)] = std::min(a, b);
    }

  private:
    std::vector<std::uint32_t> parents_;
};

using Cell = std::array<std::int64_t, 3>;

// The first position that came to each cell.
class CellTable {
  public:
    explicit CellTable(std::size_t positions)
        : slots_(std::bit_ceil(2 * positions + 1), kNobody), cells_(positions) {}
    std::uint32_t firstIn(const Cell& cell) const { return slots_[slotOf(cell)]; }
    void put(std::uint32_t position, const Cell& cell) {
        cells_[position] = cell;
        std::uint32_t& slot = slots_[slotOf(cell)];
        if (slot == kNobody) slot = position;
    }

  private:
    std::size_t slotOf(const Cell& cell) const {
        std::uint64_t slot = 0;
        for (const std::int64_t number : cell) slot = mixed(slot ^ static_cast<std::uint64_t>(number));
        slot &= slots_.size() - 1;
        while (slots_[slot] != kNobody && cells_[slots_[slot]] != cell)
            slot = (slot + 1) & (slots_.size() - 1);
        return slot;
    }
    std::vector<std::uint32_t> slots_;
    std::vector<Cell> cells_;
};

// Joins positions that are one. They lie in one cell, or in two that both are as near to as they are apart.
void joinNear(const std::vector<glm::vec3>& positions, JoinedSets& points) {
    constexpr double kPerCell = 8;  // distances across a cell: few positions are near a border
    glm::vec3 low(INFINITY), high(-INFINITY);
    for (const glm::vec3& p : positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const glm::dvec3 farthest = glm::max(glm::abs(low), glm::abs(high));
    const double apart = std::max(kApart * std::max({farthest.x, farthest.y, farthest.z}), 1e-30);
    CellTable table(positions.size());
    for (std::uint32_t i = 0; i < positions.size(); ++i) {
        const glm::dvec3 at = (glm::dvec3(positions[i]) - glm::dvec3(low)) / (kPerCell * apart);
        // The first and the last cell along each axis that it is near.
        Cell first{}, last{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double place = at[static_cast<int>(axis)];
            first[axis] = static_cast<std::int64_t>(std::floor(place - 1 / kPerCell));
            last[axis] = static_cast<std::int64_t>(std::floor(place + 1 / kPerCell));
        }
        for (int neighbour = 0; neighbour < 8; ++neighbour) {
            Cell cell = first;
            bool another = true;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                if ((neighbour >> axis & 1) == 0) continue;
                another = another && first[axis] != last[axis];
                cell[axis] = last[axis];
            }
            const std::uint32_t there = another ? table.firstIn(cell) : kNobody;
            if (there != kNobody) points.join(i, there);
        }
        table.put(i, {static_cast<std::int64_t>(at.x), static_cast<std::int64_t>(at.y),
                      static_cast<std::int64_t>(at.z)});
    }
}

// What the triangles of a part add up to.
struct Part {
    double volume = 0, area = 0;
    std::uint64_t edges = 0;  // of each edge a random number, plus one way, minus the other
};

// Of the edge from a to b.
std::uint64_t signedNumber(std::uint32_t a, std::uint32_t b) {
    if (a == b) return 0;
    const std::uint64_t number = mixed((std::uint64_t{std::min(a, b)} << 32) | std::max(a, b));
    return a < b ? number : ~number + 1;
}

float thickness(const Part& part) {
    const bool closed = part.edges == 0 && part.area > 0 && part.volume >= kFlat * std::pow(part.area, 1.5);
    return closed ? static_cast<float>(4 * std::max(part.volume, 0.0) / part.area) : -1.0f;
}

}  // namespace

std::vector<float> solidThickness(const std::vector<glm::vec3>& positions,
                                  const std::vector<std::uint32_t>& indices) {
    const bool finite = std::all_of(positions.begin(), positions.end(), [](const glm::vec3& p) {
        return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    });
    if (!finite || indices.empty()) return std::vector<float>(positions.size(), -1.0f);
    JoinedSets points(positions.size());
    joinNear(positions, points);
    JoinedSets members(positions.size());
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
        for (const std::size_t k : {std::size_t{1}, std::size_t{2}})
            members.join(points.of(indices[i]), points.of(indices[i + k]));

    std::vector<Part> parts(positions.size());
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const std::array<std::uint32_t, 3> at = {points.of(indices[i]), points.of(indices[i + 1]),
                                                 points.of(indices[i + 2])};
        const std::uint32_t member = members.of(at[0]);
        Part& part = parts[member];
        // From a place of its own: volumes of what is small and far away would drown in rounding.
        const glm::dvec3 origin(positions[member]);
        const glm::dvec3 a = glm::dvec3(positions[at[0]]) - origin, b = glm::dvec3(positions[at[1]]) - origin,
                         c = glm::dvec3(positions[at[2]]) - origin;
        part.volume += glm::dot(a, glm::cross(b, c)) / 6;
        part.area += glm::length(glm::cross(b - a, c - a)) / 2;
        for (std::size_t k = 0; k < 3; ++k) part.edges += signedNumber(at[k], at[(k + 1) % 3]);
    }
    std::vector<float> result(positions.size());
    for (std::uint32_t i = 0; i < positions.size(); ++i)
        result[i] = thickness(parts[members.of(points.of(i))]);
    return result;
}

std::uint8_t solidCode(float thickness) {
    if (thickness < 0) return 0;
    const float steps = std::ceil(std::log2(std::max(thickness, 1e-30f))) + VERTEX_SOLID_BIAS;
    return steps > 31 ? 0 : static_cast<std::uint8_t>(std::max(steps, 1.0f));
}

std::vector<std::uint8_t> solidCodes(const Mesh& mesh) {
    std::vector<std::uint8_t> codes;
    codes.reserve(mesh.positions.size());
    for (const float thickness : solidThickness(mesh.positions, mesh.indices))
        codes.push_back(solidCode(thickness));
    return codes;
}

}  // namespace conelight::scene
