// SPDX-License-Identifier: MIT
// The outline of the selected object over the picture: edges between a triangle that faces the eye and one
// that does not, or none. Those behind other objects are drawn, too. Of very large meshes the box round them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "session/session.h"

namespace conelight::program {

class SelectionOutline {
  public:
    // Into the current ImGui window.
    void draw(const Session& session, const glm::vec2& at, const glm::vec2& size);

  private:
    struct Edge {
        std::array<std::uint32_t, 2> ends{};  // vertices
        std::array<int, 2> triangles{-1, -1};
    };
    void findEdges(const Mesh& mesh);
    std::vector<std::array<glm::vec3, 2>> lines(const Session& session);

    std::vector<Edge> edges_;  // of the mesh that was drawn last
    std::optional<std::size_t> mesh_;
    std::uint64_t scene_ = 0;
};

}  // namespace conelight::program
