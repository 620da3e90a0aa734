// SPDX-License-Identifier: MIT
// Edges of shadows in mode `traced`, where rays that meet triangles decide what coarse shadow maps leave open
// (traced.exact_shadows): against the path tracer, pixel by pixel.
#include <algorithm>
#include <cmath>

#include "support/scenes.h"
#include "support/traced_rig.h"

namespace conelight::test {
namespace {

class ExactShadows : public TracedModeTest {
  protected:
    // A white floor below slats, and a box that stands on it; seen at a slant.
    static Scene yard(const Light& light, bool sheetsLookUp = true, bool twoSided = false) {
        Scene scene;
        addInstance(scene, quadMesh({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), diffuseMaterial(glm::vec3(0.5f)));
        Material sheet = diffuseMaterial(glm::vec3(0.4f));
        sheet.doubleSided = twoSided;
        // Slats twice as wide as a texel of the maps, and as far apart.
        const glm::vec3 u(0.9f, 0.1f, 0.35f), v(-0.024f, 0, 0.061f);
        for (int i = 0; i < 8; ++i) {
            const glm::vec3 corner = glm::vec3(-0.9f, 0.6f, -0.6f) + 2.0f * static_cast<float>(i) * v;
            addInstance(scene, sheetsLookUp ? quadMesh(corner, v, u) : quadMesh(corner, u, v), sheet);
        }
        const glm::mat4 place =
            glm::rotate(glm::translate(glm::mat4(1), {0.4f, 0.2f, -1.0f}), 0.6f, {0, 1, 0});
        addInstance(scene, boxMesh(), sheet, glm::scale(place, glm::vec3(0.2f)));
        scene.lights = {light};
        Camera camera;
        camera.eye = {0.2f, 3.2f, 2.2f};
        camera.target = {0, 0, -0.1f};
        camera.fovY = 0.75f;
        scene.cameras = {camera};
        return scene;
    }
    static Light sun() {
        Light light;
        light.type = LightType::Directional;
        light.direction = glm::normalize(glm::vec3(0.35f, -1, -0.3f));
        light.intensity = glm::vec3(3);
        return light;
    }
    static Light lamp() {
        Light light;
        light.type = LightType::Point;
        light.position = {-0.3f, 2.1f, 0.4f};
        light.intensity = glm::vec3(6);
        return light;
    }
    static Settings settings(bool exact) {
        Settings settings = tracedSettings(Quality::Interactive, Component::Direct);
        settings.voxels.size = 48;
        settings.light.shadowSize = 128;
        settings.traced.exactShadows = exact;
        return settings;
    }
    // Pixels of direct light that are lit where the path tracer's are not, or the other way round.
    static int wrong(const Image& image, const reference::PathTracedPicture& truth) {
        float brightest = 0;
        for (const auto& pixel : truth.direct.pixels) brightest = std::max(brightest, pixel.g);
        int count = 0;
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            count += std::fabs(image.pixels[i].g - truth.direct.pixels[i].g) > 0.1f * brightest;
        return count;
    }
    static reference::PathTracedPicture truthOf(const Scene& scene) {
        reference::PathTracerSettings wanted;
        wanted.samplesPerPixel = 2;
        wanted.bounces = 0;
        return reference::PathTracer(scene).render(scene.cameras.at(0), kTracedPixels, kTracedPixels, wanted);
    }
};

TEST_F(ExactShadows, EdgesAreThoseOfTriangles) {
    for (const Light& light : {sun(), lamp()})
        for (const bool up : {true, false})
            for (const bool twoSided : {false, true}) {
                const Scene scene = yard(light, up, twoSided);
                const reference::PathTracedPicture truth = truthOf(scene);
                const int exact = wrong(draw(scene, settings(true)), truth);
                const int maps = wrong(draw(scene, settings(false)), truth);
                EXPECT_LE(exact, 2) << up << twoSided << " maps " << maps;
                EXPECT_GE(maps, 12) << up << twoSided;
            }
}

TEST_F(ExactShadows, WhatCastsNoneHidesNothing) {
    Scene scene = yard(sun());
    for (Instance& instance : scene.instances) instance.castsShadow = false;
    EXPECT_EQ(draw(scene, settings(true)).pixels, draw(scene, settings(false)).pixels);
    EXPECT_LE(wrong(draw(scene, settings(true)), truthOf(scene)), 2);
}

// Rays see what is in the voxels. Where something else casts shadows, maps answer alone.
TEST_F(ExactShadows, CastersOutsideVoxelsLeaveItToMaps) {
    Scene scene = yard(sun());
    scene.instances.back().voxelized = false;
    EXPECT_EQ(draw(scene, settings(true)).pixels, draw(scene, settings(false)).pixels);
}

// A mask's texels cut the shadow as they cut the surface.
TEST_F(ExactShadows, MasksCutTheShadow) {
    Scene scene = yard(sun());
    Material sheet = diffuseMaterial(glm::vec3(0.4f));
    sheet.doubleSided = true;
    Mesh mesh = quadMesh({-0.8f, 0.7f, 0.9f}, {1.1f, 0, 0.3f}, {0.3f, 0, -0.9f});
    mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    sheet.alphaMode = AlphaMode::Mask;
    sheet.baseColorTexture.texture = 0;
    // In the slats' place.
    scene.instances.erase(scene.instances.begin() + 1, scene.instances.end());
    addInstance(scene, std::move(mesh), sheet);
    Texture grid;
    grid.name = "holes";
    grid.width = grid.height = 8;
    for (int i = 0; i < 64; ++i) {
        const bool hole = i % 8 >= 2 && i % 8 < 6 && i / 8 >= 2 && i / 8 < 6;
        grid.rgba.insert(grid.rgba.end(), {255, 255, 255, static_cast<std::uint8_t>(hole ? 0 : 255)});
    }
    grid.filter = TextureFilter::Nearest;
    scene.textures.push_back(grid);
    const reference::PathTracedPicture truth = truthOf(scene);
    const int exact = wrong(draw(scene, settings(true)), truth);
    const int maps = wrong(draw(scene, settings(false)), truth);
    EXPECT_LT(exact, maps);
    EXPECT_LE(exact, 3);
}

// More lights than the picture has bits: the others are looked up in their maps.
TEST_F(ExactShadows, ManyLightsAreAllThere) {
    Scene scene = yard(sun());
    scene.lights.clear();
    for (int i = 0; i < 36; ++i) {
        Light light = lamp();
        light.position.x = -1.5f + 0.08f * static_cast<float>(i);
        light.intensity = glm::vec3(0.2f);
        scene.lights.push_back(light);
    }
    const reference::PathTracedPicture truth = truthOf(scene);
    EXPECT_NEAR(meanOf(draw(scene, settings(true))) / meanOf(draw(scene, settings(false))), 1, 0.01);
    EXPECT_NEAR(meanOf(draw(scene, settings(true))) / meanOf(truth.direct), 1, 0.03);
}

}  // namespace
}  // namespace conelight::test
