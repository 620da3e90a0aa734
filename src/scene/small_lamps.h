// SPDX-License-Identifier: MIT
// Small lamps: instances that are one untextured emissive ball or box are area lights of the same radiance, where the ball
// is less than two voxels of the default grid wide, or the box less than two thick. Voxels cannot hold what such lamps send
// to what is near them. Which ones they are decides what is "direct light", in the GL modes and in the path tracer. No GL.
#pragma once

#include <cstddef>
#include <vector>

#include "conelight/scene.h"

namespace conelight::scene {

// A light is asked at every pixel: scenes with more small balls than these leave all to the voxels; the same of boxes.
constexpr std::size_t kMostEmissiveSpheres = 4;
constexpr std::size_t kMostEmissiveBoxes = 4;

// A ball is one light, a box has six that follow one another.
struct SmallLamp {
    std::size_t instance;
    Light light;
};
// `bounds` tell the size of a voxel: of the boxes of visible instances, of the scene as it is or as it first was
// (GpuScene::firstBounds), which does not change when something moves. Without them they are made here.
std::vector<SmallLamp> smallLamps(const Scene& scene, const Aabb& bounds);
std::vector<SmallLamp> smallLamps(const Scene& scene);

// Instances that may be such a shape: plain emitters in the voxels, of so many triangles. None where there are more than 64:
// a few lamps do not light such a scene, and it is not searched.
std::vector<std::size_t> possibleLamps(const Scene& scene, std::size_t fewestTriangles,
                                       std::size_t mostTriangles);

}  // namespace conelight::scene
