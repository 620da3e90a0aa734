// SPDX-License-Identifier: MIT
// The classes of Conelight: who holds what, and who makes what (src/README.md says the same in a table).
#include <algorithm>

#include "figures/drawings/drawing.h"
#include "figures/drawings/drawings.h"

namespace conelight::figures {
namespace {

constexpr double kSize = 13, kStep = 17, kPad = 10;

// A class: its name, then what it holds or does.
Box classBox(Drawing& d, Point centre, const std::string& name, const std::vector<std::string>& members,
             const char* fill) {
    double width = textWidth(name, kSize + 1, true) + 2 * kPad;
    for (const std::string& member : members) width = std::max(width, textWidth(member, kSize) + 2 * kPad);
    const double head = kStep + 10, height = head + kStep * double(members.size()) + 10;
    const Point corner = centre - 0.5 * Point(width, height);
    d.rect(corner, {width, height}, {.fill = colour::kPaper});
    d.rect(corner, {width, head}, {.fill = fill});
    d.text({centre.x, corner.y + head - 9}, name, {.size = kSize + 1, .bold = true});
    for (std::size_t i = 0; i < members.size(); ++i)
        d.text({corner.x + kPad, corner.y + head + kStep * double(i + 1)}, members[i],
               {.size = kSize, .anchor = Anchor::Start});
    return {centre, {0.5 * width, 0.5 * height}};
}

// "holds": a filled diamond at the holder.
void holds(Drawing& d, const std::vector<Point>& way) {
    const Point tip = way.front(), along = glm::normalize(way[1] - tip), across(-along.y, along.x);
    d.polyline(way, stroke(colour::kInk, 1.4));
    d.polygon({tip, tip + along * 8.0 + across * 5.0, tip + along * 16.0, tip + along * 8.0 - across * 5.0},
              filled(colour::kInk));
}

// "is a": an open head at the general one.
void isA(Drawing& d, Point from, Point to) {
    const Point along = glm::normalize(to - from), across(-along.y, along.x);
    d.line(from, to - along * 12.0, stroke(colour::kInk, 1.4));
    d.polygon({to, to - along * 13.0 + across * 7.0, to - along * 13.0 - across * 7.0},
              {.width = 1.4, .fill = colour::kPaper});
}

}  // namespace

std::string drawClasses() {
    Drawing d;
    constexpr const char *kApi = "#fbe7c3", *kValue = "#d9ecf7", *kMode = "#d5efe5", *kApp = "#eadcf0";
    const Box program =
        classBox(d, {-330, 0}, "program", {"render, view, compare,", "bench, figures ..."}, kApp);
    const Box session =
        classBox(d, {-330, 150}, "Session", {"Scene, Settings, Camera", "edits, undo, commands"}, kApp);
    const Box renderer =
        classBox(d, {0, 0}, "Renderer",
                 {"setScene, setInstance ...", "render(Camera, Settings)", "readImage, inspectPixel"}, kApi);
    const Box scene = classBox(d, {-330, 320}, "Scene",
                               {"meshes, materials, textures", "instances, lights, cameras"}, kApi);
    const Box gpu = classBox(d, {340, -90}, "scene::GpuScene", {"tables on the GPU, revisions"}, kValue);
    const Box lights = classBox(d, {340, -10}, "light::Lights", {"light table, shadow maps"}, kValue);
    const Box surfaces = classBox(d, {340, 70}, "view::Surfaces", {"G-buffer and its matrices"}, kValue);
    const Box image = classBox(d, {340, 150}, "image::LinearImage", {"radiance per pixel"}, kValue);
    const Box mode = classBox(d, {0, 190}, "modes::Mode", {"draw(...): the recipe"}, kMode);
    const Box phong = classBox(d, {-110, 345}, "PhongMode", {"direct light"}, kMode);
    const Box thesis =
        classBox(d, {40, 345}, "thesis::Mode", {"ThesisVolume,", "three kinds of cones"}, kMode);
    const Box cones = classBox(d, {215, 345}, "ConesMode", {"Voxels,", "ConeVolume"}, kMode);
    const Box traced = classBox(d, {385, 345}, "TracedMode", {"Voxels, LitVoxels,", "Indirect"}, kMode);
    const Box voxels = classBox(d, {120, 500}, "voxels::Voxels", {"grid, records, faces"}, kValue);
    const Box lit = classBox(d, {330, 500}, "light::LitVoxels", {"irradiance per face"}, kValue);
    const Box gather = classBox(d, {560, 500}, "gather::Indirect", {"means over frames"}, kValue);
    const Box truth = classBox(d, {-330, 480}, "reference", {"PathTracer,", "bakeRadiosity"}, kApp);
    holds(d, {program.bottom(), session.top()});
    holds(d, {session.bottom(), scene.top()});
    holds(d, {program.right(), renderer.left()});
    for (const Box* value : {&gpu, &lights, &surfaces, &image}) {
        const double x = 170;
        holds(d, {renderer.right(), {x, renderer.centre.y}, {x, value->centre.y}, value->left()});
    }
    holds(d, {renderer.bottom(), mode.top()});
    for (const Box* one : {&phong, &thesis, &cones, &traced}) {
        d.line(one->top(), {one->centre.x, 268}, stroke(colour::kInk, 1.4));
        d.line({one->centre.x, 268}, {0, 268}, stroke(colour::kInk, 1.4));
    }
    isA(d, {0, 268}, mode.bottom());
    holds(d,
          {cones.bottom() - Point(20, 0), {cones.centre.x - 20, 430}, {voxels.centre.x, 430}, voxels.top()});
    holds(d, {traced.bottom() - Point(20, 0), {traced.centre.x - 20, 430}, {lit.centre.x, 430}, lit.top()});
    holds(
        d,
        {traced.bottom() + Point(20, 0), {traced.centre.x + 20, 430}, {gather.centre.x, 430}, gather.top()});
    d.line(lit.left(), voxels.right(), stroke(colour::kPale, 1.4, "5 4"));
    d.arrow(scene.bottom(), truth.top(), stroke(colour::kPale, 1.4, "5 4"));
    d.text({-160, 560}, "◆ holds    △ is a    dashed: reads",
           {.size = 13, .anchor = Anchor::Start, .colour = "#4a5160"});
    return d.svg("Classes of Conelight");
}

}  // namespace conelight::figures
