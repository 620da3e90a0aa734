// SPDX-License-Identifier: MIT
// A binary tree over many lamps, from which one is drawn by about what it gives at a surface. Boxes and powers of lamps
// -> tree; a place and a number -> a lamp and the probability of that choice.
//
// From the root down a child is chosen in proportion to power over squared distance, times the largest cosine that its
// bounding sphere has with the normal (Conty Estevez and Kulla 2018, "Importance Sampling of Many Lights with Adaptive
// Tree Splitting", without cones of emission). A choice costs the logarithm of the number of lamps.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "conelight/scene.h"

namespace conelight::reference {

class LightTree {
  public:
    struct Lamp {
        Aabb box;
        float power = 0;  // above 0
        std::uint32_t number = 0;
    };
    explicit LightTree(std::vector<Lamp> lamps = {});
    bool empty() const { return nodes_.empty(); }

    // A normal of 0: light counts from all sides.
    struct Place {
        glm::vec3 position{0}, normal{0};
    };
    struct Drawn {
        std::uint32_t number = 0;
        float probability = 0;
    };
    // The lamp that a number in [0,1) stands for.
    Drawn draw(const Place& place, float number) const;
    // Of drawing this lamp; 0 for one that is not in the tree.
    float probability(const Place& place, std::uint32_t number) const;

  private:
    struct Node {
        glm::vec3 center{0};
        float radius2 = 0;  // of a sphere around its lamps, squared
        float power = 0;
        std::uint32_t parent = 0, child = 0;  // the first of two; 0: a lamp
        std::uint32_t number = 0;
    };
    void split(std::vector<Lamp>& lamps, std::uint32_t node, std::size_t first, std::size_t end);
    float firstShare(const Place& place, const Node& node) const;

    std::vector<Node> nodes_;            // the root first
    std::vector<std::uint32_t> leafOf_;  // by number
};

}  // namespace conelight::reference
