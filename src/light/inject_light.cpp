// SPDX-License-Identifier: MIT
#include "light/inject_light.h"

#include "light/shadow_maps.h"

namespace conelight::light {
namespace {

gl::ProgramDesc programDesc(const gl::Defines& lights) { return {{"light/inject_light.comp.glsl"}, lights}; }

}  // namespace

void injectLight(gl::ProgramLibrary& programs, gl::Profiler& profiler, const scene::GpuScene& scene,
                 const LightSettings& settings, const voxels::SurfaceVoxels& surface) {
    const gl::PassScope pass(profiler, "inject light");
    surface.bind();
    programs.get(programDesc(lightDefines(scene, settings))).dispatchLinear(surface.faceCount());
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
}

// With all kinds of lights; scenes that lack some leave parts of the same text out.
std::vector<gl::ProgramDesc> injectLightProgramDescs() { return {programDesc({})}; }

}  // namespace conelight::light
