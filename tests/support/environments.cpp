// SPDX-License-Identifier: MIT
#include "support/environments.h"

#include <cstdint>

namespace conelight::test {

std::shared_ptr<EnvironmentImage> evenEnvironment(int width, const glm::vec3& radiance) {
    auto image = std::make_shared<EnvironmentImage>();
    image->width = width;
    image->height = width / 2;
    image->radiance.assign(static_cast<std::size_t>(image->width * image->height), radiance);
    return image;
}

std::shared_ptr<EnvironmentImage> sunnyEnvironment(int width) {
    auto image = evenEnvironment(width, glm::vec3(0));
    std::uint32_t state = 7;
    for (glm::vec3& radiance : image->radiance) {
        state = state * 1664525u + 1013904223u;
        radiance = glm::vec3(0.5f, 0.7f, 1.0f) * (0.5f + static_cast<float>(state >> 8) * 0x1p-24f);
    }
    const int row = width / 2 * 40 / 180, column = width * 5 / 8;
    image->radiance[static_cast<std::size_t>(row * width + column)] = glm::vec3(1e5f, 0.9e5f, 0.8e5f);
    return image;
}

}  // namespace conelight::test
