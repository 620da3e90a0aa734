// SPDX-License-Identifier: MIT
// Foreground: Image + Scene + Camera -> the picture without the surroundings behind it, associated alpha. What a pixel
// shows is a F + (1 - a) S of coverage a, light F of surfaces and S of the surroundings; S is known, a F is what is
// left. S is looked up once a pixel, at its centre.
#include <glm/gtc/matrix_inverse.hpp>

#include "conelight/renderer.h"
#include "scene/surroundings.h"
#include "view/camera.h"

namespace conelight {

Image foreground(const Image& image, const Scene& scene, const Camera& camera) {
    const scene::Surroundings surroundings(scene);
    const glm::dmat4 worldFromClip = glm::inverse(
        glm::dmat4(view::clipFromView(camera, image.width, image.height) * view::viewFromWorld(camera)));
    const auto pointAt = [&](const glm::dvec2& at, double depth) {
        const glm::dvec4 p = worldFromClip * glm::dvec4(at, depth, 1);
        return glm::dvec3(p) / p.w;
    };
    Image alone = image;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            glm::vec4& pixel = alone.pixels[std::size_t(y) * std::size_t(image.width) + std::size_t(x)];
            const float alpha = glm::clamp(pixel.a, 0.0f, 1.0f);
            pixel.a = alpha;
            if (alpha >= 1) continue;
            const glm::dvec2 at((x + 0.5) / image.width * 2 - 1, 1 - (y + 0.5) / image.height * 2);
            const glm::vec3 behind =
                surroundings.radiance(glm::normalize(glm::vec3(pointAt(at, 1) - pointAt(at, -1))));
            pixel = alpha > 0 ? glm::vec4(glm::max(glm::vec3(pixel) - (1 - alpha) * behind, 0.0f), alpha)
                              : glm::vec4(0);
        }
    return alone;
}

}  // namespace conelight
