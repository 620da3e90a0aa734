// SPDX-License-Identifier: MIT
// Textures finer than a pixel, seen at a slant, and normal maps whose normals differ within a pixel: direct light
// against the path tracer's mean over each pixel.
#include <cmath>

#include "math/srgb.h"
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

// Noise that is far finer than a pixel: the floor sends back what the mean of all texels does. Levels that lose a little
// each, as some drivers make them, are darker by percents.
TEST_F(TextureFilterTest, NoiseSeenFromAfarKeepsItsMean) {
    Texture noise;
    noise.name = "noise";
    noise.srgb = true;
    noise.width = noise.height = kTexels;
    std::uint32_t state = 5;
    for (int i = 0; i < 4 * kTexels * kTexels; ++i) {
        state = state * 1664525u + 1013904223u;
        noise.rgba.push_back(i % 4 == 3 ? 255 : static_cast<std::uint8_t>(150 + (state >> 24) % 80));
    }
    double mean = 0;
    for (int i = 0; i < kTexels * kTexels; ++i)
        mean += static_cast<double>(
            math::srgbToLinear(static_cast<float>(noise.rgba[4 * static_cast<std::size_t>(i)]) / 255.0f));
    mean /= kTexels * kTexels;
    Material plain = diffuseMaterial(glm::vec3(static_cast<float>(mean)));
    Material textured = diffuseMaterial(glm::vec3(1));
    textured.baseColorTexture.texture = 0;
    const double fine = meanOf(direct(floor(textured, noise, 64)));
    const double even = meanOf(direct(floor(plain, noise, 64)));
    EXPECT_NEAR(fine / even, 1, 0.005);
}

// Normals that all point up, but are 0.8 to 3 % too short, as JPEG leaves them: the sun's highlight is as narrow as with
// unit ones.
TEST_F(TextureFilterTest, ShortNormalsAreNoSpread) {
    Material steel = diffuseMaterial(glm::vec3(0.9f));
    steel.metallic = 1;
    steel.roughness = 0.1f;
    const auto lit = [&](const std::array<glm::u8vec3, 2>& normals) {
        Scene scene = floor(steel, stripes("normals", false, normals, 8), 16);
        scene.lights[0].direction = glm::normalize(glm::vec3(0, -0.14f, 1));
        return scene;
    };
    steel.normalTexture.texture = 0;
    const Image unit = direct(lit({glm::u8vec3(128, 128, 255), glm::u8vec3(128, 128, 255)}));
    const Image shorter = direct(lit({glm::u8vec3(128, 128, 254), glm::u8vec3(128, 128, 251)}));
    EXPECT_GT(meanOf(unit), 1e-3);
    EXPECT_LT(relRmse(shorter, unit), 0.01);
}

// Textures and materials that come later, in any order, are as those of a scene that had them from the start.
TEST_F(TextureFilterTest, ATextureBecomesANormalMap) {
    Material steel = diffuseMaterial(glm::vec3(0.9f));
    steel.roughness = 0.3f;
    Material mapped = steel;
    mapped.normalTexture.texture = 0;
    const Texture shorter =
        stripes("normals", false, {glm::u8vec3(128, 128, 254), glm::u8vec3(140, 128, 240)}, 8);
    const Texture plain = stripes("plain", false, {glm::u8vec3(128, 128, 255), glm::u8vec3(200, 90, 30)}, 8);
    const Settings settings = tracedSettings(Quality::Draft, Component::Direct);
    const auto pixels = [&](Renderer& renderer, const Scene& scene) {
        renderer.render(scene.cameras[0], 24, 24, settings);
        return renderer.readImage().pixels;
    };
    Renderer fresh, edited;
    const Scene whole = floor(mapped, shorter, 16);
    fresh.setScene(whole);
    edited.setScene(floor(steel, plain, 16));
    edited.setMaterial(0, mapped);
    edited.setTexture(0, shorter);
    EXPECT_EQ(pixels(edited, whole), pixels(fresh, whole));
    // As a colour it is itself again.
    Material colored = steel;
    colored.baseColorTexture.texture = 0;
    edited.setMaterial(0, colored);
    fresh.setScene(floor(colored, shorter, 16));
    EXPECT_EQ(pixels(edited, whole), pixels(fresh, whole));
}

}  // namespace
}  // namespace conelight::test
