// SPDX-License-Identifier: MIT
#include "reference/beam_order.h"

#include <algorithm>
#include <utility>

namespace conelight::reference {
namespace {

// Fewer polygons than this are parted by their own planes alone.
constexpr std::size_t kFew = 12;
// Own planes that are tried, spread over the polygons.
constexpr std::size_t kTried = 8;
// A cut costs as much as a tree that is out of balance by so many polygons. Chosen by trial on builtin:clutter.
constexpr std::size_t kCutCost = 4;
// An axis-parallel plane must leave at most this part of the polygons on either side, or it parts nothing.
constexpr double kMostOnOneSide = 0.8;

struct Split {
    std::size_t front = 0, back = 0, both = 0;
    std::size_t cost() const { return (front > back ? front - back : back - front) + kCutCost * both; }
};

Split splitBy(const std::vector<OrderedPart>& parts, const BeamPlane& plane, double within) {
    Split split;
    for (const OrderedPart& part : parts) {
        const Side side = sideOf(part.corners, plane, within);
        split.front += side == Side::Front ? 1 : 0;
        split.back += side == Side::Back ? 1 : 0;
        split.both += side == Side::Both ? 1 : 0;
    }
    return split;
}

double medianAlong(const std::vector<OrderedPart>& parts, glm::dvec3::length_type axis) {
    std::vector<double> places;
    places.reserve(parts.size());
    for (const OrderedPart& part : parts) places.push_back(centroidOf(part.corners)[axis]);
    const auto middle = places.begin() + static_cast<std::ptrdiff_t>(places.size() / 2);
    std::nth_element(places.begin(), middle, places.end());
    return *middle;
}

}  // namespace

BeamOrder::BeamOrder(std::vector<OrderedPart> parts, double within) : within_(within) {
    root_ = build(std::move(parts));
}

// False when no polygon has a plane.
bool BeamOrder::choosePlane(const std::vector<OrderedPart>& parts, BeamPlane& plane) const {
    bool found = false;
    std::size_t least = 0;
    const auto offer = [&](const BeamPlane& candidate, std::size_t cost) {
        if (found && cost >= least) return;
        found = true;
        least = cost;
        plane = candidate;
    };
    const std::size_t step = std::max<std::size_t>(parts.size() / kTried, 1);
    for (std::size_t i = 0; i < parts.size(); i += step) {
        BeamPlane own;
        if (planeOf(parts[i].corners, own)) offer(own, splitBy(parts, own, within_).cost());
    }
    if (parts.size() < kFew) return found;
    for (glm::dvec3::length_type axis = 0; axis < 3; ++axis) {
        BeamPlane across;
        across.normal[axis] = 1;
        across.offset = medianAlong(parts, axis);
        const Split split = splitBy(parts, across, within_);
        const double most = kMostOnOneSide * static_cast<double>(parts.size());
        if (static_cast<double>(std::max(split.front, split.back) + split.both) < most)
            offer(across, split.cost());
    }
    return found;
}

int BeamOrder::build(std::vector<OrderedPart> parts) {
    BeamPlane plane;
    if (parts.empty() || !choosePlane(parts, plane)) return -1;
    const int index = static_cast<int>(nodes_.size());
    nodes_.emplace_back();
    BeamBox box;
    std::vector<OrderedPart> front, back, on;
    for (OrderedPart& part : parts) {
        box.grow(part.corners);
        switch (sideOf(part.corners, plane, within_)) {
            case Side::Front:
                front.push_back(std::move(part));
                break;
            case Side::Back:
                back.push_back(std::move(part));
                break;
            case Side::On:
                on.push_back(std::move(part));
                break;
            case Side::Both: {
                CutPolygon halves = cut(part.corners, plane, within_);
                if (halves.front.size() >= 3) front.push_back({std::move(halves.front), part.polygon});
                if (halves.back.size() >= 3) back.push_back({std::move(halves.back), part.polygon});
                break;
            }
        }
    }
    parts.clear();
    parts.shrink_to_fit();
    partCount_ += on.size();
    const int inFront = build(std::move(front)), behind = build(std::move(back));
    Node& node = nodes_[static_cast<std::size_t>(index)];
    node = {plane, box, inFront, behind, std::move(on)};
    return index;
}

void BeamOrder::walk(int index, const BeamApex& apex, Visitor& visitor) const {
    if (index < 0) return;
    const Node& node = nodes_[static_cast<std::size_t>(index)];
    if (!visitor.enters(node.box)) return;
    const bool inFront = apex.side(node.plane) > 0;
    walk(inFront ? node.front : node.back, apex, visitor);
    for (const OrderedPart& part : node.parts) visitor.visit(part);
    walk(inFront ? node.back : node.front, apex, visitor);
}

}  // namespace conelight::reference
