// SPDX-License-Identifier: MIT
// Shadow maps of all lights: GpuScene -> one array of depth textures, and the light table's shadow fields.
// Point lights have six maps (the sides of a cube), spots and directional lights one, rectangles five per
// sample point (the sides of half a cube). All are tiles of one array texture, so that shaders need one
// sampler and one way of filtering; shaders/lib/shadow.glsl documents tiles, depths and what hides what, and
// is the other half of this file. Maps other than rectangles' keep slopes and extents of triangles too.
//
// Each map is one pass over the instances that its frustum meets: measured on llvmpipe, six culled passes
// cost no more than one layered pass, and they need no extension.
//
// Reads: scene tables. Writes: the textures at UNIT_SHADOW, _DEPTHS, _SURFACES. Both sides of every surface
// cast shadows.
#pragma once

#include <memory>

#include "conelight/settings.h"
#include "gl/pass.h"
#include "gl/program.h"
#include "scene/gpu_scene.h"

namespace conelight::light {

class ShadowMaps {
  public:
    ShadowMaps();
    ~ShadowMaps();

    // Brings the maps up to date: draws those of lights that changed, and those that see an instance that
    // changed, where it was or where it is; with `everything` all. The depths are the same bit for bit.
    // Updates `scene`'s light table (GpuScene::updateLights). The scene must be bound.
    void update(gl::ProgramLibrary& programs, gl::Profiler& profiler, scene::GpuScene& scene,
                const LightSettings& settings, bool everything = false);
    int redrawn() const;  // maps that the last update drew
    // UNIT_SHADOW, _DEPTHS, _SURFACES; before the first update a map without shadows.
    void bind() const;

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// Defines for shaders that include lib/lights.glsl: how many lights of each kind the scene has (or whether
// any, when they are many), the filter radius, whether there are shadows at all.
gl::Defines lightDefines(const scene::GpuScene& scene, const LightSettings& settings);

// `base` with lightDefines' defines added, for a programDescs(): every kind of light alone and all together,
// every filter radius, and without shadows. Other combinations are made of the same code.
std::vector<gl::ProgramDesc> lightVariants(const gl::ProgramDesc& base);

}  // namespace conelight::light
