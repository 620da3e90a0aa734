// SPDX-License-Identifier: MIT
// Small bulbs: instances that are one untextured emissive ball are spherical lights of the same radiance, where the ball
// is less than two voxels of the default grid wide. Voxels cannot hold what such a ball sends to what is near it. Which
// ones they are decides what is "direct light", in the GL modes and in the path tracer. No GL.
#pragma once

#include <cstddef>
#include <vector>

#include "conelight/scene.h"

namespace conelight::scene {

// A light is asked at every pixel: scenes with more small balls than these leave all to the voxels.
constexpr std::size_t kMostEmissiveSpheres = 4;

// `light` has the area of the mesh, which lies within its own sphere of corners.
struct EmissiveSphere {
    std::size_t instance;
    Light light;
};
// `bounds` tell the size of a voxel: of the boxes of visible instances, of the scene as it is or as it first was
// (GpuScene::firstBounds), which does not change when something moves. Without them they are made here.
std::vector<EmissiveSphere> emissiveSpheres(const Scene& scene, const Aabb& bounds);
std::vector<EmissiveSphere> emissiveSpheres(const Scene& scene);

}  // namespace conelight::scene
