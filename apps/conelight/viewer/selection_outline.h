// SPDX-License-Identifier: MIT
// The outline of the selected objects over the picture: edges between a triangle that faces the eye and one that does
// not, or none; of many triangles the line round the pixels that they cover, and boxes while the camera moves. What
// lies behind other objects is outlined, too. Lights have shapes of their own (light_shapes.h).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <vector>

#include "platform/picture_texture.h"
#include "session/mesh_bounds.h"
#include "session/session.h"

namespace conelight::program {

class SelectionOutline {
  public:
    // Into the current ImGui window. `moving`: what takes long waits.
    void draw(const Session& session, MeshBounds& bounds, const glm::vec2& at, const glm::vec2& size,
              bool moving);

  private:
    using Line = std::array<glm::vec3, 2>;
    struct Edge {
        std::array<std::uint32_t, 2> ends{};  // vertices
        std::array<int, 2> triangles{-1, -1};
    };
    struct MeshEdges {
        std::uint64_t revision = 0;
        std::vector<Edge> edges;
    };
    const std::vector<Edge>& edgesOf(const Session& session, std::size_t mesh);
    void addLines(const Session& session, const Instance& instance, std::vector<Line>& lines);
    void drawCovered(const Session& session, const std::vector<std::size_t>& objects, const glm::vec2& at,
                     const glm::vec2& size);

    std::map<std::size_t, MeshEdges> edges_;  // of meshes that were drawn
    std::uint64_t scene_ = 0;
    platform::PictureTexture covered_;
    // What it was drawn for.
    Camera camera_;
    std::array<std::uint64_t, 2> revisions_{};
    glm::ivec2 sizePx_{0};
};

}  // namespace conelight::program
