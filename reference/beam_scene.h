// SPDX-License-Identifier: MIT
// A scene as the beam tracer sees it: flat polygons and lamps. Scene -> polygons in world space, in an order that can be
// walked from any point, and a point for each lamp; or a refusal of what beams cannot show.
//
// Neighbouring triangles of a mesh that make one flat convex quadrangle are one polygon.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "conelight/scene.h"
#include "reference/beam_order.h"
#include "reference/lights.h"
#include "reference/surface.h"

namespace conelight::reference {

struct BeamPolygon {
    Corners corners;
    BeamPlane plane;  // its normal is that of the front
    std::uint32_t instance = 0;
    std::array<std::uint32_t, 2> triangles{};
    int triangleCount = 0;  // 0: a rectangular lamp without triangles, which mirrors alone show
    bool twoSided = false, voxelized = true, castsShadow = true;
    bool unlit = false, mirror = false, textured = false;
    bool quadLamp = false;  // an emissive quad: what it sends is direct light
    glm::vec3 radiance{0};  // of a lamp without triangles
};

// A light, or one point of a rectangle.
struct BeamLamp {
    BeamApex apex;
    bool castsShadow = true;
    Light light;               // point, spot, directional; of a rectangle's point, where it is
    bool ofRectangle = false;  // light.intensity is then its radiance times the point's share of the area
    // What arrives at `from` when nothing is in the way; false when nothing does.
    bool sample(const glm::vec3& from, LightSample& result) const;
};

class BeamScene {
  public:
    static constexpr std::size_t kMostTriangles = 200000;

    // `quads`: flat emissive quads are lamps. `lampPoints`: rectangles become so many points along each side. `scene`
    // must outlive it. Throws Error(BadInput) that says what is in the way of beams.
    BeamScene(const Scene& scene, bool quads, int lampPoints);

    const Scene& scene() const { return scene_; }
    const std::vector<BeamPolygon>& polygons() const { return polygons_; }
    const std::vector<BeamLamp>& lamps() const { return lamps_; }
    const BeamOrder& order() const { return *order_; }
    double within() const { return within_; }  // lengths below are nothing, m

    // The hit of a ray on the polygon's plane; it may lie beside the polygon by rounding.
    RayHit hitOf(const BeamPolygon& polygon, const glm::dvec3& position, double t) const;

  private:
    void addInstance(std::size_t index);
    void addLamps(bool quads, int lampPoints);
    void addRectangle(const Light& light, int lampPoints, bool seenInMirrors);
    bool isMirrorAt(const BeamPolygon& polygon) const;
    void refuseCurved(const BeamPolygon& polygon) const;

    const Scene& scene_;
    double within_ = 0;
    std::vector<BeamPolygon> polygons_;
    std::vector<BeamLamp> lamps_;
    std::unique_ptr<BeamOrder> order_;
};

}  // namespace conelight::reference
