// SPDX-License-Identifier: MIT
// A scene with its voxels, shadow maps and irradiance cache, without the renderer: what tests of the cache
// start from.
#pragma once

#include <functional>
#include <vector>

#include "conelight/scene.h"
#include "conelight/settings.h"
#include "gl/device.h"
#include "light/emission_fit.h"
#include "light/irradiance_cache.h"
#include "light/lights.h"
#include "light/lit_faces.h"
#include "scene/gpu_scene.h"
#include "voxels/voxels.h"

namespace conelight::test {

// One face of the cache, unpacked.
struct CachedFace {
    glm::vec3 position;  // world, in the middle of what the face holds
    glm::vec3 normal;
    glm::vec3 albedo;
    glm::vec3 radiance;    // emission and reflected direct light
    glm::vec3 irradiance;  // indirect, over pi
    glm::vec3 atPixels;    // the same, as pixels see it
    float area;            // m^2
    bool dead;
};

struct CacheRig {
    CacheRig(gl::ProgramLibrary& programs, const Scene& scene, int voxels);

    // As a frame does: after a change of geometry; of light; updates.
    void voxelize();
    void relight();
    void update(int passes);

    std::vector<CachedFace> faces() const;
    // Mean of f over the area of all faces that are not dead and for which `counts` holds.
    double mean(const std::function<double(const CachedFace&)>& f,
                const std::function<bool(const CachedFace&)>& counts = {}) const;
    double meanIrradiance() const;

    gl::Profiler profiler;
    gl::Device device;
    LightSettings light;
    VoxelSettings voxelSettings;
    light::CacheSettings settings;
    scene::GpuScene scene;
    light::Lights lights;
    voxels::Voxels voxels;
    const voxels::SurfaceVoxels& surface;  // of `voxels`
    light::LitFaces lit;
    gl::Buffer directLight;  // a uint per face, as light::RayLight
    gl::Texture directTexels;
    light::EmissionFit fit;
    light::IrradianceCache cache;
};

}  // namespace conelight::test
