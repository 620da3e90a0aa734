// SPDX-License-Identifier: MIT
// Beams (Heckbert and Hanrahan 1984, "Beam Tracing Polygonal Objects"): a camera's frustum -> the polygons that it ends
// on, cut to what is seen; from each mirror among them a further beam, whose apex is the mirror image of the one it came
// from. And from each lamp a beam of its own, which ends on all that it lights.
//
// What a beam ends on is exact: convex parts of polygons, disjoint, each seen wholly (BeamOrder, BeamCover). Nothing
// depends on pixels.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "reference/beam_scene.h"
#include "reference/lens.h"

namespace conelight::reference {

constexpr std::uint32_t kNoPolygon = ~0u;

// What a beam ends on: a part of a polygon, or of what is around the scene (kNoPolygon; its corners then lie on the
// window).
struct BeamPart {
    std::uint32_t polygon = kNoPolygon;
    Corners corners;
    int child = -1;  // the beam that it mirrors
};

struct Beam {
    int parent = -1, parentPart = -1;
    int depth = 0;                      // mirrors before
    std::uint32_t mirror = kNoPolygon;  // the last of them
    BeamApex apex;
    glm::dmat4 unfolded{1};  // places as the eye takes them to be, behind the mirrors
    double share = 1;        // of light, at most, that the mirrors leave
    Corners window;          // the part of the mirror, or of the camera's near plane, that it passes
    std::vector<BeamPart> parts;
};

struct BeamTree {
    std::vector<Beam> beams;  // parents first; the first is the eye's
    std::size_t partCount() const;
};

struct BeamTreeSettings {
    int mostMirrors = 32;       // in a row
    double leastShare = 0.002;  // beams that less light is left of are not followed
    bool background = true;     // keep what is seen of the surroundings
};

// Throws Error(BadInput) when the mirrors make too many beams. `goesOn` ends the work early by returning false.
BeamTree beamTree(const BeamScene& scene, const Lens& lens, const BeamTreeSettings& settings,
                  const std::function<bool()>& goesOn = {});

// Of each polygon the parts that a lamp lights.
using LitParts = std::vector<std::vector<Corners>>;
LitParts litParts(const BeamScene& scene, const BeamLamp& lamp);

}  // namespace conelight::reference
