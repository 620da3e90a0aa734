// SPDX-License-Identifier: MIT
// Which set of cones gathers light best: pictures by one ring of cones each, against the truth -> rings and
// weights. A picture gathered by several rings is the weighted sum of theirs, so every set is judged without
// being drawn. Method: docs/theory/4a_cones.md, "Sets by search".
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "conelight/renderer.h"
#include "conelight/settings.h"

namespace conelight::reference {

// Equal cones about the normal, at even azimuths; one cone: along it.
struct Ring {
    int cones = 1;
    float tilt = 0;      // from the normal, rad
    float aperture = 1;  // full angle, rad
    bool operator==(const Ring&) const = default;
};
// The ring as a set of its own. `turn`: of its first cone, as a part of the way to the next.
std::vector<SetCone> conesOf(const Ring& ring, double turn = 0.25);

// What one scene says of every ring: with x the picture by rings of the weights w (sum 1), a and b two
// independent pictures of the truth and m its mean,
//     relMSE(w) = mean((x - a)(x - b)) / m^2 = w' G w - 2 h' w + c.
class SceneFit {
  public:
    // Throws Error(BadInput) for pictures of different sizes or a black truth. Pixels that are not finite are
    // left out.
    SceneFit(std::span<const Image> byRing, const Image& truthA, const Image& truthB);

    struct Share {
        std::size_t ring;
        double weight;
    };
    double relMse(std::span<const Share> set) const;

    std::size_t rings() const { return h_.size(); }
    double g(std::size_t i, std::size_t j) const { return g_[i * h_.size() + j]; }
    double h(std::size_t i) const { return h_[i]; }
    double c() const { return c_; }

  private:
    std::vector<double> g_, h_;
    double c_ = 0;
};

struct FoundSet {
    std::vector<SceneFit::Share> shares;  // in the order of tilt; weights add up to 1
    double objective = 0;                 // mean over scenes of relMSE times the scene's scale
};

// The best set of `cones` cones: a pole with one or two rings, or two rings. `scales`: one per scene, 0 leaves
// it out. Weights are at least 0.02 each. Nothing found: no shares.
FoundSet bestSet(std::span<const Ring> rings, std::span<const SceneFit> scenes,
                 std::span<const double> scales, int cones);

}  // namespace conelight::reference
