// SPDX-License-Identifier: MIT
// Leaves cut out by a mask: in the picture, in shadows and in the cache, against the path tracer.
#include <cmath>
#include <cstdint>
#include <glm/gtc/matrix_transform.hpp>

#include "support/scenes.h"
#include "support/traced_rig.h"

namespace conelight::test {
namespace {

class FoliageTest : public TracedModeTest {
  protected:
    // Round leaves on a transparent ground, half of whose area they cover.
    static Texture leaves() {
        constexpr int kEdge = 64, kLeaf = 16;
        Texture texture;
        texture.name = "leaves";
        texture.width = texture.height = kEdge;
        for (int y = 0; y < kEdge; ++y)
            for (int x = 0; x < kEdge; ++x) {
                const glm::vec2 from = glm::vec2(x % kLeaf, y % kLeaf) - 0.5f * static_cast<float>(kLeaf - 1);
                const bool leaf = glm::length(from) < 0.4f * static_cast<float>(kLeaf);
                // Where nothing is the colour is wrong on purpose.
                const std::uint8_t green = leaf ? 200 : 0;
                texture.rgba.insert(texture.rgba.end(), {static_cast<std::uint8_t>(leaf ? 90 : 255), green,
                                                         60, static_cast<std::uint8_t>(leaf ? 255 : 0)});
            }
        return texture;
    }
    // Cards of leaves about a trunk, over a white ground and before a white wall, in sun and under a sky.
    static Scene tree() {
        Scene scene;
        const Material white = diffuseMaterial(glm::vec3(0.8f));
        addInstance(scene, quadMesh({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), white);
        addInstance(scene, quadMesh({-2, 0, -2}, {4, 0, 0}, {0, 3, 0}), white);
        addInstance(scene, boxMesh(), diffuseMaterial({0.3f, 0.2f, 0.1f}),
                    glm::scale(glm::translate(glm::mat4(1), {0, 0.6f, 0}), {0.08f, 0.6f, 0.08f}));
        scene.textures.push_back(leaves());
        Material leaf = diffuseMaterial();
        leaf.doubleSided = true;
        leaf.alphaMode = AlphaMode::Mask;
        leaf.baseColorTexture.texture = 0;
        Mesh card = quadMesh({-0.6f, -0.5f, 0}, {1.2f, 0, 0}, {0, 1, 0});
        card.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        for (int i = 0; i < 7; ++i) {
            glm::mat4 place = glm::translate(glm::mat4(1), {0, 1.4f + 0.05f * static_cast<float>(i % 3), 0});
            place = glm::rotate(place, 0.9f * static_cast<float>(i), {0, 1, 0});
            place = glm::rotate(place, 0.5f * static_cast<float>(i % 4) - 0.6f, {1, 0, 0});
            addInstance(scene, card, leaf, glm::translate(place, {0, 0, 0.15f}));
        }
        Light sun;
        sun.type = LightType::Directional;
        sun.direction = glm::normalize(glm::vec3(0.3f, -1, -0.5f));
        sun.intensity = glm::vec3(4);
        scene.lights = {sun};
        scene.sky = {0.4f, 0.5f, 0.7f};
        Camera camera;
        camera.eye = {1.2f, 2.1f, 4.2f};
        camera.target = {0, 0.9f, -0.4f};
        camera.fovY = 0.7f;
        scene.cameras = {camera};
        return scene;
    }
};

TEST_F(FoliageTest, IsRightInPictureShadowAndCache) {
    Scene scene = tree();
    reference::PathTracerSettings wanted;
    wanted.samplesPerPixel = 256;
    const auto traced = [&] {
        return reference::PathTracer(scene).render(scene.cameras.at(0), kTracedPixels, kTracedPixels, wanted);
    };
    const reference::PathTracedPicture truth = traced();
    for (const Component component : {Component::Direct, Component::Indirect}) {
        Settings settings = tracedSettings(Quality::Interactive, component);
        settings.voxels.size = 64;
        settings.light.shadowSize = 1024;
        settings.image.antialiasing = 8;
        const Image image = draw(scene, settings);
        const Image& right = component == Component::Direct ? truth.direct : truth.indirect;
        EXPECT_LT(relRmse(image, right), 0.15) << (component == Component::Direct ? "direct" : "indirect");
        EXPECT_NEAR(meanOf(image) / meanOf(right), 1, 0.02);
    }
    // Whole cards would be far from that.
    for (Material& material : scene.materials) material.alphaMode = AlphaMode::Opaque;
    const reference::PathTracedPicture whole = traced();
    EXPECT_GT(relRmse(whole.direct, truth.direct), 0.2);
    EXPECT_GT(std::fabs(meanOf(whole.indirect) / meanOf(truth.indirect) - 1), 0.04);
}

}  // namespace
}  // namespace conelight::test
