// SPDX-License-Identifier: MIT
// The triangles of glass, as a value: GpuScene -> a bounding volume hierarchy in world space, for rays that are
// to meet every one of them (lib/glass_tree.glsl). Glass is in no voxel and in no shadow map: light goes through
// it, and it is drawn in front of a finished picture. Blended surfaces may be in the tree as well ("veils"): they hide
// their part of the light of lamps, in the place of shadow maps.
#pragma once

#include <vector>

#include "base/revision.h"
#include "gl/buffer.h"
#include "gl/inputs.h"
#include "gl/texture.h"
#include "scene/gpu_scene.h"
#include "shared/glass.h"

namespace conelight::scene {

// A closed surface of glass that bends light, or a smooth pane, which mirrors it.
struct GlassSolid {
    glm::vec3 middle;
    float radius;  // of a ball about the middle that holds it
    std::uint32_t instance;
    bool isPane;
    bool operator==(const GlassSolid&) const = default;
};

class GlassTree {
  public:
    // Made anew when an instance of glass has changed, on the CPU; returns at once otherwise. `veils`: with blended
    // surfaces, for the light of lamps.
    void update(const GpuScene& scene, bool veils);
    bool empty() const { return nodes_ == 0; }
    bool holdsGlass() const { return holdsGlass_; }  // not veils alone
    // In the order of their numbers (gpu::GlassTriangle::solid); panes are the last.
    const std::vector<GlassSolid>& solids() const { return solids_; }

    void declare(gl::Inputs& inputs) const;  // glassNodes, glassTriangles; nothing when empty

  private:
    base::Revision scene_, geometry_;
    std::vector<base::Revision> from_;  // of the instances
    std::vector<GlassSolid> solids_;
    gl::Buffer nodeBuffer_, triangleBuffer_;
    gl::Texture nodeTexture_, triangleTexture_;  // read them
    std::uint32_t nodes_ = 0;
    bool veils_ = false, holdsGlass_ = false;
};

// Whether there are veils, and few enough for the tree.
bool hasVeils(const GpuScene& scene);

// Sorts `triangles` into leaves, and returns the nodes over them: splits by the surface area heuristic over
// bins (Wald 2007, "On fast Construction of SAH-based Bounding Volume Hierarchies").
std::vector<gpu::GlassNode> sortIntoTree(std::vector<gpu::GlassTriangle>& triangles);

}  // namespace conelight::scene
