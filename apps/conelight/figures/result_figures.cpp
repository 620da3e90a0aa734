// SPDX-License-Identifier: MIT
// Figures of the thesis's second half of chapter 5 and of chapter 6, and its two tables.
#include "figures/drawings/drawings.h"
#include "figures/renders.h"
#include "figures/table.h"
#include "io/scene_format.h"

namespace conelight::figures {
namespace {

// A scene file with all that the format has: models, a material, a light.
constexpr const char* kSceneText = R"(scene = {
    name = room
    model = {
        name = Lamp
        primitive = cube
        position = { x = 0.0 y = 0.49 z = 0.4 }
        scale = 0.2
        static = true
        shader = EMIT
    }
    model = {
        name = Statue
        path = models/statue.obj
        material = {
            shininess = 32
            specular_str = 1.0
        }
    }
    light = {
        position = { x = 0.0 y = 0.4 z = 0.4 }
        color = { r = 1.0 g = 1.0 b = 1.0 }
    }
}
)";

Panels drawTreeOfScene(Studio&) {
    const io::SceneFormat* format = io::sceneFormatOf(".scene");
    const std::string svg = drawSyntaxTree(format->syntax(kSceneText, "room.scene"), kSceneText);
    return {{"", ".svg", {svg.begin(), svg.end()}}};
}

const Figure kResultFigures[] = {
    {"F38", "Occlusion cones", "Visibility by the regular and by the customised occlusion cone",
     "Where lamps shine, white, and where not. The first two pictures have the published program's cones: "
     "regular ones "
     "see their own surface and darken everything, customised ones damp what is near. Mended, both agree but "
     "for edges.",
     Kind::Render, renderOcclusionVariants},
    {"F39", "Specular cones", "Reflections by the regular and by the customised specular cone",
     "The mirror ball and glossy bodies alone reflect. Customised cones weaken what is reflected away from "
     "the lamp, "
     "which takes false highlights off.",
     Kind::Render, renderSpecularVariants},
    {"F40", "Diffuse cones", "Indirect light by regular and by customised diffuse cones",
     "Regular cones of the published program lose near colours, so that their picture is shown brighter; "
     "customised ones "
     "end at the first hit. Mended, both give the same picture.",
     Kind::Render, renderDiffuseVariants},
    {"F41", "Syntax tree", "The tree that the scene parser makes of a scene file, beside the file",
     "Left the tree as the parser made it, right the text; the number before a node is its line. "
     "`conelight info --tree FILE` prints the tree of any such file.",
     Kind::Drawing, drawTreeOfScene},
    {"F42", "Cone sets", "Indirect light by four sets of cones, and the sets",
     "Above the pictures, below the cones of each set.", Kind::Series, renderConeSets},
    {"F43", "Summary", "Voxel cone tracing in short",
     "A scene; its voxels, which keep its light; and the cones of one point, coloured by what they gather.",
     Kind::Drawing, vectorFigure<drawSummary>},
    {"F44", "Power of two", "Sizes that mip levels do not have",
     "A cone grows evenly, whole levels double. Between two of them a sample is up to 1.41 times too large "
     "or too "
     "small.",
     Kind::Plot, vectorFigure<plotPowerOfTwo>},
    {"F45", "Leaking colours", "Colour of a hidden body shows through a thin wall in coarse levels",
     "The volume's colours on the surfaces, at four levels. A green body stands behind the red screen; in "
     "coarse levels "
     "its colour reaches the screen's front.",
     Kind::Series, renderLeaks},
    {"F46", "Reflections near walls", "Wrong reflections and a black cap on a mirror ball beside a wall",
     "Left the published program: its cones start at fixed distances and see nothing nearer, a black "
     "crescent on the ball. "
     "Right they start just clear of the surface.",
     Kind::Render, renderBallNearWall},
    {"F47", "Comparison", "Methods of global illumination compared",
     "Each mode on the box with a lamp: error against the path tracer, CPU time, GL memory, what may move. "
     "Time is that of the first picture and of a further frame. All numbers are measured when the figure is "
     "drawn.",
     Kind::Table, plotComparison},
    {"F48", "Jumping voxels", "A wall's voxel layer jumps when the wall is moved by a hair",
     "Visibility by the published program before and after the right wall moves by two millionths of the "
     "room: its voxels "
     "fall to the other side, and its light changes at once. Mended, it does not.",
     Kind::Render, renderJumpingVoxels},
    {"F49", "Rings", "Light that falls off in waves",
     "Visibility of the lamp on walls around it. As published, the number of samples changes by one on "
     "spheres round the "
     "lamp, which shows as rings. Counting the last step by its share takes them away.",
     Kind::Render, renderRings},
    {"F50", "Gallery", "Pictures of the presented implementation",
     "The statue under one lamp and the room with three, by modes `thesis`, `cones` and `traced`.",
     Kind::Series, renderGallery},
    {"T1", "Frame times without voxelization", "Time of a frame at three voxel sizes, voxels made once",
     "Means over 100 frames of this device, or over what ten seconds allow. Beside them stand the numbers "
     "that "
     "the thesis printed, and the CPU time of its program. `published` is its own variant, `mended` the "
     "default.",
     Kind::Table, measureStill},
    {"T2", "Frame times with voxelization",
     "Time of a frame at three voxel sizes, voxels made anew in each frame",
     "Means over 100 frames of this device, or over what ten seconds allow. Beside them stand the numbers "
     "that "
     "the thesis printed, and the CPU time of its program. `published` is its own variant, `mended` the "
     "default.",
     Kind::Table, measureDynamic},
};

}  // namespace

std::span<const Figure> resultFigures() { return kResultFigures; }

}  // namespace conelight::figures
