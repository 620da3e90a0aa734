// SPDX-License-Identifier: MIT
// Drawings of the machine: stages of OpenGL, and the spaces that a point goes through.
#include <fmt/format.h>

#include <glm/gtc/matrix_transform.hpp>

#include "figures/drawings/drawings.h"
#include "figures/drawings/space_view.h"

namespace conelight::figures {
namespace {

using glm::dvec3;
using glm::dvec4;

// A house: corners of its walls, then the ends of its ridge.
const std::vector<dvec3>& house() {
    static const std::vector<dvec3> points = {
        {-0.5, 0, -0.7}, {0.5, 0, -0.7},  {0.5, 0.8, -0.7}, {-0.5, 0.8, -0.7}, {-0.5, 0, 0.7},
        {0.5, 0, 0.7},   {0.5, 0.8, 0.7}, {-0.5, 0.8, 0.7}, {0, 1.3, -0.7},    {0, 1.3, 0.7}};
    return points;
}
constexpr int kEdges[][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4},
                             {1, 5}, {2, 6}, {3, 7}, {2, 8}, {3, 8}, {6, 9}, {7, 9}, {8, 9}};

// y up in space, z up in the view.
dvec3 shown(const dvec3& p) { return {p.z, p.x, p.y}; }

void drawHouse(Drawing& d, const SpaceView& view, const glm::dmat4& transform) {
    for (const auto& edge : kEdges) {
        const dvec4 a = transform * dvec4(house()[std::size_t(edge[0])], 1),
                    b = transform * dvec4(house()[std::size_t(edge[1])], 1);
        d.line(view.at(shown(dvec3(a) / a.w)), view.at(shown(dvec3(b) / b.w)), stroke(colour::kBlue, 1.8));
    }
}

void drawAxes(Drawing& d, const SpaceView& view, double length, const char* const names[3]) {
    for (int axis = 0; axis < 3; ++axis) {
        dvec3 end(0);
        end[axis] = length;
        d.arrow(view.at(dvec3(0)), view.at(shown(end)), stroke(colour::kPale, 1.3));
        d.text(view.at(shown(end * 1.12)) + Point(0, 5), names[axis],
               {.size = 13, .colour = colour::kNote, .italic = true});
    }
}

}  // namespace

std::string drawPipeline() {
    Drawing d;
    struct Stage {
        const char *name, *does, *used;
        bool ours;  // a program of the user's
    };
    constexpr Stage kStages[] = {
        {"vertex data", "positions, normals, uv; indices", "GpuScene", false},
        {"vertex shader", "to clip space", "surface, shadow, voxelize", true},
        {"tessellation", "finer patches; optional", "not used", true},
        {"geometry shader", "whole primitives", "thesis voxelize, edges", true},
        {"clipping, culling", "off screen, back faces", "back faces by material", false},
        {"rasterizer", "fragments under triangles", "G-buffer, shadow maps", false},
        {"fragment shader", "colour of a fragment", "surface, thesis voxelize", true},
        {"tests, blending", "depth; into the frame", "depth only", false}};
    const std::string fixed = "#e4e8ef", programmed = "#d9ecf7";
    Box last{};
    for (int i = 0; i < 8; ++i) {
        const int column = i < 4 ? i : 7 - i, row = i / 4;
        const Box now = box(d, {double(column) * 252, row * 150.0}, {kStages[i].name, kStages[i].does},
                            kStages[i].ours ? programmed : fixed, 222);
        d.text(now.bottom() + Point(0, 22), kStages[i].used,
               {.size = 12, .colour = colour::kNote, .italic = true});
        if (i == 4) {
            d.arrow({last.bottom() + Point(84, 0), now.top() + Point(84, 0)}, stroke(colour::kInk, 1.8));
        } else if (i > 0) {
            connect(d, last, now, stroke(colour::kInk, 1.8));
        }
        last = now;
    }
    const Box compute =
        box(d, {378, 290}, {"compute shader", "voxels, light, gathering: all other passes"}, programmed, 330);
    d.text(compute.bottom() + Point(0, 22), "beside the pipeline: reads and writes buffers and textures",
           {.size = 12, .colour = colour::kNote, .italic = true});
    d.rect({-110, 270}, {18, 14}, {.fill = programmed});
    d.text({-84, 282}, "a program", {.size = 13, .anchor = Anchor::Start});
    d.rect({-110, 298}, {18, 14}, {.fill = fixed});
    d.text({-84, 310}, "fixed", {.size = 13, .anchor = Anchor::Start});
    return d.svg("Stages of the graphics pipeline and what Conelight uses them for");
}

std::string drawSpaces() {
    Drawing d;
    const glm::dmat4 world =
        glm::translate(glm::dmat4(1), dvec3(1.3, 0, -0.4)) * glm::rotate(glm::dmat4(1), 0.6, dvec3(0, 1, 0));
    const glm::dmat4 view = glm::lookAt(dvec3(2.3, 1.5, 2.4), dvec3(1.1, 0.5, -0.2), dvec3(0, 1, 0));
    const glm::dmat4 clip = glm::perspective(0.8, 4.0 / 3.0, 1.4, 6.0);
    struct Step {
        const char *name, *by;
        glm::dmat4 transform;
        double scale;
    };
    const Step steps[] = {{"local space", "", glm::dmat4(1), 92},
                          {"world space", "worldFromObject", world, 62},
                          {"view space", "viewFromWorld", view * world, 52},
                          {"clip space, after division by w", "clipFromView", clip * view * world, 88}};
    constexpr const char* kNames[3] = {"x", "y", "z"};
    for (int i = 0; i < 4; ++i) {
        const Step& step = steps[i];
        const Point centre(i * 270.0 + (i == 3 ? 50 : 0), 0);
        SpaceView at{.origin = centre, .scale = step.scale, .azimuthDeg = 28, .elevationDeg = 22};
        if (i == 2) at.origin += Point(50, -60);  // what the eye sees lies at negative z
        drawAxes(d, at, i == 2 ? 1.6 : 1.5, kNames);
        if (i == 3) {
            const glm::dmat4 cube =
                glm::scale(glm::translate(glm::dmat4(1), dvec3(0, -1, 0)), dvec3(2, 2, 2));
            for (int e = 0; e < 12; ++e) {
                const auto corner = [&](int c) {
                    return dvec3(cube * dvec4((c & 1) - 0.5, (c >> 1) & 1, (c >> 2) - 0.5, 1));
                };
                constexpr int kBox[12][2] = {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3},
                                             {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
                d.line(at.at(shown(corner(kBox[e][0]))), at.at(shown(corner(kBox[e][1]))),
                       stroke(colour::kPale, 0.8, "4 3"));
            }
        }
        drawHouse(d, at, step.transform);
        d.text(centre + Point(0, 150), step.name, {.size = 15, .bold = true});
        if (i > 0) {
            d.arrow(centre + Point(-178, 186), centre + Point(-72, 186), stroke(colour::kInk, 1.6));
            d.text(centre + Point(-125, 208), step.by, {.size = 12, .colour = colour::kRed});
        }
    }
    // The screen: x and y of clip space on pixels.
    const Point corner(1050, -70), size(200, 150);
    d.rect(corner, size, {.width = 2, .fill = "#f6f8fb"});
    const glm::dmat4 all = clip * view * world;
    for (const auto& edge : kEdges) {
        const auto pixel = [&](int index) {
            const dvec4 p = all * dvec4(house()[std::size_t(index)], 1);
            return corner + size * Point(0.5 + 0.5 * p.x / p.w, 0.5 - 0.5 * p.y / p.w);
        };
        d.line(pixel(edge[0]), pixel(edge[1]), stroke(colour::kBlue, 1.8));
    }
    d.text(corner + Point(100, 220), "screen", {.size = 15, .bold = true});
    d.arrow({932, 186}, {1038, 186}, stroke(colour::kInk, 1.6));
    d.text({985, 208}, "viewport", {.size = 12, .colour = colour::kRed});
    return d.svg("Spaces from the mesh to the screen");
}

}  // namespace conelight::figures
