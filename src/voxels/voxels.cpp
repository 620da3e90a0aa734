// SPDX-License-Identifier: MIT
#include "voxels/voxels.h"

namespace conelight::voxels {

void Voxels::update(const gl::Device& device, const scene::GpuScene& scene, const VoxelSettings& settings,
                    Rays rays) {
    const bool same = revision() && scene_ == scene.identity() && geometry_ == scene.geometryRevision() &&
                      settings_ == settings;
    if (!same) surface_.update(device, scene, settings);
    scene_ = scene.identity();
    geometry_ = scene.geometryRevision();
    settings_ = settings;
    makeOctants(device, rays);
}

void Voxels::updateIn(const VoxelGrid& grid, const gl::Device& device, const scene::GpuScene& scene,
                      const VoxelSettings& settings, Rays rays) {
    const bool same = revision() && scene_ == scene.identity() && geometry_ == scene.geometryRevision() &&
                      this->grid() == grid;
    if (!same) surface_.update(device, scene, grid);
    scene_ = scene.identity();
    geometry_ = scene.geometryRevision();
    settings_ = settings;
    makeOctants(device, rays);
}

void Voxels::build(const gl::Device& device, const scene::GpuScene& scene, const VoxelSettings& settings,
                   Rays rays) {
    surface_.build(device, scene, settings);
    scene_ = scene.identity();
    geometry_ = scene.geometryRevision();
    settings_ = settings;
    makeOctants(device, rays);
}

void Voxels::makeOctants(const gl::Device& device, Rays rays) {
    if (rays == Rays::No || octantsOf_ == revision()) return;
    octants_.build(device, surface_);
    octantsOf_ = revision();
}

bool Voxels::hasOctants() const { return octantsOf_ && octantsOf_ == revision(); }

void Voxels::declare(gl::Inputs& inputs) const {
    inputs.add(surface_);
    if (hasOctants()) inputs.add(octants_);
}

}  // namespace conelight::voxels
