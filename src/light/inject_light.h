// SPDX-License-Identifier: MIT
// Light into voxels: voxels + lights -> the radiance word of every face record,
//   emission + albedo / pi * irradiance of all lights, shadows included (lib/lights.glsl), at the centre of
// the face's surface. Emission of rectangles that shine as area lights (LIGHT_FROM_EMITTER) is left out:
// their light arrives exactly, and must not arrive twice.
#pragma once

#include <vector>

#include "gl/device.h"
#include "light/emission_fit.h"
#include "light/lights.h"
#include "scene/gpu_scene.h"
#include "voxels/surface_voxels.h"

namespace conelight::light {

// For rays: irradiance that was gathered stays, and the part of the radiance that is not looked up at hits is
// written once more by itself.
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

// Irradiance gathered before is cleared, but for rays. Ends with the barrier for shader storage and texture
// fetches. GL state changed: program and its slots.
void injectLight(const gl::Device& device, const InjectInputs& inputs, const RayLight* rays = nullptr);

std::vector<gl::ProgramDesc> injectLightProgramDescs();

}  // namespace conelight::light
