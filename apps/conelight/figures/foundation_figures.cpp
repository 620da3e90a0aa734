// SPDX-License-Identifier: MIT
// Figures of the thesis's chapters 1 to 3: radiometry, light transport, rasterization and the older methods.
#include "figures/drawings/drawings.h"
#include "figures/renders.h"
#include "figures/table.h"

namespace conelight::figures {
namespace {

const Figure kFoundationFigures[] = {
    {"F01", "What it is good for", "A collage of demonstrations of voxel cone tracing",
     "Scenes of this project in its own modes: a sunlit courtyard, a box with a lamp, a parlour, glass "
     "on a table.",
     Kind::Series, renderUses},
    {"F02", "Solid angle", "The patch that two angles and their steps cut out of the unit sphere",
     "The patch (blue) at θ from the pole and φ round it. Its edges are dθ and sin θ dφ long, so its area, "
     "the solid "
     "angle, is their product. The number below is that of the patch as drawn.",
     Kind::Drawing, vectorFigure<drawSolidAngle>},
    {"F03", "Projected patch",
     "A surface patch as it is seen from a point, projected across the line of sight",
     "A patch (blue) whose normal is turned away from the line of sight by θ'. Seen from x it looks as large "
     "as its "
     "projection (orange).",
     Kind::Drawing, vectorFigure<drawProjectedPatch>},
    {"F04", "Two projections", "Area becomes solid angle in two steps",
     "First the patch is turned to face x, which takes a cosine. Then it is drawn in to the unit sphere "
     "round x, which "
     "takes the distance squared.",
     Kind::Drawing, vectorFigure<drawTwoProjections>},
    {"F05", "Four kinds of lights", "Point, spot, directional and area light",
     "One room four times. The point lamp lights all walls; the spot draws a disc; the directional light "
     "falls alike "
     "everywhere and throws parallel shadows; the rectangle gives soft ones.",
     Kind::Render, renderLightKinds},
    {"F06", "Inverse square", "Light that spreads over an area which grows with the distance squared",
     "The light that passes through one square at r passes through four at 2r and nine at 3r.", Kind::Drawing,
     vectorFigure<drawInverseSquare>},
    {"F07", "Three falloffs", "Quadratic, linear and constant attenuation",
     "One lamp over a floor. With the square the light stays near the lamp, with the distance it reaches "
     "further, and "
     "without falloff only the angle dims it.",
     Kind::Render, renderFalloffs},
    {"F08", "Parts of reflection", "Ideal specular, ideal diffuse and glossy reflection, and their sum",
     "Light comes in from the left (orange). The further a curve lies from the middle, the more light goes "
     "there. The "
     "glossy lobe is that of the renderer's own BRDF; it leans from the mirrored direction towards the "
     "surface.",
     Kind::Plot, vectorFigure<plotReflectanceParts>},
    {"F09", "Glossy lobes", "The glossy lobe for several exponents",
     "Left the Phong lobe of modes `phong` and `thesis`; right the lobe of the physical modes for the same "
     "materials. "
     "Both get narrower as the exponent grows.",
     Kind::Plot, vectorFigure<plotGlossyLobes>},
    {"F10", "The rendering equation", "The parts of the rendering equation in a scene",
     "Each part of the formula has the colour of what it stands for: light that leaves towards the eye, own "
     "glow, "
     "reflectance, light that comes in from lamps and from other surfaces, and the cosine.",
     Kind::Drawing, vectorFigure<drawRenderingEquation>},
    {"F11", "Local model", "Light that a local model takes in: straight from the lamp, or once reflected",
     "The grey path meets two surfaces before the eye. A local model leaves it out.", Kind::Drawing,
     vectorFigure<drawLocalModel>},
    {"F12", "Local and global",
     "The same scene by a local and by a global model; colour passes between surfaces",
     "Left direct light alone: what the lamp does not see is black. Right all bounces: the white blocks turn "
     "red and "
     "green beside the walls.",
     Kind::Render, renderLocalAndGlobal},
    {"F13", "Graphics pipeline", "Stages of the OpenGL pipeline",
     "Stages that are programs are blue, fixed ones grey. Below each stands what this project uses it for.",
     Kind::Drawing, vectorFigure<drawPipeline>},
    {"F14", "Spaces", "Spaces that a point goes through on its way to the screen",
     "A house in local, world, view and clip space and on the screen, placed by the matrices named in red.",
     Kind::Drawing, vectorFigure<drawSpaces>},
    {"F15", "Geometry shader", "Triangles that a geometry shader has shrunk",
     "A body of triangles whole, and with each triangle drawn smaller about its middle (`view.shrink`).",
     Kind::Render, renderShrunkTriangles},
    {"F16", "Phong's model", "A dragon by Phong's model",
     "Direct light alone: ambient, diffuse and glossy part of Phong's model on a body made by code.",
     Kind::Render, renderDragon},
    {"F17", "Path tracing", "A photorealistic interior by ray tracing",
     "A room with glass and textures, lit by the sun, by the path tracer of mode `reference`. The stain on "
     "the floor is sunlight that passed through coloured panes; what noise was left is filtered out.",
     Kind::Render, renderPathTraced},
    {"F18", "Bounces", "Radiosity after a growing number of bounces",
     "Each bounce lights what the one before it left dark, and adds less than the one before it.",
     Kind::Series, renderBounces},
    {"F19", "Radiosity and ray tracing", "The same scene by radiosity and by ray tracing",
     "Left radiosity, which knows diffuse light alone: metal is dark. Right the path tracer.", Kind::Render,
     renderRadiosityBesideRays},
    {"F20", "Two approximations", "How radiosity and ray tracing approximate the rendering equation",
     "Left patches that exchange light along all lines of sight; those of one patch are drawn. Right one "
     "path from the "
     "eye that asks at each meeting whether the lamp is seen.",
     Kind::Drawing, vectorFigure<drawTwoApproximations>},
};

}  // namespace

std::span<const Figure> foundationFigures() { return kFoundationFigures; }

}  // namespace conelight::figures
