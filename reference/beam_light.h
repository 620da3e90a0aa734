// SPDX-License-Identifier: MIT
// What comes back along one line of a beam: place in the picture + beam + what it ends on -> radiance. The line goes by
// way of the beam's mirrors; light and materials are those of the path tracer.
#pragma once

#include <vector>

#include "reference/beam_tree.h"
#include "scene/surroundings.h"

namespace conelight::reference {

class BeamLight {
  public:
    // All must outlive it.
    BeamLight(const BeamScene& scene, const BeamTree& tree, const Lens& lens);

    static constexpr int kOwn = -1;  // emission, or the surroundings
    struct Query {
        int beam = 0;
        std::uint32_t polygon = kNoPolygon;
        int lamp = kOwn;  // of lamps(): what it adds, nothing in its way
    };
    // `place`: in the picture, [-1,1]^2 with y up. `turn` moves where the first surface's textures are read
    // (surfaceAt). Thread-safe.
    glm::vec3 radiance(const glm::dvec2& place, const Query& query, const glm::vec3& turn) const;

  private:
    struct Line {
        glm::dvec3 origin{0}, direction{0};  // unit
        glm::vec3 throughput{1};
    };
    Surface meet(const BeamPolygon& polygon, Line& line, const glm::vec3& turn) const;
    Line throughMirrors(const glm::dvec2& place, int beam, glm::vec3& turn) const;
    glm::vec3 reflectedLight(const Surface& surface, const glm::vec3& toEye, const BeamLamp& lamp) const;

    const BeamScene& scene_;
    const Lens& lens_;
    scene::Surroundings surroundings_;
    std::vector<std::vector<std::uint32_t>> mirrors_;  // of each beam, the first first
};

}  // namespace conelight::reference
