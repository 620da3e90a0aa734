// SPDX-License-Identifier: MIT
#include "support/view_rig.h"

#include <cmath>

namespace conelight::test {

ViewRig::ViewRig(const Scene& source, const Camera& seenFrom, int w, int h)
    : camera(seenFrom), width(w), height(h), gpuScene(source) {}

void ViewRig::draw(const gl::Device& device, bool cullBackFaces) {
    lights.update(device, gpuScene, wanted);
    surfaces.see(device, gpuScene, {camera, width, height, cullBackFaces});
}

glm::dvec3 pixelOnPlane(const Camera& camera, const glm::ivec2& size, const glm::ivec2& pixel,
                        const glm::dvec3& normal, double offset) {
    const glm::dvec3 eye(camera.eye);
    const glm::dvec3 forward = glm::normalize(glm::dvec3(camera.target) - eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(camera.up)));
    const glm::dvec3 up = glm::cross(right, forward);
    const double tanY = camera.isOrthographic() ? 0.5 * static_cast<double>(camera.orthographicHeight)
                                                : std::tan(0.5 * static_cast<double>(camera.fovY));
    const double clipX = (pixel.x + 0.5) / size.x * 2 - 1, clipY = (pixel.y + 0.5) / size.y * 2 - 1;
    const glm::dvec3 aside = clipX * tanY * size.x / size.y * right + clipY * tanY * up;
    if (camera.isOrthographic()) {
        const glm::dvec3 from = eye + aside;
        return from + forward * ((offset - glm::dot(normal, from)) / glm::dot(normal, forward));
    }
    const glm::dvec3 ray = forward + aside;
    return eye + ray * ((offset - glm::dot(normal, eye)) / glm::dot(normal, ray));
}

}  // namespace conelight::test
