// SPDX-License-Identifier: MIT
#include "light/near_lamps.h"

#include <algorithm>

#include "gl/gl.h"
#include "shared/lamps.h"

namespace conelight::light {
namespace {

constexpr std::size_t kFacesOfBlock = std::size_t{6} * NEAR_LAMP_BLOCK * NEAR_LAMP_BLOCK * NEAR_LAMP_BLOCK;

// Loops over the table, however many lamps of which kind there are. Maps are asked without a filter: means blur edges.
LightKey nearKey(LightKey lights) {
    lights.fixed = false;
    lights.point = lights.spot = lights.directional = 1;
    lights.rect = lights.filter = 0;
    return lights;
}

// Of spheres alone.
LightKey bulbKey(LightKey lights) {
    lights.fixed = false;
    lights.point = lights.spot = lights.directional = lights.filter = 0;
    lights.rect = 1;
    lights.shaped = true;
    return lights;
}

gl::ProgramDesc nearLampsDesc(const LightKey& lights) {
    gl::ProgramDesc desc{{"light/near_lamps.comp.glsl"}, lights.defines()};
    desc.defines.emplace_back("BULBS", lights == bulbKey(lights) ? "1" : "0");
    return desc;
}

void lightNear(const gl::Device& device, const NearLampInputs& inputs, LitFaces& faces,
               const LightKey& lights, std::size_t lamps) {
    const voxels::SurfaceVoxels& surface = inputs.voxels.surface();
    if (lamps == 0 || surface.mostFaces() == 0) return;
    const gl::PassScope pass(device.profiler, "light of near lamps");
    gl::Inputs given;
    given.add(inputs.scene)
        .add(inputs.lights)
        .add(inputs.voxels)
        .add(faces)
        .storage("CachedDirect", inputs.cachedDirect);
    surface.declareTriangles(given);
    const auto levels = static_cast<std::size_t>(std::max(surface.grid().levels, 1));
    device.get(nearLampsDesc(lights)).dispatchLinear(given, lamps * levels * kFacesOfBlock);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
}

}  // namespace

void lightNearLamps(const gl::Device& device, const NearLampInputs& inputs, LitFaces& faces) {
    lightNear(device, inputs, faces, nearKey(inputs.lights.key()), inputs.lights.ends().y);
}

void lightNearBulbs(const gl::Device& device, const NearLampInputs& inputs, LitFaces& faces) {
    const std::vector<gpu::Light>& table = inputs.lights.table();
    const bool any = std::any_of(table.begin(), table.end(),
                                 [](const gpu::Light& light) { return (light.flags & LIGHT_SPHERE) != 0; });
    const glm::uvec4 ends = inputs.lights.ends();
    if (any) lightNear(device, inputs, faces, bulbKey(inputs.lights.key()), ends.w - ends.z);
}

std::vector<gl::ProgramDesc> nearLampsProgramDescs() {
    std::vector<gl::ProgramDesc> descs;
    for (const LightKey& lights : LightKey::all())
        if (!lights.fixed && (lights == nearKey(lights) || lights == bulbKey(lights)))
            descs.push_back(nearLampsDesc(lights));
    return descs;
}

}  // namespace conelight::light
