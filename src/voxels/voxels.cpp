// SPDX-License-Identifier: MIT
#include "voxels/voxels.h"

namespace conelight::voxels {

base::Steps Voxels::updateInSteps(const gl::Device& device, const scene::GpuScene& scene,
                                  VoxelSettings settings, Rays rays) {
    if (!areOf(scene, settings))
        co_await surface_.updateInSteps(device, scene, SurfaceVoxels::gridOf(scene, settings));
    remember(scene, settings);
    co_await makeOctants(device, rays);
}

base::Steps Voxels::updateInSteps(VoxelGrid grid, const gl::Device& device, const scene::GpuScene& scene,
                                  VoxelSettings settings, Rays rays, Scroll scroll) {
    const bool same = surface_.revision() && surface_.grid() == grid && !surface_.hasScrolled();
    if (!areIn(grid, scene, scroll)) {
        if (same || scroll == Scroll::Yes)
            co_await surface_.updateInSteps(device, scene, grid);
        else
            co_await surface_.buildInSteps(device, scene, grid);
    }
    remember(scene, settings);
    co_await makeOctants(device, rays);
}

void Voxels::build(const gl::Device& device, const scene::GpuScene& scene, const VoxelSettings& settings,
                   Rays rays) {
    surface_.build(device, scene, settings);
    remember(scene, settings);
    makeOctants(device, rays).finish();
}

bool Voxels::areOf(const scene::GpuScene& scene, const VoxelSettings& settings) const {
    return revision() && grid().levels == 1 && scene_ == scene.identity() &&
           geometry_ == scene.geometryRevision() && settings_ == withoutAnchor(settings);
}

bool Voxels::areIn(const VoxelGrid& grid, const scene::GpuScene& scene, Scroll scroll) const {
    return revision() && scene_ == scene.identity() && geometry_ == scene.geometryRevision() &&
           this->grid() == grid && (scroll == Scroll::Yes || !surface_.hasScrolled());
}

void Voxels::remember(const scene::GpuScene& scene, const VoxelSettings& settings) {
    scene_ = scene.identity();
    geometry_ = scene.geometryRevision();
    settings_ = withoutAnchor(settings);
}

base::Steps Voxels::makeOctants(const gl::Device& device, Rays rays) {
    if (rays == Rays::No || octantsOf_ == revision()) co_return;
    octantsOf_ = {};
    co_await octants_.buildInSteps(device, surface_);
    octantsOf_ = revision();
}

bool Voxels::hasOctants() const { return octantsOf_ && octantsOf_ == revision(); }

void Voxels::declare(gl::Inputs& inputs) const {
    inputs.add(surface_);
    if (hasOctants()) inputs.add(octants_);
}

}  // namespace conelight::voxels
