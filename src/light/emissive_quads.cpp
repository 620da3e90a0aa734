// SPDX-License-Identifier: MIT
#include "light/emissive_quads.h"

#include "scene/emissive_quads.h"
#include "scene/gpu_lights.h"

namespace conelight::light {

void setEmissiveQuads(scene::GpuScene& gpuScene, const Scene& source, bool enabled) {
    std::vector<gpu::Light> lights = gpuScene.lights();
    std::erase_if(lights, [](const gpu::Light& light) { return (light.flags & LIGHT_FROM_EMITTER) != 0; });
    std::vector<char> lit(source.instances.size(), 0);
    if (enabled)
        for (const scene::EmissiveQuad& quad : scene::emissiveQuads(source)) {
            // Rectangles are the last kind, so the table stays sorted.
            lights.push_back(scene::packedLights({quad.light}).front());
            lights.back().flags |= LIGHT_FROM_EMITTER;
            lit[quad.instance] = 1;
        }
    for (std::size_t i = 0; i < lit.size(); ++i) gpuScene.setLitExactly(i, lit[i] != 0);
    gpuScene.updateLights(lights);
}

}  // namespace conelight::light
