// SPDX-License-Identifier: MIT
#include "support/traced_rig.h"

#include <algorithm>
#include <cmath>

namespace conelight::test {

Settings tracedSettings(Quality quality, Component component) {
    Settings settings;
    settings.mode = Mode::Traced;
    settings.component = component;
    settings.voxels.size = 32;
    settings.light.shadowSize = 256;
    settings.light.areaSamples = 4;
    applyQuality(settings.traced, quality);
    settings.traced.cacheRays = std::min(settings.traced.cacheRays, 2);
    settings.traced.passes = std::min(settings.traced.passes, 8);
    return settings;
}

double indirectError(const Image& image, const reference::PathTracedPicture& truth) {
    double square = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const glm::dvec3 a(image.pixels[i] - truth.indirectA.pixels[i]);
        const glm::dvec3 b(image.pixels[i] - truth.indirectB.pixels[i]);
        square += glm::dot(a, b) / (3.0 * kTracedPixels * kTracedPixels);
    }
    return std::sqrt(std::max(square, 0.0)) / meanOf(truth.indirect);
}

int dotsIn(const Image& image, const std::function<bool(float, const std::array<float, 9>&)>& isDot) {
    int dots = 0;
    for (int y = 1; y + 1 < image.height; ++y)
        for (int x = 1; x + 1 < image.width; ++x) {
            std::array<float, 9> around;
            for (int i = 0; i < 9; ++i) {
                const int at = (y + i / 3 - 1) * image.width + x + i % 3 - 1;
                around[static_cast<std::size_t>(i)] = image.pixels[static_cast<std::size_t>(at)].x;
            }
            const float own = around[4];
            std::sort(around.begin(), around.end());
            dots += isDot(own, around) ? 1 : 0;
        }
    return dots;
}

Image TracedModeTest::draw(Renderer& renderer, const Scene& scene, const Settings& settings) {
    renderer.render(scene.cameras.at(0), kTracedPixels, kTracedPixels, settings);
    return renderer.readImage();
}

Image TracedModeTest::draw(const Scene& scene, const Settings& settings) {
    Renderer renderer;
    renderer.setScene(scene);
    return draw(renderer, scene, settings);
}

}  // namespace conelight::test
