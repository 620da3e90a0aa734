// SPDX-License-Identifier: MIT
// What has changed in a scene, for light elsewhere to stay (docs/theory/4d_cache.md, "Things that move", "Lights that
// change"): places of things and of lights. On the CPU.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "shared/irradiance.h"

namespace conelight::light {

// A sphere in world space, m, and the part of its cross-section that changed, [0,1].
struct EditSphere {
    glm::vec3 center{0};
    float radius = 0, part = 1;
};

// A light that changed, in world space.
struct LightEdit {
    glm::vec3 center{0};
    float radius = 0;   // m, that it may be beside the centre
    float flux = 0;     // W, mean of the channels: by how much it is another
    glm::vec3 axis{0};  // unit, of a spot, whose light is anywhere along it; zero: it shines to all sides
    // m. Farther away, at the distance d, a light that has only moved is another by reach / d of the flux.
    float reach = std::numeric_limits<float>::max();
    float part = std::numeric_limits<float>::max();  // of the irradiance at a place it changes no more
};

struct EditList {
    std::vector<EditSphere> places;
    std::vector<LightEdit> lights;
    // By which irradiance may be another at any place, W/m^2, mean of the channels, but by no more than a part of it.
    float everywhere = 0, everywherePart = 0;
    bool most = false;  // of the scene's light is another
    bool empty() const { return places.empty() && lights.empty() && everywhere == 0; }
    bool ofLight() const { return !lights.empty() || everywhere > 0; }
};

// Of the sum of fluxes, what is another, W: all that changed, and of what moved the part that it is another by over the
// `extent` of a scene, m.
inline float changedFlux(const std::vector<LightEdit>& lights, float extent) {
    float sum = 0;
    for (const LightEdit& light : lights) sum += light.flux * std::min(light.reach / extent, 1.0f);
    return sum;
}

// All of a change; none: it may be anything.
using SceneEdits = std::optional<EditList>;

// Into a block of shaders (lib/edits.glsl). At most CHANGED_PLACES of a kind.
template <typename Constants>
void putEdits(Constants& constants, const EditList& edits) {
    constants.placeCount = static_cast<std::uint32_t>(edits.places.size());
    for (std::size_t i = 0; i < edits.places.size(); ++i) {
        constants.places[i] = {edits.places[i].center, edits.places[i].radius};
        constants.placeParts[i / 4][static_cast<int>(i % 4)] = edits.places[i].part;
    }
    constants.lightEdits = static_cast<std::uint32_t>(edits.lights.size());
    for (std::size_t i = 0; i < edits.lights.size(); ++i) {
        constants.editedLights[i] = {edits.lights[i].center, edits.lights[i].flux};
        constants.editedAxes[i] = {edits.lights[i].axis, edits.lights[i].radius};
        constants.editedLimits[i] = {edits.lights[i].reach, edits.lights[i].part, 0, 0};
    }
    constants.editedEverywhere = edits.everywhere;
    constants.editedEverywherePart = edits.everywherePart;
}

}  // namespace conelight::light
