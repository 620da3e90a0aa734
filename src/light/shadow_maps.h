// SPDX-License-Identifier: MIT
// Shadow maps of all lights: scene + light table -> one array of depth textures, and the table's shadow
// fields. Point lights have six maps (the sides of a cube), spots and directional lights one, rectangles five
// per sample point (the sides of half a cube). All are tiles of one array texture, so that shaders need one
// sampler and one way of filtering (light/shadow_layout.h). Maps other than rectangles' keep slopes and
// extents of triangles too. Both sides of every surface cast shadows.
//
// Each map is one pass over the instances that its frustum meets: measured on llvmpipe, six culled passes
// cost no more than one layered pass, and they need no extension. Part of light::Lights.
#pragma once

#include <memory>
#include <vector>

#include "base/steps.h"
#include "conelight/settings.h"
#include "gl/device.h"
#include "light/shadow_layout.h"
#include "scene/gpu_scene.h"

namespace conelight::light {

class ShadowMaps {
  public:
    ShadowMaps();
    ~ShadowMaps();
    ShadowMaps(ShadowMaps&&) noexcept;
    ShadowMaps& operator=(ShadowMaps&&) noexcept;

    // Brings the maps up to date: draws those of lights that changed, and those that see an instance that
    // changed, where it was or where it is. The depths are the same bit for bit as if all were drawn. GL
    // state changed: raster state, program and its slots, vertex array, texture units of materials.
    base::Steps updateInSteps(const gl::Device& device, const scene::GpuScene& scene,
                              const LightSettings& settings, bool leavesVeils,
                              std::vector<gpu::Light>& lights);
    // The same for maps that lie as `layout` says; `name` is that of the pass.
    base::Steps drawInSteps(const gl::Device& device, const scene::GpuScene& scene, ShadowLayout layout,
                            const char* name);
    int redrawn() const;       // maps that the last update drew
    bool leavesVeils() const;  // ShadowLayout::leavesVeils of the last update
    // shadowMaps, shadowDepths, shadowSurfaces; before the first update maps without shadows.
    void declare(gl::Inputs& inputs) const;
    void declareAs(gl::Inputs& inputs, gl::ResourceName depths, gl::ResourceName surfaces) const;
    std::size_t bytes() const;

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace conelight::light
