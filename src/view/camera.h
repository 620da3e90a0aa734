// SPDX-License-Identifier: MIT
// Matrices of a camera, and the constants every pass of a frame reads. Computed in double, given in float.
#pragma once

#include "conelight/scene.h"
#include "scene/gpu_scene.h"
#include "shared/frame.h"

namespace conelight::view {

glm::mat4 viewFromWorld(const Camera& camera);
glm::mat4 clipFromView(const Camera& camera, int width, int height);  // GL clip space, z in [-1,1]

// `scene` gives the counts of instances, triangles and lights: call it after ShadowMaps::update, which may
// add lights.
gpu::FrameConstants frameConstants(const Camera& camera, int width, int height, const scene::GpuScene& scene,
                                   const glm::vec3& sky, std::uint32_t frameIndex, std::uint32_t seed);

}  // namespace conelight::view
