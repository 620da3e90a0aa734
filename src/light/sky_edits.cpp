// SPDX-License-Identifier: MIT
#include "light/sky_edits.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>

namespace conelight::light {
namespace {

// A turned sky, or one of other pixels, may be another in every direction.
bool isComparable(const Environment& was, const Environment& is) {
    if (was.used() != is.used()) return false;
    if (!is.used()) return true;
    return was.rotation == is.rotation && was.image->width == is.image->width &&
           was.image->height == is.image->height;
}

float channels(const glm::vec3& radiance) { return (radiance.r + radiance.g + radiance.b) / 3; }

// Over all directions, means of two skies: how far they are apart, and of the first.
std::pair<double, double> apartAndMean(const Environment& was, const Environment& is) {
    if (!is.used()) return {0, 0};
    double apart = 0, mean = 0, all = 0;
    const auto width = static_cast<std::size_t>(is.image->width);
    for (int row = 0; row < is.image->height; ++row) {
        const float* const before = &was.image->radiance[static_cast<std::size_t>(row) * width].r;
        const float* const now = &is.image->radiance[static_cast<std::size_t>(row) * width].r;
        float difference = 0, sum = 0;
        for (std::size_t i = 0; i < 3 * width; ++i) {
            difference += std::abs(was.strength * before[i] - is.strength * now[i]);
            sum += was.strength * before[i];
        }
        const double solidAngle =
            std::sin(glm::pi<double>() * (row + 0.5) / static_cast<double>(is.image->height));
        apart += solidAngle * static_cast<double>(difference);
        mean += solidAngle * static_cast<double>(sum);
        all += solidAngle * static_cast<double>(3 * width);
    }
    return {apart / all, mean / all};
}

}  // namespace

SkyEdits::Change SkyEdits::look(const glm::vec3& sky, const Environment& environment) {
    Change change;
    if (sky == sky_ && environment == environment_) return change;
    if (isComparable(environment_, environment)) {
        auto [apart, mean] = apartAndMean(environment_, environment);
        apart += static_cast<double>(channels(glm::abs(sky - sky_)));
        mean += static_cast<double>(channels(sky_));
        // As of half of all directions, since below the horizon there may be none of it.
        change.irradiance = 2 * glm::pi<float>() * static_cast<float>(apart);
        change.part = static_cast<float>(apart / mean);
        change.isAnything = !std::isfinite(change.part);
    } else {
        change.isAnything = true;
    }
    sky_ = sky;
    environment_ = environment;
    return change;
}

}  // namespace conelight::light
