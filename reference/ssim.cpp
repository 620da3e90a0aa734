// SPDX-License-Identifier: MIT
// Structural similarity: two planes in [0,1] -> mean SSIM.
// Wang, Bovik, Sheikh, Simoncelli, "Image Quality Assessment: From Error Visibility to Structural
// Similarity", 2004, eq. 13 to 17: 11x11 Gaussian windows of sigma 1.5 that lie within the picture. In a
// picture smaller than 11 pixels the window shrinks to what fits.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "reference/metric_parts.h"

namespace conelight::reference {
namespace {

constexpr int kWindow = 11;          // section III.C of the paper
constexpr double kSigma = 1.5;       // pixels, the same
constexpr double kC1 = 0.01 * 0.01;  // (K1 L)^2 with dynamic range L = 1, the same
constexpr double kC2 = 0.03 * 0.03;  // (K2 L)^2

std::vector<double> gaussian(int size) {
    std::vector<double> weights(static_cast<std::size_t>(size));
    double sum = 0;
    for (int i = 0; i < size; ++i) {
        const double x = i - (size - 1) / 2.0;
        sum += weights[std::size_t(i)] = std::exp(-x * x / (2 * kSigma * kSigma));
    }
    for (double& weight : weights) weight /= sum;
    return weights;
}

// Five moments and the weight of unusable pixels, filtered together.
using Moments = std::array<double, 6>;

double ssimOf(const Moments& m) {
    const double varianceX = m[2] - m[0] * m[0];
    const double varianceR = m[3] - m[1] * m[1];
    const double covariance = m[4] - m[0] * m[1];
    return (2 * m[0] * m[1] + kC1) * (2 * covariance + kC2) /
           ((m[0] * m[0] + m[1] * m[1] + kC1) * (varianceX + varianceR + kC2));
}

}  // namespace

double meanSsim(const std::vector<float>& test, const std::vector<float>& reference, int width, int height,
                const std::vector<std::uint8_t>& usable) {
    const std::vector<double> across = gaussian(std::min(kWindow, width));
    const std::vector<double> down = gaussian(std::min(kWindow, height));
    const int columns = width - int(across.size()) + 1;
    const int rows = height - int(down.size()) + 1;

    // Filter along rows.
    std::vector<Moments> filtered(std::size_t(columns) * std::size_t(height), Moments{});
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < columns; ++x) {
            Moments& sum = filtered[std::size_t(y) * std::size_t(columns) + std::size_t(x)];
            for (std::size_t k = 0; k < across.size(); ++k) {
                const std::size_t i = std::size_t(y) * std::size_t(width) + std::size_t(x) + k;
                const double w = across[k], a = test[i], b = reference[i];
                const Moments here = {a, b, a * a, b * b, a * b, usable[i] ? 0.0 : 1.0};
                for (std::size_t j = 0; j < here.size(); ++j) sum[j] += w * here[j];
            }
        }

    // Filter along columns, and average over the windows in which every pixel is usable.
    double total = 0;
    std::size_t count = 0;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            Moments sum{};
            for (std::size_t k = 0; k < down.size(); ++k) {
                const Moments& part = filtered[(std::size_t(y) + k) * std::size_t(columns) + std::size_t(x)];
                for (std::size_t j = 0; j < sum.size(); ++j) sum[j] += down[k] * part[j];
            }
            if (sum[5] > 0) continue;
            total += ssimOf(sum);
            ++count;
        }
    return count ? total / static_cast<double>(count) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace conelight::reference
