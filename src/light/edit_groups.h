// SPDX-License-Identifier: MIT
// Many places of changes as fewer: those near each other are taken together. On the CPU.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "conelight/scene.h"

namespace conelight::light {

// A place has a center and a radius, m. The sphere round those from `begin` on, up to `end`.
template <typename Place>
std::pair<glm::vec3, float> sphereRound(const std::vector<Place>& places, std::size_t begin,
                                        std::size_t end) {
    Aabb box;
    for (std::size_t i = begin; i < end; ++i) {
        box.grow(places[i].center - places[i].radius);
        box.grow(places[i].center + places[i].radius);
    }
    const glm::vec3 center = box.center();
    float radius = 0;
    for (std::size_t i = begin; i < end; ++i)
        radius = std::max(radius, glm::distance(center, places[i].center) + places[i].radius);
    return {center, radius};
}

// Where to divide a group, whose places it puts in order: in the middle of where they are.
template <typename Place>
std::size_t dividedAt(std::vector<Place>& places, std::size_t begin, std::size_t end) {
    Aabb box;
    for (std::size_t i = begin; i < end; ++i) box.grow(places[i].center);
    const glm::vec3 extent = box.extent();
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
    const float middle = box.center()[axis];
    const auto first = places.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = places.begin() + static_cast<std::ptrdiff_t>(end);
    const auto cut =
        std::stable_partition(first, last, [&](const Place& place) { return place.center[axis] < middle; });
    const bool divides = cut != first && cut != last;  // not where all are in one point
    return divides ? static_cast<std::size_t>(cut - places.begin()) : (begin + end) / 2;
}

// At most `most` in place of all: the largest group is divided until there are as many. together(places, begin, end) is
// one in place of those.
template <typename Place, typename Together>
std::vector<Place> fewer(std::vector<Place> places, std::size_t most, const Together& together) {
    if (places.size() <= most) return places;
    struct Group {
        std::size_t begin, end;
        Place place;
    };
    std::vector<Group> groups = {{0, places.size(), together(places, 0, places.size())}};
    const auto size = [](const Group& group) {
        return group.end - group.begin > 1 ? group.place.radius : -1.0f;
    };
    while (groups.size() < most) {
        const auto largest = std::max_element(
            groups.begin(), groups.end(), [&](const Group& a, const Group& b) { return size(a) < size(b); });
        const std::size_t begin = largest->begin, end = largest->end, cut = dividedAt(places, begin, end);
        const auto group = [&](std::size_t from, std::size_t to) {
            return Group{from, to, to - from == 1 ? places[from] : together(places, from, to)};
        };
        *largest = group(begin, cut);
        groups.push_back(group(cut, end));
    }
    std::vector<Place> some;
    for (const Group& group : groups) some.push_back(group.place);
    return some;
}

}  // namespace conelight::light
