// SPDX-License-Identifier: MIT
// Lit faces -> volume of premultiplied radiance with levels, for cones: a dense texture, or an octree that
// gives the same values. Layout: shared/radiance_volume.h, shared/radiance_octree.h. Method: docs/theory/2_voxels.md, "Levels"; six directions after Crassin et al.
// 2011, "Interactive Indirect Illumination Using Voxel Cone Tracing", section 4.2.
//
// Level 0 holds the faces' outgoing radiance times their coverage W, and W (at most 1). Faces are seen from
// their front only: a cone that leaves a surface never meets that surface.
// Coarser levels average four columns of two texels; along the column a texel hides what is behind it
// (OpacityModel::Fog), or adds its area to it (OpacityModel::Area).
//
// Reads: voxRec, face, litFaces. Writes: texture or octree. build() ends with the barrier for texture fetches.
#pragma once

#include <vector>

#include "base/steps.h"
#include "conelight/settings.h"
#include "gather/radiance_layout.h"
#include "gather/radiance_octree.h"
#include "gl/buffer.h"
#include "gl/device.h"
#include "gl/texture.h"
#include "light/lit_faces.h"
#include "voxels/surface_voxels.h"

namespace conelight::gather {

class RadianceVolume {
  public:
    RadianceVolume() = default;
    // Dense: allocates all levels; contents undefined until build().
    explicit RadianceVolume(const RadianceLayout& layout);

    // Fills every level from the faces' radiance + albedo * irradiance. `surface` must have the layout's
    // grid.
    void build(const gl::Device& device, const voxels::SurfaceVoxels& surface, const light::LitFaces& faces,
               OpacityModel opacity) {
        buildInSteps(device, surface, faces, opacity).finish();
    }
    base::Steps buildInSteps(const gl::Device& device, const voxels::SurfaceVoxels& surface,
                             const light::LitFaces& faces, OpacityModel opacity);

    // What shaders may read: RadianceVolumeBlock, and radianceVolume or what the octree declares.
    void declare(gl::Inputs& inputs) const;

    const RadianceLayout& layout() const { return layout_; }
    bool laidOut() const { return static_cast<bool>(block_); }
    bool isOctree() const { return layout_.storage == VolumeStorage::Octree; }
    const gl::Texture& texture() const { return texture_; }  // of a dense volume
    const RadianceOctree& octree() const { return octree_; }

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    void clearLevel(const gl::Device& device, int level);
    void scatter(const gl::Device& device, const voxels::SurfaceVoxels& surface,
                 const light::LitFaces& faces);
    void buildLevel(const gl::Device& device, const voxels::SurfaceVoxels& surface, OpacityModel opacity,
                    int level);
    void buildOctreeLevel(const gl::Device& device, OpacityModel opacity, int level);

    RadianceLayout layout_;
    gl::Texture texture_;    // dense
    RadianceOctree octree_;  // else
    gl::Buffer block_;
};

}  // namespace conelight::gather
