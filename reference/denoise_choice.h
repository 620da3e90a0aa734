// SPDX-License-Identifier: MIT
// Candidates of one part of the light -> for each pixel the one that the halves show the least error for.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

namespace conelight::reference {

using HalfColors = std::array<std::vector<glm::vec3>, 2>;  // of both halves, rows from the top

// Means over squares of 2 radius + 1 pixels, fewer at the picture's edges. Value: float or glm::vec3.
template <class Value>
std::vector<Value> smoothed(const std::vector<Value>& values, int width, int height, int radius);

// As smoothed, without the pixel itself.
std::vector<float> meanAround(const std::vector<float>& values, int width, int height, int radius);

// Estimated squared error of the mean of two filtered halves, from halves a and b as they came: its expected
// value is the error, as long as no filtered half depends on the other one (denoise.h). May be negative.
template <class Vector>
Vector errorOf(const Vector& a, const Vector& b, const Vector& filteredA, const Vector& filteredB) {
    const Vector ab = filteredA - b, ba = filteredB - a, raw = a - b, left = filteredA - filteredB;
    using Scalar = typename Vector::value_type;
    return Scalar(0.5) * (ab * ab + ba * ba - raw * raw) - Scalar(0.25) * left * left;
}

// The first candidate is the unfiltered one.
HalfColors leastError(const std::array<const HalfColors*, 3>& candidates, int width, int height);

}  // namespace conelight::reference
