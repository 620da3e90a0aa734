// SPDX-License-Identifier: MIT
#include "light/sky_edits.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>

#include "math/brightness.h"
#include "scene/surroundings.h"

namespace conelight::light {
namespace {

// Over all directions, the mean of ofRow(first texel, count) over the rows of a picture.
template <typename OfRow>
glm::vec3 meanOf(const EnvironmentImage& image, const OfRow& ofRow) {
    glm::dvec3 sum(0);
    double all = 0;
    const auto count = static_cast<std::size_t>(image.width);
    for (int row = 0; row < image.height; ++row) {
        const double solidAngle = scene::texelSolidAngle(image, row);
        sum += solidAngle * glm::dvec3(ofRow(static_cast<std::size_t>(row) * count, count));
        all += solidAngle * static_cast<double>(count);
    }
    return glm::vec3(sum / all);
}

glm::vec3 meanOf(const EnvironmentImage& image) {
    return meanOf(image, [&](std::size_t first, std::size_t count) {
        glm::vec3 sum(0);
        for (std::size_t i = first; i < first + count; ++i) sum += image.radiance[i];
        return sum;
    });
}

// How far two pictures are apart, each times a factor.
glm::vec3 meanApart(const EnvironmentImage& was, const glm::vec3& wasScale, const EnvironmentImage& is,
                    float isScale) {
    return meanOf(is, [&](std::size_t first, std::size_t count) {
        glm::vec3 sum(0);
        for (std::size_t i = first; i < first + count; ++i)
            sum += glm::abs(wasScale * was.radiance[i] - isScale * is.radiance[i]);
        return sum;
    });
}

}  // namespace

// A turned sky, or one of other pixels, may be another in every direction.
bool SkyEdits::areComparable(const Sky& before, const Sky& now) {
    const Environment &was = before.environment, &is = now.environment;
    if (was.used() != is.used()) return false;
    if (!is.used()) return true;
    return was.rotation == is.rotation && was.image->width == is.image->width &&
           was.image->height == is.image->height;
}

void SkyEdits::look(const glm::vec3& sky, const Environment& environment) {
    before_ = std::move(now_);
    now_ = {sky, environment};
    if (!environment.used()) return;
    const bool sameImage = environment.image == before_.environment.image;
    now_.picture = sameImage ? before_.picture : meanOf(*environment.image);
}

LightChange SkyEdits::change(const glm::vec3& scale) const {
    LightChange change;
    const Environment &was = before_.environment, &is = now_.environment;
    if (scale == glm::vec3(1) && before_.radiance == now_.radiance && was == is) return change;
    if (!areComparable(before_, now_)) {
        change.isAnything = true;
        return change;
    }
    glm::vec3 apart = glm::abs(now_.radiance - scale * before_.radiance);
    // Of one picture only the strength is another.
    if (is.used())
        apart += is.image == was.image ? glm::abs(is.strength - scale * was.strength) * now_.picture
                                       : meanApart(*was.image, scale * was.strength, *is.image, is.strength);
    if (glm::all(glm::lessThanEqual(apart, kScaleRounding * now_.mean()))) return change;
    // As of half of all directions, since below the horizon there may be none of it.
    change.everywhere = 2 * glm::pi<float>() * math::brightness(apart);
    change.everywherePart = math::brightness(apart) / math::brightness(scale * before_.mean());
    const glm::vec3 dimmed = glm::abs(now_.mean() - scale * before_.mean());
    change.dimmed = 2 * glm::pi<float>() * math::brightness(dimmed);
    change.dimmedPart = math::brightness(dimmed) / math::brightness(scale * before_.mean());
    change.isAnything = !std::isfinite(change.everywherePart);
    return change;
}

void SkyEdits::addSource(std::vector<LightSource>& sources, float radius) const {
    const float area = 4 * glm::pi<float>() * radius * radius;
    sources.push_back({glm::pi<float>() * area * before_.mean(), glm::pi<float>() * area * now_.mean()});
}

}  // namespace conelight::light
