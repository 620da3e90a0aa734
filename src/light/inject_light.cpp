// SPDX-License-Identifier: MIT
#include "light/inject_light.h"

#include <algorithm>

#include "base/assert.h"
#include "gl/gl.h"
#include "light/shadow_maps.h"
#include "shared/bindings.h"

namespace conelight::light {
namespace {

gl::ProgramDesc programDesc(gl::Defines lights, bool keepsIrradiance, bool fits) {
    lights.emplace_back("KEEP_IRRADIANCE", keepsIrradiance ? "1" : "0");
    lights.emplace_back("EMISSION_FITS", fits ? "1" : "0");
    return {{"light/inject_light.comp.glsl"}, std::move(lights)};
}

gl::ProgramDesc fitProgramDesc(int step) {
    return {{"light/emission_fit.comp.glsl"}, {{"STEP", std::to_string(step)}}};
}

// Others than those whose light comes from rectangles.
bool hasEmitters(const scene::GpuScene& scene) {
    return std::any_of(
        scene.instances().begin(), scene.instances().end(), [&](const gpu::Instance& instance) {
            const gpu::Material& m = scene.materials()[instance.material];
            const std::uint32_t flags = INSTANCE_VOXELIZED | INSTANCE_LIT_EXACTLY;
            return (instance.flags & flags) == INSTANCE_VOXELIZED && (m.flags & MATERIAL_UNLIT) == 0 &&
                   std::max({m.emission.x, m.emission.y, m.emission.z}) > 0;
        });
}

void makeFit(gl::ProgramLibrary& programs, const voxels::SurfaceVoxels& surface, EmissionFit& fit) {
    const std::size_t bytes = std::size_t{4} * surface.faceCount();
    if (fit.parts.bytes() < bytes) {
        fit.texels = {};
        fit.parts = {};
        fit.parts = gl::Buffer(bytes + bytes / 4, "emission that fits");
        fit.texels = gl::Texture(fit.parts, GL_R32UI, "emission that fits");
    }
    fit.parts.bindStorage(BINDING_STORAGE_PASS);
    const glm::ivec3 size = surface.grid().bricks();
    const auto bricks = static_cast<std::size_t>(size.x * size.y * size.z);
    for (int step = 0; step < 3; ++step) {
        programs.get(fitProgramDesc(step)).dispatchLinear(step == 1 ? surface.faceCount() : bricks);
        gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
    }
    fit.known = true;
}

}  // namespace

void injectLight(gl::ProgramLibrary& programs, gl::Profiler& profiler, const scene::GpuScene& scene,
                 const LightSettings& settings, const voxels::SurfaceVoxels& surface,
                 const gl::Buffer* steadyLight, EmissionFit* fit) {
    const gl::PassScope pass(profiler, "inject light");
    CONELIGHT_ASSERT(steadyLight == nullptr || fit != nullptr, "injectLight: steady light without a fit");
    surface.bind();
    const bool fits = steadyLight != nullptr && surface.faceCount() > 0 && hasEmitters(scene);
    if (fits) {
        if (!fit->known) makeFit(programs, surface, *fit);
        fit->texels.bind(UNIT_PASS);
    }
    if (steadyLight != nullptr) steadyLight->bindStorage(BINDING_STORAGE_PASS);
    programs.get(programDesc(lightDefines(scene, settings), steadyLight != nullptr, fits))
        .dispatchLinear(surface.faceCount());
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
}

// With all kinds of lights; scenes that lack some leave parts of the same text out.
std::vector<gl::ProgramDesc> injectLightProgramDescs() {
    return {programDesc({}, false, false),
            programDesc({}, true, false),
            programDesc({}, true, true),
            fitProgramDesc(0),
            fitProgramDesc(1),
            fitProgramDesc(2)};
}

}  // namespace conelight::light
