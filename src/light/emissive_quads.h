// SPDX-License-Identifier: MIT
// Flat emitters as lights: instances that are one untextured emissive parallelogram (two triangles) become
// rectangular lights of the same radiance, whose light is exact and sharp in its shadows, where voxels would
// blur it. Scene -> entries of GpuScene's light table and a mark on the instances, whose emission the voxels
// then leave out. What the camera sees of the emitter does not change.
#pragma once

#include "scene/gpu_scene.h"

namespace conelight::light {

struct EmissiveQuad {
    std::size_t instance;
    Light light;
};
std::vector<EmissiveQuad> emissiveQuads(const Scene& scene);

// Makes the tables of `gpuScene` hold the lights of `source`'s emissive quads (`enabled`) or none of them.
// Call it before ShadowMaps::update whenever the scene or the setting changed.
void setEmissiveQuads(scene::GpuScene& gpuScene, const Scene& source, bool enabled);

}  // namespace conelight::light
