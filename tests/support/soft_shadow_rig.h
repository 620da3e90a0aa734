// SPDX-License-Identifier: MIT
// What tests of soft shadows by cones share: a plate's shadow on a floor, the same in truth by the path tracer
// and a lamp that has the cone's size, shares of light that arrive, and an empty room in which all should.
#pragma once

#include <vector>

#include "conelight/renderer.h"
#include "conelight/scene.h"
#include "conelight/settings.h"

namespace conelight::test {

constexpr int kShadowPixels = 64;  // edge of the pictures

// A white floor; a plate at 0.75 m; a point light at 2 m.
Scene plateScene(bool withPlate);

// The point light as a square that faces down and has the area of a disc of that aperture, seen from the middle of
// the picture.
Light lampOf(float aperture);

Image drawSmall(const Scene& scene, const Settings& settings);

// Share of the light that arrives, per pixel. By cones: component occlusion where the settings ask for it, else
// the picture over the same without shadows.
std::vector<float> visible(const Image& shadowed, const Image& open);
std::vector<float> visibleByCones(const Scene& scene, const Settings& settings);
std::vector<float> visibleInTruth(const Light& lamp);
double meanDifference(const std::vector<float>& a, const std::vector<float>& b);

// Least share in an empty closed room with a lamp below its ceiling, and the largest jump: how far a pixel is off
// the mean of its neighbours. Over three directions of view.
struct RoomShares {
    float least = 2, jump = 0;
};
RoomShares sharesInAnEmptyRoom(const Settings& settings);

}  // namespace conelight::test
