// SPDX-License-Identifier: MIT
// Lights over the picture: an icon each, which a click selects, the rectangle, the cone of a spot, the arrow of a
// directional light, the range of a point light that is selected. Also those behind surfaces. A directional light
// has no place: its icon stands where it comes from, at the picture's edge when that is outside.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "session/mesh_bounds.h"
#include "session/session.h"

namespace conelight::program {

class LightShapes {
  public:
    bool shown = true;
    // Into the current ImGui window, over the picture at `at`; the icon under the mouse stands out when `hovered`.
    void draw(const Session& session, MeshBounds& bounds, const glm::vec2& at, const glm::vec2& size,
              bool hovered);
    // The light whose icon is at this part of the picture; of several the nearest.
    std::optional<std::size_t> at(const glm::vec2& part) const;

  private:
    struct Icon {
        std::size_t light = 0;
        glm::vec2 part{0};
        glm::vec3 place{0};  // world
    };
    void placeIcons(const Session& session, const Aabb& scene);

    std::vector<Icon> icons_;  // as drawn last
    glm::vec2 size_{1};
};

}  // namespace conelight::program
