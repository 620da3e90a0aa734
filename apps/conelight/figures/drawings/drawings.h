// SPDX-License-Identifier: MIT
// Figures that need no OpenGL: each function makes the text of one SVG file. What has a formula is computed
// by it, and by the renderer's own code where that has it.
#pragma once

#include <string>
#include <vector>

#include "io/scene_format.h"

namespace conelight::figures {

// Radiometry (radiometry.cpp)
std::string drawSolidAngle();
std::string drawProjectedPatch();
std::string drawTwoProjections();
std::string drawInverseSquare();

// Reflection (lobes.cpp)
std::string plotReflectanceParts();
std::string plotGlossyLobes();

// Transport (transport.cpp, gathering.cpp)
std::string drawRenderingEquation();
std::string drawLocalModel();
std::string drawTwoApproximations();
std::string drawThreeGatherings();

// The machine (pipeline.cpp)
std::string drawPipeline();
std::string drawSpaces();

// The technique and the program (flow.cpp, program_map.cpp)
std::string drawComponentFlow();
std::string drawOverview();
std::string drawDataFlow();
std::string drawClasses();
std::string drawSummary();
std::string drawSyntaxTree(const std::vector<io::SyntaxLine>& tree, const std::string& text);

// Cones (cone_march.cpp)
std::string drawConeMarch();
std::string plotPowerOfTwo();
std::string drawConeSet(bool side, bool intermediate);

// Beams (beam_drawings.cpp)
std::string drawBeamPlan();
std::string drawBeamTree();

// Voxels (voxel_drawings.cpp)
std::string drawViewportProjection();
std::string drawThreeVoxelizations();
std::string drawDominantAxis();

// Textures (texture_drawings.cpp)
std::string drawCheckers();
std::string drawMipPyramid();
std::string drawMagnification();
std::string drawFlatConeMarch();

}  // namespace conelight::figures
