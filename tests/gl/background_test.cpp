// SPDX-License-Identifier: MIT
// Where a picture of mode `traced` shows a surface and where the sky: the depth test tells them apart, which
// must not depend on how near to the far plane a surface is.
#include <gtest/gtest.h>

#include "conelight/renderer.h"
#include "support/gl_fixture.h"

namespace conelight::test {
namespace {

const glm::vec3 kSky{0.25f, 0.5f, 1.0f};

class BackgroundTest : public GlTest {
  protected:
    // An unlit square to the left of the view axis, `distance` in front of a camera that sees up to 1e4 m.
    static Image picture(float distance, Component component) {
        Scene scene;
        Mesh square;
        const float d = distance;
        square.positions = {{-d, -d, -d}, {0, -d, -d}, {0, d, -d}, {-d, d, -d}};
        square.normals.assign(4, {0, 0, 1});
        square.indices = {0, 1, 2, 0, 2, 3};
        scene.meshes = {square};
        Material material;
        material.baseColor = {0.5f, 0.25f, 0.125f, 1};
        material.unlit = true;
        scene.materials = {material};
        Instance instance;
        instance.mesh = instance.material = 0;
        scene.instances = {instance};
        scene.sky = kSky;
        Camera camera;
        camera.eye = {0, 0, 0};
        camera.target = {0, 0, -1};
        camera.zNear = 1e-3f;
        camera.zFar = 1e4f;
        Settings settings;
        settings.voxels.size = 16;
        settings.traced.cacheUpdates = 1;
        settings.component = component;
        Renderer renderer;
        renderer.setScene(scene);
        renderer.render(camera, 32, 16, settings);
        return renderer.readImage();
    }
    static glm::vec4 at(const Image& image, int x, int y) {
        return image.pixels[static_cast<std::size_t>(y * image.width + x)];
    }
};

}  // namespace

TEST_F(BackgroundTest, SurfacesAreSeenUpToTheFarPlane) {
    // From 5,000 m on a depth that ends at 1 rounds to 1, which is the background's.
    for (const float distance : {1.0f, 5000.0f, 9990.0f}) {
        const Image image = picture(distance, Component::Full);
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 32; ++x) {
                const glm::vec4 pixel = at(image, x, y);
                const bool surface = x < 16;
                const glm::vec3 wanted = surface ? glm::vec3(0.5f, 0.25f, 0.125f) : kSky;
                ASSERT_LT(glm::length(glm::vec3(pixel) - wanted), 1e-3f)
                    << x << "," << y << " at " << distance;
                ASSERT_EQ(pixel.a, surface ? 1.0f : 0.0f) << x << "," << y << " at " << distance;
            }
    }
}

TEST_F(BackgroundTest, PartsWithoutDirectLightAreBlackBehind) {
    const Image image = picture(1, Component::Diffuse);
    EXPECT_EQ(at(image, 8, 8), glm::vec4(0, 0, 0, 1));
    EXPECT_EQ(at(image, 24, 8), glm::vec4(0));
}

}  // namespace conelight::test
