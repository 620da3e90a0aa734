// SPDX-License-Identifier: MIT
#include "reference/light_tree.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <tuple>

namespace conelight::reference {
namespace {

constexpr std::uint32_t kNoLeaf = ~0u;
// Of the cosine of a node that is below the horizon: rounding must not make light impossible that arrives.
constexpr float kLeastCosine = 1e-3f;

// The largest cosine with `normal` of directions to a sphere at `way`.
float largestCosine(const glm::vec3& way, float radius2, const glm::vec3& normal) {
    const float d2 = glm::dot(way, way);
    if (!(d2 > radius2)) return 1;
    const float cosine = glm::dot(way, normal) / std::sqrt(d2);
    const float sine2 = radius2 / d2, wideCosine = std::sqrt(1 - sine2);
    if (cosine >= wideCosine) return 1;
    const float across = std::sqrt(std::max(1 - cosine * cosine, 0.0f));
    return std::max(cosine * wideCosine + across * std::sqrt(sine2), kLeastCosine);
}

}  // namespace

LightTree::LightTree(std::vector<Lamp> lamps) {
    if (lamps.empty()) return;
    std::uint32_t most = 0;
    for (const Lamp& lamp : lamps) most = std::max(most, lamp.number);
    leafOf_.assign(std::size_t{most} + 1, kNoLeaf);
    nodes_.reserve(2 * lamps.size());
    nodes_.emplace_back();
    split(lamps, 0, 0, lamps.size());
}

// In half at the middle lamp along the longest edge of their centres' box.
void LightTree::split(std::vector<Lamp>& lamps, std::uint32_t node, std::size_t first, std::size_t end) {
    Aabb box, centers;
    double power = 0;
    for (std::size_t i = first; i < end; ++i) {
        box.grow(lamps[i].box.min);
        box.grow(lamps[i].box.max);
        centers.grow(lamps[i].box.center());
        power += static_cast<double>(lamps[i].power);
    }
    Node& made = nodes_[node];
    made.center = box.center();
    made.radius2 = 0.25f * glm::dot(box.extent(), box.extent());
    made.power = static_cast<float>(power);
    if (end - first == 1) {
        made.number = lamps[first].number;
        leafOf_[made.number] = node;
        return;
    }
    const glm::vec3 extent = centers.extent();
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
    const std::size_t middle = (first + end) / 2;
    const auto at = [&](std::size_t i) { return lamps.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(first), at(middle), at(end), [axis](const Lamp& a, const Lamp& b) {
        const float left = a.box.center()[axis], right = b.box.center()[axis];
        return std::tie(left, a.number) < std::tie(right, b.number);
    });
    const auto child = static_cast<std::uint32_t>(nodes_.size());
    made.child = child;
    nodes_.resize(nodes_.size() + 2);
    nodes_[child].parent = nodes_[child + 1].parent = node;
    split(lamps, child, first, middle);
    split(lamps, child + 1, middle, end);
}

// Probability of a node's first child.
float LightTree::firstShare(const Place& place, const Node& node) const {
    const auto weight = [&](const Node& one) {
        const glm::vec3 way = one.center - place.position;
        const float given = one.power / std::max({glm::dot(way, way), one.radius2, 1e-12f});
        return place.normal == glm::vec3(0) ? given : given * largestCosine(way, one.radius2, place.normal);
    };
    const float first = weight(nodes_[node.child]), second = weight(nodes_[node.child + 1]);
    return first / (first + second);
}

LightTree::Drawn LightTree::draw(const Place& place, float number) const {
    const Node* node = nodes_.data();
    double rest = static_cast<double>(number);
    float probability = 1;
    while (node->child != 0) {
        const float share = firstShare(place, *node), other = 1 - share;
        const bool first = rest < static_cast<double>(share);
        rest = first ? rest / static_cast<double>(share)
                     : (rest - static_cast<double>(share)) / std::max(static_cast<double>(other), 1e-12);
        probability *= first ? share : other;
        node = &nodes_[node->child + (first ? 0 : 1)];
    }
    return {node->number, probability};
}

float LightTree::probability(const Place& place, std::uint32_t number) const {
    if (number >= leafOf_.size() || leafOf_[number] == kNoLeaf) return 0;
    float probability = 1;
    for (std::uint32_t at = leafOf_[number]; at != 0; at = nodes_[at].parent) {
        const Node& parent = nodes_[nodes_[at].parent];
        const float share = firstShare(place, parent);
        probability *= at == parent.child ? share : 1 - share;
    }
    return probability;
}

}  // namespace conelight::reference
