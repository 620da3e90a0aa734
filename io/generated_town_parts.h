// SPDX-License-Identifier: MIT
// Meshes of builtin:town: houses with rooms, trees, lamps, things on the square. Internal to conelight_io. Colours of
// small parts are those of vertices, so that a house is a few instances.
#pragma once

#include "io/generated_furnished.h"

namespace conelight::io::generated {

// A mesh of parts with a colour each.
class PaintedMesh {
  public:
    void add(const Mesh& part, glm::vec3 colour, const glm::mat4& place = glm::mat4(1));
    void box(glm::vec3 low, glm::vec3 high, glm::vec3 colour, const glm::mat4& place = glm::mat4(1));
    Mesh take() { return std::move(mesh_); }

  private:
    Mesh mesh_;
};

// Its front is at z = 0 and looks along +z; x goes from 0 to kTownHouseWidth, y from the floor.
struct TownHouse {
    int storeys = 2, columns = 3;
    bool shop = false;  // one wide window and an awning
    bool open = false;  // the door stands open
    glm::vec3 shutters{0.1f}, cloth{0.5f};
};
inline constexpr float kTownHouseWidth = 8, kTownHouseDepth = 9, kTownWall = 0.3f, kTownStorey = 3.2f;

struct TownHouseMeshes {
    Mesh walls;    // what is plastered outside
    Mesh roof;     // courses of tiles
    Mesh painted;  // rooms, frames, sills, shutters, door
    // Dark panes of upper floors: those behind which there is light at night, and the others.
    Mesh litPanes, panes;
};
TownHouseMeshes townHouse(const TownHouse& house);

Mesh townFurniture();                                               // of the front room on the ground floor
Mesh townTree(int leavesPerClump, float leaf, std::uint32_t seed);  // 6.5 m high
Mesh townLampPost();                                                // its globe is at kTownLampHeight
inline constexpr float kTownLampHeight = 4.15f;
Mesh townFountain();
Mesh townWater();
Mesh townBench();
Mesh townStall(glm::vec3 cloth);

}  // namespace conelight::io::generated
