// SPDX-License-Identifier: MIT
// Boxes round a session's meshes, each computed once for what it is.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "session/session.h"

namespace conelight::program {

class MeshBounds {
  public:
    const Aabb& of(const Session& session, std::size_t mesh);
    Aabb ofInstance(const Session& session, std::size_t instance);  // world
    Aabb ofScene(const Session& session);                           // all that is visible

  private:
    struct Known {
        std::uint64_t revision = 0;
        Aabb box;
    };
    std::uint64_t scene_ = 0;
    std::vector<std::optional<Known>> meshes_;
    std::optional<std::uint64_t> tables_;  // of `all_`
    Aabb all_;
};

}  // namespace conelight::program
