// SPDX-License-Identifier: MIT
// Which lights a shader is made for: variants of shaders that include lib/lights.glsl, and of those whose
// rays look lights up where they hit (lib/voxel_light.glsl).
#pragma once

#include <compare>
#include <vector>

#include "gl/device.h"
#include "gl/shader_source.h"
#include "shared/scene.h"

namespace conelight::light {

// Lights of each kind: on a processor their numbers while there are at most four in all (`fixed`), so that shaders read
// them at constant places; else whether there are any, so that a light more needs no other program.
struct LightKey {
    int point = 0, spot = 0, directional = 0, rect = 0;
    bool fixed = true;
    bool shaped = false;  // area lights may be round, others have profiles; not fixed then
    bool shadows = false;
    bool glass = false;  // with shadows: glass tints them
    bool cascades =
        false;  // with shadows of directional lights: pixels have maps about the eye (view/shadow_cascades.h)
    int filter = 0;  // radius of the shadow filter, texels; 0 without shadows; -1: one texel, unfiltered

    // `ends`: of the kinds in the sorted light table.
    static LightKey of(const glm::uvec4& ends, bool shaped, bool shadows, int filter,
                       gl::ExecutionProfile profile);
    // Lights without extent whose shadow maps answer yes or no: without a filter.
    bool hasSharpShadows() const { return shadows && filter == 0 && point + spot + directional > 0; }
    gl::Defines defines() const;
    static std::vector<LightKey> all();       // but those with filter -1, which hits ask for, and cascades
    static std::vector<LightKey> ofPixels();  // and those with cascades
    auto operator<=>(const LightKey&) const = default;
};

// Of shaders that draw lamps by chance (lib/lamp_tree.glsl).
struct LampKey {
    bool shaped = false;  // as LightKey's
    bool glass = false;
    bool veils = false;  // of glass: blended surfaces are looked at by its tree

    gl::Defines defines() const;
    static std::vector<LampKey> all();
    auto operator<=>(const LampKey&) const = default;
};

// What rays do where they hit.
struct HitKey {
    bool exact = false;  // punctual lights are looked up; else faces give all light
    bool lobes = false;  // metals reflect in their lobe
    bool gloss = false;  // of exact ones without lobes: dielectrics reflect punctual lights in theirs
    // Where they hit nothing they see a picture; or a constant sky that is not black, to which others are guided.
    bool environment = false;
    bool guided = false;
    bool glass = false;  // light passes glass on its way
    LightKey lights;     // of `exact`: the punctual ones, filter 0 or -1

    gl::Defines defines() const;
    // `filter`: of exact ones, 0 or -1.
    static std::vector<HitKey> all(int filter);
    auto operator<=>(const HitKey&) const = default;
};

}  // namespace conelight::light
