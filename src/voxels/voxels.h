// SPDX-License-Identifier: MIT
// The value of the stage of voxels: GpuScene -> surface voxels, and what rays need to cross them. It keeps
// what it was made from; update() of a scene that has not changed costs two comparisons.
//
// Readers keep revision(), and compare it with that of the next frame.
#pragma once

#include "voxels/octant_words.h"
#include "voxels/surface_voxels.h"

namespace conelight::voxels {

// Whether rays will cross the voxels, which takes octant words.
enum class Rays : bool { No, Yes };
// Whether nested grids around another eye may keep voxels (SurfaceVoxels::hasScrolled), as pictures in motion do.
enum class Scroll : bool { No, Yes };

// An anchor moves levels, as an eye does, and is no other setting of what they hold.
inline VoxelSettings withoutAnchor(VoxelSettings settings) {
    settings.anchor = {};
    return settings;
}

class Voxels {
  public:
    // Makes voxels of `scene` as it is, in place of those there are: what has not changed stays
    // (SurfaceVoxels::update). Octant words are made with Rays::Yes only.
    void update(const gl::Device& device, const scene::GpuScene& scene, const VoxelSettings& settings,
                Rays rays) {
        updateInSteps(device, scene, settings, rays).finish();
    }
    base::Steps updateInSteps(const gl::Device& device, const scene::GpuScene& scene, VoxelSettings settings,
                              Rays rays);
    // As update(), in another grid: that of another scene's voxels, or nested ones (SurfaceVoxels::gridAround).
    void updateIn(const VoxelGrid& grid, const gl::Device& device, const scene::GpuScene& scene,
                  const VoxelSettings& settings, Rays rays = Rays::No) {
        updateInSteps(grid, device, scene, settings, rays).finish();
    }
    base::Steps updateInSteps(VoxelGrid grid, const gl::Device& device, const scene::GpuScene& scene,
                              VoxelSettings settings, Rays rays = Rays::No, Scroll scroll = Scroll::No);
    // As update(), but all of it anew, also of a scene that has not changed.
    void build(const gl::Device& device, const scene::GpuScene& scene, const VoxelSettings& settings,
               Rays rays);

    // Whether update() would leave them as they are: areOf, in one grid.
    bool areIn(const VoxelGrid& grid, const scene::GpuScene& scene, Scroll scroll = Scroll::No) const;
    bool areOf(const scene::GpuScene& scene, const VoxelSettings& settings) const;
    // Of the surface voxels: equal as long as these are the same.
    base::Revision revision() const { return surface_.revision(); }
    const SurfaceVoxels& surface() const { return surface_; }
    bool hasOctants() const;  // of these voxels
    const OctantWords& octants() const { return octants_; }
    const VoxelGrid& grid() const { return surface_.grid(); }
    // That the voxels were made with, but for the anchor: the grid tells where levels lie.
    const VoxelSettings& settings() const { return settings_; }
    // Keys of the voxels before the last change; null when there were none.
    const VoxelKeys* previous() const { return surface_.previous(); }

    // What SurfaceVoxels and, if there are any, OctantWords declare.
    void declare(gl::Inputs& inputs) const;

  private:
    void remember(const scene::GpuScene& scene, const VoxelSettings& settings);
    base::Steps makeOctants(const gl::Device& device, Rays rays);

    SurfaceVoxels surface_;
    OctantWords octants_;
    base::Revision octantsOf_;  // voxels
    // What the voxels were made from.
    base::Revision scene_, geometry_;
    VoxelSettings settings_;
};

}  // namespace conelight::voxels
