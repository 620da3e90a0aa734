// SPDX-License-Identifier: MIT
#include "light/lamp_tree.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "conelight/scene.h"
#include "gl/gl.h"

namespace conelight::light {
namespace {

constexpr float kNoReach = 1e30f;
// A lamp of mean power has so many slots, one of more power at most so many times as many: the rest is told by weights.
constexpr float kSlotsOfMean = 4, kMostSlots = 1024;

struct TreeLamp {
    glm::vec3 position;
    float power;
    float reach;
    std::uint32_t slots;
    std::uint32_t number;
};

// What the lamp gives at distance `far`, as if by the inverse square.
float powerOf(const gpu::Light& light, float far) {
    const float power = (light.intensity.x + light.intensity.y + light.intensity.z) / 3;
    if (light.customFalloff == 0) return power;
    const glm::vec3& f = light.falloff;
    return power * far * far / std::max(f.x + f.y * far + f.z * far * far, 1e-12f);
}

class TreeBuilder {
  public:
    TreeBuilder(std::vector<TreeLamp> lamps, LampTree& tree) : lamps_(std::move(lamps)), tree_(tree) {
        tree_.nodes.reserve(2 * lamps_.size());
        split(0, lamps_.size());
    }

  private:
    // In half at the middle lamp along the longest edge of their box.
    void split(std::size_t first, std::size_t end) {
        const std::size_t own = tree_.nodes.size();
        tree_.nodes.emplace_back();
        const auto firstSlot = static_cast<std::uint32_t>(tree_.slots.size());
        Aabb box;
        float power = 0, reach = 0;
        for (std::size_t i = first; i < end; ++i) {
            box.grow(lamps_[i].position);
            power += lamps_[i].power;
            reach = std::max(reach, lamps_[i].reach);
        }
        if (end - first == 1) {
            tree_.slots.insert(tree_.slots.end(), lamps_[first].slots, lamps_[first].number);
        } else {
            const glm::vec3 extent = box.extent();
            const int axis =
                extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
            const std::size_t middle = (first + end) / 2;
            const auto at = [&](std::size_t i) { return lamps_.begin() + static_cast<std::ptrdiff_t>(i); };
            std::nth_element(at(first), at(middle), at(end), [axis](const TreeLamp& a, const TreeLamp& b) {
                return std::tie(a.position[axis], a.number) < std::tie(b.position[axis], b.number);
            });
            split(first, middle);
            split(middle, end);
        }
        gpu::LampNode& node = tree_.nodes[own];
        node.center = box.center();
        node.radius2 = 0.25f * glm::dot(box.extent(), box.extent());
        node.power = power;
        node.reach = reach;
        node.next = static_cast<std::uint32_t>(tree_.nodes.size());
        node.firstSlot = firstSlot;
        node.slots = static_cast<std::uint32_t>(tree_.slots.size()) - firstSlot;
    }

    std::vector<TreeLamp> lamps_;
    LampTree& tree_;
};

}  // namespace

LampTree LampTree::over(std::span<gpu::Light> lamps) {
    Aabb box;
    for (const gpu::Light& light : lamps) box.grow(light.position);
    const float far = lamps.empty() ? 0 : std::max(0.5f * glm::length(box.extent()), 1e-3f);
    std::vector<TreeLamp> shining;
    float total = 0;
    for (std::size_t i = 0; i < lamps.size(); ++i) {
        const float power = powerOf(lamps[i], far);
        if (!(power > 0)) continue;
        shining.push_back({lamps[i].position, power, lamps[i].range > 0 ? lamps[i].range : kNoReach, 1,
                           static_cast<std::uint32_t>(i)});
        total += power;
    }
    LampTree tree;
    if (shining.empty()) return tree;
    const float perSlot = total / (kSlotsOfMean * static_cast<float>(shining.size()));
    for (TreeLamp& lamp : shining) {
        lamp.slots =
            static_cast<std::uint32_t>(std::clamp(std::round(lamp.power / perSlot), 1.0f, kMostSlots));
        lamps[lamp.number].sampleGrid = lamp.slots;
    }
    TreeBuilder(std::move(shining), tree);
    return tree;
}

void LampTable::update(const LampTree& tree) {
    *this = {};
    if (tree.nodes.empty()) return;
    nodes_ = gl::Buffer(tree.nodes, "lamp nodes");
    slots_ = gl::Buffer(tree.slots, "lamp slots");
    nodeTexels_ = gl::Texture(nodes_, GL_RGBA32UI, "lamp nodes");
    slotTexels_ = gl::Texture(slots_, GL_R32UI, "lamp slots");
}

void LampTable::declare(gl::Inputs& inputs) const {
    if (empty()) return;
    inputs.texture("lampNodes", nodeTexels_).texture("lampSlots", slotTexels_);
}

}  // namespace conelight::light
