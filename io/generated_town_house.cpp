// SPDX-License-Identifier: MIT
// A house of builtin:town: walls with thickness about a front and a back room on each floor, windows and a door cut
// through them. TownHouse -> meshes.
#include <algorithm>
#include <vector>

#include "io/generated_town_parts.h"

namespace conelight::io::generated {
namespace {

constexpr float kSlab = 0.25f, kSillHeight = 0.9f, kLintel = 2.35f, kHalfWindow = 0.55f;
constexpr float kFrameAt = -0.14f, kRoofRise = 3.1f, kEaves = 0.5f;
constexpr glm::vec3 kWhitePaint(0.72f, 0.70f, 0.66f), kRoomPaint(0.68f, 0.62f, 0.52f),
    kFloorWood(0.34f, 0.21f, 0.12f), kSillStone(0.50f, 0.48f, 0.44f), kChimney(0.38f, 0.20f, 0.15f);

// A hole in a wall of one storey: x from low.x to high.x, y above the storey's floor.
struct Hole {
    glm::vec2 low, high;
    bool door = false, wide = false;
};

std::vector<Hole> holesOf(const TownHouse& house, int storey, bool front) {
    std::vector<Hole> holes;
    const float pitch = kTownHouseWidth / float(house.columns);
    for (int c = 0; c < house.columns; ++c) {
        const float x = (float(c) + 0.5f) * pitch;
        const bool door = front && storey == 0 && c == 0;
        if (front && storey == 0 && house.shop && c == 1) {
            holes.push_back({{x - 0.9f, 0.6f}, {kTownHouseWidth - 0.7f, 2.45f}, false, true});
            break;
        }
        holes.push_back(
            {{x - kHalfWindow, door ? 0.0f : kSillHeight}, {x + kHalfWindow, kLintel}, door, false});
    }
    return holes;
}

// One skin of a wall in the plane z = 0 that looks along +z: all but the holes.
void addSkin(Mesh& mesh, float from, float to, float height, const std::vector<Hole>& holes,
             const glm::mat4& place) {
    Mesh skin;
    const auto panel = [&](float x0, float x1, float y0, float y1) {
        if (x1 > x0 && y1 > y0)
            shapes::appendQuad(skin, {x0, y0, 0}, {x1 - x0, 0, 0}, {0, y1 - y0, 0}, {x0, -y1});
    };
    float x = from;
    for (const Hole& hole : holes) {
        panel(x, hole.low.x, 0, height);
        panel(hole.low.x, hole.high.x, 0, hole.low.y);
        panel(hole.low.x, hole.high.x, hole.high.y, height);
        x = hole.high.x;
    }
    panel(x, to, 0, height);
    merge(mesh, skin, place);
}

// The four sides of a hole through a wall between z = 0 and z = -kTownWall.
void addReveal(Mesh& mesh, const Hole& hole, const glm::mat4& place) {
    const glm::vec3 depth(0, 0, kTownWall), a(hole.low, -kTownWall), across(hole.high.x - hole.low.x, 0, 0),
        up(0, hole.high.y - hole.low.y, 0);
    Mesh sides;
    shapes::appendQuad(sides, a, depth, across);
    shapes::appendQuad(sides, a + up, across, depth);
    shapes::appendQuad(sides, a, up, depth);
    shapes::appendQuad(sides, a + across, depth, up);
    merge(mesh, sides, place);
}

// Back walls are front walls turned round.
glm::mat4 sideOf(bool front, int storey) {
    const glm::mat4 up = translation({0, kTownStorey * float(storey), 0});
    return front ? up : up * translation({kTownHouseWidth, 0, -kTownHouseDepth}) * turnAboutY(3.14159265f);
}

void addWalls(Mesh& walls, const TownHouse& house) {
    const float top = kTownStorey * float(house.storeys);
    for (int storey = 0; storey < house.storeys; ++storey)
        for (const bool front : {true, false}) {
            const std::vector<Hole> holes = holesOf(house, storey, front);
            addSkin(walls, 0, kTownHouseWidth, kTownStorey, holes, sideOf(front, storey));
            for (const Hole& hole : holes) addReveal(walls, hole, sideOf(front, storey));
        }
    for (const float x : {0.0f, kTownHouseWidth})
        appendPolygon(walls,
                      {{x, 0, 0},
                       {x, top, 0},
                       {x, top + kRoofRise, -0.5f * kTownHouseDepth},
                       {x, top, -kTownHouseDepth},
                       {x, 0, -kTownHouseDepth}},
                      {x > 0 ? 1.0f : -1.0f, 0, 0});
}

// Floor, ceiling and the inner skins of both rooms, with a wall and a doorway between them.
void addRooms(PaintedMesh& painted, const TownHouse& house, int storey) {
    const float x0 = kTownWall, x1 = kTownHouseWidth - kTownWall, z0 = kTownWall - kTownHouseDepth,
                height = kTownStorey - kSlab, middle = -0.5f * kTownHouseDepth;
    const glm::mat4 up = translation({0, kTownStorey * float(storey), 0});
    const glm::vec3 across(x1 - x0, 0, 0), along(0, 0, -kTownWall - z0);
    painted.add(quad({x0, 0.01f, -kTownWall}, across, -along), kFloorWood, up);
    painted.add(quad({x0, height, z0}, across, along), kWhitePaint, up);
    painted.add(quad({x0, 0, -kTownWall}, -along, {0, height, 0}), kRoomPaint, up);
    painted.add(quad({x1, 0, z0}, along, {0, height, 0}), kRoomPaint, up);
    for (const bool front : {true, false}) {
        Mesh skin;
        addSkin(
            skin, -x1, -x0, height,
            [&] {
                std::vector<Hole> holes = holesOf(house, storey, front);
                std::reverse(holes.begin(), holes.end());
                for (Hole& hole : holes) {
                    const float low = -hole.high.x;
                    hole.high.x = -hole.low.x;
                    hole.low.x = low;
                }
                return holes;
            }(),
            sideOf(front, storey) * translation({0, 0, -kTownWall}) * turnAboutY(3.14159265f));
        painted.add(skin, kRoomPaint);
    }
    if (storey > 0) return;  // its panes are dark
    const float mid = 0.5f * kTownHouseWidth;
    painted.box({x0, 0, middle - 0.06f}, {mid - 0.45f, height, middle + 0.06f}, kRoomPaint, up);
    painted.box({mid + 0.45f, 0, middle - 0.06f}, {x1, height, middle + 0.06f}, kRoomPaint, up);
    painted.box({mid - 0.45f, 2.1f, middle - 0.06f}, {mid + 0.45f, height, middle + 0.06f}, kRoomPaint, up);
}

// Frame, seen from both sides, and bars of a window.
void addWindow(PaintedMesh& painted, const Hole& hole, const glm::mat4& place) {
    const glm::vec3 low(hole.low, kFrameAt), high(hole.high, kFrameAt + 0.06f);
    const float edge = 0.06f;
    const glm::vec3 across(high.x - low.x, 0, 0), up(0, high.y - low.y, 0);
    const glm::vec2 inner(edge / across.x, edge / up.y);
    Mesh frame;
    shapes::appendFrame(frame, {low.x, low.y, high.z}, across, up, inner, 1.0f - inner);
    shapes::appendFrame(frame, low + across, -across, up, inner, 1.0f - inner);
    painted.add(frame, kWhitePaint, place);
    const int bars = hole.wide ? 3 : 1;
    for (int i = 1; i <= bars; ++i) {
        const float x = low.x + (high.x - low.x) * float(i) / float(bars + 1);
        painted.box({x - 0.025f, low.y + edge, low.z + 0.01f}, {x + 0.025f, high.y - edge, high.z - 0.01f},
                    kWhitePaint, place);
    }
    const float y = low.y + 0.66f * (high.y - low.y);
    painted.box({low.x + edge, y, low.z + 0.015f}, {high.x - edge, y + 0.04f, high.z - 0.015f}, kWhitePaint,
                place);
}

// Two shutters of slats that lie open at the wall, and a sill.
void addShutters(PaintedMesh& painted, const Hole& hole, glm::vec3 colour, const glm::mat4& place) {
    painted.box({hole.low.x - 0.1f, hole.low.y - 0.07f, -0.1f}, {hole.high.x + 0.1f, hole.low.y, 0.1f},
                kSillStone, place);
    for (const float x : {hole.low.x - 0.6f, hole.high.x + 0.02f}) {
        painted.box({x, hole.low.y, 0.01f}, {x + 0.58f, hole.high.y, 0.03f}, 0.7f * colour, place);
        constexpr int kSlats = 4;
        for (int i = 0; i < kSlats; ++i) {
            const float y = hole.low.y + (hole.high.y - hole.low.y) * (float(i) + 0.1f) / float(kSlats);
            painted.add(quad({x + 0.05f, y, 0.065f}, {0.48f, 0, 0}, {0, 0.28f, -0.035f}), colour, place);
        }
    }
}

void addDoor(PaintedMesh& painted, const TownHouse& house, const Hole& hole) {
    const float wide = hole.high.x - hole.low.x;
    const glm::mat4 leaf =
        translation({hole.low.x, 0, -0.2f}) * (house.open ? turnAboutY(1.45f) : glm::mat4(1));
    painted.box({0.02f, 0.02f, -0.025f}, {wide - 0.02f, hole.high.y - 0.02f, 0.025f}, house.shutters, leaf);
    for (int i = 0; i < 4; ++i) {
        const glm::vec3 panel(0.12f + 0.46f * float(i % 2), 0.18f + 1.08f * float(i / 2), 0.025f);
        painted.box(panel, panel + glm::vec3(0.38f, 0.9f, 0.012f), 1.3f * house.shutters, leaf);
    }
    painted.box({hole.low.x - 0.2f, -0.15f, -kTownWall}, {hole.high.x + 0.2f, 0.009f, 0.35f}, kSillStone);
}

// Stripes of cloth over the wide window, and a board with the shop's sign.
void addTownAwning(PaintedMesh& painted, const Hole& hole, glm::vec3 cloth) {
    constexpr int kStripes = 12;
    const float wide = (hole.high.x - hole.low.x) / float(kStripes);
    for (int i = 0; i < kStripes; ++i) {
        const glm::vec3 colour = i % 2 == 0 ? cloth : glm::vec3(0.7f, 0.67f, 0.6f);
        const float x = hole.low.x + wide * float(i);
        for (const float under : {0.0f, 1.0f})
            painted.add(under == 0 ? quad({x, 2.35f, 1.3f}, {wide, 0, 0}, {0, 0.5f, -1.28f})
                                   : quad({x, 2.84f, 0.02f}, {wide, 0, 0}, {0, -0.5f, 1.28f}),
                        colour);
        painted.box({x, 2.17f, 1.29f}, {x + wide, 2.35f, 1.3f}, colour);
    }
    painted.box({hole.low.x, 2.9f, 0}, {hole.high.x, 3.12f, 0.06f}, 0.5f * cloth);
}

// Two slopes of courses that lie on each other like tiles, and their undersides.
Mesh roofOf(const TownHouse& house) {
    Mesh slope;
    const float run = 0.5f * kTownHouseDepth + kEaves, rise = kRoofRise * run / (run - kEaves),
                y = kTownStorey * float(house.storeys) - (rise - kRoofRise);
    constexpr int kCourses = 14;
    constexpr float kLift = 0.07f;
    const glm::vec3 across(kTownHouseWidth, 0, 0), step(0, rise / kCourses, -run / kCourses);
    for (int i = 0; i < kCourses; ++i) {
        const glm::vec3 at = glm::vec3(0, y + 0.04f, kEaves) + float(i) * step;
        shapes::appendQuad(slope, at, across, {0, kLift, 0});
        shapes::appendQuad(slope, at + glm::vec3(0, kLift, 0), across, step - glm::vec3(0, kLift, 0));
    }
    shapes::appendQuad(slope, {0, y + rise, kEaves - run}, across, {0, 0.04f - rise, run});
    Mesh roof = slope;
    merge(roof, slope, translation({kTownHouseWidth, 0, -kTownHouseDepth}) * turnAboutY(3.14159265f));
    return roof;
}

void addTrim(PaintedMesh& painted, const TownHouse& house) {
    const float top = kTownStorey * float(house.storeys);
    for (const bool front : {true, false}) {
        painted.box({0, top - 0.25f, 0}, {kTownHouseWidth, top - 0.02f, 0.2f}, kSillStone, sideOf(front, 0));
        if (front)
            painted.box({0, kTownStorey - 0.06f, 0}, {kTownHouseWidth, kTownStorey + 0.08f, 0.07f},
                        kSillStone);
    }
    painted.box({0, -0.15f, 0}, {0.42f, 0.45f, 0.05f}, kSillStone);
    painted.box({kTownHouseWidth - 0.5f, -0.15f, 0}, {kTownHouseWidth, 0.45f, 0.05f}, kSillStone);
    const float ridge = top + kRoofRise;
    painted.box({0.9f, top + 0.8f, -3.6f}, {1.6f, ridge + 0.9f, -2.9f}, kChimney);
    painted.box({0.82f, ridge + 0.9f, -3.68f}, {1.68f, ridge + 1.05f, -2.82f}, kSillStone);
}

}  // namespace

TownHouseMeshes townHouse(const TownHouse& house) {
    TownHouseMeshes meshes;
    PaintedMesh painted;
    addWalls(meshes.walls, house);
    meshes.roof = roofOf(house);
    addTrim(painted, house);
    for (int storey = 0; storey < house.storeys; ++storey) {
        addRooms(painted, house, storey);
        for (const bool front : {true, false})
            for (const Hole& hole : holesOf(house, storey, front)) {
                const glm::mat4 place = sideOf(front, storey);
                if (hole.door) {
                    addDoor(painted, house, hole);
                    continue;
                }
                addWindow(painted, hole, place);
                if (hole.wide) addTownAwning(painted, hole, house.cloth);
                if (front && !hole.wide) addShutters(painted, hole, house.shutters, place);
                if (storey == 0) continue;
                const bool lit = randomAt(17, int(8 * hole.low.x) + 100 * storey,
                                          house.columns + (front ? 0 : 50)) < 0.45f;
                merge(
                    lit ? meshes.litPanes : meshes.panes,
                    quad({hole.low.x + 0.06f, hole.low.y + 0.06f, kFrameAt + 0.02f},
                         {hole.high.x - hole.low.x - 0.12f, 0, 0}, {0, hole.high.y - hole.low.y - 0.12f, 0}),
                    place);
            }
    }
    meshes.painted = painted.take();
    return meshes;
}

}  // namespace conelight::io::generated
