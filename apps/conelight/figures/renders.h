// SPDX-License-Identifier: MIT
// Figures that are pictures of scenes, and what is measured. Each takes the studio and gives its panels.
#pragma once

#include "figures/studio.h"

namespace conelight::figures {

using Panels = std::vector<Panel>;

// Chapters 1 to 3 (foundation_renders.cpp)
Panels renderUses(Studio& studio);
Panels renderLightKinds(Studio& studio);
Panels renderFalloffs(Studio& studio);
Panels renderLocalAndGlobal(Studio& studio);
Panels renderShrunkTriangles(Studio& studio);
Panels renderDragon(Studio& studio);
Panels renderPathTraced(Studio& studio);
Panels renderBounces(Studio& studio);
Panels renderRadiosityBesideRays(Studio& studio);

// Chapters 4 to 6 (method_renders.cpp)
Panels renderConesOfPixel(Studio& studio);
Panels renderMagnification(Studio& studio);
Panels renderThreeDirections(Studio& studio);
Panels renderLightAndVoxels(Studio& studio);
Panels renderPrimitives(Studio& studio);
Panels renderResolutions(Studio& studio);
Panels renderOcclusionVariants(Studio& studio);
Panels renderSpecularVariants(Studio& studio);
Panels renderDiffuseVariants(Studio& studio);
Panels renderConeSets(Studio& studio);
Panels renderLeaks(Studio& studio);
Panels renderBallNearWall(Studio& studio);
Panels renderJumpingVoxels(Studio& studio);
Panels renderRings(Studio& studio);
Panels renderGallery(Studio& studio);

// Beyond the thesis (beam_renders.cpp)
Panels drawBeams(Studio& studio);
Panels renderMirrorHall(Studio& studio);

// Measured (comparison_chart.cpp, frame_tables.cpp)
Panels plotComparison(Studio& studio);
Panels measureStill(Studio& studio);
Panels measureDynamic(Studio& studio);

}  // namespace conelight::figures
