// SPDX-License-Identifier: MIT
#include "io/environment_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "conelight/error.h"
#include "io/generated.h"
#include "io/generated_scenes.h"
#include "io/generated_surroundings.h"
#include "io/image_file.h"

namespace conelight::io {
namespace {

std::shared_ptr<const EnvironmentImage> readPicture(const std::string& path) {
    imageFormatOf(path);  // says what is read, whatever is in the file
    const FloatImage picture = readImage(path);
    // Some programs leave out or repeat a row or column.
    if (std::abs(picture.width - 2 * picture.height) > 2)
        throw Error(
            ErrorKind::BadInput,
            fmt::format("{}: {} x {} pixels; a latitude-longitude picture, twice as wide as high, would be "
                        "right",
                        path, picture.width, picture.height));
    auto image = std::make_shared<EnvironmentImage>();
    image->width = picture.width;
    image->height = picture.height;
    const std::size_t texels =
        static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
    const auto channels = static_cast<std::size_t>(picture.channels);
    image->radiance.reserve(texels);
    for (std::size_t i = 0; i < texels; ++i) {
        const float* pixel = picture.pixels.data() + i * channels;
        const glm::vec3 radiance =
            channels < 3 ? glm::vec3(pixel[0]) : glm::vec3(pixel[0], pixel[1], pixel[2]);
        for (int c = 0; c < 3; ++c)
            if (!std::isfinite(radiance[c]))
                throw Error(
                    ErrorKind::BadInput,
                    fmt::format("{}: pixel ({}, {}) is not finite; a radiance below 1e38 would be right",
                                path, i % static_cast<std::size_t>(picture.width),
                                i / static_cast<std::size_t>(picture.width)));
        image->radiance.push_back(glm::max(radiance, glm::vec3(0)));
    }
    return image;
}

}  // namespace

LoadedEnvironment loadEnvironment(const std::string& pathOrBuiltin) {
    LoadedEnvironment loaded;
    if (pathOrBuiltin.starts_with(kBuiltin))
        loaded = generateSurroundings(pathOrBuiltin.substr(kBuiltin.size()));
    else
        loaded.environment.image = readPicture(pathOrBuiltin);
    loaded.environment.file = pathOrBuiltin;
    return loaded;
}

void useEnvironment(Scene& scene, LoadedEnvironment loaded, float rotation, float strength) {
    scene.environment = std::move(loaded.environment);
    scene.environment.rotation = rotation;
    scene.environment.strength = strength;
    std::erase_if(scene.lights, [](const Light& light) { return light.name == kGeneratedSunName; });
    if (!loaded.sun) return;
    loaded.sun->intensity *= strength;
    loaded.sun->direction = glm::vec3(generated::turnAboutY(rotation) * glm::vec4(loaded.sun->direction, 0));
    scene.lights.push_back(std::move(*loaded.sun));
}

}  // namespace conelight::io
