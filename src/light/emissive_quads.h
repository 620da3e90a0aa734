// SPDX-License-Identifier: MIT
// Flat emitters (scene/emissive_quads.h) into the light table: their light is exact and sharp in its shadows,
// where voxels would blur it. What the camera sees of the emitter does not change.
#pragma once

#include "conelight/scene.h"
#include "scene/gpu_scene.h"

namespace conelight::light {

// Makes the tables of `gpuScene` hold the lights of `source`'s emissive quads (`enabled`) or none of them,
// and marks their instances, whose emission the voxels then leave out. Call it before ShadowMaps::update
// whenever the scene or the setting changed.
void setEmissiveQuads(scene::GpuScene& gpuScene, const Scene& source, bool enabled);

}  // namespace conelight::light
