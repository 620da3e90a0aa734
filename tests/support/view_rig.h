// SPDX-License-Identifier: MIT
// A scene on the GPU with its frame block and G-buffer, without the renderer: what tests of single passes
// start from.
#pragma once

#include "conelight/scene.h"
#include "gl/pass.h"
#include "gl/program.h"
#include "scene/gpu_scene.h"
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

// The world position of the centre of pixel (x, y), row 0 at the bottom, on the plane dot(normal, p) =
// offset.
glm::dvec3 pixelOnPlane(const Camera& camera, int width, int height, int x, int y, const glm::dvec3& normal,
                        double offset);

// One quad (two triangles) with its normal, counter-clockwise from the side of cross(edgeU, edgeV).
Mesh quadMesh(const glm::vec3& origin, const glm::vec3& edgeU, const glm::vec3& edgeV);
// Adds the mesh with a material as an instance; returns the instance's index.
std::size_t addInstance(Scene& scene, Mesh mesh, const Material& material,
                        const glm::mat4& worldFromObject = glm::mat4(1));

}  // namespace conelight::test
