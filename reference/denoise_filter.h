// SPDX-License-Identifier: MIT
// The regression of denoise.h: noisy signals + features -> two filtered candidates of each signal.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

namespace conelight::reference {

// What neighbours are judged by. One entry per pixel, rows from the top.
struct GuideTable {
    int width = 0, height = 0;
    std::vector<glm::vec3> normal;
    std::vector<float> distance;   // along the ray, m; 0: nothing seen
    std::vector<glm::vec2> slope;  // of the distance, m per pixel to the right and down, at least
    std::vector<glm::vec3> albedo;

    std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

// One half of one part of the light.
struct NoisySignal {
    std::vector<glm::vec3> color, variance;  // of the pixel's mean
};

// Candidates of one signal.
struct FilteredSignal {
    std::vector<glm::vec3> byColor, byFeatures;
};

// The same bits for any number of threads.
std::vector<FilteredSignal> filterSignals(const GuideTable& guide, const std::vector<NoisySignal>& signals,
                                          int threads);

}  // namespace conelight::reference
