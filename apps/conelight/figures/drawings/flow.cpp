// SPDX-License-Identifier: MIT
// Drawings of the technique as boxes and arrows, and its summary in a flat room.
#include <algorithm>
#include <cmath>

#include "figures/drawings/drawings.h"
#include "figures/drawings/flat_room.h"

namespace conelight::figures {
namespace {

constexpr const char* kWarm = "#fbe7c3";
constexpr const char* kCool = "#d9ecf7";
constexpr const char* kFresh = "#d5efe5";
constexpr const char* kPlain = "#eef1f6";
const Paint kWay = stroke(colour::kInk, 1.7);
const Paint kDashed = stroke(colour::kPale, 1.5, "6 4");

// An arrow with corners: straight down or up, then across, then on.
void bend(Drawing& d, Point from, Point to, const Paint& paint) {
    const double middle = 0.5 * (from.x + to.x);
    d.arrow({from, {middle, from.y}, {middle, to.y}, to}, paint);
}

}  // namespace

std::string drawComponentFlow() {
    Drawing d;
    const Box lamp = box(d, {0, 0}, {"lamps"}, kWarm, 110);
    const Box volume = box(d, {0, 210}, {"3D texture", "direct light, levels"}, kCool, 150);
    const Box phong = box(d, {240, -50}, {"Phong, diffuse"}, kPlain, 150);
    const Box gloss = box(d, {240, 30}, {"Phong, glossy", "may be left out"}, kPlain, 150);
    const Box occlusion = box(d, {240, 118}, {"occlusion cones", "u, one per lamp"}, kCool, 150);
    const Box diffuse = box(d, {240, 210}, {"diffuse cones", "n, wide"}, kCool, 150);
    const Box specular = box(d, {240, 296}, {"specular cone", "1, narrow"}, kCool, 150);
    const Box sum = box(d, {470, -10}, {"sum"}, kPlain, 60);
    const Box times = box(d, {600, 60}, {"× visibility"}, kPlain, 110);
    const Box albedo = box(d, {500, 210}, {"× albedo"}, kPlain, 110);
    const Box share = box(d, {500, 296}, {"× mirrored share"}, kPlain, 140);
    const Box direct = box(d, {790, 60}, {"direct light"}, kWarm, 130);
    const Box indirect = box(d, {790, 250}, {"indirect light"}, kWarm, 130);
    const Box picture = box(d, {960, 155}, {"picture"}, kFresh, 100);
    bend(d, lamp.right(), phong.left(), kWay);
    bend(d, lamp.right(), gloss.left(), kWay);
    bend(d, lamp.right(), occlusion.left(), kWay);
    connect(d, lamp, volume, kWay);
    d.text({-8, 110}, "voxelize", {.size = 12, .anchor = Anchor::End, .colour = colour::kNote});
    for (const Box* cone : {&occlusion, &diffuse, &specular}) bend(d, volume.right(), cone->left(), kDashed);
    bend(d, phong.right(), sum.left(), kWay);
    bend(d, gloss.right(), sum.left(), kWay);
    bend(d, sum.right(), times.left(), kWay);
    bend(d, occlusion.right(), times.left() + Point(0, 8), kWay);
    connect(d, diffuse, albedo, kWay);
    connect(d, specular, share, kWay);
    connect(d, times, direct, kWay);
    bend(d, albedo.right(), indirect.left() - Point(0, 6), kWay);
    bend(d, share.right(), indirect.left() + Point(0, 6), kWay);
    bend(d, direct.right(), picture.left() - Point(0, 6), kWay);
    bend(d, indirect.right(), picture.left() + Point(0, 6), kWay);
    d.text({480, 366}, "1 + n + u cones per pixel; dashed: reads of the 3D texture",
           {.size = 14, .colour = colour::kNote});
    return d.svg("Flow of the components of voxel cone tracing");
}

std::string drawOverview() {
    Drawing d;
    const Box scene = box(d, {0, 0}, {"scene", "triangles, materials, lamps"}, kPlain, 200);
    const Box pass = box(d, {290, 0}, {"voxelize", "each triangle along", "its dominant axis"}, kCool, 170);
    const Box volume =
        box(d, {540, 0}, {"3D texture", "colour: direct light", "alpha: occupancy"}, kCool, 170);
    const Box levels = box(d, {790, 0}, {"levels", "2 × 2 × 2 texels", "into one"}, kCool, 150);
    const Box seen = box(d, {290, 150}, {"surfaces seen", "position, normal, material"}, kFresh, 200);
    const Box cones = box(d, {590, 150}, {"cones per pixel", "occlusion, diffuse, specular"}, kFresh, 210);
    const Box picture = box(d, {850, 150}, {"picture"}, kWarm, 100);
    connect(d, scene, pass, kWay);
    connect(d, pass, volume, kWay);
    connect(d, volume, levels, kWay);
    d.arrow({scene.bottom(), {scene.centre.x, seen.centre.y}, seen.left()}, kWay);
    connect(d, seen, cones, kWay);
    connect(d, cones, picture, kWay);
    d.arrow({levels.bottom(), {levels.centre.x, 86}, {cones.centre.x, 86}, cones.top()}, kWay);
    const Box change = box(d, {0, 240}, {"something moved"}, kPlain, 150);
    d.arrow({change.right(),
             {pass.centre.x - 130, 240},
             {pass.centre.x - 130, 78},
             {pass.centre.x - 40, 78},
             pass.bottom() - Point(40, 0)},
            kDashed);
    d.text({180, 262}, "anew, or what changed",
           {.size = 12, .anchor = Anchor::Start, .colour = colour::kNote});
    return d.svg("Overview of voxel cone tracing");
}

std::string drawDataFlow() {
    Drawing d;
    // Two rooms: what the processor holds, what the graphics processor holds.
    d.rect({-120, -70}, {260, 560}, {.stroke = "none", .fill = "#f6f8fb"}, 10);
    d.rect({190, -70}, {760, 560}, {.stroke = "none", .fill = "#fbf7ef"}, 10);
    d.text({10, -44}, "CPU", {.size = 17, .bold = true});
    d.text({570, -44}, "GPU", {.size = 17, .bold = true});
    const Box scene = box(d, {10, 20}, {"Scene", "tables as given"}, kPlain, 190);
    const Box grid = box(d, {10, 150}, {"voxel grid", "bounds, size, bricks"}, kPlain, 190);
    const Box settings = box(d, {10, 270}, {"Settings", "mode, apertures, qualities"}, kPlain, 190);
    const Box camera = box(d, {10, 380}, {"Camera"}, kPlain, 190);
    const Box tables = box(d, {300, 20}, {"GpuScene", "vertices, materials"}, kFresh, 170);
    const Box voxels = box(d, {300, 150}, {"Voxels", "records, faces"}, kCool, 170);
    const Box lights = box(d, {570, 20}, {"Lights", "table, shadow maps"}, kWarm, 170);
    const Box lit = box(d, {570, 150}, {"LitVoxels", "light of each face"}, kCool, 170);
    const Box cones = box(d, {830, 150}, {"ConeVolume", "radiance in levels"}, kCool, 170);
    const Box surfaces = box(d, {300, 380}, {"Surfaces", "what pixels see"}, kFresh, 170);
    const Box gather = box(d, {570, 290}, {"Indirect", "rays or cones per pixel"}, kCool, 170);
    const Box image = box(d, {830, 380}, {"LinearImage", "radiance"}, kWarm, 150);
    connect(d, scene, tables, kWay);
    connect(d, tables, voxels, kWay);
    connect(d, tables, lights, kWay);
    connect(d, lights, lit, kWay);
    connect(d, voxels, lit, kWay);
    connect(d, lit, cones, kWay);
    d.arrow({tables.left() + Point(0, 14), {196, 34}, {196, 372}, surfaces.left() - Point(0, 8)}, kWay);
    d.arrow({lit.bottom(), gather.top()}, kWay);
    d.arrow({cones.bottom(), {cones.centre.x, 290}, gather.right()}, kWay);
    d.arrow({surfaces.top(), {surfaces.centre.x, 290}, gather.left()}, kWay);
    d.arrow({gather.bottom(), {570, 372}, image.left() - Point(0, 8)}, kWay);
    d.arrow({surfaces.right() + Point(0, 10), image.left() + Point(0, 10)}, kWay);
    connect(d, grid, voxels, kDashed);
    d.arrow({settings.right(),
             {gather.left().x - 50, 270},
             {gather.left().x - 50, 278},
             gather.left() - Point(0, 12)},
            kDashed);
    d.arrow({camera.right() + Point(0, 8), surfaces.left() + Point(0, 8)}, kDashed);
    d.line({-100, 460}, {-60, 460}, kWay);
    d.text({-50, 465}, "tables, textures", {.size = 12, .anchor = Anchor::Start});
    d.line({220, 460}, {260, 460}, kDashed);
    d.text({270, 465}, "uniforms: numbers of this frame", {.size = 12, .anchor = Anchor::Start});
    return d.svg("Data flow of Conelight between CPU and GPU");
}

std::string drawSummary() {
    Drawing d;
    constexpr double kVoxel = 21;
    const FlatRoom plain({0, 0}), cubes({400, 0}), traced({800, 0});
    for (const FlatRoom* room : {&plain, &cubes, &traced}) {
        room->draw(d);
        if (room == &plain) continue;
        // Voxels that a wall passes through, coloured by the wall.
        for (const FlatWall& wall : room->walls) {
            const double length = glm::length(wall.to - wall.from);
            Point last(-1e9);
            for (int i = 0; i <= 400; ++i) {
                const Point at = wall.from + (wall.to - wall.from) * (i / 400.0) - room->corner;
                const Point cell = glm::floor((at + Point(0.5, -0.5)) / kVoxel);
                if (cell == last || length < 1) continue;
                last = cell;
                d.rect(room->corner + cell * kVoxel, Point(kVoxel),
                       {.stroke = colour::kPaper,
                        .width = 1,
                        .fill = wall.colour,
                        .opacity = room == &cubes ? 0.85 : 0.35});
            }
        }
    }
    // Cones of each kind at one point of the picture.
    const Point x = traced.receiver() - Point(0, 3);
    const auto cone = [&](double angle, double half, const char* tint, double reach) {
        std::vector<Point> outline{x};
        for (int i = 0; i <= 24; ++i) {
            const double a = angle - half + 2 * half * i / 24;
            const std::optional<FlatHit> end = traced.hit(x, upTurned(a));
            outline.push_back(x + std::min(end ? end->distance - 5 : reach, reach) * upTurned(a));
        }
        d.polygon(outline, {.stroke = tint, .width = 1.5, .fill = tint, .opacity = 0.4});
    };
    for (const double angle : {-0.95, -0.32}) cone(angle, 0.27, colour::kBlue, 400);
    cone(0.95, 0.27, colour::kBlue, 400);
    const Point toLamp = traced.lamp() + Point(0, 12) - x;
    cone(std::atan2(toLamp.x, -toLamp.y), 0.08, colour::kOrange, glm::length(toLamp));
    cone(0.52, 0.045, colour::kRed, 400);
    d.circle(x, 5, filled(colour::kInk));
    const char* titles[] = {"1. scene", "2. lit voxels", "3. cones per pixel"};
    for (int i = 0; i < 3; ++i) d.text(Point(150 + 400.0 * i, -38), titles[i], {.size = 17, .bold = true});
    for (int i = 0; i < 2; ++i)
        d.arrow({324 + 400.0 * i, 105}, {378 + 400.0 * i, 105}, stroke(colour::kInk, 3));
    const std::pair<const char*, const char*> words[] = {
        {"diffuse", colour::kBlue}, {"occlusion", colour::kOrange}, {"specular", colour::kRed}};
    double at = 815;
    for (const auto& [word, tint] : words) {
        d.text({at, 246}, word, {.size = 14, .anchor = Anchor::Start, .colour = tint, .bold = true});
        at += textWidth(word, 14, true) + 14;
    }
    return d.svg("Voxel cone tracing in short");
}

}  // namespace conelight::figures
