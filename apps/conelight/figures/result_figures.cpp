// SPDX-License-Identifier: MIT
// Figures of the thesis's second half of chapter 5 and of chapter 6, and its two tables.
#include "figures/drawings/drawings.h"
#include "figures/renders.h"
#include "figures/table.h"

namespace conelight::figures {
namespace {

const Figure kFigures[] = {
    {"F38", "Occlusion cones", "Visibility by the regular and by the customised occlusion cone",
     "Left every occluder counts alike, right near ones count less.", Kind::Render, nullptr,
     "pictures of scenes"},
    {"F39", "Specular cones", "Reflections by the regular and by the customised specular cone",
     "Left as traced, right weighted by the angle to the lamp.", Kind::Render, nullptr, "pictures of scenes"},
    {"F40", "Diffuse cones", "Indirect light by regular and by customised diffuse cones",
     "Left cones gather what they pass through, right they end at the first hit.", Kind::Render, nullptr,
     "pictures of scenes"},
    {"F41", "Syntax tree", "The tree that the scene parser makes of a scene file, beside the file",
     "Left the tree, right the text.", Kind::Drawing, nullptr,
     "a way from the parser of scene files to drawings"},
    {"F42", "Cone sets", "Indirect light by four sets of cones, and the sets",
     "Above the pictures, below the cones of each set.", Kind::Series, nullptr, "pictures of scenes"},
    {"F43", "Summary", "Voxel cone tracing in short",
     "A scene; its voxels, which keep its light; and the cones of one point, coloured by what they gather.",
     Kind::Drawing, vectorFigure<drawSummary>},
    {"F44", "Power of two", "Sizes that mip levels do not have",
     "A cone grows evenly, whole levels double. Between two of them a sample is up to 1.41 times too large "
     "or too "
     "small.",
     Kind::Plot, vectorFigure<plotPowerOfTwo>},
    {"F45", "Leaking colours", "Colour of a hidden body shows through a thin wall in coarse levels",
     "A green body behind a red wall: the finer level keeps them apart, coarse ones mix them.", Kind::Series,
     nullptr, "pictures of scenes"},
    {"F46", "Reflections near walls", "Wrong reflections and a black cap on a mirror ball beside a wall",
     "With fixed offsets the cones start behind the wall.", Kind::Render, nullptr, "pictures of scenes"},
    {"F47", "Comparison", "Methods of global illumination compared", "Numbers of each mode on one scene.",
     Kind::Plot, nullptr, "measurements of all modes"},
    {"F48", "Jumping voxels", "A wall's voxel layer jumps when the wall is moved by a hair",
     "The right wall is moved by two millionths of the room.", Kind::Render, nullptr, "pictures of scenes"},
    {"F49", "Rings", "Light that falls off in waves", "Occlusion alone, with the last step counted in full.",
     Kind::Render, nullptr, "pictures of scenes"},
    {"F50", "Gallery", "Pictures of the presented implementation",
     "Scenes of the thesis's kind in this project.", Kind::Series, nullptr, "pictures of scenes"},
    {"T1", "Frame times without voxelization", "Time of a frame at three voxel sizes, voxels made once",
     "Means over frames of this device, with the numbers that the thesis printed beside them.", Kind::Table,
     nullptr, "the measurement of mode thesis"},
    {"T2", "Frame times with voxelization",
     "Time of a frame at three voxel sizes, voxels made anew in each frame",
     "Means over frames of this device, with the numbers that the thesis printed beside them.", Kind::Table,
     nullptr, "the measurement of mode thesis"},
};

}  // namespace

std::span<const Figure> resultFigures() { return kFigures; }

}  // namespace conelight::figures
