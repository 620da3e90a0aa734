// SPDX-License-Identifier: MIT
// Light of points and spots on the faces of voxels about them (light/near_lamps.comp.glsl): voxels + lights + LitFaces with
// all direct light at the faces' middles -> the same with means over the triangles that these voxels hold. Part of
// light::LitVoxels.
#pragma once

#include <vector>

#include "gl/device.h"
#include "light/lights.h"
#include "light/lit_faces.h"
#include "scene/gpu_scene.h"
#include "voxels/voxels.h"

namespace conelight::light {

struct NearLampInputs {
    const scene::GpuScene& scene;
    const Lights& lights;
    const voxels::Voxels& voxels;
    const gl::Buffer& cachedDirect;  // RayLight::cachedDirect of injectLight; of spheres written, too
};

// After injectLight. Ends with the barrier for shader storage and texture fetches. GL state changed: program and its slots.
void lightNearLamps(const gl::Device& device, const NearLampInputs& inputs, LitFaces& faces);
// The same for spheres of light that are smaller than a voxel.
void lightNearBulbs(const gl::Device& device, const NearLampInputs& inputs, LitFaces& faces);

std::vector<gl::ProgramDesc> nearLampsProgramDescs();

}  // namespace conelight::light
