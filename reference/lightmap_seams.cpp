// SPDX-License-Identifier: MIT
// Unknown are the texels that lookups along seams read. Differences of both sides count fully, changes of a texel
// a little; the normal equations are solved by conjugate gradients.
#include "reference/lightmap_seams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

namespace conelight::reference {
namespace {

constexpr double kStay = 0.05;  // weight of a texel's own value against that of a lookup's difference
constexpr int kSteps = 200;
constexpr double kLeastGain = 1e-8;  // of the residual's square, relative: done

struct Footprint {
    std::array<std::size_t, 4> texel{};
    std::array<float, 4> weight{};
};

Footprint footprint(const glm::ivec2& size, const glm::vec2& at) {
    const glm::vec2 p = glm::clamp(at - 0.5f, glm::vec2(0), glm::vec2(size - 1));
    const glm::ivec2 low = glm::min(glm::ivec2(p), glm::max(size - 2, glm::ivec2(0)));
    const glm::ivec2 high = glm::min(low + 1, size - 1);
    const glm::vec2 f = p - glm::vec2(low);
    const auto index = [&](int x, int y) {
        return static_cast<std::size_t>(x) + static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x);
    };
    return {{index(low.x, low.y), index(high.x, low.y), index(low.x, high.y), index(high.x, high.y)},
            {(1 - f.x) * (1 - f.y), f.x * (1 - f.y), (1 - f.x) * f.y, f.x * f.y}};
}

// One lookup's difference: sum of weights times unknowns.
using Row = std::array<std::pair<std::size_t, double>, 8>;

class System {
  public:
    System(const glm::ivec2& size, const std::vector<Seam>& seams) : size_(size) {
        for (const Seam& seam : seams) {
            const float length = std::max(glm::distance(seam.one[0], seam.one[1]),
                                          glm::distance(seam.other[0], seam.other[1]));
            const int steps = std::max(1, static_cast<int>(std::ceil(2 * length)));
            for (int i = 0; i <= steps; ++i) {
                const float t = static_cast<float>(i) / static_cast<float>(steps);
                add(glm::mix(seam.one[0], seam.one[1], t), glm::mix(seam.other[0], seam.other[1], t));
            }
        }
    }
    const std::vector<std::size_t>& texels() const { return texels_; }

    // Of the normal equations: times a vector.
    std::vector<double> times(const std::vector<double>& x) const {
        std::vector<double> result(x.size());
        for (std::size_t i = 0; i < x.size(); ++i) result[i] = kStay * x[i];
        for (const Row& row : rows_) {
            double sum = 0;
            for (const auto& [at, weight] : row) sum += weight * x[at];
            for (const auto& [at, weight] : row) result[at] += weight * sum;
        }
        return result;
    }

  private:
    std::size_t unknown(std::size_t texel) {
        const auto [found, isNew] = unknownOf_.emplace(texel, texels_.size());
        if (isNew) texels_.push_back(texel);
        return found->second;
    }
    void add(const glm::vec2& one, const glm::vec2& other) {
        Row row;
        const Footprint a = footprint(size_, one), b = footprint(size_, other);
        for (std::size_t i = 0; i < 4; ++i) {
            row[i] = {unknown(a.texel[i]), static_cast<double>(a.weight[i])};
            row[4 + i] = {unknown(b.texel[i]), -static_cast<double>(b.weight[i])};
        }
        rows_.push_back(row);
    }

    glm::ivec2 size_;
    std::vector<Row> rows_;
    std::vector<std::size_t> texels_;
    std::unordered_map<std::size_t, std::size_t> unknownOf_;
};

double dot(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

// (A^T A + k) x = k x0, from x0.
void solve(const System& system, std::vector<double>& x) {
    std::vector<double> residual = system.times(x);
    for (std::size_t i = 0; i < x.size(); ++i) residual[i] = kStay * x[i] - residual[i];
    std::vector<double> way = residual;
    double square = dot(residual, residual);
    const double enough = square * kLeastGain;
    for (int step = 0; step < kSteps && square > enough; ++step) {
        const std::vector<double> moved = system.times(way);
        const double length = square / dot(way, moved);
        for (std::size_t i = 0; i < x.size(); ++i) {
            x[i] += length * way[i];
            residual[i] -= length * moved[i];
        }
        const double next = dot(residual, residual);
        for (std::size_t i = 0; i < x.size(); ++i) way[i] = residual[i] + next / square * way[i];
        square = next;
    }
}

}  // namespace

void stitchSeams(std::vector<glm::vec3>& texels, const glm::ivec2& size, const std::vector<Seam>& seams) {
    if (seams.empty()) return;
    const System system(size, seams);
    std::vector<double> x(system.texels().size());
    for (int channel = 0; channel < 3; ++channel) {
        for (std::size_t i = 0; i < x.size(); ++i)
            x[i] = static_cast<double>(texels[system.texels()[i]][channel]);
        solve(system, x);
        for (std::size_t i = 0; i < x.size(); ++i)
            texels[system.texels()[i]][channel] = static_cast<float>(std::max(x[i], 0.0));
    }
}

glm::vec3 bilinear(const std::vector<glm::vec3>& texels, const glm::ivec2& size, const glm::vec2& at) {
    const Footprint read = footprint(size, at);
    glm::vec3 sum(0);
    for (std::size_t i = 0; i < 4; ++i) sum += texels[read.texel[i]] * read.weight[i];
    return sum;
}

}  // namespace conelight::reference
