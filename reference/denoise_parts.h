// SPDX-License-Identifier: MIT
// A path-traced picture as denoise.h filters it: parts of the light, freed of what reflects them, and the guide.
#pragma once

#include <array>

#include "reference/denoise_choice.h"
#include "reference/denoise_filter.h"
#include "reference/path_tracer.h"

namespace conelight::reference {

// Not finite: black; beyond 1e12: that, whose square is a number yet.
glm::vec3 usableColor(const glm::vec4& pixel);

// Light = irradiance times reflectance, of both halves.
struct LightPart {
    HalfColors irradiance, reflectance;
    bool isNoisy() const { return irradiance[0] != irradiance[1]; }
    HalfColors light() const;  // multiplied again
};

struct LightParts {
    std::array<LightPart, 3> parts;  // direct without emission, diffuse, specular
    HalfColors emission;
};

// The picture has features.
LightParts partsOf(const PathTracedPicture& picture);
GuideTable guideOf(const PathTracedPicture& picture);

// The picture with its parts, halves and noise made of `light`: direct, diffuse and specular.
PathTracedPicture pictureOf(const PathTracedPicture& noisy, std::array<HalfColors, 3> light,
                            const HalfColors& emission);

}  // namespace conelight::reference
