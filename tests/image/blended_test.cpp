// SPDX-License-Identifier: MIT
// Blended surfaces (AlphaMode::Blend) in anti-aliased stills: shares of what they hide, layers in order, in every
// mode and in the path tracer.
#include "conelight/thesis/settings.h"
#include "support/scenes.h"
#include "support/traced_rig.h"

namespace conelight::test {
namespace {

Material veil(const glm::vec3& color, float opacity, const glm::vec3& emission) {
    Material m = diffuseMaterial(color, emission);
    m.baseColor.a = opacity;
    m.alphaMode = AlphaMode::Blend;
    m.doubleSided = true;
    return m;
}

class BlendedTest : public TracedModeTest {
  protected:
    // A glowing wall behind veils that glow in other colours, the nearest last.
    static Scene veils(const std::vector<Material>& materials) {
        Scene scene;
        addInstance(scene, quadMesh({-3, -3, -1}, {6, 0, 0}, {0, 6, 0}),
                    diffuseMaterial(glm::vec3(0), {1, 1, 1}));
        float z = 0;
        for (const Material& material : materials)
            addInstance(scene, quadMesh({-3, -3, z += 0.2f}, {6, 0, 0}, {0, 6, 0}), material);
        Camera camera;
        camera.eye = {0, 0, 3};
        scene.cameras.push_back(camera);
        return scene;
    }
    static Settings still(const Mode& mode) {
        Settings settings = tracedSettings(Quality::Interactive);
        settings.mode = mode;
        settings.image.antialiasing = 16;
        return settings;
    }
};

TEST_F(BlendedTest, SharesAreThoseOfTheirOpacity) {
    for (const Mode mode : {Mode::Traced, Mode::Cones, Mode::Phong, thesis::kMode})
        for (const float opacity : {0.0f, 0.25f, 0.7f, 1.0f}) {
            const Scene scene = veils({veil(glm::vec3(0), opacity, {2, 0, 0})});
            const glm::dvec3 mean = meanColorOf(draw(scene, still(mode)));
            EXPECT_NEAR(mean.r, static_cast<double>(2 * opacity + 1 - opacity), 0.05) << mode.name();
            EXPECT_NEAR(mean.g, static_cast<double>(1 - opacity), 0.03) << mode.name();
        }
}

TEST_F(BlendedTest, LayersAreInOrder) {
    const Scene scene = veils({veil(glm::vec3(0), 0.5f, {4, 0, 0}), veil(glm::vec3(0), 0.25f, {0, 0, 8})});
    const glm::dvec3 expected(0.75 * (0.5 * 4 + 0.5), 0.75 * 0.5, 0.25 * 8 + 0.75 * 0.5);
    const glm::dvec3 mean = meanColorOf(draw(scene, still(Mode::Traced)));
    reference::PathTracerSettings settings;
    settings.samplesPerPixel = 256;
    const glm::dvec3 truth = meanColorOf(
        reference::PathTracer(scene).render(scene.cameras[0], kTracedPixels, kTracedPixels, settings).full);
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(mean[i], expected[i], 0.06) << i;
        EXPECT_NEAR(truth[i], expected[i], 0.02) << i;
    }
}

// A veil that hides little is in no voxel, and has its light from rays of the pixels that see it.
TEST_F(BlendedTest, ThinVeilsAreLit) {
    Scene scene = closedBox(diffuseMaterial(glm::vec3(0.5f)));
    Light lamp;
    lamp.type = LightType::Point;
    lamp.position = {0, 0.6f, 0.5f};
    lamp.intensity = glm::vec3(2);
    scene.lights.push_back(lamp);
    addInstance(scene, quadMesh({-0.8f, -0.8f, -0.4f}, {1.6f, 0, 0}, {0, 1.6f, 0}),
                veil({0.1f, 0.8f, 0.1f}, 0.35f, glm::vec3(0)));
    const Image image = draw(scene, still(Mode::Traced));
    reference::PathTracerSettings settings;
    settings.samplesPerPixel = 512;
    const reference::PathTracedPicture truth =
        reference::PathTracer(scene).render(scene.cameras[0], kTracedPixels, kTracedPixels, settings);
    const glm::dvec3 own = meanColorOf(image), other = meanColorOf(truth.full);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(own[i] / other[i], 1, 0.13) << i;
    EXPECT_LT(relRmse(image, truth.full), 0.2);
}

// A wall with the shadow of a bar, lit through a sheet behind the eye, or lit freely.
Scene wallBehindSheet(float opacity, int alphaOfTexel) {
    Scene scene;
    addInstance(scene, quadMesh({-3, -3, -1}, {6, 0, 0}, {0, 6, 0}), diffuseMaterial(glm::vec3(0.5f)));
    addInstance(scene, quadMesh({-0.2f, -2, 0.3f}, {0.15f, 0.1f, 0}, {0, 4, 0}),
                diffuseMaterial(glm::vec3(0.5f)));
    if (opacity > 0) {
        Material sheet = veil({0.9f, 0.1f, 0.1f}, opacity, glm::vec3(0));
        scene.textures.push_back({.width = 1, .height = 1});
        scene.textures.back().rgba = {255, 255, 255, static_cast<std::uint8_t>(alphaOfTexel)};
        if (alphaOfTexel < 255) sheet.baseColorTexture.texture = 0;
        addInstance(scene, quadMesh({-3, -3, 0.5f}, {6, 0, 0}, {0, 6, 0}), sheet);
    }
    Light lamp;
    lamp.type = LightType::Point;
    lamp.position = {0.2f, 0.3f, 1.5f};
    lamp.intensity = glm::vec3(2);
    scene.lights.push_back(lamp);
    Camera camera;
    camera.eye = {0, 0, 0.2f};
    scene.cameras.push_back(camera);
    return scene;
}

TEST_F(BlendedTest, LampsShineThroughByOpacity) {
    for (const Mode mode : {Mode::Traced, Mode::Cones}) {
        Settings settings = tracedSettings(Quality::Draft);
        settings.mode = mode;
        settings.component = Component::Direct;
        Image freely = draw(wallBehindSheet(0, 255), settings);
        for (const auto& [opacity, texel] :
             {std::pair{0.3f, 255}, std::pair{0.8f, 255}, std::pair{1.0f, 102}}) {
            Image expected = freely;
            const float left = 1 - opacity * static_cast<float>(texel) / 255;
            for (glm::vec4& pixel : expected.pixels) pixel *= left;
            EXPECT_LT(relRmse(draw(wallBehindSheet(opacity, texel), settings), expected), 0.01)
                << mode.name() << opacity;
        }
        EXPECT_GT(meanColorOf(freely).r, 0.01);
    }
}

// Without anti-aliasing, surfaces that hide a half and more are there.
TEST_F(BlendedTest, PicturesAtCentresCutAtAHalf) {
    for (const float opacity : {0.45f, 0.55f}) {
        Settings settings = still(Mode::Traced);
        settings.image.antialiasing = 0;
        const Scene scene = veils({veil(glm::vec3(0), opacity, {2, 0, 0})});
        const glm::dvec3 mean = meanColorOf(draw(scene, settings));
        EXPECT_NEAR(mean.g, opacity < 0.5f ? 1 : 0, 1e-3);
    }
}

}  // namespace
}  // namespace conelight::test
