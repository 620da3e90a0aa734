// SPDX-License-Identifier: MIT
#include "scene/enclosure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace conelight::scene {
namespace {

constexpr int kCells = 40;
// Of directions, those that lead outside from a place in a room, through doors and windows; and from one in a room
// without a front. The middle of a cube without a side has a sixth.
constexpr float kMostOfRooms = 0.15f, kMostOfStages = 0.4f;
// From so many sheltered places the way is free towards a side that is missing.
constexpr float kOpenSide = 0.6f;
constexpr std::array<glm::vec3, 4> kSides = {{{1, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 0, -1}}};

// Spread evenly over the sphere: a Fibonacci lattice, whose turns are the golden angle.
template <std::size_t N>
std::array<glm::vec3, N> evenDirections() {
    std::array<glm::vec3, N> all;
    for (std::size_t i = 0; i < N; ++i) {
        const float y = 1 - (2 * static_cast<float>(i) + 1) / N;
        const float turn = 2.3999632f * static_cast<float>(i), r = std::sqrt(1 - y * y);
        all[i] = {r * std::cos(turn), y, r * std::sin(turn)};
    }
    return all;
}

template <class Use>
void forCells(const glm::ivec3& size, const Use& use) {
    glm::ivec3 cell;
    for (cell.z = 0; cell.z < size.z; ++cell.z)
        for (cell.y = 0; cell.y < size.y; ++cell.y)
            for (cell.x = 0; cell.x < size.x; ++cell.x) use(cell);
}

// What an eye sees in a direction: far is good, and so is detail.
struct View {
    static constexpr float kFovY = 1.05f, kAspect = 4.0f / 3.0f;  // rad
    static constexpr int kAcross = 9, kUpwards = 7;

    glm::vec3 ahead, right, up;

    explicit View(float turn) : ahead(std::sin(turn), -0.12f, -std::cos(turn)) {
        ahead = glm::normalize(ahead);
        right = glm::normalize(glm::cross(ahead, glm::vec3(0, 1, 0)));
        up = glm::cross(right, ahead);
    }
    float worth(const CoarseGrid& grid, const glm::ivec3& eye) const {
        const glm::vec2 half = std::tan(0.5f * kFovY) * glm::vec2(kAspect, 1);
        float sum = 0;
        for (int y = 0; y < kUpwards; ++y)
            for (int x = 0; x < kAcross; ++x) {
                const glm::vec2 at =
                    half * ((2.0f * glm::vec2(x, y) + 1.0f) / glm::vec2(kAcross, kUpwards) - 1.0f);
                const CoarseGrid::Hit hit = grid.look(eye, glm::normalize(ahead + at.x * right + at.y * up));
                sum += std::log2(hit.distance / grid.edge());
                if (!hit.leaves)
                    sum += kOfDetail * std::log2(1.0f + static_cast<float>(grid.corners(hit.cell)));
            }
        return sum;
    }

  private:
    static constexpr float kOfDetail = 0.25f;
};

}  // namespace

Enclosure::Enclosure(const Scene& scene, const Aabb& bounds)
    : grid_(scene, bounds, kCells), directions_(evenDirections<kDirections>()) {
    findInside();
    findDetail();
}

std::size_t Enclosure::at(const glm::ivec3& cell) const {
    const glm::ivec3 size = grid_.size();
    return static_cast<std::size_t>((cell.z * size.y + cell.y) * size.x + cell.x);
}

void Enclosure::findInside() {
    const glm::ivec3 size = grid_.size();
    int inside = 0, sheltered = 0, leave = 0;
    forCells(size, [&](const glm::ivec3& cell) {
        const bool isEmpty = grid_.empty(cell);
        int open = 0;
        for (const glm::vec3& direction : directions_) open += isEmpty && grid_.look(cell, direction).leaves;
        const float part = static_cast<float>(open) / kDirections;
        inside_.push_back(isEmpty && part <= kMostOfRooms ? 1 : 0);
        if (isEmpty && part <= kMostOfStages) {
            ++sheltered;
            for (std::size_t i = 0; i < ways_.size(); ++i) ways_[i] += grid_.look(cell, kSides[i]).leaves;
        }
        if (inside_.back() == 0) return;
        ++inside;
        leave += open;
    });
    const glm::ivec3 within = size - 2 * CoarseGrid::kBorder;
    const auto all = static_cast<float>(within.x * within.y * within.z);
    share_ = static_cast<float>(inside) / all;
    sheltered_ = static_cast<float>(sheltered) / all;
    open_ =
        static_cast<float>(leave) / static_cast<float>(std::max(inside, 1) * static_cast<int>(kDirections));
    for (float& way : ways_) way /= static_cast<float>(std::max(sheltered, 1));
}

// Outside lies up to two cells away: shells are as thick.
bool Enclosure::isSeenFromOutside(const glm::ivec3& cell) const {
    const glm::ivec3 low = glm::max(cell - 2, glm::ivec3(0)), high = glm::min(cell + 2, grid_.size() - 1);
    bool seen = false;
    forCells(high - low + 1, [&](const glm::ivec3& step) {
        seen = seen || (grid_.empty(low + step) && !isInside(low + step));
    });
    return seen;
}

void Enclosure::findDetail() {
    double all = 0, inside = 0;
    forCells(grid_.size(), [&](const glm::ivec3& cell) {
        const std::uint32_t corners = grid_.corners(cell);
        if (corners == 0) return;
        all += corners;
        if (!isSeenFromOutside(cell)) inside += corners;
    });
    detail_ = static_cast<float>(inside / std::max(all, 1.0));
}

std::optional<glm::vec3> Enclosure::openSide() const {
    const auto most = std::max_element(ways_.begin(), ways_.end());
    if (sheltered_ < 1.0f / 3.0f || *most < kOpenSide) return {};
    return kSides[static_cast<std::size_t>(most - ways_.begin())];
}

// A lamp may be let into a wall or a ceiling.
std::vector<glm::ivec3> Enclosure::cellsAbout(const glm::vec3& p) const {
    const glm::ivec3 middle = grid_.cellOf(p);
    if (isInside(middle)) return {middle};
    std::vector<glm::ivec3> cells;
    const glm::ivec3 low = glm::max(middle - 1, glm::ivec3(0)), high = glm::min(middle + 1, grid_.size() - 1);
    forCells(high - low + 1, [&](const glm::ivec3& step) {
        if (isInside(low + step)) cells.push_back(low + step);
    });
    return cells;
}

// All cells inside that are reached from one.
std::vector<glm::ivec3> Enclosure::roomOf(const glm::ivec3& cell) const {
    std::vector<char> left = inside_;
    std::vector<glm::ivec3> room = {cell};
    left[at(cell)] = 0;
    for (std::size_t i = 0; i < room.size(); ++i)
        for (int axis = 0; axis < 3; ++axis)
            for (const int step : {-1, 1}) {
                glm::ivec3 next = room[i];
                next[axis] += step;
                // Border cells are outside.
                if (std::exchange(left[at(next)], char{0}) != 0) room.push_back(next);
            }
    return room;
}

void Enclosure::keepRoomsOf(const std::vector<glm::vec3>& lamps) {
    const auto all = std::count(inside_.begin(), inside_.end(), char{1});
    std::vector<char> kept(inside_.size(), 0);
    bool any = false;
    for (const glm::vec3& lamp : lamps)
        for (const glm::ivec3& cell : cellsAbout(lamp)) {
            if (kept[at(cell)] != 0) continue;
            const std::vector<glm::ivec3> room = roomOf(cell);
            if (std::ssize(room) * 20 < all) continue;  // the inside of a lamp
            any = true;
            for (const glm::ivec3& one : room) kept[at(one)] = 1;
        }
    if (any) inside_ = std::move(kept);
}

float Enclosure::clearance(const glm::ivec3& cell) const {
    float nearest = std::numeric_limits<float>::infinity();
    for (const glm::vec3& direction : directions_)
        nearest = std::min(nearest, grid_.look(cell, direction).distance);
    return nearest;
}

// A little above half the height of the room, and not in a corner of it.
std::vector<Enclosure::Cell> Enclosure::placesOfEyes() const {
    std::vector<Cell> places;
    float highest = 0;
    forCells(grid_.size(), [&](const glm::ivec3& cell) {
        if (!isInside(cell)) return;
        const Cell place{cell, grid_.look(cell, {0, -1, 0}).distance, grid_.look(cell, {0, 1, 0}).distance};
        const float part = place.below / (place.below + place.above);
        if (part < 0.45f || part > 0.65f) return;
        highest = std::max(highest, place.below + place.above);
        places.push_back(place);
    });
    const float near = grid_.edge();
    std::erase_if(places, [&](const Cell& place) {
        return place.below + place.above < 0.6f * highest || clearance(place.index) < near;
    });
    return places;
}

bool Enclosure::sees(const glm::ivec3& cell, const glm::vec3& p) const {
    const glm::vec3 to = p - grid_.middle(cell);
    const float distance = glm::length(to);
    return distance < grid_.edge() || grid_.look(cell, to / distance).distance > distance - 2 * grid_.edge();
}

std::optional<Camera> Enclosure::cameraInside(const std::vector<glm::vec3>& lamps) const {
    constexpr std::size_t kMostPlaces = 400, kMostLamps = 64;
    constexpr int kTurns = 16;
    const std::size_t each = lamps.size() / kMostLamps + 1;
    const auto isLit = [&](const Cell& place) {
        for (std::size_t i = 0; i < lamps.size(); i += each)
            if (sees(place.index, lamps[i])) return true;
        return false;
    };
    std::vector<Cell> places = placesOfEyes();
    const auto dark = std::stable_partition(places.begin(), places.end(), isLit);
    if (dark != places.begin()) places.erase(dark, places.end());
    const std::size_t step = places.size() / kMostPlaces + 1;
    std::optional<Camera> best;
    float most = 0;
    for (std::size_t i = 0; i < places.size(); i += step)
        for (int turn = 0; turn < kTurns; ++turn) {
            const View view(2 * std::numbers::pi_v<float> * static_cast<float>(turn) / kTurns);
            const float worth = view.worth(grid_, places[i].index);
            if (best && worth <= most) continue;
            most = worth;
            if (!best) best.emplace();
            best->eye = grid_.middle(places[i].index);
            best->target =
                best->eye +
                std::max(grid_.look(places[i].index, view.ahead).distance, grid_.edge()) * view.ahead;
        }
    if (!best) return {};
    best->name = "inside";
    best->fovY = View::kFovY;
    best->zNear = 0.2f * grid_.edge();
    best->zFar = 100.0f * grid_.edge() * static_cast<float>(kCells);
    return best;
}

Enclosure::Lamp Enclosure::lamp() const {
    // The highest room is not a cupboard; of its places the one nearest to their middle.
    const std::vector<Cell> places = placesOfEyes();
    if (places.empty()) return {grid_.middle(grid_.size() / 2), grid_.edge()};
    glm::vec3 middle(0);
    for (const Cell& place : places) middle += grid_.middle(place.index) / static_cast<float>(places.size());
    const Cell& place = *std::min_element(places.begin(), places.end(), [&](const Cell& a, const Cell& b) {
        return glm::distance(grid_.middle(a.index), middle) < glm::distance(grid_.middle(b.index), middle);
    });
    const float height = 0.85f * (place.below + place.above);
    return {grid_.middle(place.index) + glm::vec3(0, height - place.below, 0), height};
}

}  // namespace conelight::scene
