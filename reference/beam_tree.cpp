// SPDX-License-Identifier: MIT
#include "reference/beam_tree.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/log.h"
#include "reference/beam_cover.h"
#include "reference/materials.h"

namespace conelight::reference {
namespace {

// Corners of beams' parts are computed, not given: what is nothing there is a thousandth of what it is in the scene.
constexpr double kFiner = 1e-3;
constexpr std::size_t kMostBeams = 20000;

enum class Ends { Eye, Mirror, Lamp };  // what the beam comes from

// One beam through the scene.
class Sweep : public BeamOrder::Visitor {
  public:
    Sweep(const BeamScene& scene, Ends from, const BeamApex& apex, std::vector<BeamPlane> window)
        : scene_(scene),
          from_(from),
          apex_(apex),
          window_(std::move(window)),
          within_(kFiner * scene.within()),
          cover_(apex, window_, within_) {
        scene.order().walk(apex, *this);
    }

    bool enters(const BeamBox& box) override {
        if (cover_.full()) return false;
        return std::all_of(window_.begin(), window_.end(),
                           [&](const BeamPlane& plane) { return box.most(plane) > 0; });
    }
    void visit(const OrderedPart& part) override;
    // What is left of a polygon on which the window lies.
    void addBackground(const Corners& window) {
        std::vector<Corners> free;
        cover_.add(window, false, free);
        for (Corners& corners : free) parts.push_back({kNoPolygon, std::move(corners)});
    }

    std::vector<BeamPart> parts;

  private:
    bool meets(const BeamPolygon& polygon, bool& blocks) const;

    const BeamScene& scene_;
    Ends from_;
    BeamApex apex_;
    std::vector<BeamPlane> window_;
    double within_;
    BeamCover cover_;
};

// The rules of rays (RayKind); lamps without triangles are seen in mirrors, from their front, and hide nothing.
bool Sweep::meets(const BeamPolygon& polygon, bool& blocks) const {
    const double side = apex_.side(polygon.plane);
    if (std::fabs(side) <= (apex_.parallel ? kFiner * kFiner : within_)) return false;  // seen edge-on
    blocks = polygon.triangleCount > 0;
    switch (from_) {
        case Ends::Eye:
            return blocks && (side > 0 || polygon.twoSided);
        case Ends::Mirror:
            return blocks ? polygon.voxelized : side > 0;
        case Ends::Lamp:
            if (!blocks) return false;
            blocks = polygon.castsShadow;
            return true;
    }
    return false;
}

void Sweep::visit(const OrderedPart& part) {
    bool blocks = true;
    if (!meets(scene_.polygons()[part.polygon], blocks)) return;
    Corners corners = part.corners;
    for (const BeamPlane& plane : window_)
        if (!keepFront(corners, plane, within_)) return;
    std::vector<Corners> free;
    cover_.add(corners, blocks, free);
    for (Corners& seen : free) parts.push_back({part.polygon, std::move(seen)});
}

glm::dmat4 reflection(const BeamPlane& mirror) {
    glm::dmat4 matrix(1);
    for (glm::dmat4::length_type column = 0; column < 3; ++column)
        for (glm::dmat4::length_type row = 0; row < 3; ++row)
            matrix[column][row] -= 2 * mirror.normal[column] * mirror.normal[row];
    matrix[3] = glm::dvec4(2 * mirror.offset * mirror.normal, 1);
    return matrix;
}

// The most that a mirror's part returns towards the beam's apex: at its corners and in its middle.
double mirrorShare(const BeamScene& scene, const BeamApex& apex, const BeamPart& part) {
    const BeamPolygon& polygon = scene.polygons()[part.polygon];
    Corners places = part.corners;
    places.push_back(centroidOf(part.corners));
    double most = 0;
    for (const glm::dvec3& place : places) {
        Ray ray;
        ray.direction = glm::vec3(apex.parallel ? -apex.place : glm::normalize(place - apex.place));
        const Surface surface = surfaceAt(scene.scene(), ray, scene.hitOf(polygon, place, 1));
        const glm::vec3 share = Reflection(surface, -ray.direction).mirrorShare();
        most = std::max(most, static_cast<double>(std::max({share.r, share.g, share.b})));
    }
    return most;
}

class Tree {
  public:
    Tree(const BeamScene& scene, const BeamTreeSettings& settings) : scene_(scene), settings_(settings) {}

    BeamTree make(const Lens& lens, const std::function<bool()>& goesOn) {
        tree_.beams.push_back(eye(lens));
        std::vector<BeamPlane> window = sidesOf(tree_.beams[0].apex, tree_.beams[0].window);
        window.push_back({lens.forward, glm::dot(lens.forward, lens.eye) + lens.zNear});
        window.push_back({-lens.forward, -glm::dot(lens.forward, lens.eye) - lens.zFar});
        sweep(0, Ends::Eye, std::move(window));
        for (std::size_t i = 1; i < tree_.beams.size(); ++i) {
            if (goesOn && !goesOn()) break;
            window = sidesOf(tree_.beams[i].apex, tree_.beams[i].window);
            window.push_back(facing(tree_.beams[i]));
            sweep(i, Ends::Mirror, std::move(window));
        }
        return std::move(tree_);
    }

  private:
    static Beam eye(const Lens& lens) {
        Beam beam;
        beam.apex = {lens.parallel ? -lens.forward : lens.eye, lens.parallel};
        const glm::dvec3 middle = lens.eye + lens.forward * lens.zNear;
        const double size = lens.parallel ? 1 : lens.zNear;
        for (const glm::dvec2 corner : {glm::dvec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
            beam.window.push_back(middle + size * (corner.x * lens.right + corner.y * lens.up));
        return beam;
    }

    // The mirror's plane, what it mirrors in front.
    BeamPlane facing(const Beam& beam) const {
        const BeamPlane& plane = scene_.polygons()[beam.mirror].plane;
        return beam.apex.side(plane) > 0 ? BeamPlane{-plane.normal, -plane.offset} : plane;
    }

    void sweep(std::size_t index, Ends from, std::vector<BeamPlane> window) {
        Sweep sweep(scene_, from, tree_.beams[index].apex, std::move(window));
        if (settings_.background) sweep.addBackground(tree_.beams[index].window);
        tree_.beams[index].parts = std::move(sweep.parts);
        for (std::size_t p = 0; p < tree_.beams[index].parts.size(); ++p) follow(index, p);
    }

    void follow(std::size_t index, std::size_t partIndex) {
        const Beam& from = tree_.beams[index];
        const BeamPart& part = from.parts[partIndex];
        if (part.polygon == kNoPolygon || from.depth >= settings_.mostMirrors) return;
        const BeamPolygon& polygon = scene_.polygons()[part.polygon];
        if (!polygon.mirror || (!polygon.twoSided && from.apex.side(polygon.plane) < 0)) return;
        const double share = from.share * mirrorShare(scene_, from.apex, part);
        if (share < settings_.leastShare) return;
        if (tree_.beams.size() >= kMostBeams)
            base::fail(ErrorKind::BadInput,
                       "mode beams: the mirrors make more than %zu beams; fewer mirrors, or --bounces with a "
                       "smaller "
                       "number, would be right",
                       kMostBeams);
        Beam beam;
        beam.parent = static_cast<int>(index);
        beam.parentPart = static_cast<int>(partIndex);
        beam.depth = from.depth + 1;
        beam.mirror = part.polygon;
        beam.apex = reflected(from.apex, polygon.plane);
        beam.unfolded = from.unfolded * reflection(polygon.plane);
        beam.share = share;
        beam.window = part.corners;
        tree_.beams[index].parts[partIndex].child = static_cast<int>(tree_.beams.size());
        tree_.beams.push_back(std::move(beam));
    }

    const BeamScene& scene_;
    BeamTreeSettings settings_;
    BeamTree tree_;
};

}  // namespace

std::size_t BeamTree::partCount() const {
    std::size_t count = 0;
    for (const Beam& beam : beams) count += beam.parts.size();
    return count;
}

BeamTree beamTree(const BeamScene& scene, const Lens& lens, const BeamTreeSettings& settings,
                  const std::function<bool()>& goesOn) {
    return Tree(scene, settings).make(lens, goesOn);
}

LitParts litParts(const BeamScene& scene, const BeamLamp& lamp) {
    Sweep sweep(scene, Ends::Lamp, lamp.apex, {});
    LitParts lit(scene.polygons().size());
    for (BeamPart& part : sweep.parts) lit[part.polygon].push_back(std::move(part.corners));
    return lit;
}

}  // namespace conelight::reference
