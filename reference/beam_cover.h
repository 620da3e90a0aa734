// SPDX-License-Identifier: MIT
// How much of a beam is covered: a binary tree of planes through the beam's apex whose leaves are free or covered (the
// shadow volume BSP tree of Chin and Feiner 1989, "Near Real-Time Shadow Generation Using BSP Trees"). Polygons are
// added from front to back; what of them falls into free leaves is seen, wholly.
#pragma once

#include <vector>

#include "reference/beam_polygon.h"

namespace conelight::reference {

class BeamCover {
  public:
    // `within`: corners closer to a plane lie on it, m. All polygons lie in front of the planes of `window`.
    BeamCover(const BeamApex& apex, std::vector<BeamPlane> window, double within);

    // Appends the parts of a convex polygon that nothing covers: the whole of it as one where all is free. They are
    // covered from then on if it `blocks`.
    void add(const Corners& polygon, bool blocks, std::vector<Corners>& free);
    bool full() const { return root_ == kCovered; }

  private:
    static constexpr int kFree = -1, kCovered = -2;
    struct Node {
        BeamPlane plane;
        int inside = kFree, outside = kFree;  // in front of the plane, behind it
    };
    bool insert(int tree, const Corners& polygon, std::vector<Corners>& free, int& changed);
    int covered(const Corners& polygon);
    bool isSide(const glm::dvec3& a, const glm::dvec3& b) const;

    BeamApex apex_;
    std::vector<BeamPlane> path_;  // planes above the leaf at hand, and those of the window
    double within_;
    bool blocks_ = false;
    int root_ = kFree;
    std::vector<Node> nodes_;
};

}  // namespace conelight::reference
