// SPDX-License-Identifier: MIT
// Tiles of 16 x 16 pixels. Per tile: weights of all neighbours by features, once; per signal weights by colours
// (non-local means: Buades, Coll and Morel 2005; with the variances of Rousselle et al. 2012, "Adaptive
// Rendering with Non-Local Means Filtering"); per pixel the normal equations of a weighted plane, solved by
// Cholesky's method. Products of features stand ready per
// pixel, so that a neighbour costs 52 multiplications.
#include "reference/denoise_filter.h"

#include <algorithm>
#include <cmath>

#include "reference/radiosity_parallel.h"

namespace conelight::reference {
namespace {

constexpr int kFilterTile = 16;
// By measured error on scenes cornell, study, spheres, atrium and mirror-hall, 192 x 144 pixels, 64 samples.
constexpr int kRadius = 7;              // of the window, pixels
constexpr int kPatch = 2;               // of the squares whose colours are compared, pixels
constexpr float kColorDistance = 0.7f;  // how unlike colours may be, in standard deviations of their noise
constexpr float kNormalSpread = 0.2f;   // of unit vectors' difference
constexpr float kDepthSpread = 1.5f;    // of distances, in steps of the surface's slope
constexpr float kAlbedoSpread = 0.3f;
// Added to the features' variances: a slope needs neighbours that differ.
constexpr double kRidge = 1e-3;
constexpr float kLargestExponent = 20;  // exponents beyond weigh nothing

constexpr int kTerms = 7;                           // 1, x, y, normal, albedo
constexpr int kMatrix = kTerms * (kTerms + 1) / 2;  // 28: its upper triangle, row by row
constexpr int kSums = 52;  // + 3 channels of each term = 49, and up to a multiple of 4
using Sums = std::array<float, kSums>;
using Weights = std::vector<float>;  // [offset][pixel of the tile]

struct Tile {
    int x0, y0, x1, y1;
    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }
};

struct Offset {
    int x, y;
};

std::vector<Offset> offsetsOfWindow() {
    std::vector<Offset> offsets;
    for (int y = -kRadius; y <= kRadius; ++y)
        for (int x = -kRadius; x <= kRadius; ++x) offsets.push_back({x, y});
    return offsets;
}

class TileFilter {
  public:
    TileFilter(const GuideTable& guide, const std::vector<NoisySignal>& signals,
               std::vector<FilteredSignal>& results)
        : guide_(guide), signals_(signals), results_(results), offsets_(offsetsOfWindow()) {}

    void run(const Tile& tile);

  private:
    std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(guide_.width) +
               static_cast<std::size_t>(x);
    }
    bool inside(int x, int y) const { return x >= 0 && y >= 0 && x < guide_.width && y < guide_.height; }
    float featureWeight(std::size_t p, std::size_t q, const Offset& offset) const;
    void weighByFeatures(const Tile& tile);
    void weighByColors(const Tile& tile, const NoisySignal& signal);
    void distances(const Tile& tile, const NoisySignal& signal, const Offset& offset);
    void prepareProducts(const Tile& tile, const NoisySignal& signal);
    glm::vec3 fit(const Tile& tile, int x, int y, const Weights& weights) const;

    const GuideTable& guide_;
    const std::vector<NoisySignal>& signals_;
    std::vector<FilteredSignal>& results_;
    std::vector<Offset> offsets_;
    Weights byFeatures_, byColors_;
    std::vector<float> distances_, rows_;  // of a tile and a patch's border; summed along x
    std::vector<Sums> products_;           // of a tile and the window's border
};

float TileFilter::featureWeight(std::size_t p, std::size_t q, const Offset& offset) const {
    const glm::vec3 turned = guide_.normal[p] - guide_.normal[q];
    float exponent = glm::dot(turned, turned) / (2 * kNormalSpread * kNormalSpread);
    const float dp = guide_.distance[p], dq = guide_.distance[q];
    if ((dp > 0) != (dq > 0)) return 0;
    const float expected = guide_.slope[p].x * static_cast<float>(std::abs(offset.x)) +
                           guide_.slope[p].y * static_cast<float>(std::abs(offset.y));
    const float apart = std::abs(dp - dq) / (kDepthSpread * (expected + 0.002f * dp) + 1e-12f);
    exponent += 0.5f * apart * apart;
    const glm::vec3 colored = guide_.albedo[p] - guide_.albedo[q];
    exponent += glm::dot(colored, colored) / (2 * kAlbedoSpread * kAlbedoSpread);
    return exponent < kLargestExponent ? std::exp(-exponent) : 0.0f;
}

void TileFilter::weighByFeatures(const Tile& tile) {
    float* weight = byFeatures_.data();
    for (const Offset& offset : offsets_)
        for (int y = tile.y0; y < tile.y1; ++y)
            for (int x = tile.x0; x < tile.x1; ++x, ++weight)
                *weight = inside(x + offset.x, y + offset.y)
                              ? featureWeight(at(x, y), at(x + offset.x, y + offset.y), offset)
                              : 0.0f;
}

// Squared differences of colours in units of their noise, less what noise alone makes (Rousselle et al. 2012,
// eq. 5), of the tile and a border. Pixels beyond the picture are those at its edge.
void TileFilter::distances(const Tile& tile, const NoisySignal& signal, const Offset& offset) {
    const auto clamped = [&](int x, int y) {
        return at(std::clamp(x, 0, guide_.width - 1), std::clamp(y, 0, guide_.height - 1));
    };
    float* out = distances_.data();
    for (int y = tile.y0 - kPatch; y < tile.y1 + kPatch; ++y)
        for (int x = tile.x0 - kPatch; x < tile.x1 + kPatch; ++x, ++out) {
            const std::size_t p = clamped(x, y), q = clamped(x + offset.x, y + offset.y);
            const glm::vec3 &vp = signal.variance[p], &vq = signal.variance[q];
            const glm::vec3 d = signal.color[p] - signal.color[q];
            const glm::vec3 both = vp + vq, scale = kColorDistance * kColorDistance * both + 1e-20f +
                                                    1e-6f * signal.color[p] * signal.color[p];
            const glm::vec3 parts = (d * d - (vp + glm::min(vp, vq))) / scale;
            *out = (parts.r + parts.g + parts.b) / 3.0f;
        }
}

void TileFilter::weighByColors(const Tile& tile, const NoisySignal& signal) {
    const int w = tile.width(), h = tile.height(), wide = w + 2 * kPatch, high = h + 2 * kPatch;
    const float scale = 1.0f / static_cast<float>((2 * kPatch + 1) * (2 * kPatch + 1));
    const float* feature = byFeatures_.data();
    float* weight = byColors_.data();
    for (const Offset& offset : offsets_) {
        distances(tile, signal, offset);
        // Sums over patches, along x, then along y.
        for (int y = 0; y < high; ++y)
            for (int x = 0; x < w; ++x) {
                float sum = 0;
                for (int i = 0; i <= 2 * kPatch; ++i)
                    sum += distances_[static_cast<std::size_t>(y * wide + x + i)];
                rows_[static_cast<std::size_t>(y * w + x)] = sum;
            }
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x, ++weight, ++feature) {
                float sum = 0;
                for (int i = 0; i <= 2 * kPatch; ++i) sum += rows_[static_cast<std::size_t>((y + i) * w + x)];
                const float distance = std::max(sum * scale, 0.0f);
                *weight = *feature > 0 && distance < kLargestExponent ? *feature * std::exp(-distance) : 0.0f;
            }
    }
}

void TileFilter::prepareProducts(const Tile& tile, const NoisySignal& signal) {
    const int wide = tile.width() + 2 * kRadius;
    const float middleX = 0.5f * static_cast<float>(tile.x0 + tile.x1),
                middleY = 0.5f * static_cast<float>(tile.y0 + tile.y1);
    for (int y = std::max(tile.y0 - kRadius, 0); y < std::min(tile.y1 + kRadius, guide_.height); ++y)
        for (int x = std::max(tile.x0 - kRadius, 0); x < std::min(tile.x1 + kRadius, guide_.width); ++x) {
            const std::size_t p = at(x, y);
            Sums& sums =
                products_[static_cast<std::size_t>((y - tile.y0 + kRadius) * wide + x - tile.x0 + kRadius)];
            const glm::vec3 n = guide_.normal[p], c = signal.color[p];
            const float f[kTerms] = {1,
                                     (static_cast<float>(x) - middleX) / static_cast<float>(kRadius),
                                     (static_cast<float>(y) - middleY) / static_cast<float>(kRadius),
                                     n.x,
                                     n.y,
                                     n.z,
                                     (guide_.albedo[p].r + guide_.albedo[p].g + guide_.albedo[p].b) / 3.0f};
            int k = 0;
            for (int i = 0; i < kTerms; ++i)
                for (int j = i; j < kTerms; ++j) sums[static_cast<std::size_t>(k++)] = f[i] * f[j];
            for (int i = 0; i < kTerms; ++i)
                for (int channel = 0; channel < 3; ++channel)
                    sums[static_cast<std::size_t>(k++)] = f[i] * c[channel];
            while (k < kSums) sums[static_cast<std::size_t>(k++)] = 0;
        }
}

// covariance x = side for three sides at once, by Cholesky's factors, in place.
constexpr int kSlopes = kTerms - 1;
struct Equations {
    double covariance[kSlopes][kSlopes];
    double side[kSlopes][3];

    void solve() {
        for (int i = 0; i < kSlopes; ++i) {
            for (int j = 0; j <= i; ++j) {
                double sum = covariance[i][j];
                for (int m = 0; m < j; ++m) sum -= covariance[i][m] * covariance[j][m];
                covariance[i][j] = i == j ? std::sqrt(std::max(sum, 1e-12)) : sum / covariance[j][j];
            }
            for (double& value : side[i]) {
                const auto c = &value - side[i];
                for (int m = 0; m < i; ++m) value -= covariance[i][m] * side[m][c];
                value /= covariance[i][i];
            }
        }
        for (int i = kSlopes - 1; i >= 0; --i)
            for (double& value : side[i]) {
                const auto c = &value - side[i];
                for (int m = i + 1; m < kSlopes; ++m) value -= covariance[m][i] * side[m][c];
                value /= covariance[i][i];
            }
    }
};

// The weighted plane at the pixel whose own terms are `own`; no less than 0.
glm::vec3 planeAt(const Sums& sums, const Sums& own) {
    const double weight = static_cast<double>(sums[0]);
    const auto mean = [&](int k) { return static_cast<double>(sums[static_cast<std::size_t>(k)]) / weight; };
    Equations equations;
    int k = kTerms;
    for (int i = 0; i < kSlopes; ++i) {
        for (int j = i; j < kSlopes; ++j, ++k)
            equations.covariance[i][j] = equations.covariance[j][i] = mean(k) - mean(i + 1) * mean(j + 1);
        equations.covariance[i][i] += kRidge;
        for (int c = 0; c < 3; ++c)
            equations.side[i][c] = mean(kMatrix + 3 * (i + 1) + c) - mean(i + 1) * mean(kMatrix + c);
    }
    equations.solve();
    glm::vec3 value(0);
    for (int c = 0; c < 3; ++c) {
        double sum = mean(kMatrix + c);
        for (int i = 0; i < kSlopes; ++i)
            sum += equations.side[i][c] *
                   (static_cast<double>(own[static_cast<std::size_t>(i + 1)]) - mean(i + 1));
        value[c] = static_cast<float>(std::max(sum, 0.0));
    }
    return value;
}

glm::vec3 TileFilter::fit(const Tile& tile, int x, int y, const Weights& weights) const {
    const int wide = tile.width() + 2 * kRadius;
    const auto pixels = static_cast<std::size_t>(tile.width() * tile.height());
    const float* weight = &weights[static_cast<std::size_t>((y - tile.y0) * tile.width() + x - tile.x0)];
    const auto own = static_cast<std::ptrdiff_t>((y - tile.y0 + kRadius) * wide + x - tile.x0 + kRadius);
    Sums sums{};
    for (const Offset& offset : offsets_) {
        const float w = *weight;
        weight += pixels;
        if (!(w > 0)) continue;
        const Sums& of = products_[static_cast<std::size_t>(own + offset.y * wide + offset.x)];
        for (std::size_t k = 0; k < kSums; ++k) sums[k] += w * of[k];
    }
    return planeAt(sums, products_[static_cast<std::size_t>(own)]);
}

void TileFilter::run(const Tile& tile) {
    const auto pixels = static_cast<std::size_t>(tile.width() * tile.height());
    byFeatures_.resize(offsets_.size() * pixels);
    byColors_.resize(offsets_.size() * pixels);
    const auto bordered = [&](int border) {
        return static_cast<std::size_t>((tile.width() + 2 * border) * (tile.height() + 2 * border));
    };
    distances_.resize(bordered(kPatch));
    rows_.resize(bordered(kPatch));
    products_.resize(bordered(kRadius));
    weighByFeatures(tile);
    for (std::size_t s = 0; s < signals_.size(); ++s) {
        prepareProducts(tile, signals_[s]);
        weighByColors(tile, signals_[s]);
        for (int y = tile.y0; y < tile.y1; ++y)
            for (int x = tile.x0; x < tile.x1; ++x) {
                results_[s].byColor[at(x, y)] = fit(tile, x, y, byColors_);
                results_[s].byFeatures[at(x, y)] = fit(tile, x, y, byFeatures_);
            }
    }
}

}  // namespace

std::vector<FilteredSignal> filterSignals(const GuideTable& guide, const std::vector<NoisySignal>& signals,
                                          int threads) {
    std::vector<FilteredSignal> results(signals.size());
    for (FilteredSignal& result : results) {
        result.byColor.resize(guide.pixels());
        result.byFeatures.resize(guide.pixels());
    }
    const int tilesX = (guide.width + kFilterTile - 1) / kFilterTile,
              tilesY = (guide.height + kFilterTile - 1) / kFilterTile;
    const auto some = [&](std::size_t begin, std::size_t end) {
        TileFilter filter(guide, signals, results);
        for (std::size_t i = begin; i < end; ++i) {
            const int x0 = static_cast<int>(i) % tilesX * kFilterTile,
                      y0 = static_cast<int>(i) / tilesX * kFilterTile;
            filter.run(
                {x0, y0, std::min(x0 + kFilterTile, guide.width), std::min(y0 + kFilterTile, guide.height)});
        }
    };
    parallelFor(static_cast<std::size_t>(tilesX * tilesY), threads, some, {}, 1);
    return results;
}

}  // namespace conelight::reference
