// SPDX-License-Identifier: MIT
#include "light/light_scale.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace conelight::light {
namespace {

using Ratio = std::pair<float, float>;  // and its weight

float medianOf(std::vector<Ratio>& ratios) {
    double all = 0;
    for (const auto& [ratio, weight] : ratios) all += static_cast<double>(weight);
    std::sort(ratios.begin(), ratios.end());
    double sum = 0;
    for (const auto& [ratio, weight] : ratios) {
        sum += static_cast<double>(weight);
        if (2 * sum >= all) return ratio;
    }
    return 1;
}

}  // namespace

glm::vec3 commonScale(const std::vector<LightSource>& sources) {
    glm::vec3 scale(1);
    std::vector<Ratio> ratios;
    for (int channel = 0; channel < 3; ++channel) {
        ratios.clear();
        for (const LightSource& source : sources) {
            const float was = source.was[channel], ratio = source.is[channel] / was;
            const bool known = was > 0 && std::isfinite(was) && std::isfinite(ratio);
            if (known && source.was != source.is) ratios.emplace_back(ratio, was);
        }
        scale[channel] = medianOf(ratios);
    }
    return scale;
}

glm::vec3 scaledTo(const glm::vec3& was, const glm::vec3& scale, const glm::vec3& is) {
    const glm::vec3 scaled = scale * was;
    return glm::mix(scaled, is, glm::lessThanEqual(glm::abs(scaled - is), kScaleRounding * is));
}

}  // namespace conelight::light
