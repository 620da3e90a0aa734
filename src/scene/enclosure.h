// SPDX-License-Identifier: MIT
// The part of a scene from which hardly anything outside is seen. Of rooms it is what there is to see, and from
// outside they are boxes.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "conelight/scene.h"
#include "scene/coarse_grid.h"

namespace conelight::scene {

class Enclosure {
  public:
    Enclosure(const Scene& scene, const Aabb& bounds);

    // Its part of the bounds. Things that are hollow have up to a quarter: a helmet, a pot, a hare.
    float share() const { return share_; }
    // Unit vector along x or z: where one side is missing, as of a stage.
    std::optional<glm::vec3> openSide() const;
    // Whether a good part of the scene's detail is inside. Things have up to a twentieth there.
    bool isFurnished() const { return detail_ > 0.2f; }
    bool hasWindows() const { return open_ > 0; }
    // Whether a point, m, is inside or next to it.
    bool contains(const glm::vec3& p) const { return !cellsAbout(p).empty(); }
    // Of several rooms, leaves those in which these lamps are, m, if they are in any.
    void keepRoomsOf(const std::vector<glm::vec3>& lamps);

    // At the height of an eye, where most is seen, and one of these lamps from there if that can be; none where there
    // is no place for it.
    std::optional<Camera> cameraInside(const std::vector<glm::vec3>& lamps) const;
    // A place for a lamp under the ceiling.
    struct Lamp {
        glm::vec3 position;  // m
        float height;        // above what is below it, m
    };
    Lamp lamp() const;

  private:
    static constexpr std::size_t kDirections = 32;
    struct Cell {
        glm::ivec3 index;
        float below, above;  // how far it is to a surface, m
    };
    std::size_t at(const glm::ivec3& cell) const;
    bool isInside(const glm::ivec3& cell) const { return inside_[at(cell)] != 0; }
    bool isSeenFromOutside(const glm::ivec3& cell) const;
    std::vector<glm::ivec3> cellsAbout(const glm::vec3& p) const;
    std::vector<glm::ivec3> roomOf(const glm::ivec3& cell) const;
    void findInside();
    void findDetail();
    std::vector<Cell> placesOfEyes() const;
    float clearance(const glm::ivec3& cell) const;
    bool sees(const glm::ivec3& cell, const glm::vec3& p) const;

    CoarseGrid grid_;
    std::array<glm::vec3, kDirections> directions_;
    std::vector<char> inside_;  // of cells
    float share_ = 0;           // of all cells
    float sheltered_ = 0;       // of all cells, those that most directions do not leave
    float detail_ = 0;          // part of triangles' corners that are not seen from outside
    float open_ = 0;            // of all directions from inside, those that lead outside
    // Of sheltered cells, those from which one looks outside along +x, -x, +z, -z.
    std::array<float, 4> ways_{};
};

}  // namespace conelight::scene
