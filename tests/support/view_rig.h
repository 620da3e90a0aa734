// SPDX-License-Identifier: MIT
// A scene on the GPU with its lights and what a camera sees of it, without the renderer: what tests of single
// passes start from.
#pragma once

#include "conelight/scene.h"
#include "gl/device.h"
#include "light/lights.h"
#include "scene/gpu_scene.h"
#include "support/scenes.h"
#include "view/surfaces.h"

namespace conelight::test {

struct ViewRig {
    ViewRig(const Scene& source, const Camera& camera, int width, int height);

    // Lights and surfaces as they are.
    void draw(const gl::Device& device, bool cullBackFaces = false);

    Camera camera;
    int width, height;
    scene::GpuScene gpuScene;
    light::LightsWanted wanted;
    light::Lights lights;
    view::Surfaces surfaces;
};

// The world position of the centre of a pixel of a picture of `size`, row 0 at the bottom, on the plane
// dot(normal, p) = offset.
glm::dvec3 pixelOnPlane(const Camera& camera, const glm::ivec2& size, const glm::ivec2& pixel,
                        const glm::dvec3& normal, double offset);

}  // namespace conelight::test
