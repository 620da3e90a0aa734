// SPDX-License-Identifier: MIT
#include "reference/beam_cover.h"

#include <cmath>
#include <utility>

namespace conelight::reference {

BeamCover::BeamCover(const BeamApex& apex, std::vector<BeamPlane> window, double within)
    : apex_(apex), path_(std::move(window)), within_(within) {}

void BeamCover::add(const Corners& polygon, bool blocks, std::vector<Corners>& free) {
    blocks_ = blocks;
    insert(root_, polygon, free, root_);
}

// An edge that an ancestor's plane already cuts along needs no plane of its own. Parallel rays also see edges on the near
// plane, which is no side.
bool BeamCover::isSide(const glm::dvec3& a, const glm::dvec3& b) const {
    constexpr double kAcross = 1e-6;  // cosine
    for (const BeamPlane& plane : path_)
        if (apex_.parallel && std::fabs(apex_.side(plane)) > kAcross)
            continue;
        else if (std::fabs(plane.at(a)) <= 2 * within_ && std::fabs(plane.at(b)) <= 2 * within_)
            return true;
    return false;
}

// A tree for a free leaf that the polygon falls into: outside of each of its edges all stays free.
int BeamCover::covered(const Corners& polygon) {
    const glm::dvec3 middle = centroidOf(polygon);
    int tree = kCovered;
    for (std::size_t i = polygon.size(); i-- > 0;) {
        const glm::dvec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        BeamPlane plane;
        if (isSide(a, b) || !planeThrough(apex_, {a, b}, middle, plane)) continue;
        nodes_.push_back({plane, tree, kFree});
        tree = static_cast<int>(nodes_.size()) - 1;
    }
    return tree;
}

// Whether all of the polygon was free; `changed`: the tree that stands in the old one's place.
bool BeamCover::insert(int tree, const Corners& polygon, std::vector<Corners>& free, int& changed) {
    if (tree == kCovered) return false;
    if (tree == kFree) {
        free.push_back(polygon);
        if (blocks_) changed = covered(polygon);
        return true;
    }
    const auto index = static_cast<std::size_t>(tree);
    const BeamPlane plane = nodes_[index].plane;
    int inside = nodes_[index].inside, outside = nodes_[index].outside;
    const std::size_t before = free.size();
    path_.push_back(plane);
    bool whole = true;
    switch (sideOf(polygon, plane, within_)) {
        case Side::Front:
            whole = insert(inside, polygon, free, inside);
            break;
        case Side::Back:
            whole = insert(outside, polygon, free, outside);
            break;
        case Side::Both: {
            const CutPolygon halves = cut(polygon, plane, within_);
            if (halves.front.size() >= 3) whole = insert(inside, halves.front, free, inside);
            if (halves.back.size() >= 3) whole = insert(outside, halves.back, free, outside) && whole;
            break;
        }
        case Side::On:  // seen edge-on
            break;
    }
    path_.pop_back();
    if (whole && free.size() > before + 1) {
        free.resize(before);
        free.push_back(polygon);
    }
    nodes_[index].inside = inside;
    nodes_[index].outside = outside;
    if (inside == kCovered && outside == kCovered) changed = kCovered;
    return whole;
}

}  // namespace conelight::reference
