// SPDX-License-Identifier: MIT
// Direct light on finely meshed surfaces: no dark dots where the path tracer has none. Triangles are about a
// texel of the shadow map, so that edges pass through the centres of many texels.
#include <algorithm>

#include "support/traced_rig.h"

namespace conelight::test {
namespace {

constexpr int kPixels = 160;

using ShadowSpecksTest = TracedModeTest;

// A sphere with bumps, whose triangles are turned from one another by up to 15 degrees, in a sun from beside
// the camera.
Scene bumpySphere() {
    Scene scene;
    Mesh sphere = sphereMesh(96, 64);
    std::uint32_t state = 1;
    for (glm::vec3& position : sphere.positions) {
        state = state * 1664525u + 1013904223u;
        position *= 1.0f + 0.006f * static_cast<float>(state >> 8) / 16777216.0f;
    }
    sphere.normals.clear();
    addInstance(scene, std::move(sphere), diffuseMaterial());
    Light sun;
    sun.type = LightType::Directional;
    sun.direction = glm::normalize(glm::vec3(0.3f, -0.4f, -1));
    sun.intensity = glm::vec3(3);
    scene.lights.push_back(sun);
    Camera camera;
    camera.eye = {0, 0, 3};
    camera.fovY = 0.8f;
    scene.cameras.push_back(camera);
    return scene;
}

// Where the truth is bright, pixels with less than half of its light.
int darkPixels(const Image& image, const Image& truth) {
    int dark = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        dark += truth.pixels[i].x > 0.3f && image.pixels[i].x < 0.5f * truth.pixels[i].x ? 1 : 0;
    return dark;
}

TEST_F(ShadowSpecksTest, FineTrianglesShowNoDarkDots) {
    const Scene scene = bumpySphere();
    reference::PathTracerSettings traced;
    traced.samplesPerPixel = 4;
    traced.bounces = 0;
    const Image truth =
        reference::PathTracer(scene).render(scene.cameras.at(0), kPixels, kPixels, traced).direct;
    Renderer renderer;
    renderer.setScene(scene);
    int dark = 0;
    // Each size lays other edges through the centres of texels.
    for (const int size : {96, 112, 128, 144, 160, 176, 192}) {
        Settings settings = tracedSettings(Quality::Draft, Component::Direct);
        settings.light.shadowSize = size;
        renderer.render(scene.cameras.at(0), kPixels, kPixels, settings);
        dark += darkPixels(renderer.readImage(), truth);
    }
    EXPECT_LE(dark,
              25);  // 46 when triangles that end at a texel's centre were over everything; bumps shade some
}

}  // namespace
}  // namespace conelight::test
