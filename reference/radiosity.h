// SPDX-License-Identifier: MIT
// Radiosity: the other pole of a comparison with the path tracer. Diffuse light between patches, solved once
// for the whole scene, looked at from anywhere. Methods and citations: radiosity.cpp.
//
// Result: a Scene of the same look whose vertices carry the light: vertex colours are the irradiance over pi
// of diffuse surfaces (times base colour and texture = radiance), materials are unlit, emitters show their
// radiance. Any GL mode draws it, and so does the path tracer. Highlights and mirrors are left out: only the
// diffuse part of a material reflects.
#pragma once

#include <cstdint>
#include <functional>

#include "conelight/scene.h"

namespace conelight::reference {

struct RadiositySettings {
    float patchSize = 0;     // longest edge of the patches that exchange light, m; 0: a 16th of the longest
                             // side of the scene
    int maxSubdivision = 4;  // further halvings of edges where the light changes fast; 0..8
    float subdivideError = 0.02f;  // deviation from linear light that splits an element, relative
    float residual = 0.0005f;      // stop when an iteration changes the light by less than this part
    int patchRays = 256;           // per patch: its form factors; 16..65536
    int gatherRays = 512;          // per vertex: light of the last bounce; 16..65536
    int visibilityRays = 256;      // per vertex and area light in its penumbra; 16..4096
    int bounces = -1;              // of indirect light; -1: all; 0: direct light only
    std::uint32_t seed = 1;
    int threads = 0;            // 0: all cores
    bool emissiveQuads = true;  // of bakeIndirect: light of flat emitters comes straight from lights
};

struct RadiosityStats {
    std::size_t patches = 0, elements = 0, vertices = 0;
    int iterations = 0;
    double residual = 0;
    std::uint64_t rays = 0;
    double cpuSeconds = 0, wallSeconds = 0;
};

struct RadiosityProgress {
    double done = 0;  // part of the work known so far; falls back when elements are split
    double residual = 1;
    double secondsLeft = -1;  // < 0: unknown
};

// Bakes `scene`. `onProgress`, called from this thread a few times a second, stops by returning false: the
// result holds what is there. Throws Error(BadInput) as Scene::validate, Error(Usage) for settings out of
// range.
Scene bakeRadiosity(const Scene& scene, const RadiositySettings& settings, RadiosityStats* stats = nullptr,
                    const std::function<bool(const RadiosityProgress&)>& onProgress = {});

// Indirect light of what does not move, for mode `hybrid`: of `scene` without its dynamic instances, by its lights as
// they are. The mesh follows indirect light alone: edges of shadows are none of its business. Else as bakeRadiosity.
BakedLight bakeIndirect(const Scene& scene, const RadiositySettings& settings,
                        RadiosityStats* stats = nullptr,
                        const std::function<bool(const RadiosityProgress&)>& onProgress = {});

}  // namespace conelight::reference
