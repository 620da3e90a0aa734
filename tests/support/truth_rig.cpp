// SPDX-License-Identifier: MIT
#include "support/truth_rig.h"

#include <cmath>

namespace conelight::test {

Camera cameraAbove(const glm::vec3& point, float height, float width) {
    Camera camera;
    camera.eye = point + glm::vec3(0, height, 0);
    camera.target = point;
    camera.up = {0, 0, -1};
    camera.fovY = 2 * std::atan(0.5f * width / height);
    return camera;
}

Camera cameraSlanted(double angle) {
    Camera camera;
    camera.eye = {static_cast<float>(std::sin(angle)), static_cast<float>(std::cos(angle)), 0};
    camera.target = {0, 0, 0};
    camera.up = {0, 0, 1};
    camera.fovY = 1e-3f;
    return camera;
}

Mesh groundMesh(float half) { return quadMesh({-half, 0, half}, {2 * half, 0, 0}, {0, 0, -2 * half}); }

glm::dvec3 meanColorOf(const Image& image) {
    glm::dvec3 sum(0);
    for (const glm::vec4& p : image.pixels) sum += glm::dvec3(p.r, p.g, p.b);
    return sum / static_cast<double>(image.pixels.size());
}

double meanOf(const Image& image) {
    const glm::dvec3 c = meanColorOf(image);
    return (c.r + c.g + c.b) / 3;
}

double relRmse(const Image& a, const Image& b) {
    double squares = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const glm::dvec3 d = glm::dvec3(a.pixels[i]) - glm::dvec3(b.pixels[i]);
        squares += glm::dot(d, d) / 3;
    }
    return std::sqrt(squares / static_cast<double>(a.pixels.size())) / meanOf(b);
}

}  // namespace conelight::test
