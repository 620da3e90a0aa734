// SPDX-License-Identifier: MIT
// Baked light at voxel faces: BakedLight + voxels of what does not move -> irradiance of their faces, and of the
// same faces among the voxels of all.
//
// Its correction is what the bake knows and cones miss: irradiance that was baked less that which cones gather in
// the volume of what does not move. Added to what they gather in another volume it makes errors cancel (Fournier,
// Gunawan and Romanzin 1993, "Common Illumination between Real and Computer Generated Scenes").
#pragma once

#include "base/revision.h"
#include "conelight/scene.h"
#include "gl/device.h"
#include "light/lit_faces.h"
#include "voxels/surface_voxels.h"

namespace conelight::light {

class BakedFaces {
  public:
    // Looks light up at the faces of `statics`, which has to live until the next update; there are no corrections
    // yet. Waits for the GPU.
    void update(const BakedLight& baked, const voxels::SurfaceVoxels& statics);
    // Corrections, from what cones gathered at these faces. Ends with the barrier for shader storage.
    void correct(const gl::Device& device, const LitFaces& gathered);
    base::Revision revision() const { return revision_; }  // of the irradiance
    base::Revision correctionRevision() const { return correctionRevision_; }

    // Irradiance and corrections of the faces of `surface`, which lies in the same grid. Those that the voxels of
    // what does not move lack get none. Ends with the barrier for shader storage and texture fetches.
    void light(const gl::Device& device, const voxels::SurfaceVoxels& surface, const LitFaces& faces,
               gl::Buffer& corrections) const;

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    const voxels::SurfaceVoxels* statics_ = nullptr;
    gl::Buffer irradiance_, corrections_;  // per face: shared/baked_light.h
    base::Revision revision_, correctionRevision_;
};

}  // namespace conelight::light
