// SPDX-License-Identifier: MIT
// Shadows of the sun from a metre to two kilometres in one picture: against the path tracer, and that the eye's way
// does not move them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "gather/direct_light.h"
#include "gl/gl.h"
#include "support/gl_fixture.h"
#include "support/traced_rig.h"
#include "support/view_rig.h"

namespace conelight::test {
namespace {

constexpr int kPixels = kTracedPixels;
constexpr float kDistances[] = {1, 10, 100, 400, 1000, 2000};  // m
const glm::vec3 kEye(0, 0.6f, 0);

glm::vec3 towards(int post) {
    const float turn = 0.18f * static_cast<float>(post) - 0.8f;
    return {std::sin(turn), 0, -std::cos(turn)};
}

// A ground of 4 km, and about the eye posts at these distances, each before a screen that its shadow falls on. Sizes go
// with the distance, so that the eye sees all alike.
Scene street(float aside = 0) {
    Scene scene;
    const Material grey = diffuseMaterial(glm::vec3(0.5f));
    addInstance(scene, quadMesh({-2000, 0, 2000}, {4000, 0, 0}, {0, 0, -4000}), grey);
    for (int i = 0; i < 6; ++i) {
        const float d = kDistances[i];
        glm::mat4 place = glm::translate(glm::mat4(1), kEye + glm::vec3(aside, 0, 0) + d * towards(i));
        place = glm::scale(place, glm::vec3(0.01f * d));
        addInstance(scene, boxMesh(), grey, glm::scale(place, {0.4f, 3.5f, 0.4f}));
        addInstance(scene, boxMesh(), grey, glm::scale(glm::translate(place, {0, 0, -4}), {7, 7, 0.2f}));
    }
    Light sun;
    sun.type = LightType::Directional;
    sun.direction = glm::normalize(glm::vec3(0.4f, -0.35f, -0.8f));
    sun.intensity = glm::vec3(3);
    scene.lights = {sun};
    scene.cameras = {Camera{}};
    return scene;
}

// One post and its screen fill the picture: pixels of about a thousandth of its width, as in a picture of all.
Camera towardsPost(int post, float aside = 0) {
    Camera camera;
    camera.eye = kEye + glm::vec3(aside, 0, 0);
    camera.target = camera.eye + towards(post);
    camera.fovY = 0.11f;
    return camera;
}

class ShadowCascadesTest : public TracedModeTest {
  protected:
    // Pixels that are lit where the path tracer's are not, or the other way round.
    static int wrong(const Image& image, const Image& truth) {
        int count = 0;
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            count += std::fabs(image.pixels[i].g - truth.pixels[i].g) > 0.1f;
        return count;
    }
    static Settings direct(Mode mode) {
        Settings settings = tracedSettings(Quality::Interactive, Component::Direct);
        settings.mode = mode;
        settings.image.antialiasing = 0;
        settings.light.shadowSize = 1024;
        settings.phong.shadows = Toggle::On;
        return settings;
    }

    // Direct light of a picture whose maps lie about another place than its eye.
    struct Rig : ViewRig {
        view::ShadowCascades cascades;
        gather::DirectLight light;
        using ViewRig::ViewRig;

        std::vector<glm::vec4> draw(const gl::Device& device, const glm::vec3& about) {
            lights.update(device, gpuScene, wanted);
            cascades.updateInSteps(device, gpuScene, lights, wanted.settings, about).finish();
            surfaces.see(device, gpuScene,
                         {.camera = camera,
                          .width = width,
                          .height = height,
                          .cullBackFaces = true,
                          .cascades = &cascades});
            light.draw(device, {gpuScene, lights, surfaces});
            gl::barrier(gl::Access::TextureFetch);
            std::vector<glm::vec4> pixels(static_cast<std::size_t>(width * height));
            light.diffuse().read(0, GL_RGBA, GL_FLOAT, pixels.data(), pixels.size() * sizeof(glm::vec4));
            return pixels;
        }
    };
    static int different(const std::vector<glm::vec4>& a, const std::vector<glm::vec4>& b) {
        int count = 0;
        for (std::size_t i = 0; i < a.size(); ++i) count += std::fabs(a[i].g - b[i].g) > 0.02f;
        return count;
    }
};

TEST_F(ShadowCascadesTest, PostsFromAMetreToKilometresCastTheirShadows) {
    const Scene scene = street();
    Renderer renderer;
    renderer.setScene(scene);
    const reference::PathTracer tracer(scene);
    reference::PathTracerSettings once;
    once.samplesPerPixel = 1;
    once.bounces = 0;
    once.filter = reference::PixelFilter::Center;
    for (int post = 0; post < 6; ++post) {
        const Camera camera = towardsPost(post);
        const Image truth = tracer.render(camera, kPixels, kPixels, once).direct;
        const auto dark = std::count_if(truth.pixels.begin(), truth.pixels.end(),
                                        [](const glm::vec4& pixel) { return pixel.g == 0; });
        EXPECT_GT(dark, 50) << kDistances[post];
        for (const Mode mode : {Mode::Phong, Mode::Traced}) {
            renderer.render(camera, kPixels, kPixels, direct(mode));
            EXPECT_LE(wrong(renderer.readImage(), truth), mode == Mode::Phong ? 40 : 18)
                << kDistances[post] << " m, " << (mode == Mode::Phong ? "phong" : "traced") << ", dark "
                << dark;
        }
    }
}

// The eye moves by less than a texel, by some, and by so much that maps move.
TEST_F(ShadowCascadesTest, ShadowsStayWhereTheyAreWhenTheEyeMoves) {
    for (const int post : {0, 3}) {
        Rig rig(street(), towardsPost(post), kPixels, kPixels);
        const std::vector<glm::vec4> before = rig.draw(device(), kEye);
        EXPECT_EQ(rig.cascades.redrawn(), rig.cascades.levels());
        const std::vector<glm::vec4> still = rig.draw(device(), kEye + glm::vec3(0.001f, 0, 0));
        EXPECT_EQ(rig.cascades.redrawn(), 0);
        EXPECT_EQ(still, before);
        for (const float step : {0.013f, 0.1f, 0.31f}) {
            const std::vector<glm::vec4> after =
                rig.draw(device(), kEye + step * glm::vec3(0.7f, 0.3f, 0.6f));
            EXPECT_LE(different(after, before), 2) << post << " " << step;
        }
        EXPECT_GT(rig.cascades.redrawn(), 0);
        EXPECT_LT(rig.cascades.redrawn(), rig.cascades.levels());
    }
}

// No level leaves specks, also not far from the world's origin, where floats are coarse; nor do filtered ones where one
// passes over into the next.
TEST_F(ShadowCascadesTest, LitGroundIsLitAllOverWithoutSeams) {
    Scene scene = street();
    scene.instances.resize(1);
    addInstance(scene, boxMesh(), {}, glm::translate(glm::mat4(1), {-1990, 200, -1990}));
    Camera camera;
    camera.eye = {1700, 1.5f, 1800};
    camera.target = {1600, 0, 1650};
    for (const int filter : {0, 2}) {
        Rig rig(scene, camera, 4 * kPixels, 2 * kPixels);
        rig.wanted.settings.shadowFilter = filter;
        const std::vector<glm::vec4> pixels = rig.draw(device(), camera.eye);
        const auto dark = std::count_if(pixels.begin(), pixels.end(),
                                        [](const glm::vec4& pixel) { return pixel.a > 0 && pixel.g < 0.1f; });
        EXPECT_EQ(dark, 0) << filter;
    }
}

TEST_F(ShadowCascadesTest, RoomsHaveNoneAndMemorySaysHowMany) {
    Rig room(closedBox(diffuseMaterial()), towardsPost(0), 8, 8);
    room.gpuScene.setLights(street().lights);
    room.draw(device(), kEye);
    EXPECT_EQ(room.cascades.levels(), 0);

    const LightSettings settings{.shadowSize = 1024};
    constexpr std::size_t kMap = std::size_t{12} << 20;
    EXPECT_EQ(view::cascadeLevels(16, settings, 1, 100 * kMap).count, 0);
    EXPECT_EQ(view::cascadeLevels(2000, settings, 0, 100 * kMap).count, 0);
    const view::CascadeLevels all = view::cascadeLevels(2000, settings, 1, 100 * kMap);
    EXPECT_EQ(all.count, 11);
    EXPECT_EQ(all.ratio, 2);
    const view::CascadeLevels half = view::cascadeLevels(2000, settings, 1, 6 * kMap);
    EXPECT_EQ(half.count, 6);
    EXPECT_EQ(half.ratio, 4);
    EXPECT_EQ(half.asked, 11);
    EXPECT_EQ(view::cascadeLevels(2000, settings, 50, 60 * kMap).count, 0);
    EXPECT_EQ(view::cascadeLevels(2000, {.shadowSize = 4096}, 1, 100 * kMap).size, 2048);
}

// What moves before a map's near side, towards the sun, is drawn anew too.
TEST_F(ShadowCascadesTest, FarCastersShadowTheGroundAboutTheEye) {
    Scene scene = street();
    scene.instances.resize(1);
    const glm::vec3 ground(0.4f, 0, -1);
    const glm::vec3 away = ground - 500.0f * scene.lights[0].direction;
    const auto lid = addInstance(scene, boxMesh(), {}, glm::translate(glm::mat4(1), away));
    Camera camera = cameraAbove(ground, 1, 0.5f);
    Rig rig(scene, camera, 16, 16);
    EXPECT_EQ(rig.draw(device(), camera.eye)[100].g, 0);
    scene.instances[lid].worldFromObject = glm::translate(glm::mat4(1), away + glm::vec3(30, 0, 0));
    rig.gpuScene.setInstance(lid, scene.instances[lid]);
    EXPECT_GT(rig.draw(device(), camera.eye)[100].g, 0.1f);
    EXPECT_LT(rig.cascades.redrawn(), 2 * rig.cascades.levels());
}

}  // namespace
}  // namespace conelight::test
