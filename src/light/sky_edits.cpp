// SPDX-License-Identifier: MIT
#include "light/sky_edits.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "math/brightness.h"
#include "scene/surroundings.h"

namespace conelight::light {
namespace {

// A turned sky, or one of other pixels, may be another in every direction.
bool isComparable(const Environment& was, const Environment& is) {
    if (was.used() != is.used()) return false;
    if (!is.used()) return true;
    return was.rotation == is.rotation && was.image->width == is.image->width &&
           was.image->height == is.image->height;
}

// Over all directions and channels, the mean of ofRow(first float, count) over the rows of a picture.
template <typename OfRow>
double meanOf(const EnvironmentImage& image, const OfRow& ofRow) {
    double sum = 0, all = 0;
    const std::size_t count = 3 * static_cast<std::size_t>(image.width);
    for (int row = 0; row < image.height; ++row) {
        const double solidAngle = scene::texelSolidAngle(image, row);
        sum += solidAngle * static_cast<double>(ofRow(static_cast<std::size_t>(row) * count, count));
        all += solidAngle * static_cast<double>(count);
    }
    return sum / all;
}

double meanOf(const EnvironmentImage& image) {
    const float* const texels = &image.radiance[0].r;
    return meanOf(image, [&](std::size_t first, std::size_t count) {
        float sum = 0;
        for (std::size_t i = first; i < first + count; ++i) sum += texels[i];
        return sum;
    });
}

// How far two skies are apart.
double meanApart(const Environment& was, const Environment& is) {
    const float* const before = &was.image->radiance[0].r;
    const float* const now = &is.image->radiance[0].r;
    return meanOf(*is.image, [&](std::size_t first, std::size_t count) {
        float sum = 0;
        for (std::size_t i = first; i < first + count; ++i)
            sum += std::abs(was.strength * before[i] - is.strength * now[i]);
        return sum;
    });
}

}  // namespace

SkyEdits::Change SkyEdits::look(const glm::vec3& sky, const Environment& environment) {
    Change change;
    if (sky == sky_ && environment == environment_) return change;
    if (isComparable(environment_, environment)) {
        auto apart = static_cast<double>(math::brightness(glm::abs(sky - sky_)));
        auto mean = static_cast<double>(math::brightness(sky_));
        if (environment.used()) {
            if (mean_ < 0) mean_ = meanOf(*environment_.image);
            mean += static_cast<double>(environment_.strength) * mean_;
            // Of one picture only the strength is another.
            const auto dimmed = static_cast<double>(std::abs(environment_.strength - environment.strength));
            apart += environment.image == environment_.image ? dimmed * mean_
                                                             : meanApart(environment_, environment);
        }
        // As of half of all directions, since below the horizon there may be none of it.
        change.irradiance = 2 * glm::pi<float>() * static_cast<float>(apart);
        change.part = static_cast<float>(apart / mean);
        change.isAnything = !std::isfinite(change.part);
    } else {
        change.isAnything = true;
    }
    if (environment.image != environment_.image) mean_ = -1;
    sky_ = sky;
    environment_ = environment;
    return change;
}

}  // namespace conelight::light
