// SPDX-License-Identifier: MIT
// Lit faces -> dense volume of premultiplied radiance with levels, for cones. Layout:
// shared/radiance_volume.h. Method: docs/theory/2_voxels.md, "Levels"; six directions after Crassin et al.
// 2011, "Interactive Indirect Illumination Using Voxel Cone Tracing", section 4.2.
//
// Level 0 holds the faces' outgoing radiance times their coverage W, and W (at most 1). Faces are seen from
// their front only: a cone that leaves a surface never meets that surface.
// Coarser levels average four columns of two texels; along the column a texel hides what is behind it
// (OpacityModel::Fog), or adds its area to it (OpacityModel::Area).
//
// Reads: voxRec, face, litFaces. Writes: the texture. build() ends with the barrier for texture fetches.
#pragma once

#include <vector>

#include "conelight/settings.h"
#include "gl/buffer.h"
#include "gl/device.h"
#include "gl/texture.h"
#include "light/lit_faces.h"
#include "shared/radiance_volume.h"
#include "voxels/surface_voxels.h"

namespace conelight::gather {

// Where the texels of a volume lie.
struct RadianceLayout {
    voxels::VoxelGrid grid;
    int blocks = 1;      // 6 with directions
    int maxLevel = 0;    // coarsest level
    glm::ivec3 size{4};  // texels of level 0 per block; texel 0 is voxel 0

    gpu::RadianceVolume packed() const;
    bool operator==(const RadianceLayout&) const = default;
};

// `maxFootprint`: fraction of the grid's longest side (ConesSettings).
RadianceLayout radianceLayout(const voxels::VoxelGrid& grid, VolumeDirections directional,
                              float maxFootprint);

class RadianceVolume {
  public:
    RadianceVolume() = default;
    // Allocates all levels; contents undefined until build().
    explicit RadianceVolume(const RadianceLayout& layout);

    // Fills every level from the faces' radiance + albedo * irradiance. `surface` must have the layout's
    // grid.
    void build(const gl::Device& device, const voxels::SurfaceVoxels& surface, const light::LitFaces& faces,
               OpacityModel opacity);

    // Samples lie between two levels, or in the nearest (the default).
    void sampleBetweenLevels(bool between);

    // What shaders may read: RadianceVolumeBlock, radianceVolume.
    void declare(gl::Inputs& inputs) const;

    const RadianceLayout& layout() const { return layout_; }
    const gl::Texture& texture() const { return texture_; }

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    void buildLevels(const gl::Device& device, const voxels::SurfaceVoxels& surface, OpacityModel opacity);

    RadianceLayout layout_;
    gl::Texture texture_;
    gl::Buffer block_;
};

}  // namespace conelight::gather
