// SPDX-License-Identifier: MIT
#include "support/views_rig.h"

namespace conelight::test {

glm::vec3 colorAt(const Image& image, int x, int y) {
    return glm::vec3(image.pixels[static_cast<std::size_t>(y * image.width + x)]);
}

double covered(const Image& image) {
    double sum = 0;
    for (const glm::vec4& p : image.pixels) sum += p.a;
    return sum / static_cast<double>(image.pixels.size());
}

double differing(const Image& a, const Image& b) {
    double count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        count += glm::length(glm::vec3(a.pixels[i] - b.pixels[i])) > 1e-3f ? 1 : 0;
    return count / static_cast<double>(a.pixels.size());
}

Settings viewSettings(Mode mode, Component component) {
    Settings settings;
    settings.mode = mode;
    settings.component = component;
    settings.voxels.size = 32;
    settings.light.shadowSize = 256;
    settings.cones.bounces = 1;
    settings.traced.cacheUpdates = 4;
    settings.traced.passes = 1;
    return settings;
}

Scene redCube() {
    Scene outside;
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f}) {
            glm::vec3 n(0), u(0), v(0);
            n[axis] = side;
            u[(axis + 1) % 3] = 1;
            v[(axis + 2) % 3] = 1;
            const glm::vec3 corner = 0.5f * n - 0.5f * (u + v);
            addInstance(outside, side > 0 ? quadMesh(corner, u, v) : quadMesh(corner, v, u),
                        diffuseMaterial({0.8f, 0.1f, 0.05f}));
        }
    Light light;
    light.type = LightType::Point;
    light.position = {0.4f, 0.6f, 3};
    light.intensity = glm::vec3(10);
    outside.lights.push_back(light);
    Camera camera;
    camera.eye = {0.2f, 0.3f, 3};
    camera.target = {0, 0, 0};
    camera.fovY = 0.5f;
    outside.cameras.push_back(camera);
    return outside;
}

void ViewsTest::TearDown() {
    renderer_.reset();
    GlTest::TearDown();
}

Image ViewsTest::draw(const Scene& scene, const Settings& settings) {
    if (!renderer_) renderer_ = std::make_unique<Renderer>();
    renderer_->setScene(scene);
    return again(scene, settings);
}

Image ViewsTest::again(const Scene& scene, const Settings& settings) {
    renderer_->render(scene.cameras.at(0), kViewPixels, kViewPixels, settings);
    return renderer_->readImage();
}

}  // namespace conelight::test
