// SPDX-License-Identifier: MIT
// Textures finer than a pixel, seen at a slant, and normal maps whose normals differ within a pixel: direct light
// against the path tracer's mean over each pixel.
#include <cmath>

#include "support/scenes.h"
#include "support/traced_rig.h"

namespace conelight::test {
namespace {

constexpr int kTexels = 256;

class TextureFilterTest : public TracedModeTest {
  protected:
    // A floor of 8 m under a steep sun, seen along z from a height of 0.4 m.
    static Scene floor(const Material& material, Texture texture, float repeats = 1) {
        Scene scene;
        scene.textures.push_back(std::move(texture));
        Mesh mesh = quadMesh({-4, 0, 4}, {8, 0, 0}, {0, 0, -8});
        mesh.uvs = {{0, 0}, {repeats, 0}, {repeats, repeats}, {0, repeats}};
        mesh.tangents.assign(4, glm::vec4(1, 0, 0, 1));
        addInstance(scene, std::move(mesh), material);
        Light sun;
        sun.type = LightType::Directional;
        sun.direction = glm::normalize(glm::vec3(0.15f, -1, -0.1f));
        sun.intensity = glm::vec3(3);
        scene.lights = {sun};
        Camera camera;
        camera.eye = {0, 0.4f, 4};
        camera.target = {0, 0, 1};
        camera.fovY = 0.5f;
        scene.cameras = {camera};
        return scene;
    }
    static Texture stripes(const char* name, bool srgb, const std::array<glm::u8vec3, 2>& colors,
                           int period) {
        Texture texture;
        texture.name = name;
        texture.srgb = srgb;
        texture.width = texture.height = kTexels;
        for (int i = 0; i < kTexels * kTexels; ++i) {
            const glm::u8vec3& c = colors[static_cast<std::size_t>(i % kTexels / (period / 2) % 2)];
            texture.rgba.insert(texture.rgba.end(), {c.r, c.g, c.b, 255});
        }
        return texture;
    }
    static Image direct(const Scene& scene) {
        return draw(scene, tracedSettings(Quality::Interactive, Component::Direct));
    }
    static Image truthOf(const Scene& scene) {
        reference::PathTracerSettings wanted;
        wanted.samplesPerPixel = 1024;
        wanted.bounces = 0;
        return reference::PathTracer(scene)
            .render(scene.cameras.at(0), kTracedPixels, kTracedPixels, wanted)
            .direct;
    }
};

// Stripes run away from the eye. Across them they are wider than a pixel, along the pixel's longer axis they do not
// change: what is averaged along the shorter axis alone is grey.
TEST_F(TextureFilterTest, StripesAtASlantKeepTheirContrast) {
    Material material = diffuseMaterial();
    material.baseColorTexture.texture = 0;
    const Scene scene = floor(material, stripes("stripes", true, {glm::u8vec3(250), glm::u8vec3(20)}, 32));
    EXPECT_LT(relRmse(direct(scene), truthOf(scene)), 0.08);
}

// Grooves of 45 degrees to both sides, finer than a pixel, are darker than a flat floor. Between texels the path tracer
// has normals in between, as long as any.
TEST_F(TextureFilterTest, NormalsFinerThanAPixelDarken) {
    constexpr float kRepeats = 16;
    const glm::u8vec3 up(128, 128, 255), left(38, 128, 218), right(218, 128, 218);
    Material material = diffuseMaterial(glm::vec3(0.5f));
    const double flat = meanOf(truthOf(floor(material, stripes("flat", false, {up, up}, 8), kRepeats)));
    material.normalTexture.texture = 0;
    const Scene scene = floor(material, stripes("grooves", false, {left, right}, 8), kRepeats);
    const double truth = meanOf(truthOf(scene));
    EXPECT_LT(truth, 0.85 * flat);
    EXPECT_NEAR(meanOf(direct(scene)) / truth, 1, 0.06);
}

}  // namespace
}  // namespace conelight::test
