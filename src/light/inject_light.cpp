// SPDX-License-Identifier: MIT
#include "light/inject_light.h"

#include "light/shadow_maps.h"
#include "shared/bindings.h"

namespace conelight::light {
namespace {

gl::ProgramDesc programDesc(gl::Defines lights, bool keepsIrradiance) {
    lights.emplace_back("KEEP_IRRADIANCE", keepsIrradiance ? "1" : "0");
    return {{"light/inject_light.comp.glsl"}, std::move(lights)};
}

}  // namespace

void injectLight(gl::ProgramLibrary& programs, gl::Profiler& profiler, const scene::GpuScene& scene,
                 const LightSettings& settings, const voxels::SurfaceVoxels& surface,
                 const gl::Buffer* steadyLight) {
    const gl::PassScope pass(profiler, "inject light");
    surface.bind();
    if (steadyLight != nullptr) steadyLight->bindStorage(BINDING_STORAGE_PASS);
    programs.get(programDesc(lightDefines(scene, settings), steadyLight != nullptr))
        .dispatchLinear(surface.faceCount());
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
}

// With all kinds of lights; scenes that lack some leave parts of the same text out.
std::vector<gl::ProgramDesc> injectLightProgramDescs() {
    return {programDesc({}, false), programDesc({}, true)};
}

}  // namespace conelight::light
