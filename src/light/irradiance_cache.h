// SPDX-License-Identifier: MIT
// Indirect light per voxel face, kept in world space over frames: rays from each face gather what other faces
// show, their own cached light included, so that every update adds a bounce. Estimator and schedule:
// docs/theory/4_gather.md, "The cache".
//
// Order of calls in a frame:
//   voxels changed:  beforeVoxelize, SurfaceVoxels::build, OctantWords::build, afterVoxelize, injectLight
//   light changed:   injectLight, lightChanged
//   always:          update, bind
// Reads: octWord, brickWord, voxRec, face, faceSource, steadyLight. Writes: irradiance of face, brightFaces.
// The same calls give the same bits: rays read the light of the update before, and all sums have an order.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "gl/buffer.h"
#include "gl/pass.h"
#include "gl/program.h"
#include "scene/gpu_scene.h"
#include "voxels/octant_words.h"
#include "voxels/surface_voxels.h"

namespace conelight::light {

struct CacheSettings {
    int cosineRays = 2;  // per face and update, to directions by the cosine; 1..64
    int lightRays = 2;   // per face and update, to bright faces; 0..64
    // Faces that one update visits at most, in turn; 0: all. Rays per frame are this times the rays per face.
    std::uint32_t facesPerUpdate = 0;
    int longestWindow = 256;  // updates that are averaged in the end
    bool averages = true;     // false: every update replaces what was there, for a limited number of bounces
    int reflections = 1;      // of one ray on metals; then all but lights is reflected as if matt; 0..8
    bool exactDirect = true;  // light of point, spot and directional lights is looked up where rays hit
    std::uint32_t seed = 1;
};

class IrradianceCache {
  public:
    IrradianceCache();
    ~IrradianceCache();
    IrradianceCache(IrradianceCache&&) noexcept;
    IrradianceCache& operator=(IrradianceCache&&) noexcept;

    // Forgets everything: the next afterVoxelize starts in the dark.
    void reset();
    // Before voxels are built anew: remembers whose light is whose. Nothing before the first build.
    void beforeVoxelize(gl::Profiler& profiler, const voxels::SurfaceVoxels& surface);
    // After: the order in which updates visit faces goes to SurfaceVoxels::faceScratch; injectLight, which
    // must follow, puts steady light (shared/irradiance.h) into secondFaceScratch. Each face takes over the
    // light of the face that lay there and looked the same way. Counts as a change of light, too.
    void afterVoxelize(gl::ProgramLibrary& programs, gl::Profiler& profiler,
                       const voxels::SurfaceVoxels& surface);
    // Direct light, emission or the sky changed: short averages again, until bounces have settled.
    void lightChanged();

    // Visits faces `passes` times over (facesPerUpdate each). The scene, the frame block, shadow maps,
    // `surface` and `octants` must be bound. GL state changed: program, storage slots of passes,
    // BINDING_PASS.
    void update(gl::ProgramLibrary& programs, gl::Profiler& profiler, const scene::GpuScene& scene,
                const LightSettings& light, const voxels::SurfaceVoxels& surface,
                const CacheSettings& settings, int passes = 1);

    // Whether bounces have settled since the last change, so that all further updates only average noise
    // away.
    bool settled() const;
    int updates() const;  // whole rounds over all faces since the last change

    // What lib/voxel_light.glsl needs besides SurfaceVoxels::bind and OctantWords::bind.
    void bind() const;
    const gl::Buffer& state() const;  // gpu::FaceCache per face, for tests

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// Defines of shaders that include lib/voxel_light.glsl: LOBES, EXACT_DIRECT and which lights are looked up at
// hits.
// Off where a scene has none to look up, or more than pays (kMostExactLights).
gl::Defines hitLightDefines(const scene::GpuScene& scene, const LightSettings& settings, bool exactDirect);
// Most that a ray may bring by reflections on metal, over what the metal shows if matt, when a mean is of so
// many rays: a single ray then moves the mean by no more than what the metal would show if matt.
float reflectedLimit(int rays);
// `base` with these defines, for a programDescs().
std::vector<gl::ProgramDesc> hitLightVariants(const gl::ProgramDesc& base);

}  // namespace conelight::light
