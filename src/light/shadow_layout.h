// SPDX-License-Identifier: MIT
// Where shadow maps lie: light table -> views, tiles of one array texture, and the table's shadow fields.
// shaders/lib/shadow.glsl documents tiles and depths, and is the other half of this file.
#pragma once

#include <vector>

#include "conelight/scene.h"
#include "conelight/settings.h"
#include "shared/scene.h"

namespace conelight::light {

// One map: where it lies in the array and how the world is projected into it.
struct ShadowView {
    glm::mat4 clipFromWorld;
    glm::vec2 slopeUnit;  // depth per texel of a slope of 1: x + y * depth
    int layer, x, y, width, height;
    bool surfaces;         // whether slopes and outlines are drawn
    int without = -1;      // this instance casts no shadow into it; -1: all do
    bool clamped = false;  // what lies before the near side casts its shadow as if it were there

    bool samePlace(const ShadowView& other) const {
        return layer == other.layer && x == other.x && y == other.y && width == other.width &&
               height == other.height;
    }
};

// All maps together: enough for 28 point lights, or 42 spots, at 1024 texels. More lights have smaller maps.
constexpr std::size_t kMostShadowBytes = std::size_t{512} << 20;
// What every driver of OpenGL 4.5 has room for: enough for 1365 point lights, or 2048 spots.
constexpr int kMostShadowLayers = 2048;

struct ShadowLayout {
    int size = 0;  // texels per edge of a layer
    int layers = 0;
    int surfaceLayers = 0;  // the first ones: their views draw slopes and outlines
    bool leavesVeils =
        false;  // blended surfaces are left out: their shadows are the tree's (scene/glass_tree.h)
    std::vector<ShadowView> views;

    std::size_t bytes(int edge) const;  // of all layers, were they of so many texels per edge
};

// `bounds` of what casts shadows; `firstBounds`: bounds that do not change when something moves, for the near
// distance. Fills in the shadow fields of `lights`; no maps for settings without shadows. Layers are of
// LightSettings::shadowSize, or smaller where that would take more than kMostShadowBytes. Throws Error (Runtime) for
// lights that ask for more than kMostShadowLayers.
ShadowLayout layOutShadows(const Aabb& bounds, const Aabb& firstBounds, const LightSettings& settings,
                           std::vector<gpu::Light>& lights);

// A directional light's map: the middle of its near side, the inverse of how deep it is, the edge of a texel in m.
struct ParallelMap {
    glm::vec3 position;
    float shadowNear, texel;
};

// Half the edge of a map that holds all of `bounds`, in steps of 2^(1/8).
float halfOfAll(const gpu::Light& light, const Aabb& bounds);
// Holds all of `bounds` in size x size texels, besides `guard` at each edge.
ParallelMap parallelMapOfAll(const gpu::Light& light, const Aabb& bounds, int size, int guard);
ShadowView parallelView(const gpu::Light& light, const ParallelMap& map, int size);
// Texels that a map of `size` keeps beyond what it is to hold, for a filter of that radius.
int guardTexels(int filterRadius, int size);

}  // namespace conelight::light
