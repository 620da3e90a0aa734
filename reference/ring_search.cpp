// SPDX-License-Identifier: MIT
#include "reference/ring_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "base/log.h"

namespace conelight::reference {
namespace {

using Share = SceneFit::Share;

constexpr double kLeastWeight = 0.02;
constexpr std::size_t kMostRings = 3;

// Sum over scenes of the quadratic form (SceneFit), as one.
struct Form {
    std::size_t rings = 0;
    std::vector<double> g, h;
    double c = 0;

    Form(std::span<const SceneFit> scenes, std::span<const double> scales) {
        rings = scenes.front().rings();
        g.assign(rings * rings, 0);
        h.assign(rings, 0);
        double count = 0;
        for (const double scale : scales) count += scale > 0 ? 1 : 0;
        for (std::size_t s = 0; s < scenes.size(); ++s) {
            const double scale = scales[s] / count;
            if (!(scale > 0)) continue;
            for (std::size_t i = 0; i < rings; ++i) {
                for (std::size_t j = 0; j < rings; ++j) g[i * rings + j] += scale * scenes[s].g(i, j);
                h[i] += scale * scenes[s].h(i);
            }
            c += scale * scenes[s].c();
        }
    }

    double at(std::span<const Share> set) const {
        double sum = c;
        for (const Share& a : set) {
            sum -= 2 * h[a.ring] * a.weight;
            for (const Share& b : set) sum += a.weight * b.weight * g[a.ring * rings + b.ring];
        }
        return sum;
    }
};

// Weights of least error that add up to 1, for one, two or three rings: w0 = 1 - the others, and the
// gradient over the others is 0. Nothing where a weight would be too small.
std::optional<std::vector<Share>> weighted(const Form& form, std::span<const std::size_t> rings) {
    const auto g = [&](std::size_t i, std::size_t j) { return form.g[rings[i] * form.rings + rings[j]]; };
    const auto slope = [&](std::size_t i) { return form.h[rings[i]] - form.h[rings[0]] - g(i, 0) + g(0, 0); };
    const auto curve = [&](std::size_t i, std::size_t j) { return g(i, j) - g(i, 0) - g(j, 0) + g(0, 0); };
    std::array<double, kMostRings> w{1, 0, 0};
    if (rings.size() == 2) {
        w[1] = slope(1) / curve(1, 1);
    } else if (rings.size() == 3) {
        const double det = curve(1, 1) * curve(2, 2) - curve(1, 2) * curve(1, 2);
        w[1] = (slope(1) * curve(2, 2) - slope(2) * curve(1, 2)) / det;
        w[2] = (slope(2) * curve(1, 1) - slope(1) * curve(1, 2)) / det;
    }
    w[0] = 1 - w[1] - w[2];
    std::vector<Share> shares;
    for (std::size_t i = 0; i < rings.size(); ++i) {
        if (!(w[i] >= kLeastWeight)) return std::nullopt;
        shares.push_back({rings[i], w[i]});
    }
    return shares;
}

// Goes through all ways to make `cones` of at most three rings that lie one outside the other.
class Search {
  public:
    Search(std::span<const Ring> rings, const Form& form) : rings_(rings), form_(form) {}

    FoundSet run(int cones) {
        best_ = {{}, std::numeric_limits<double>::infinity()};
        extend(cones);
        return best_;
    }

  private:
    // A set of two rings without a pole is one of "at most three rings"; one ring without a pole is no set.
    void extend(int conesLeft) {
        if (conesLeft == 0) {
            judge();
            return;
        }
        if (chosen_.size() == kMostRings) return;
        for (std::size_t i = 0; i < rings_.size(); ++i) {
            const bool pole = rings_[i].cones == 1;
            if (rings_[i].cones > conesLeft || pole != (chosen_.empty() && pole)) continue;
            if (!chosen_.empty() && !(rings_[i].tilt > rings_[chosen_.back()].tilt)) continue;
            if (chosen_.size() == 2 && rings_[chosen_.front()].cones != 1) continue;
            chosen_.push_back(i);
            extend(conesLeft - rings_[i].cones);
            chosen_.pop_back();
        }
    }

    void judge() {
        if (chosen_.size() < 2 && rings_[chosen_.front()].cones != 1) return;
        const std::optional<std::vector<Share>> shares = weighted(form_, chosen_);
        if (!shares) return;
        const double objective = form_.at(*shares);
        if (objective < best_.objective) best_ = {*shares, objective};
    }

    std::span<const Ring> rings_;
    const Form& form_;
    std::vector<std::size_t> chosen_;
    FoundSet best_;
};

bool finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace

std::vector<SetCone> conesOf(const Ring& ring, double turn) {
    std::vector<SetCone> cones;
    for (int i = 0; i < ring.cones; ++i) {
        const double azimuth = 2 * std::numbers::pi * (i + turn) / ring.cones;
        const double across = std::sin(double(ring.tilt));
        cones.push_back({glm::vec3(across * std::cos(azimuth), across * std::sin(azimuth),
                                   std::max(std::cos(double(ring.tilt)), 0.0)),
                         ring.aperture, 1.0f});
    }
    return cones;
}

SceneFit::SceneFit(std::span<const Image> byRing, const Image& truthA, const Image& truthB) {
    const std::size_t count = truthA.pixels.size();
    bool fits = truthB.pixels.size() == count;
    for (const Image& image : byRing) fits = fits && image.pixels.size() == count;
    if (!fits) base::fail(ErrorKind::BadInput, "pictures of one scene have different sizes");
    // Values of each ring one after the other, and of the truth; bad pixels are black in all.
    std::vector<std::vector<double>> values(byRing.size());
    std::vector<double> a, b;
    double sum = 0;
    for (std::size_t p = 0; p < count; ++p) {
        bool good = finite(truthA.pixels[p]) && finite(truthB.pixels[p]);
        for (const Image& image : byRing) good = good && finite(image.pixels[p]);
        if (!good) continue;
        for (int k = 0; k < 3; ++k) {
            a.push_back(double(truthA.pixels[p][k]));
            b.push_back(double(truthB.pixels[p][k]));
            sum += 0.5 * (a.back() + b.back());
            for (std::size_t r = 0; r < byRing.size(); ++r)
                values[r].push_back(double(byRing[r].pixels[p][k]));
        }
    }
    if (!(sum > 0)) base::fail(ErrorKind::BadInput, "the truth is black");
    const double n = double(a.size());
    const double scale = n / (sum * sum);  // 1 / (n m^2)
    const std::size_t rings = byRing.size();
    g_.assign(rings * rings, 0);
    h_.assign(rings, 0);
    for (std::size_t i = 0; i < rings; ++i) {
        for (std::size_t j = i; j < rings; ++j) {
            double dot = 0;
            for (std::size_t p = 0; p < a.size(); ++p) dot += values[i][p] * values[j][p];
            g_[i * rings + j] = g_[j * rings + i] = scale * dot;
        }
        for (std::size_t p = 0; p < a.size(); ++p) h_[i] += 0.5 * scale * values[i][p] * (a[p] + b[p]);
    }
    for (std::size_t p = 0; p < a.size(); ++p) c_ += scale * a[p] * b[p];
}

double SceneFit::relMse(std::span<const Share> set) const {
    double sum = c_;
    for (const Share& x : set) {
        sum -= 2 * h_[x.ring] * x.weight;
        for (const Share& y : set) sum += x.weight * y.weight * g(x.ring, y.ring);
    }
    return sum;
}

FoundSet bestSet(std::span<const Ring> rings, std::span<const SceneFit> scenes,
                 std::span<const double> scales, int cones) {
    return Search(rings, Form(scenes, scales)).run(cones);
}

}  // namespace conelight::reference
