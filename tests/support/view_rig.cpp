// SPDX-License-Identifier: MIT
#include "support/view_rig.h"

#include <cmath>

#include "shared/bindings.h"

namespace conelight::test {

ViewRig::ViewRig(const Scene& source, const Camera& seenFrom, int width, int height)
    : camera(seenFrom),
      sky(source.sky),
      gpuScene(source),
      frameBlock(sizeof(gpu::FrameConstants), "frame"),
      gbuffer(width, height) {}

void ViewRig::draw(gl::ProgramLibrary& programs, bool cullBackFaces) {
    frameBlock.update(view::frameConstants(camera, gbuffer.width(), gbuffer.height(), gpuScene, sky, 0, 1));
    frameBlock.bindUniform(BINDING_FRAME);
    gpuScene.bind();
    gbuffer.draw(programs, profiler, gpuScene, cullBackFaces);
    gbuffer.bind();
}

glm::dvec3 pixelOnPlane(const Camera& camera, const glm::ivec2& size, const glm::ivec2& pixel,
                        const glm::dvec3& normal, double offset) {
    const glm::dvec3 eye(camera.eye);
    const glm::dvec3 forward = glm::normalize(glm::dvec3(camera.target) - eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(camera.up)));
    const glm::dvec3 up = glm::cross(right, forward);
    const double tanY = std::tan(0.5 * static_cast<double>(camera.fovY));
    const double clipX = (pixel.x + 0.5) / size.x * 2 - 1, clipY = (pixel.y + 0.5) / size.y * 2 - 1;
    const glm::dvec3 ray = forward + clipX * tanY * size.x / size.y * right + clipY * tanY * up;
    return eye + ray * ((offset - glm::dot(normal, eye)) / glm::dot(normal, ray));
}

}  // namespace conelight::test
