// SPDX-License-Identifier: MIT
// Direct light on voxels: voxels + lights -> LitFaces, of every face the radiance
//   emission + albedo / pi * irradiance of all lights, shadows included (lib/lights.glsl), at the centre of
// the face's surface. Emission of what shines as an area light (LIGHT_FROM_EMITTER) is left out:
// their light arrives exactly, and must not arrive twice.
#pragma once

#include <vector>

#include "gl/device.h"
#include "light/emission_fit.h"
#include "light/lights.h"
#include "light/lit_faces.h"
#include "scene/gpu_scene.h"
#include "voxels/surface_voxels.h"

namespace conelight::light {

// For rays: the part of the radiance that is not looked up at hits is written once more by itself.
struct RayLight {
    const gl::Buffer& cachedDirect;  // a uint per face: RGB9E5
    const EmissionFit* fit;          // of these voxels; null where nothing glows but rectangles of the table
};

struct InjectInputs {
    const scene::GpuScene& scene;
    const Lights& lights;
    const voxels::SurfaceVoxels& surface;
};

// Whether anything glows whose light does not come from the light table.
bool hasOtherEmitters(const scene::GpuScene& scene, const Lights& lights);

// Fills `faces`, indirect irradiance zero. Ends with the barrier for shader storage and texture fetches. GL
// state changed: program and its slots.
void injectLight(const gl::Device& device, const InjectInputs& inputs, LitFaces& faces,
                 const RayLight* rays = nullptr);

std::vector<gl::ProgramDesc> injectLightProgramDescs();

}  // namespace conelight::light
