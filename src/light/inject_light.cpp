// SPDX-License-Identifier: MIT
#include "light/inject_light.h"

#include <algorithm>

#include "gl/gl.h"

namespace conelight::light {
namespace {

struct InjectKey {
    LightKey lights;
    bool forRays = false;
    bool fits = false;

    gl::ProgramDesc desc() const {
        gl::Defines defines = lights.defines();
        defines.emplace_back("FOR_RAYS", forRays ? "1" : "0");
        defines.emplace_back("EMISSION_FITS", fits ? "1" : "0");
        return {{"light/inject_light.comp.glsl"}, std::move(defines)};
    }
    static std::vector<InjectKey> all() {
        std::vector<InjectKey> keys;
        for (const LightKey& lights : LightKey::all())
            for (const auto& [rays, fits] : {std::pair{false, false}, {true, false}, {true, true}})
                keys.push_back({lights, rays, fits});
        return keys;
    }
};

}  // namespace

bool hasOtherEmitters(const scene::GpuScene& scene, const Lights& lights) {
    const std::vector<gpu::Instance>& instances = scene.instances();
    for (std::size_t i = 0; i < instances.size(); ++i) {
        const gpu::Material& m = scene.materials()[instances[i].material];
        if ((instances[i].flags & INSTANCE_VOXELIZED) != 0 && !lights.areInTable(i) &&
            (m.flags & MATERIAL_UNLIT) == 0 && std::max({m.emission.x, m.emission.y, m.emission.z}) > 0)
            return true;
    }
    return false;
}

void injectLight(const gl::Device& device, const InjectInputs& inputs, LitFaces& faces,
                 const RayLight* rays) {
    const gl::PassScope pass(device.profiler, "inject light");
    faces.reserve(inputs.surface.mostFaces());
    gl::Inputs given;
    given.add(inputs.scene).add(inputs.lights).add(inputs.surface).add(faces);
    if (rays != nullptr) given.storage("CachedDirect", rays->cachedDirect);
    const bool fits = rays != nullptr && rays->fit != nullptr;
    if (fits) given.add(*rays->fit);
    device.get(InjectKey{inputs.lights.key(), rays != nullptr, fits}.desc())
        .dispatchLinear(given, inputs.surface.mostFaces());
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
}

std::vector<gl::ProgramDesc> injectLightProgramDescs() {
    std::vector<gl::ProgramDesc> descs;
    for (const InjectKey& key : InjectKey::all()) descs.push_back(key.desc());
    return descs;
}

}  // namespace conelight::light
