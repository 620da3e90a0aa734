// SPDX-License-Identifier: MIT
// Light on finely meshed and on smooth surfaces: no dark dots where the path tracer has none. Triangles are about a
// texel of the shadow map, so that edges pass through the centres of many texels.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>

#include "io/scene_file.h"
#include "support/traced_rig.h"

namespace conelight::test {
namespace {

constexpr int kPixels = 160, kBodyPixels = 112;

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

// A torus with smooth normals, about the y axis.
Mesh smoothTorus(int rings, int sides) {
    Mesh mesh;
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < sides; ++j) {
            const float a = glm::two_pi<float>() * static_cast<float>(i) / static_cast<float>(rings);
            const float b = glm::two_pi<float>() * static_cast<float>(j) / static_cast<float>(sides);
            const glm::vec3 out(std::cos(a), 0, std::sin(a));
            mesh.normals.push_back(std::cos(b) * out + std::sin(b) * glm::vec3(0, 1, 0));
            mesh.positions.push_back(0.7f * out + 0.3f * mesh.normals.back());
        }
    const auto at = [&](int i, int j) { return static_cast<std::uint32_t>((i % rings) * sides + j % sides); };
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < sides; ++j)
            for (const std::uint32_t v :
                 {at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i + 1, j)})
                mesh.indices.push_back(v);
    return mesh;
}

// The unit body in the light of a lamp, a sun and the sky, before a floor.
Scene inLight(Scene scene) {
    addInstance(scene, quadMesh({-3, -1.02f, 3}, {6, 0, 0}, {0, 0, -6}), diffuseMaterial(glm::vec3(0.5f)));
    Light sun;
    sun.type = LightType::Directional;
    sun.direction = glm::normalize(glm::vec3(0.5f, -0.6f, -1));
    sun.intensity = glm::vec3(1.5f);
    Light lamp;
    lamp.position = {-1.5f, 1.5f, 1.2f};
    lamp.intensity = glm::vec3(4);
    scene.lights = {sun, lamp};
    scene.sky = glm::vec3(0.2f);
    Camera camera;
    camera.eye = {0.4f, 0.9f, 3};
    camera.fovY = 0.75f;
    scene.cameras = {camera};
    return scene;
}

Scene bodyOf(Mesh mesh) {
    Scene scene;
    addInstance(scene, std::move(mesh), diffuseMaterial(glm::vec3(0.7f)));
    return scene;
}

// Whole, about the origin, in the size of the unit sphere.
Scene modelOf(const std::string& file) {
    Scene read = io::loadScene(file, {});
    const Aabb box = read.bounds();
    const glm::vec3 extent = box.max - box.min;
    const float scale = 2 / std::max({extent.x, extent.y, extent.z});
    for (Instance& instance : read.instances)
        instance.worldFromObject = glm::scale(glm::mat4(1), glm::vec3(scale)) *
                                   glm::translate(glm::mat4(1), -0.5f * (box.min + box.max)) *
                                   instance.worldFromObject;
    read.environment = {};
    return read;
}

// Pixels with less than two thirds of the truth's light, and of the light around them.
int darkSpecks(const Image& image, const Image& truth) {
    const auto at = [&](const Image& of, int x, int y) {
        return of.pixels[static_cast<std::size_t>(y * kBodyPixels + x)].y;
    };
    int dark = 0;
    for (int y = 1; y + 1 < kBodyPixels; ++y)
        for (int x = 1; x + 1 < kBodyPixels; ++x) {
            std::array<float, 9> own{}, there{};
            for (int i = 0; i < 9; ++i) {
                own[static_cast<std::size_t>(i)] = at(image, x + i % 3 - 1, y + i / 3 - 1);
                there[static_cast<std::size_t>(i)] = at(truth, x + i % 3 - 1, y + i / 3 - 1);
            }
            std::nth_element(own.begin(), own.begin() + 4, own.end());
            const float least = *std::min_element(there.begin(), there.end());
            dark += at(image, x, y) < 0.67f * std::min(own[4], least) ? 1 : 0;
        }
    return dark;
}

class SmoothBodiesTest : public ShadowSpecksTest {
  protected:
    void expectNoSpecks(const Scene& body, const std::string& name) {
        const Scene scene = inLight(body);
        reference::PathTracerSettings traced;
        traced.samplesPerPixel = 16;
        traced.bounces = 2;
        const Image truth =
            reference::PathTracer(scene).render(scene.cameras.at(0), kBodyPixels, kBodyPixels, traced).full;
        Renderer renderer;
        renderer.setScene(scene);
        Settings settings;
        settings.mode = Mode::Traced;
        settings.voxels.size = 64;
        renderer.render(scene.cameras.at(0), kBodyPixels, kBodyPixels, settings);
        Image image = renderer.readImage();
        EXPECT_EQ(darkSpecks(image, truth), 0) << name;
        // One would be seen.
        image.pixels.at(static_cast<std::size_t>(kBodyPixels * kBodyPixels / 2 + kBodyPixels / 4)) *= 0.5f;
        EXPECT_EQ(darkSpecks(image, truth), 1) << name;
    }
};

TEST_F(SmoothBodiesTest, TheWholePictureHasNoDarkSpecks) {
    expectNoSpecks(bodyOf(sphereMesh(96, 64)), "fine sphere");
    expectNoSpecks(bodyOf(sphereMesh(24, 16)), "coarse sphere");
    expectNoSpecks(bodyOf(smoothTorus(90, 40)), "torus");
}

TEST_F(SmoothBodiesTest, ModelsOfOthersHaveNoneEither) {
    for (const char* name : {"stanford-bunny.obj", "teapot.obj"}) {
        const std::optional<std::string> file = testData(std::string("models/") + name);
        if (!file) GTEST_SKIP() << name << " is not there";
        expectNoSpecks(modelOf(*file), name);
    }
}

}  // namespace
}  // namespace conelight::test
