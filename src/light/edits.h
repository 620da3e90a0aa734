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
    float whole = 0;                                 // W, all that it sends out; 0: another edit says so
    bool goes = false;                               // all that it brings is elsewhere, but no less
};

struct LightChange {
    std::vector<LightEdit> lights;
    // By which irradiance may be another at any place, W/m^2, mean of the channels, but by no more than a part of it.
    float everywhere = 0, everywherePart = 0;
    // The same without what is only elsewhere, as of a sun that turns: by which there is more or less of it.
    float dimmed = 0, dimmedPart = 0;
    bool isAnything = false;  // there is nothing to go by
    bool ofLight() const { return !lights.empty() || everywhere > 0; }
    // Of lights from `first` on, other edits say all that they send out.
    void haveSaid(std::size_t first) {
        for (; first < lights.size(); ++first) lights[first].whole = 0;
    }
};

// What is left of a change of light when all light that was there is taken `scale` times.
struct ScaledChange : LightChange {
    glm::vec3 scale{1};
};

struct EditList : LightChange {
    std::vector<EditSphere> places;
    std::optional<ScaledChange> scaled;  // where what changed was for the most part there, brighter or darker
    bool most = false;                   // of the scene's light is another, whether it is scaled or not
    bool empty() const { return places.empty() && !ofLight(); }
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

// Into a block of shaders (lib/edits.glsl). At most CHANGED_PLACES of a kind, of lights as many again that are left when
// light is scaled.
template <typename Constants>
void putEdits(Constants& constants, const EditList& edits, bool scales = true) {
    constants.placeCount = static_cast<std::uint32_t>(edits.places.size());
    for (std::size_t i = 0; i < edits.places.size(); ++i) {
        constants.places[i] = {edits.places[i].center, edits.places[i].radius};
        constants.placeParts[i / 4][static_cast<int>(i % 4)] = edits.places[i].part;
    }
    std::uint32_t count = 0;
    const auto put = [&](const LightChange& change) {
        for (const LightEdit& light : change.lights) {
            constants.editedLights[count] = {light.center, light.flux};
            constants.editedAxes[count] = {light.axis, light.radius};
            constants.editedLimits[count++] = {light.reach, light.part, light.whole, light.goes ? 0 : 1};
        }
    };
    put(edits);
    constants.lightEdits = count;
    constants.editedEverywhere = edits.everywhere;
    constants.editedEverywherePart = edits.everywherePart;
    const ScaledChange* const scaled = edits.scaled && scales ? &*edits.scaled : nullptr;
    if (scaled) put(*scaled);
    constexpr float kAll = std::numeric_limits<float>::max();  // nothing is left as it was
    constants.lightScale = scaled ? scaled->scale : glm::vec3(1);
    constants.scaledEverywhere = scaled ? scaled->everywhere : kAll;
    constants.scaledEverywherePart = scaled ? scaled->everywherePart : kAll;
    constants.dimmed = {edits.dimmed, edits.dimmedPart, scaled ? scaled->dimmed : kAll,
                        scaled ? scaled->dimmedPart : kAll};
    constants.allLightEdits = count;
}

}  // namespace conelight::light
