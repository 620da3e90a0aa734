// SPDX-License-Identifier: MIT
// Figures of the thesis's chapter 4 and of the first half of chapter 5: the technique and its making.
#include "figures/drawings/drawings.h"
#include "figures/renders.h"
#include "figures/table.h"

namespace conelight::figures {
namespace {

const Figure kMethodFigures[] = {
    {"F21", "Three ways to gather", "Cone tracing beside ray tracing and radiosity",
     "One point in one room. The cones are those of the renderer's set of five that lie in the drawing's "
     "plane; the "
     "rays are spread by the cosine; patches are those that the point sees.",
     Kind::Drawing, vectorFigure<drawThreeGatherings>},
    {"F22", "Cones of one pixel", "Cones that one point needs for its indirect light",
     "The cones that mode `thesis` traced for one pixel, drawn over the picture: diffuse cones in a fan, the "
     "specular "
     "cone along the mirrored view, the occlusion cone towards the lamp.",
     Kind::Render, renderConesOfPixel},
    {"F23", "Components", "How the components of voxel cone tracing flow together",
     "Direct light is weakened by occlusion cones; diffuse and specular cones add indirect light.",
     Kind::Drawing, vectorFigure<drawComponentFlow>},
    {"F24", "March", "Samples along a cone as growing spheres",
     "Each sphere is one read of the 3D texture at the level named below it. The next one lies β diameters "
     "further on. "
     "Orange ones meet a surface; what they hide is lost to those behind them.",
     Kind::Drawing, vectorFigure<drawConeMarch>},
    {"F25", "Aliasing", "A checkered floor without and with texture filtering",
     "One point per pixel makes patterns out of squares that are smaller than a pixel. The mean over the "
     "pixel turns "
     "them grey.",
     Kind::Drawing, vectorFigure<drawCheckers>},
    {"F26", "Mip levels", "A painting and its mip levels",
     "Each level has half the edge of the one before; a texel is the mean of four. The painting is made by "
     "code.",
     Kind::Drawing, vectorFigure<drawMipPyramid>},
    {"F27", "Magnification", "Nearest neighbour and bilinear filter on a magnified picture",
     "The part in the red frame, ten times as large: squares with the nearest texel, a smooth picture with "
     "the mean of four. Below the same of the volume: indirect light by cones that read its nearest texel "
     "(`thesis.filter=nearest`), and means of eight.",
     Kind::Render, renderMagnification},
    {"F28", "Flat cone", "A march through the mip levels of a picture in two dimensions",
     "The farther a sample lies, the wider it is, and the coarser the level that it is read from. Discs have "
     "the "
     "colour that was read.",
     Kind::Drawing, vectorFigure<drawFlatConeMarch>},
    {"F29", "Light and its voxels", "Direct light, and the 3D texture that keeps it",
     "Left the lit room, right what the volume keeps of it: one colour per voxel.", Kind::Render,
     renderLightAndVoxels},
    {"F30", "Onto the viewport", "A triangle is projected on the viewport, and its fragments become voxels",
     "The viewport has one pixel per column of voxels. A pixel is covered when the triangle covers its "
     "middle; its "
     "depth picks the voxel. Pixels and voxels are computed by that rule.",
     Kind::Drawing, vectorFigure<drawViewportProjection>},
    {"F31", "Three directions", "One surface voxelized along each axis",
     "A quarter of a dome, voxelized by the raster rule along x, y and z: where it is seen edge on, voxels "
     "are missing. "
     "Green: each triangle along its dominant axis. Then a room's volume by the published program, along one "
     "axis and in three passes (`thesis.voxelize_along`).",
     Kind::Render, renderThreeDirections},
    {"F32", "Dominant axis", "The axis along which a triangle covers most",
     "Three shadows of one triangle. Their areas are the parts of its normal, so the largest part picks the "
     "axis.",
     Kind::Drawing, vectorFigure<drawDominantAxis>},
    {"F33", "Overview", "The whole algorithm",
     "Above from scene to levels, once or when something moves; below what each picture takes.",
     Kind::Drawing, vectorFigure<drawOverview>},
    {"F34", "Data flow", "What lies on the CPU, what on the GPU, and what passes between them",
     "The values of this project's library. Solid arrows are tables and textures, dashed ones numbers of a "
     "frame.",
     Kind::Drawing, vectorFigure<drawDataFlow>},
    {"F35", "Classes", "Classes of the implementation",
     "The classes of this project: the program, the library's API, its values, and its modes.", Kind::Drawing,
     vectorFigure<drawClasses>},
    {"F36", "Primitives", "Primitive shapes in direct light by Phong's model",
     "A cube, a ball, a cylinder and a cone in mode `phong`.", Kind::Render, renderPrimitives},
    {"F37", "Three resolutions", "A statue in a box, voxelized at three resolutions",
     "The volume of mode `thesis` at three sizes, its front wall taken away.", Kind::Series,
     renderResolutions},
};

}  // namespace

std::span<const Figure> methodFigures() { return kMethodFigures; }

}  // namespace conelight::figures
