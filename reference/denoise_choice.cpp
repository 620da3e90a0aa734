// SPDX-License-Identifier: MIT
// Errors are averaged over a square around the pixel without the pixel itself: a choice that followed its own
// noise would look better than it is, to itself and to the estimate of the noise that is left. The noise of
// neighbours is independent. What is one pixel small shows in no neighbour: a candidate that is further from the
// pixel than its noise explains is out.
#include "reference/denoise_choice.h"

#include <algorithm>

namespace conelight::reference {
namespace {

constexpr int kChoiceRadius = 3;      // pixels; by measured error, among 3 and 5
constexpr int kNoiseRadius = 2;       // pixels
constexpr float kMostDeviations = 8;  // standard deviations of the pixel's noise

std::size_t indexOf(int x, int y, int width) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
}

float sumOf(const glm::vec3& c) { return c.r + c.g + c.b; }

// Squared distance that noise explains: of the pixel's own halves or its neighbours', whichever is more.
std::vector<float> farthest(const HalfColors& raw, int width, int height) {
    std::vector<float> own(raw[0].size());
    for (std::size_t i = 0; i < own.size(); ++i) {
        const glm::vec3 difference = raw[0][i] - raw[1][i];
        own[i] = 0.25f * sumOf(difference * difference);
    }
    std::vector<float> result = smoothed(own, width, height, kNoiseRadius);
    for (std::size_t i = 0; i < own.size(); ++i)
        result[i] = kMostDeviations * kMostDeviations * std::max(result[i], own[i]);
    return result;
}

}  // namespace

template <class Value>
std::vector<Value> smoothed(const std::vector<Value>& values, int width, int height, int radius) {
    std::vector<Value> rows(values.size()), result(values.size());
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const int first = std::max(x - radius, 0), last = std::min(x + radius, width - 1);
            Value sum(0);
            for (int i = first; i <= last; ++i) sum += values[indexOf(i, y, width)];
            rows[indexOf(x, y, width)] = sum / static_cast<float>(last - first + 1);
        }
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const int first = std::max(y - radius, 0), last = std::min(y + radius, height - 1);
            Value sum(0);
            for (int i = first; i <= last; ++i) sum += rows[indexOf(x, i, width)];
            result[indexOf(x, y, width)] = sum / static_cast<float>(last - first + 1);
        }
    return result;
}

template std::vector<float> smoothed(const std::vector<float>&, int, int, int);
template std::vector<glm::vec3> smoothed(const std::vector<glm::vec3>&, int, int, int);

// Summed one by one: less a bright pixel, a sum that held it would be rounding alone.
std::vector<float> meanAround(const std::vector<float>& values, int width, int height, int radius) {
    std::vector<float> result(values.size());
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            float sum = 0;
            int count = 0;
            for (int j = std::max(y - radius, 0); j <= std::min(y + radius, height - 1); ++j)
                for (int i = std::max(x - radius, 0); i <= std::min(x + radius, width - 1); ++i)
                    if (i != x || j != y) {
                        sum += values[indexOf(i, j, width)];
                        ++count;
                    }
            result[indexOf(x, y, width)] = count > 0 ? sum / static_cast<float>(count) : 0.0f;
        }
    return result;
}

HalfColors leastError(const std::array<const HalfColors*, 3>& candidates, int width, int height) {
    const HalfColors& raw = *candidates[0];
    const std::size_t count = raw[0].size();
    std::array<std::vector<float>, 3> error;
    for (std::size_t c = 0; c < 3; ++c) {
        std::vector<float> own(count);
        for (std::size_t i = 0; i < count; ++i) {
            const glm::vec3 e = errorOf(raw[0][i], raw[1][i], (*candidates[c])[0][i], (*candidates[c])[1][i]);
            own[i] = sumOf(e);
        }
        error[c] = meanAround(own, width, height, kChoiceRadius);
    }
    const std::vector<float> limit = farthest(raw, width, height);
    HalfColors result = raw;
    for (std::size_t i = 0; i < count; ++i) {
        std::size_t best = 0;
        for (std::size_t c = 1; c < 3; ++c) {
            const HalfColors& one = *candidates[c];
            const glm::vec3 moved = 0.5f * (one[0][i] + one[1][i] - raw[0][i] - raw[1][i]);
            if (sumOf(moved * moved) <= limit[i] && error[c][i] < error[best][i]) best = c;
        }
        for (std::size_t h = 0; h < 2; ++h) result[h][i] = (*candidates[best])[h][i];
    }
    return result;
}

}  // namespace conelight::reference
