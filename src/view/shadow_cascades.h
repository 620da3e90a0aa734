// SPDX-License-Identifier: MIT
// Shadow maps of directional lights about the eye: scene, lights, eye -> an array of depth textures. Where one map of
// the whole scene has coarse texels, pixels are lit by maps of 2, 4, 8 ... metres to either side of the eye instead,
// and of the whole scene at last. lib/shadow_cascades.glsl is the other half; docs/theory/3_light.md, "From a metre to
// kilometres". Losasso and Hoppe, Geometry Clipmaps (2004), nest squares about the eye so.
//
// What the eye does changes none of light::Lights: cache, cones and rays read the maps of the whole scene.
#pragma once

#include <vector>

#include "base/revision.h"
#include "conelight/settings.h"
#include "gl/buffer.h"
#include "gl/device.h"
#include "light/lights.h"
#include "light/shadow_maps.h"
#include "scene/gpu_scene.h"
#include "shared/shadow_cascades.h"

namespace conelight::view {

// What is within 2 m of the eye has the finest level, each next one reaches `ratio` times as far.
struct CascadeLevels {
    int count = 0;  // with that of the whole scene; 0: its map alone
    int ratio = 2;
    int size = 0;   // texels per edge of a map
    int asked = 0;  // levels, were there memory for all
};

// For a scene whose maps are to reach `half` metres to either side of its middle, of settings and `lights` that cast
// shadows, within so many bytes.
CascadeLevels cascadeLevels(float half, const LightSettings& settings, int lights, std::size_t bytes);

class ShadowCascades {
  public:
    // Brings the maps up to date: draws those that see something that changed, and those whose place is another, which
    // moves by a sixteenth of its edge. GL state changed: as light::ShadowMaps::update.
    void update(const gl::Device& device, const scene::GpuScene& scene, const light::Lights& lights,
                const LightSettings& settings, const glm::vec3& eye);
    void clear();
    int levels() const { return levels_.count; }  // 0: there are none; pixels look into the lights' own maps
    int redrawn() const { return redrawn_; }      // maps that the last update drew

    // CascadeTable, cascadeDepths, cascadeSurfaces. Precondition: there are levels.
    void declare(gl::Inputs& inputs) const;

  private:
    struct Sources {
        base::Revision scene, geometry, lights;
        LightSettings settings;
        bool operator==(const Sources&) const = default;
    };
    void upload(const glm::vec3& eye, const std::vector<gpu::Cascade>& cascades);

    CascadeLevels levels_;
    light::ShadowMaps maps_;
    gl::Buffer table_;
    Sources from_;
    std::vector<glm::vec3> places_;  // of the maps drawn
    int redrawn_ = 0;
};

}  // namespace conelight::view
