// SPDX-License-Identifier: MIT
// Light into voxels: SurfaceVoxels + lights -> the radiance word of every face record,
//   emission + albedo / pi * irradiance of all lights, shadows included (lib/lights.glsl), at the centre of
// the face's surface. Emission of rectangles that shine as area lights (LIGHT_FROM_EMITTER) is left out:
// their light arrives exactly, and must not arrive twice.
//
// Needs the frame block, the scene's tables and the shadow maps bound. Reads and writes: face. Ends with the
// barrier for shader storage. GL state changed: program, what SurfaceVoxels::bind binds.
#pragma once

#include <vector>

#include "conelight/settings.h"
#include "gl/buffer.h"
#include "gl/pass.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "scene/gpu_scene.h"
#include "voxels/surface_voxels.h"

namespace conelight::light {

// What part of its emission each face shows, so that it fits the faces' sizes as rays meet them
// (emission_fit.comp.glsl). It depends on voxels alone, and is kept until they change.
struct EmissionFit {
    gl::Buffer parts;  // a float per face
    gl::Texture texels;
    bool known = false;  // to be set to false when voxels change
};

// Irradiance gathered before is cleared; with `steadyLight` (IrradianceCache's) it is kept, and the part of
// the radiance that is not looked up at hits is written there; emission then is what `fit`, required then,
// leaves of it, for which OctantWords must be bound.
void injectLight(gl::ProgramLibrary& programs, gl::Profiler& profiler, const scene::GpuScene& scene,
                 const LightSettings& settings, const voxels::SurfaceVoxels& surface,
                 const gl::Buffer* steadyLight = nullptr, EmissionFit* fit = nullptr);

std::vector<gl::ProgramDesc> injectLightProgramDescs();

}  // namespace conelight::light
