// SPDX-License-Identifier: MIT
// A scene on the GPU with its frame block and G-buffer, without the renderer: what tests of single passes
// start from.
#pragma once

#include "conelight/scene.h"
#include "gl/pass.h"
#include "gl/program.h"
#include "scene/gpu_scene.h"
#include "support/scenes.h"
#include "view/camera.h"
#include "view/gbuffer.h"

namespace conelight::test {

struct ViewRig {
    ViewRig(const Scene& source, const Camera& camera, int width, int height);

    // Uploads the frame block (light count included), binds it and the scene, draws and binds the G-buffer.
    void draw(gl::ProgramLibrary& programs, bool cullBackFaces = false);

    Camera camera;
    glm::vec3 sky;
    scene::GpuScene gpuScene;
    gl::Profiler profiler;
    gl::Buffer frameBlock;
    view::GBuffer gbuffer;
};

// The world position of the centre of a pixel of a picture of `size`, row 0 at the bottom, on the plane
// dot(normal, p) = offset.
glm::dvec3 pixelOnPlane(const Camera& camera, const glm::ivec2& size, const glm::ivec2& pixel,
                        const glm::dvec3& normal, double offset);

}  // namespace conelight::test
