// SPDX-License-Identifier: MIT
// The order of polygons from any point: polygons -> a binary space partition (Fuchs, Kedem and Naylor 1980, "On Visible
// Surface Generation by A Priori Tree Structures"), walked from front to back.
//
// Planes that part the polygons are their own, or axis-parallel ones while there are many, which keeps the number of
// cuts low. Order of ties: that of the input, so that the same polygons give the same tree.
#pragma once

#include <cstdint>
#include <vector>

#include "reference/beam_polygon.h"

namespace conelight::reference {

// A part of a polygon, as the partition has cut it.
struct OrderedPart {
    Corners corners;
    std::uint32_t polygon = 0;
};

class BeamOrder {
  public:
    // `within`: corners closer to a plane lie on it, m.
    BeamOrder(std::vector<OrderedPart> parts, double within);

    // All parts, nearest first: no part hides one that came before it. Whole branches are left out whose box `enters`
    // refuses.
    class Visitor {
      public:
        virtual ~Visitor() = default;
        virtual bool enters(const BeamBox& box) = 0;
        virtual void visit(const OrderedPart& part) = 0;
    };
    void walk(const BeamApex& apex, Visitor& visitor) const { walk(root_, apex, visitor); }
    std::size_t partCount() const { return partCount_; }

  private:
    struct Node {
        BeamPlane plane;
        BeamBox box;  // of all below
        int front = -1, back = -1;
        std::vector<OrderedPart> parts;  // on the plane
    };
    int build(std::vector<OrderedPart> parts);
    bool choosePlane(const std::vector<OrderedPart>& parts, BeamPlane& plane) const;
    void walk(int node, const BeamApex& apex, Visitor& visitor) const;

    double within_;
    int root_ = -1;
    std::size_t partCount_ = 0;
    std::vector<Node> nodes_;
};

}  // namespace conelight::reference
